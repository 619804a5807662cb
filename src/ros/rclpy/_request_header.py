"""Request header: 16 bytes before the payload of service requests and replies that identify the request."""

from __future__ import annotations

import struct
from typing import Final, NamedTuple

ENCAPSULATION_SIZE: Final = 4  # The CDR header remains in front of the request header.
_LITTLE: Final = struct.Struct("<Qq")
_BIG: Final = struct.Struct(">Qq")


class RequestHeader(NamedTuple):
    """Identifier of the client and the sequence number of its request."""

    client: int
    sequence: int


def join(header: RequestHeader, cdr: bytes) -> bytes:
    """Return a serialized little-endian message with the header inserted."""
    return cdr[:ENCAPSULATION_SIZE] + _LITTLE.pack(*header) + cdr[ENCAPSULATION_SIZE:]


def split(data: bytes) -> tuple[RequestHeader, bytes] | None:
    """Return the header and the message without it, or None if the data are too short for a header."""
    if len(data) < ENCAPSULATION_SIZE + _LITTLE.size:
        return None
    layout = _LITTLE if data[1] & 1 else _BIG
    header = RequestHeader(*layout.unpack_from(data, ENCAPSULATION_SIZE))
    return header, data[:ENCAPSULATION_SIZE] + data[ENCAPSULATION_SIZE + layout.size :]
