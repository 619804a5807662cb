"""Who asked, and which question it was: 16 bytes before the payload of requests and replies."""

from __future__ import annotations

import struct
from typing import Final, NamedTuple

from coframe.messages.encapsulation import byte_order

ENCAPSULATION_SIZE: Final = 4  # CDR's own header, which stays in front
_LITTLE: Final = struct.Struct("<Qq")
_BIG: Final = struct.Struct(">Qq")


class RequestHeader(NamedTuple):
    """The client's identity and its running number."""

    client: int
    sequence: int


def join(header: RequestHeader, cdr: bytes) -> bytes:
    """Puts the header into a serialised (little-endian) message."""
    return cdr[:ENCAPSULATION_SIZE] + _LITTLE.pack(*header) + cdr[ENCAPSULATION_SIZE:]


def split(data: bytes) -> tuple[RequestHeader, bytes] | None:
    """Remove the header from a message; None if the message is too short or not plain CDR."""
    if len(data) < ENCAPSULATION_SIZE + _LITTLE.size:
        return None
    order = byte_order(data)
    if order is None:
        return None
    layout = _LITTLE if order == "<" else _BIG
    header = RequestHeader(*layout.unpack_from(data, ENCAPSULATION_SIZE))
    return header, data[:ENCAPSULATION_SIZE] + data[ENCAPSULATION_SIZE + layout.size :]
