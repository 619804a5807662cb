"""The first bytes of messages with a header: its stamp and its frame, without decoding the rest."""

from __future__ import annotations

import struct

__all__ = ["HEAD", "header_of"]

HEAD = 512  # bytes of a message that are enough: names of frames are short
_SECOND = 1_000_000_000


def header_of(message: bytes) -> tuple[int, str] | None:
    """The stamp in nanoseconds and the frame_id of a message in CDR that opens with a header; None if it is cut off."""
    order = "<" if message[1:2] == b"\x01" else ">"
    try:
        seconds, nanoseconds, length = struct.unpack_from(order + "iII", message, 4)
    except struct.error:
        return None
    frame = message[16 : 16 + length]
    if not 0 < length == len(frame):
        return None
    return seconds * _SECOND + nanoseconds, frame.removesuffix(b"\0").decode("utf-8", "backslashreplace")
