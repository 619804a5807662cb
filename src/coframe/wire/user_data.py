# SPDX-License-Identifier: Apache-2.0
"""The DDS user data of endpoints: pairs ``key=value;``. From Iron on, ROS 2 shows the type hash to its users."""

from __future__ import annotations

import re

TF_MESSAGE = "tf2_msgs/msg/TFMessage"
# Computing it would import message classes, which a process that only receives transforms does not need.
TF_MESSAGE_HASH = "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"

_TYPE_HASH = re.compile(rb"(?:^|;)typehash=(RIHS01_[0-9a-f]{64});")


def endpoint_user_data(ros_type: str, extra: str = "") -> str:
    """Return the user data of an endpoint.

    Args:
        ros_type: The type of its messages, such as "sensor_msgs/msg/LaserScan".
        extra: More pairs.
    """
    hashed = TF_MESSAGE_HASH if ros_type == TF_MESSAGE else _computed(ros_type)
    return f"typehash={hashed};{extra}" if hashed else extra


def type_hash_of(user_data: bytes) -> str:
    """Return the type hash in the user data of an endpoint; "" if there is none, as in Humble."""
    found = _TYPE_HASH.search(user_data)
    return found[1].decode() if found else ""


def _computed(ros_type: str) -> str:
    """Return the hash of a type; "" if it is not known in this process."""
    from coframe.messages.registry import find  # noqa: PLC0415 - importing coframe.wire must be cheap
    from coframe.messages.type_hash import type_hash  # noqa: PLC0415

    try:
        return type_hash(find(ros_type))
    except LookupError:
        return ""
