"""What the topic of an action's status carries: an `action_msgs/GoalStatusArray`, written by hand.

A busy server writes it several times for each goal, and every time it tells of all goals.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Iterable

_HEADER: Final = b"\x00\x01\x00\x00"  # of CDR, little endian
_COUNT: Final = struct.Struct("<I")
# Numbers begin at multiples of 4, so there is a gap before the stamp; not in the first entry, which begins at one.
_ENTRY: Final = struct.Struct("<16s3xiIb")
_GAP: Final = slice(16, 19)


def encode_entry(goal_info: Any, status: int) -> bytes:
    """Returns one goal's part.

    Args:
        goal_info: An `action_msgs/GoalInfo`.
        status: One of the numbers of `action_msgs/GoalStatus`.
    """
    stamp = goal_info.stamp
    return _ENTRY.pack(bytes(goal_info.goal_id.uuid), stamp.sec, stamp.nanosec, status)


def encode_statuses(entries: Iterable[bytes]) -> bytes:
    """Returns the serialised message with these goals' parts."""
    body = b"".join(entries)
    return _HEADER + _COUNT.pack(len(body) // _ENTRY.size) + body[: _GAP.start] + body[_GAP.stop :]
