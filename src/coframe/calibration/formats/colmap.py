# SPDX-License-Identifier: Apache-2.0
"""COLMAP: a folder with cameras and images, as text or binary."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.calibration._values import Place, camera
from coframe.calibration.rig import Rig
from coframe.errors import CalibrationError

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from coframe.cameras import CameraModel
    from coframe.transform.transform import Transform

__all__ = ["CONVENTION", "colmap_files", "read_binary_files", "read_text_files"]

CONVENTION = (
    "an image's pose transforms points from the world into the camera: quaternion w, x, y, z, then the translation; "
    "optical axes, the unit of the reconstruction, here meters; (0.5, 0.5) is the center of the upper left pixel"
)
MAX_IMAGES = 1_000_000
MAX_NAME = 4096  # bytes of the name of an image
# By number: the name, the number of parameters, and the name of the lens.
_MODELS: tuple[tuple[str, int, str | None], ...] = (
    ("SIMPLE_PINHOLE", 3, ""),
    ("PINHOLE", 4, ""),
    ("SIMPLE_RADIAL", 4, "plumb_bob"),
    ("RADIAL", 5, "plumb_bob"),
    ("OPENCV", 8, "plumb_bob"),
    ("OPENCV_FISHEYE", 8, "equidistant"),
    ("FULL_OPENCV", 12, "rational_polynomial"),
    ("FOV", 5, "fov"),
    ("SIMPLE_RADIAL_FISHEYE", 4, "equidistant"),
    ("RADIAL_FISHEYE", 5, "equidistant"),
    ("THIN_PRISM_FISHEYE", 12, None),
    ("RAD_TAN_THIN_PRISM_FISHEYE", 16, None),
    ("SIMPLE_DIVISION", 4, None),
    ("DIVISION", 5, None),
    ("SIMPLE_FISHEYE", 3, "equidistant"),
    ("FISHEYE", 4, "equidistant"),
    ("EUCM", 6, "eucm"),
    ("EQUIRECTANGULAR", 2, None),
)
_ONE_FOCAL_LENGTH = {
    "SIMPLE_PINHOLE",
    "SIMPLE_RADIAL",
    "RADIAL",
    "SIMPLE_RADIAL_FISHEYE",
    "RADIAL_FISHEYE",
    "SIMPLE_FISHEYE",
}
_COEFFICIENTS = {"plumb_bob": 4, "equidistant": 4, "rational_polynomial": 8, "fov": 1, "eucm": 2, "": 0}


def read_text_files(cameras: str, images: str, folder: str) -> Rig:
    """Return the rig of cameras.txt and images.txt."""
    found: dict[int, CameraModel] = {}
    place = Place(None, f"{folder}/cameras.txt")
    for line in _lines(cameras):
        words = line.split()
        try:
            number, size = int(words[0]), (int(words[2]), int(words[3]))
            found[number] = _camera(place, words[1], size, [float(word) for word in words[4:]], number)
        except (IndexError, ValueError) as error:
            if isinstance(error, CalibrationError):
                raise
            place.fail(f"has the line {line[:60]!r}, not CAMERA_ID MODEL WIDTH HEIGHT PARAMS...")
    place = Place(None, f"{folder}/images.txt")
    mounts = []
    # Each image has a second line with its points, which may be empty.
    for line in images.splitlines():
        words = line.split(maxsplit=9)
        if not line.strip() or line.lstrip().startswith("#") or not _is_image(words):
            continue
        try:
            numbers = [float(word) for word in words[1:8]]
        except ValueError:
            place.fail(f"has the line {line[:60]!r}, not IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME")
        mounts.append(_mount(place, numbers, words[9].strip()))
    return _rig(mounts, found)


def _is_image(words: list[str]) -> bool:
    """Return whether a line is that of an image; those of points have three numbers for each point."""
    if len(words) != 10:
        return False
    try:
        float(words[9].split()[0])
    except ValueError:
        return True
    # A name may be a number; a point's line goes on with numbers, and its third one is a whole number.
    return len(words[9].split()) == 1 and "." not in words[0]


def read_binary_files(cameras: bytes, images: bytes, folder: str) -> Rig:
    """Return the rig of cameras.bin and images.bin."""
    reader = _Reader(cameras, f"{folder}/cameras.bin")
    found: dict[int, CameraModel] = {}
    for _ in range(reader.count(24)):
        number, model, width, height = reader.take("<IiQQ")
        if not 0 <= model < len(_MODELS):
            reader.fail(f"has a camera with the unknown model {model}")
        name, size, _ = _MODELS[model]
        found[number] = _camera(reader.place, name, (width, height), reader.take(f"<{size}d"), number)
    reader = _Reader(images, f"{folder}/images.bin")
    mounts = []
    for _ in range(reader.count(64)):
        _, *numbers, _ = reader.take("<I7dI")
        name = reader.text()
        (points,) = reader.take("<Q")
        reader.skip(points * 24)
        mounts.append(_mount(reader.place, numbers, name))
    return _rig(mounts, found)


class _Reader:
    """Values of a binary file; every length is checked."""

    def __init__(self, data: bytes, file: str) -> None:
        self.place = Place(None, file)
        self._data = data
        self._at = 0

    def fail(self, reason: str) -> None:
        self.place.fail(reason)

    def take(self, layout: str) -> tuple[Any, ...]:
        size = struct.calcsize(layout)
        self.skip(size)
        return struct.unpack_from(layout, self._data, self._at - size)

    def skip(self, size: int) -> None:
        if size > len(self._data) - self._at:
            self.fail(f"ends early: after {len(self._data)} bytes")
        self._at += size

    def count(self, smallest: int) -> int:
        (number,) = self.take("<Q")
        if number * smallest > len(self._data) or number > MAX_IMAGES:
            self.fail(f"states {number} entries in {len(self._data)} bytes")
        return int(number)

    def text(self) -> str:
        end = self._data.find(b"\0", self._at, self._at + MAX_NAME)
        if end < 0:
            self.fail("has a name without an end")
        found = self._data[self._at : end].decode("utf-8", "replace")
        self._at = end + 1
        return found


def _lines(text: str) -> Iterator[str]:
    return (line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#"))


def _camera(place: Place, name: str, size: tuple[int, int], parameters: Sequence[float], number: int) -> CameraModel:
    known = {model[0]: model for model in _MODELS}
    lens = known[name][2] if name in known else None
    if lens is None:
        supported = ", ".join(model[0] for model in _MODELS if model[2] is not None)
        place.fail(f"has a camera with the model {name[:40]!r}, which is not supported", f"Supported: {supported}.")
    if len(parameters) != known[name][1]:
        place.fail(f"has a camera {name} with {len(parameters)} parameters, not {known[name][1]}")
    values = list(parameters)
    focal = values[:1] * 2 + values[1:3] if name in _ONE_FOCAL_LENGTH else values[:4]
    rest = values[3:] if name in _ONE_FOCAL_LENGTH else values[4:]
    rest += [0.0] * (_COEFFICIENTS[lens] - len(rest))
    focal = [*focal[:2], focal[2] - 0.5, focal[3] - 0.5]
    return camera(place, (int(size[0]), int(size[1])), focal, (lens, rest), f"camera{number}")


def _mount(place: Place, numbers: Sequence[float], name: str) -> Transform:
    pose = place.pose(numbers[4:7], np.roll(numbers[:4], -1))
    return pose.inverse().replace(target="world", source=name)


def _rig(mounts: list[Transform], cameras: dict[int, CameraModel]) -> Rig:
    return Rig(tuple(mounts), {f"camera{number}": model for number, model in cameras.items()}, {}, "COLMAP", CONVENTION)


def colmap_files(rig: Rig) -> dict[str, str]:
    """Return cameras.txt, images.txt and an empty points3D.txt: one image for each camera, with the name of its frame.

    Raises:
        CalibrationError: There are no cameras with a pose, or COLMAP has no model for a lens.
    """
    with_pose = {name: model for name, model in rig.cameras.items() if model.frame in rig.frames}
    if not with_pose:
        raise CalibrationError("a reconstruction of COLMAP needs cameras whose frames have a pose")
    cameras, images, buffer = list[str](), list[str](), rig.buffer()
    for number, (name, model) in enumerate(with_pose.items(), 1):
        kind, rest = _model_of(name, model)
        k = model.k
        values = [k[0, 0], k[1, 1], k[0, 2] + 0.5, k[1, 2] + 0.5, *rest]
        cameras.append(f"{number} {kind} {model.width} {model.height} {_words(values)}")
        if model.frame.split() != [model.frame]:
            raise CalibrationError(f"COLMAP permits no spaces in the names of images: {model.frame!r}")
        pose = buffer.lookup(model.frame, rig.frames[0])
        numbers = _words([*np.roll(pose.quaternion, 1), *pose.translation])
        images += [f"{number} {numbers} {number} {model.frame}", ""]
    texts = {"cameras.txt": cameras, "images.txt": images, "points3D.txt": []}
    return {name: "\n".join(["# Written by coframe", *lines, ""]) for name, lines in texts.items()}


def _model_of(name: str, model: CameraModel) -> tuple[str, list[float]]:
    lens, d = model.lens.name, list(model.lens.coefficients)
    if not any(d) and lens == "plumb_bob":
        return "PINHOLE", []
    if lens == "plumb_bob" and not any(d[4:]):
        return "OPENCV", (d + [0.0] * 4)[:4]
    if lens in {"plumb_bob", "rational_polynomial"} and not any(d[8:]):
        return "FULL_OPENCV", (d + [0.0] * 8)[:8]
    names = {"equidistant": "OPENCV_FISHEYE", "fov": "FOV", "eucm": "EUCM"}
    if lens not in names:
        raise CalibrationError(f"COLMAP has no model for the lens of {name}: {lens} with {len(d)} coefficients")
    return names[lens], d


def _words(values: Iterable[float]) -> str:
    return " ".join(repr(float(value) + 0.0) for value in values)
