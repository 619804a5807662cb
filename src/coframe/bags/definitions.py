# SPDX-License-Identifier: Apache-2.0
"""Definitions of message types as text; stored in a recording, they make it readable without ROS."""

from __future__ import annotations

import functools
from typing import Any

__all__ = ["definition_of"]


@functools.cache
def definition_of(ros_type: str) -> str:
    """Return the definition of a type and of all types it contains, as ``ros2msg``; "" if the type is unknown.

    The types of the packages of ROS 2 Humble are known if the package rosbags is installed.
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
