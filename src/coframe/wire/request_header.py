# SPDX-License-Identifier: Apache-2.0
"""Request header: 16 bytes before the payload of service requests and replies that identify the request."""

from __future__ import annotations

import os
import struct
from typing import Final, NamedTuple

from coframe.messages.encapsulation import byte_order

ENCAPSULATION_SIZE: Final = 4  # The CDR header stays before the request header.
_LITTLE: Final = struct.Struct("<Qq")
_BIG: Final = struct.Struct(">Qq")


class RequestHeader(NamedTuple):
    """The client ID and the sequence number of a request."""

    client: int
    sequence: int


def random_client_id() -> int:
    """Return an ID that no other client has."""
    return int.from_bytes(os.urandom(8), "little")


def join(header: RequestHeader, cdr: bytes) -> bytes:
    """Return a serialized message with the header inserted, in the byte order of the message."""
    layout = _BIG if byte_order(cdr) == ">" else _LITTLE
    return cdr[:ENCAPSULATION_SIZE] + layout.pack(*header) + cdr[ENCAPSULATION_SIZE:]


def split(data: bytes) -> tuple[RequestHeader, bytes] | None:
    """Return the header and the message without it, or None if the data are too short or not plain CDR."""
    if len(data) < ENCAPSULATION_SIZE + _LITTLE.size:
        return None
    order = byte_order(data)
    if order is None:
        return None
    layout = _LITTLE if order == "<" else _BIG
    header = RequestHeader(*layout.unpack_from(data, ENCAPSULATION_SIZE))
    return header, data[:ENCAPSULATION_SIZE] + data[ENCAPSULATION_SIZE + layout.size :]
