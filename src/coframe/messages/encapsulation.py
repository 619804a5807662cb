# SPDX-License-Identifier: Apache-2.0
"""The encapsulation header of a CDR message: 4 bytes that contain its byte order."""

from __future__ import annotations

from typing import Literal

__all__ = ["BYTE_ORDERS", "HEADER_SIZE", "LITTLE_ENDIAN_HEADER", "Order", "byte_order"]

Order = Literal["<", ">"]  # little or big endian, as struct and NumPy write it

HEADER_SIZE = 4  # bytes: the representation identifier and the options, two bytes each
LITTLE_ENDIAN_HEADER = b"\x00\x01\x00\x00"

# By representation identifier: CDR_BE and CDR_LE of the RTPS specification. ROS 2 sends nothing else. Parameter lists
# (0x0002, 0x0003) and XCDR2 (0x0006 and above) have another layout.
BYTE_ORDERS: dict[bytes, Order] = {b"\x00\x00": ">", b"\x00\x01": "<"}


def byte_order(message: bytes | memoryview) -> Order | None:
    """Return the byte order of a CDR message, or None if it is not plain CDR or is shorter than its header."""
    return BYTE_ORDERS.get(bytes(message[:2])) if len(message) >= HEADER_SIZE else None
