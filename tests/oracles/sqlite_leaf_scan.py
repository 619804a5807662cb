# SPDX-License-Identifier: Apache-2.0
"""The rows on the leaf pages of a SQLite file, by the documented format (https://www.sqlite.org/fileformat2.html).

Nothing of coframe is used, and no tree is followed: each page that looks like a leaf of a table is read on its own.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

__all__ = ["rows_on_leaves"]

_LEAF = 13
_SIZES = {1: 1, 2: 2, 3: 3, 4: 4, 5: 6, 6: 8, 7: 8, 8: 0, 9: 0, 0: 0}


class _DamagedError(Exception):
    pass


def rows_on_leaves(path: Path, page_size: int) -> Iterator[tuple[int, list[Any]]]:
    """Yield the number and the values of each complete row on each leaf page of a table."""
    data = path.read_bytes()
    for start in range(0, len(data) - page_size + 1, page_size):
        header = start + (100 if start == 0 else 0)
        if data[header] != _LEAF:
            continue
        (cells,) = struct.unpack_from(">H", data, header + 3)
        for number in range(min(cells, (page_size - 8) // 2)):
            try:
                (offset,) = struct.unpack_from(">H", data, header + 8 + 2 * number)
                if 0 < offset < page_size:
                    yield _row(data, start, start + offset, page_size)
            except (_DamagedError, struct.error, IndexError, UnicodeDecodeError):
                continue


def _varint(data: bytes, at: int) -> tuple[int, int]:
    value = 0
    for index in range(9):
        byte = data[at + index]
        if index == 8:
            return value << 8 | byte, at + 9
        value = value << 7 | byte & 127
        if byte < 128:
            return value, at + index + 1
    raise _DamagedError


def _row(data: bytes, page: int, at: int, page_size: int) -> tuple[int, list[Any]]:
    length, at = _varint(data, at)
    number, at = _varint(data, at)
    payload = _payload(data, page, at, length, page_size)
    head, position = _varint(payload, 0)
    types = []
    while position < head:
        kind, position = _varint(payload, position)
        types.append(kind)
    values = []
    for kind in types:
        size = _SIZES.get(kind, (kind - 12) // 2 if kind >= 12 else -1)
        raw = payload[position : position + size]
        if size < 0 or len(raw) < size:
            raise _DamagedError
        values.append(_value(kind, raw))
        position += size
    if position != length:
        raise _DamagedError
    return number - (1 << 64) if number >> 63 else number, values


def _payload(data: bytes, page: int, at: int, length: int, page_size: int) -> bytes:
    """Return the bytes of a row, some of which may be on overflow pages."""
    largest = page_size - 35
    if length <= largest:
        if at + length > page + page_size:
            raise _DamagedError
        return data[at : at + length]
    smallest = (page_size - 12) * 32 // 255 - 23
    inside = smallest + (length - smallest) % (page_size - 4)
    inside = inside if inside <= largest else smallest
    parts, left = [data[at : at + inside]], length - inside
    (following,) = struct.unpack_from(">I", data, at + inside)
    while left > 0:
        start = (following - 1) * page_size
        if following < 2 or start + page_size > len(data):
            raise _DamagedError
        (following,) = struct.unpack_from(">I", data, start)
        parts.append(data[start + 4 : start + 4 + min(left, page_size - 4)])
        left -= page_size - 4
    return b"".join(parts)


def _value(kind: int, raw: bytes) -> Any:
    if kind == 0:
        return None
    if kind in {8, 9}:
        return kind - 8
    if kind == 7:
        return struct.unpack(">d", raw)[0]
    if kind < 7:
        return int.from_bytes(raw, "big", signed=True)
    return raw if kind % 2 == 0 else raw.decode()
