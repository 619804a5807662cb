# SPDX-License-Identifier: Apache-2.0
"""Encoder of `action_msgs/GoalStatusArray`, the message on the status topic of an action.

A busy server publishes the message several times per goal, and each message contains all goals. Encoding the entries
separately avoids serializing all goals each time.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Iterable

_HEADER: Final = b"\x00\x01\x00\x00"  # CDR, little-endian
_COUNT: Final = struct.Struct("<I")
# CDR aligns the stamp to 4 bytes, so there are 3 bytes of padding before it, except in the first entry.
_ENTRY: Final = struct.Struct("<16s3xiIb")
_GAP: Final = slice(16, 19)


def encode_entry(goal_info: Any, status: int) -> bytes:
    """Return the encoded entry of a goal.

    Args:
        goal_info: The `action_msgs/GoalInfo` of the goal.
        status: A status constant of `action_msgs/GoalStatus`.
    """
    stamp = goal_info.stamp
    return _ENTRY.pack(bytes(goal_info.goal_id.uuid), stamp.sec, stamp.nanosec, status)


def encode_statuses(entries: Iterable[bytes]) -> bytes:
    """Return the serialized message with the encoded entries of goals."""
    body = b"".join(entries)
    return _HEADER + _COUNT.pack(len(body) // _ENTRY.size) + body[: _GAP.start] + body[_GAP.stop :]
