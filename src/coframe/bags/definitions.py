"""What types are made of, as text that stands in a recording and makes it readable without ROS."""

from __future__ import annotations

import functools
from typing import Any

__all__ = ["definition_of"]


@functools.cache
def definition_of(ros_type: str) -> str:
    """The definition of a type and of all types in it, as ``ros2msg``; "" where coframe does not know the type.

    Known are the packages that come with ROS 2 Humble, if rosbags is installed.
    """
    try:
        from rosbags.typesys import Stores, get_typestore  # noqa: PLC0415 - optional, and slow to import
    except ModuleNotFoundError:
        return ""
    store: Any = get_typestore(Stores.ROS2_HUMBLE)
    if ros_type not in store.fielddefs:
        return ""
    text, _ = store.generate_msgdef(ros_type, ros_version=2)
    return str(text)
