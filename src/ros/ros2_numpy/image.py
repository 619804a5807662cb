# SPDX-License-Identifier: Apache-2.0
"""Images as arrays."""

from typing import Any

from numpy.typing import NDArray

from cv_bridge import CvBridge
from ros2_numpy.registry import converts_from_numpy, converts_to_numpy
from sensor_msgs.msg import Image

__all__ = ["image_to_numpy", "numpy_to_image"]

_BRIDGE = CvBridge()


@converts_to_numpy(Image)
def image_to_numpy(msg: Image) -> NDArray[Any]:
    """Return the pixels of an image, shape (height, width[, channels]), a view of the message where possible.

    Raises:
        TypeError: There is no such encoding, or the data does not have the size of the image.
    """
    return _BRIDGE.imgmsg_to_cv2(msg)


@converts_from_numpy(Image)
def numpy_to_image(arr: NDArray[Any], encoding: str) -> Image:
    """Return an image message.

    Args:
        arr: Pixels, shape (height, width[, channels]).
        encoding: Encoding of the pixels, such as "rgb8".

    Raises:
        TypeError: There is no such encoding, or the array does not have its type.
    """
    return _BRIDGE.cv2_to_imgmsg(arr[..., 0] if arr.ndim == 3 and arr.shape[2] == 1 else arr, encoding)
