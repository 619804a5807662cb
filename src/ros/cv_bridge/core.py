# SPDX-License-Identifier: Apache-2.0
"""Conversion between images as messages and as arrays: CvBridge."""

import sys
from array import array
from typing import Any

import numpy as np
from numpy.typing import NDArray

from coframe.sensors import encodings
from cv_bridge._conversion import opencv
from cv_bridge.boost.cv_bridge_boost import CV_MAT_CNWrap, CV_MAT_DEPTHWrap, cvtColor2, getCvType
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import Header

__all__ = ["CvBridge", "CvBridgeError"]

Pixels = NDArray[Any]

_CHANNELS = (1, 2, 3, 4)
_COLORS = {1: "mono", 3: "bgr", 4: "bgra"}


class CvBridgeError(TypeError):
    """An image could not be converted."""


class CvBridge:
    """Converter between image messages and the arrays of OpenCV, which have the shape (height, width[, channels]).

    Attributes:
        cvtype_to_name: Names such as "8UC3" by the number of OpenCV's type.
        cvdepth_to_numpy_depth: NumPy's names by the number of OpenCV's depth.
        numpy_type_to_cvtype: Names such as "8U" by NumPy's name, and the other way round.
    """

    def __init__(self) -> None:
        generic = [
            encodings.Encoding(depth, channels, "") for depth in range(len(encodings.DEPTHS)) for channels in _CHANNELS
        ]
        self.cvtype_to_name = {encodings.cv_type(encoding): encoding.name for encoding in generic}
        self.cvdepth_to_numpy_depth = dict(enumerate(encodings.DEPTHS))
        self.numpy_type_to_cvtype = {encoding.dtype: encoding.name[:-2] for encoding in generic}
        self.numpy_type_to_cvtype.update({name: dtype for dtype, name in self.numpy_type_to_cvtype.items()})

    def dtype_with_channels_to_cvtype2(self, dtype: np.dtype[Any], n_channels: int) -> str:
        """Return the name of a type of OpenCV, such as "8UC3".

        Raises:
            CvBridgeError: Images of OpenCV cannot have values of this type.
        """
        if dtype.name not in encodings.DEPTHS:
            raise CvBridgeError(
                f"An image message cannot have values of type {dtype.name}. Use astype() to convert them to one of "
                f"{', '.join(encodings.DEPTHS)}."
            )
        return f"{self.numpy_type_to_cvtype[dtype.name]}C{n_channels}"

    def cvtype2_to_dtype_with_channels(self, cvtype: int) -> tuple[str, int]:
        """Return the NumPy type name and the number of channels of an OpenCV type."""
        return self.cvdepth_to_numpy_depth[CV_MAT_DEPTHWrap(cvtype)], CV_MAT_CNWrap(cvtype)

    def encoding_to_cvtype2(self, encoding: str) -> int:
        """Return the number of OpenCV's type for an encoding.

        Raises:
            CvBridgeError: There is no such encoding.
        """
        try:
            return getCvType(encoding)
        except RuntimeError as error:
            raise CvBridgeError(error) from error

    def encoding_to_dtype_with_channels(self, encoding: str) -> tuple[str, int]:
        """Return NumPy's name of the values of an encoding, and the number of channels.

        Raises:
            CvBridgeError: There is no such encoding.
        """
        return self.cvtype2_to_dtype_with_channels(self.encoding_to_cvtype2(encoding))

    def imgmsg_to_cv2(self, img_msg: Image, desired_encoding: str = "passthrough") -> Pixels:
        """Return the pixels of an image message.

        Args:
            img_msg: The message.
            desired_encoding: Encoding of the result. "passthrough" keeps the encoding of the message.

        Returns:
            Array of shape (height, width) or (height, width, channels), which is a view of the data of the message if
            nothing has to be converted. NV21 and NV24 have their color values below the brightness.

        Raises:
            CvBridgeError: There is no such encoding or conversion, or the data does not have the size of the image.
            ModuleNotFoundError: OpenCV is needed and not installed.
        """
        pixels = self.__pixels(img_msg)
        return pixels if desired_encoding == "passthrough" else _convert(pixels, img_msg.encoding, desired_encoding)

    def compressed_imgmsg_to_cv2(
        self, cmprs_img_msg: CompressedImage, desired_encoding: str = "passthrough"
    ) -> Pixels | None:
        """Return the pixels of a compressed image.

        Args:
            cmprs_img_msg: The message, in any format that OpenCV reads.
            desired_encoding: Encoding of the result. "passthrough": gray, BGR or BGRA, as in the file.

        Returns:
            Array of shape (height, width) or (height, width, channels). None: OpenCV cannot read the data, and the
            desired encoding is "passthrough".

        Raises:
            CvBridgeError: The data cannot be read or converted.
            ModuleNotFoundError: OpenCV is not installed.
        """
        cv2 = opencv("Reading compressed images with cv_bridge")
        data = np.frombuffer(cmprs_img_msg.data, np.uint8)
        pixels: Pixels | None = cv2.imdecode(data, cv2.IMREAD_UNCHANGED) if data.size else None
        if desired_encoding == "passthrough":
            return pixels
        if pixels is None:
            raise CvBridgeError(
                f"OpenCV cannot read the {data.size} bytes of the compressed image, whose format is "
                f"'{cmprs_img_msg.format}'."
            )
        colors = _COLORS[pixels.shape[2] if pixels.ndim > 2 else 1]
        return _convert(pixels, f"{colors}{8 * pixels.itemsize}", desired_encoding)

    def cv2_to_imgmsg(self, cvim: Pixels, encoding: str = "passthrough", header: Header | None = None) -> Image:
        """Return an image message with a copy of pixels.

        Args:
            cvim: Array of shape (height, width) or (height, width, channels).
            encoding: Encoding of the message. "passthrough": the type of OpenCV, such as "8UC3", without colors.
            header: Header of the message.

        Raises:
            TypeError: The image is not an array.
            CvBridgeError: The array does not have the type of the encoding.
        """
        if not isinstance(cvim, np.ndarray):
            raise TypeError("Your input type is not a numpy array")
        message = Image(height=cvim.shape[0], width=cvim.shape[1])
        if header is not None:
            message.header = header
        channels = 1 if cvim.ndim < 3 else cvim.shape[2]
        cv_type = self.dtype_with_channels_to_cvtype2(cvim.dtype, channels)
        message.encoding = cv_type
        if encoding != "passthrough":
            message.encoding = encoding
            dtype, wanted = self.encoding_to_dtype_with_channels(encoding)
            if (dtype, wanted) != (cvim.dtype.name, channels):
                raise CvBridgeError(f"encoding specified as {encoding}, but image has incompatible type {cv_type}")
            message.height = _height(encoding, cvim.shape[0])
        message.is_bigendian = int(_is_big_endian(cvim.dtype))
        message.step = cvim.shape[1] * channels * cvim.itemsize
        message.data = _bytes(cvim)
        return message

    def cv2_to_compressed_imgmsg(self, cvim: Pixels, dst_format: str = "jpg") -> CompressedImage:
        """Return a compressed image.

        Args:
            cvim: Array of shape (height, width) or (height, width, channels): gray, BGR or BGRA.
            dst_format: Suffix of a format that OpenCV writes, such as "jpg" or "png".

        Raises:
            TypeError: The image is not an array.
            CvBridgeError: OpenCV cannot write the image in this format.
            ModuleNotFoundError: OpenCV is not installed.
        """
        if not isinstance(cvim, np.ndarray):
            raise TypeError("Your input type is not a numpy array")
        cv2 = opencv("Compressing images with cv_bridge")
        try:
            _, data = cv2.imencode(f".{dst_format}", cvim)
        except cv2.error as error:
            raise CvBridgeError(f"OpenCV cannot write the image as '{dst_format}': {error}") from error
        message = CompressedImage(format=dst_format)
        message.data = _bytes(data)
        return message

    def __pixels(self, message: Image) -> Pixels:
        """Return a view of the data of a message, or a copy without padding and in the byte order of this machine."""
        name, channels = self.encoding_to_dtype_with_channels(message.encoding)
        dtype = np.dtype(name).newbyteorder(">" if message.is_bigendian else "<")
        rows, row_size = (
            encodings.find(message.encoding).rows(message.height),
            message.width * channels * dtype.itemsize,
        )
        step, size = message.step, memoryview(message.data).nbytes
        if step < row_size or size < step * rows:
            raise CvBridgeError(
                f"The data of the image does not have the size of the image: {message.width} x {message.height} "
                f"{message.encoding} needs {rows} rows of at least {row_size} bytes, but step is {step}, and data has "
                f"{size} bytes."
            )
        shape: tuple[int, ...] = (rows, message.width)
        strides: tuple[int, ...] = (step, channels * dtype.itemsize)
        if channels > 1:
            shape, strides = (*shape, channels), (*strides, dtype.itemsize)
        pixels: Pixels = np.ndarray(shape, dtype, buffer=message.data, strides=strides)
        return np.ascontiguousarray(pixels, dtype=dtype.newbyteorder("="))


def _convert(pixels: Pixels, source: str, target: str) -> Pixels:
    try:
        return cvtColor2(pixels, source, target)
    except RuntimeError as error:
        raise CvBridgeError(error) from error


def _is_big_endian(dtype: np.dtype[Any]) -> bool:
    return dtype.byteorder == ">" or (dtype.byteorder == "=" and sys.byteorder == "big")


def _height(encoding: str, rows: int) -> int:
    """Return the height of an image from the rows of its array, which are more for NV21 and NV24."""
    return rows * 2 // encodings.find(encoding).rows(2)


def _bytes(pixels: Pixels) -> "array[int]":
    data = array("B")
    if pixels.size:
        data.frombytes(np.ascontiguousarray(pixels).reshape(-1).view(np.uint8).data)
    return data
