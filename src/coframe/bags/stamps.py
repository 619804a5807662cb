"""Message stamps straight from the bytes: most messages open with their header."""

from __future__ import annotations

import re
import struct
from typing import TYPE_CHECKING, Any

from coframe.bags.decoding import message_class
from coframe.messages.definition import AbstractSequence, NamespacedType

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.bags.storage import Channel

__all__ = ["HEAD", "stamp_reader"]

HEAD = 24  # bytes of a message that are enough
_LITTLE, _BIG = struct.Struct("<iI"), struct.Struct(">iI")
_HEADER = re.compile(r"\s*(?:std_msgs/)?(?:msg/)?Header\s+\w+", re.ASCII)
_TIME = re.compile(r"\s*(?:builtin_interfaces/(?:msg/)?Time|time)\s+\w+", re.ASCII)


def stamp_reader(channel: Channel) -> Callable[[bytes | memoryview], int | None] | None:
    """What finds the stamp in a message's first bytes; None where messages of that type have none in front.

    The stamp is that of the header, of the first of many headers (TFMessage, MarkerArray), or the time the message
    begins with (Clock); None for a message that is cut off or holds nothing.
    """
    place = _place(channel)
    if place is None or channel.encoding not in {"cdr", "ros1"}:
        return None
    return _Cdr(place) if channel.encoding == "cdr" else _Ros1(place)


class _Cdr:
    def __init__(self, place: str) -> None:
        self.offset = 8 if place == "headers" else 4

    def __call__(self, data: bytes | memoryview) -> int | None:
        order = _LITTLE if data[1:2] == b"\x01" else _BIG
        if len(data) < self.offset + order.size:
            return None
        seconds, nanoseconds = order.unpack_from(data, self.offset)
        return int(seconds * 1_000_000_000 + nanoseconds)


class _Ros1:
    def __init__(self, place: str) -> None:
        self.offset = {"time": 0, "header": 4, "headers": 8}[place]

    def __call__(self, data: bytes | memoryview) -> int | None:
        if len(data) < self.offset + _LITTLE.size:
            return None
        seconds, nanoseconds = struct.unpack_from("<II", data, self.offset)
        return int(seconds * 1_000_000_000 + nanoseconds)


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
