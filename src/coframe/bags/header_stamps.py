"""Message stamps straight from the bytes: most messages open with their header."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe import time
from coframe.bags.decoding import message_class
from coframe.messages.definition import AbstractSequence, NamespacedType

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.bags.storage import Channel, Slices

__all__ = ["HEAD", "StampPlace", "opens_with_header", "stamps_for"]

HEAD = 24  # bytes of a message that are enough
_IN_ROS1 = {"time": 0, "header": 4, "headers": 8}
_HEADER = re.compile(r"\s*(?:std_msgs/)?(?:msg/)?Header\s+\w+", re.ASCII)
_TIME = re.compile(r"\s*(?:builtin_interfaces/(?:msg/)?Time|time)\s+\w+", re.ASCII)


def stamps_for(channel: Channel) -> StampPlace | None:
    """Where a channel's messages have their stamps in their first bytes; None where they have none in front."""
    place = _place(channel)
    if place is None or channel.encoding not in {"cdr", "ros1"}:
        return None
    # In CDR behind its header, in ROS 1 behind the header's number; of many headers behind their count, too.
    offsets = {"time": 4, "header": 4, "headers": 8} if channel.encoding == "cdr" else _IN_ROS1
    return StampPlace(offsets[place], is_cdr=channel.encoding == "cdr")


class StampPlace:
    """Where messages have their stamps: that of the header, of the first of many, or the time they begin with."""

    def __init__(self, offset: int, *, is_cdr: bool) -> None:
        self._offset = offset
        self._is_cdr = is_cdr

    def stamps(self, messages: Slices, instead: NDArray[np.int64]) -> NDArray[np.int64]:
        """The stamps, (N,) nanoseconds; ``instead`` where a message is cut off or empty."""
        data = np.frombuffer(messages.data, dtype=np.uint8)
        starts, ends = messages.starts.astype(np.int64), messages.ends.astype(np.int64)
        there = starts + self._offset + 8 <= ends
        stamps: NDArray[np.int64] = np.array(instead)
        begin = starts[there]
        raw = data[begin[:, None] + (self._offset + np.arange(8))]
        if self._is_cdr:
            swapped = raw.reshape(-1, 2, 4)[:, :, ::-1].reshape(-1, 8)
            raw = np.where((data[begin + 1] == 1)[:, None], raw, swapped)
        seconds, nanoseconds = np.ascontiguousarray(raw).view("<u4").T.astype(np.int64)
        if self._is_cdr:
            seconds = seconds.astype(np.int32).astype(np.int64)
        stamps[there] = seconds * time.SECOND + nanoseconds
        return stamps


def opens_with_header(ros_type: str) -> bool:
    """Whether coframe has the type, and its messages open with a header."""
    cls = message_class(ros_type)
    return cls is not None and _place_in(cls) == "header"


def _place(channel: Channel) -> str | None:
    """``header``, ``headers`` or ``time``: what messages of the type open with."""
    cls = message_class(channel.type)
    if cls is not None:
        return _place_in(cls)
    for line in channel.definition[:10_000].decode("utf-8", "replace").splitlines():
        field = line.partition("#")[0].strip()
        if field and "=" not in field:
            return "header" if _HEADER.match(field) else "time" if _TIME.match(field) else None
    return None


def _place_in(cls: Any) -> str | None:
    first = cls.SLOT_TYPES[0] if cls.SLOT_TYPES else None
    if isinstance(first, AbstractSequence) and isinstance(first.value_type, NamespacedType):
        inner = message_class("/".join(first.value_type.namespaced_name()))
        return "headers" if inner is not None and _place_in(inner) == "header" else None
    if not isinstance(first, NamespacedType):
        return None
    return {"Header": "header", "Time": "time"}.get(first.name)
