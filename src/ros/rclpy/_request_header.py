"""Who asked, and which question it was: 16 bytes before the payload of requests and replies."""

from __future__ import annotations

import struct
from typing import Final, NamedTuple

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
    """Takes the header out again; None when there is not even room for it."""
    if len(data) < ENCAPSULATION_SIZE + _LITTLE.size:
        return None
    layout = _LITTLE if data[1] & 1 else _BIG
    header = RequestHeader(*layout.unpack_from(data, ENCAPSULATION_SIZE))
    return header, data[:ENCAPSULATION_SIZE] + data[ENCAPSULATION_SIZE + layout.size :]
