# SPDX-License-Identifier: Apache-2.0
"""The DDS user data of endpoints: pairs ``key=value;``. ROS 2 Iron and later show the type hash to users."""

from __future__ import annotations

import re

from coframe.wire.type_hashes import type_hash_of_name

REQUESTS_HISTORY = "coframe=history;"
"""Marks a reader that exists only to request the history of writers. It belongs to no node and is not shown."""

_TYPE_HASH = re.compile(rb"(?:^|;)typehash=(RIHS01_[0-9a-f]{64});")


def endpoint_user_data(ros_type: str, extra: str = "") -> str:
    """Return the user data of an endpoint.

    Args:
        ros_type: The type of its messages, such as "sensor_msgs/msg/LaserScan".
        extra: Additional pairs.
    """
    hashed = type_hash_of_name(ros_type)
    return f"typehash={hashed};{extra}" if hashed else extra


def type_hash_of(user_data: bytes) -> str:
    """Return the type hash in the user data of an endpoint, or "" if there is none, as in Humble."""
    found = _TYPE_HASH.search(user_data)
    return found[1].decode() if found else ""
