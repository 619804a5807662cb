# SPDX-License-Identifier: Apache-2.0
"""Rows of a damaged SQLite database, read from the pages that contain them, without the tree above these pages.

Pages are read one by one: those with rows of a table are leaves, https://sqlite.org/fileformat2.html. Their rows are
recognized by the types of their values.
"""

from __future__ import annotations

import struct
from contextlib import closing
from itertools import islice
from typing import TYPE_CHECKING, BinaryIO, NamedTuple

from coframe._files.regular_files import open_regular
from coframe.bags._compression import MAX_UNPACKED_BYTES, DamagedError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

__all__ = ["LeafRow", "Leaves", "has_leaves_of_recording"]

_LEAF = 0x0D  # the first byte of a page with rows
_HEADER = 100  # bytes before the content of the first page
_MAGIC = b"SQLite format 3\0"
_PAGE_SIZES = [1 << power for power in range(9, 17)]
_USUAL_PAGE_SIZE = 4096
_MAX_PROBED_ROWS = 1000
_MAX_PROBED_BYTES = 64 << 20
_BLOCK_PAGES = 256  # read at once
_MAX_COLUMNS = 7  # of the tables of recordings
_MAX_BAD_CELLS = 20  # of a page with fewer rows; the page is then left
_MAX_TRIED_BAD_CELLS = 20_000  # until a page size or a file is given up
_INTEGERS = (1, 2, 3, 4, 5, 6, 8, 9)  # types of values; 0 is NULL, which stands for the ID of the row
_SIZES = (0, 1, 2, 3, 4, 6, 8, 8, 0, 0)  # bytes of a value by its type; larger types are BLOBs (even) and texts (odd)


class LeafRow(NamedTuple):
    """A row on a leaf.

    Attributes:
        number: Its ID.
        types: The types of its values, as in the file.
        start: Offset of its bytes in the file.
        size: Number of its bytes, including those on other pages.
        header: Number of bytes before the first value.
    """

    number: int
    types: tuple[int, ...]
    start: int
    size: int
    header: int

    @property
    def sizes(self) -> list[int]:
        """Number of bytes of each value."""
        return [_SIZES[kind] if kind < len(_SIZES) else (kind - 12) // 2 for kind in self.types]

    @property
    def is_message(self) -> bool:
        """Whether it can be a row of ``messages``: its ID, topic and time, and a BLOB."""
        if len(self.types) != 4 or not _is_blob(self.types[3]):
            return False
        number, topic, time = self.types[:3]
        return (number == 0 or number in _INTEGERS) and topic in _INTEGERS and time in _INTEGERS

    @property
    def is_topic(self) -> bool:
        """Whether it can be a row of ``topics``: its ID, name, type and encoding, and in later versions more."""
        return 4 <= len(self.types) <= 6 and self.types[0] < 10 and all(map(_is_text, self.types[1:]))


class Leaves:
    """The leaves of a database."""

    def __init__(self, path: Path) -> None:
        self._file: BinaryIO = open_regular(path)
        header = self._file.read(_HEADER).ljust(_HEADER, b"\0")
        (page_size,) = struct.unpack_from(">H", header, 16)
        size = 65536 if page_size == 1 else page_size
        self._page = self._usable_bytes = 4096
        self._bad_cells = 0  # in the current search
        self._max_message_size = min(path.stat().st_size, MAX_UNPACKED_BYTES)
        is_valid = size in _PAGE_SIZES and header.startswith(_MAGIC)
        self._page = size if is_valid else self._likely_page_size()
        self._usable_bytes = self._page - (header[20] if is_valid and header[20] < 33 else 0)

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def _likely_page_size(self) -> int:
        """Return the page size with which most rows are found at the beginning of the file, if its header is lost."""
        found = {}
        for size in _PAGE_SIZES:
            self._page = size
            found[size] = sum(row.is_message for row in islice(self.rows(_MAX_PROBED_BYTES), _MAX_PROBED_ROWS))
        return max(found, key=lambda size: (found[size], size == _USUAL_PAGE_SIZE))

    def rows(self, max_bytes: int | None = None) -> Iterator[LeafRow]:
        """Yield the rows of all leaves in the order of the file.

        Args:
            max_bytes: Where to end the search, rounded up to a block of pages, or None for the end of the file.
        """
        offset = 0
        self._bad_cells = 0
        while max_bytes is None or (offset < max_bytes and self._bad_cells < _MAX_TRIED_BAD_CELLS):
            self._file.seek(offset)
            block = self._file.read(self._page * _BLOCK_PAGES)
            for start in range(0, len(block), self._page):
                page = block[start : start + self._page]
                first = _HEADER if offset + start == 0 else 0
                if len(page) > first + 8 and page[first] == _LEAF:
                    yield from self._rows_of(page, first, offset + start)
            if len(block) < self._page * _BLOCK_PAGES:
                return
            offset += len(block)

    def _rows_of(self, page: bytes, first: int, offset: int) -> Iterator[LeafRow]:
        (number,) = struct.unpack_from(">H", page, first + 3)
        balance = 0  # cells without a row, less those with one
        for index in range(min(number, (self._page - first - 8) // 2)):
            row = self._row_of(page, first + 8 + 2 * index, offset)
            if row is None:
                balance += 1
                self._bad_cells += 1
                if balance > _MAX_BAD_CELLS:
                    return
            else:
                balance -= 1
                yield row

    def _row_of(self, page: bytes, pointer: int, offset: int) -> LeafRow | None:
        """Return the row that a cell pointer refers to, or None if the pointer is invalid."""
        try:
            (cell,) = struct.unpack_from(">H", page, pointer)
            size, position = _varint(page, cell)
            row, position = _varint(page, position)
            header, types_at = _varint(page, position)
            types: list[int] = []
            while types_at < position + header and len(types) <= _MAX_COLUMNS:
                kind, types_at = _varint(page, types_at)
                types.append(kind)
        except (IndexError, struct.error):
            return None
        found = LeafRow(row - (1 << 64) if row >> 63 else row, tuple(types), offset + position, size, header)
        return found if header + sum(found.sizes) == size <= self._max_message_size else None

    def integers(self, row: LeafRow, count: int) -> list[int]:
        """Return the first values of a row, which are integers, or NULL, which is returned as 0.

        Raises:
            DamagedError: They are not in the file.
        """
        sizes, kinds = row.sizes[:count], row.types[:count]
        self._file.seek(row.start + row.header)
        data = self._file.read(sum(sizes))
        if len(data) < sum(sizes):
            raise DamagedError("a row ends outside of the file")
        values = []
        for size, kind in zip(sizes, kinds, strict=True):
            values.append(1 if kind == 9 else int.from_bytes(data[:size], "big", signed=True))
            data = data[size:]
        return values

    def values(self, row: LeafRow, first: int) -> list[bytes]:
        """Return the values of a row from a column on.

        Raises:
            DamagedError: A page with its data is damaged.
        """
        data = self._payload(row)
        position, found = row.header, []
        for size in row.sizes:
            found.append(data[position : position + size])
            position += size
        return found[first:]

    def _payload(self, row: LeafRow) -> bytes:
        here = self._bytes_on_leaf(row.size)
        self._file.seek(row.start)
        data = bytearray(self._file.read(here))
        following = int.from_bytes(self._file.read(4), "big") if here < row.size else 0
        while len(data) < row.size:
            if following < 2:
                raise DamagedError("a page with its data is missing")
            self._file.seek((following - 1) * self._page)
            page = self._file.read(self._usable_bytes)
            if len(page) < 4 + min(self._usable_bytes - 4, row.size - len(data)):
                raise DamagedError("a page with its data is missing")
            following = int.from_bytes(page[:4], "big")
            data += page[4:]
        return bytes(data[: row.size])

    def _bytes_on_leaf(self, size: int) -> int:
        most = self._usable_bytes - 35
        if size <= most:
            return size
        least = (self._usable_bytes - 12) * 32 // 255 - 23
        some = least + (size - least) % (self._usable_bytes - 4)
        return some if some <= most else least


def has_leaves_of_recording(path: Path) -> bool:
    """Return whether rows of a recording are found in the first 64 MiB of a file whose header is lost.

    Raises:
        OSError: The file cannot be read.
    """
    leaves = Leaves(path)
    with closing(leaves):
        return any(row.is_message or row.is_topic for row in leaves.rows(_MAX_PROBED_BYTES))


def _varint(data: bytes, position: int) -> tuple[int, int]:
    value = 0
    for _ in range(8):
        byte = data[position]
        position += 1
        value = value << 7 | byte & 127
        if byte < 128:
            return value, position
    return value << 8 | data[position], position + 1


def _is_blob(kind: int) -> bool:
    return kind >= 12 and kind % 2 == 0


def _is_text(kind: int) -> bool:
    return kind >= 13 and kind % 2 == 1
