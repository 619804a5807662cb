# SPDX-License-Identifier: Apache-2.0
"""The encodings of `sensor_msgs/Image`, whose names upstream lists in the C++ header `image_encodings.hpp`.

OpenCV describes pixels by a number, its type: the number of the depth plus eight times one less than the channels.
"""

import re
from typing import NamedTuple

__all__ = ["DEPTHS", "Encoding", "cv_type", "find"]

# NumPy's names by the number of OpenCV's depth, and OpenCV's own names.
DEPTHS = ("uint8", "int8", "uint16", "int16", "int32", "float32", "float64")
_DEPTH_NAMES = ("8U", "8S", "16U", "16S", "32S", "32F", "64F")
_GENERIC = re.compile(r"(8U|8S|16U|16S|32S|32F|64F)(?:C([0-9]{1,3}))?")
_MAX_CHANNELS = 512  # of OpenCV


class Encoding(NamedTuple):
    """The meaning of an encoding name.

    Attributes:
        depth: Number of OpenCV's depth, the index in `DEPTHS`.
        channels: Values per pixel.
        colors: OpenCV's name of the colors, such as "BGR", "BayerBG", "UYVY". "": the values are not colors.
    """

    depth: int
    channels: int
    colors: str

    @property
    def dtype(self) -> str:
        """NumPy's name of the type of a value."""
        return DEPTHS[self.depth]

    @property
    def bits(self) -> int:
        """Bits of a value."""
        return int(re.sub(r"\D", "", self.dtype))

    @property
    def name(self) -> str:
        """OpenCV's name of the type, such as 8UC3."""
        return f"{_DEPTH_NAMES[self.depth]}C{self.channels}"

    def rows(self, height: int) -> int:
        """Return the rows of the array of an image. NV21 and NV24 store the colors after the brightness."""
        return {"NV21": height + height // 2, "NV24": 3 * height}.get(self.colors, height)


# OpenCV names Bayer patterns by the second row's second and third pixel, ROS by the first two rows' first two pixels.
_BAYER = {"rggb": "BayerBG", "bggr": "BayerRG", "gbrg": "BayerGR", "grbg": "BayerGB"}
_NAMED = {
    **{f"{name}{bits}": Encoding(depth, len(name), name.upper())
       for name in ("rgb", "rgba", "bgr", "bgra") for bits, depth in ((8, 0), (16, 2))},
    **{f"mono{bits}": Encoding(depth, 1, "GRAY") for bits, depth in ((8, 0), (16, 2))},
    **{f"bayer_{name}{bits}": Encoding(depth, 1, colors)
       for name, colors in _BAYER.items() for bits, depth in ((8, 0), (16, 2))},
    **dict.fromkeys(("yuv422", "uyvy"), Encoding(0, 2, "UYVY")),
    **dict.fromkeys(("yuv422_yuy2", "yuyv"), Encoding(0, 2, "YUY2")),
    "nv21": Encoding(0, 1, "NV21"),
    "nv24": Encoding(0, 1, "NV24"),
}  # fmt: skip


def find(name: str) -> Encoding:
    """Return the meaning of an encoding.

    Raises:
        RuntimeError: There is no such encoding.
    """
    if name in _NAMED:
        return _NAMED[name]
    match = _GENERIC.fullmatch(name)
    channels = int(match[2] or 1) if match else 0
    if match is None or not 1 <= channels <= _MAX_CHANNELS:
        raise RuntimeError(f"Unrecognized image encoding [{name}]")
    return Encoding(_DEPTH_NAMES.index(match[1]), channels, "")


def cv_type(encoding: Encoding) -> int:
    """Return the number of OpenCV's type."""
    return encoding.depth + ((encoding.channels - 1) << 3)
