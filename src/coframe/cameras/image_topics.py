# SPDX-License-Identifier: Apache-2.0
"""Names of image topics: where the CameraInfo of an image is, and whether the image is rectified."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Collection

__all__ = ["camera_info_topic", "is_rectified_topic"]

_TRANSPORT = re.compile(r"(compressed(depth)?|theora|ffmpeg|zstd|avif|h26\d|draco)", re.IGNORECASE)
_RECTIFIED = {"rect", "rectified"}
_NOT_RECTIFIED = {"raw", "unrect", "unrectified", "distorted"}


def is_rectified_topic(topic: str) -> bool:
    """Return whether the name of an image topic is that of a rectified image.

    Example:
        >>> is_rectified_topic("/left/image_rect/compressed"), is_rectified_topic("/direct_cam/image_raw")
        (True, False)
    """
    *namespaces, last = _raw_parts(topic)
    if _words(last) & _RECTIFIED:
        return True
    return not _words(last) & _NOT_RECTIFIED and any(_words(part) & _RECTIFIED for part in namespaces)


def camera_info_topic(image: str, topics: Collection[str] | None = None) -> str:
    """Return the topic of the CameraInfo of an image: next to the raw image, as in image_transport.

    Args:
        image: The topic of the image.
        topics: The existing CameraInfo topics. If there is none next to the image, the only one in a namespace above it
            is chosen. None: do not look for others.

    Example:
        >>> camera_info_topic("/left/image_raw/compressed")
        '/left/camera_info'
        >>> camera_info_topic("/left/rgb/image_raw", ["/left/info", "/right/info"])
        '/left/info'
    """
    parts = image.split("/")
    while len(parts) > 1 and _TRANSPORT.fullmatch(parts[-1]):
        parts.pop()
    usual = "/".join([*parts[:-1], "camera_info"])
    for end in range(len(parts) - 1, 0, -1):
        folder = "/".join(parts[:end]) + "/"
        if f"{folder}camera_info" in (topics or ()):
            return f"{folder}camera_info"
        below = [topic for topic in topics or () if topic.startswith(folder)]
        if below:
            return below[0] if len(below) == 1 else usual
    return usual


def _raw_parts(topic: str) -> list[str]:
    return [part for part in topic.split("/") if not _TRANSPORT.fullmatch(part)] or [""]


def _words(part: str) -> set[str]:
    return set(re.split("[_-]", part.lower()))
