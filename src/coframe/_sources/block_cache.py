# SPDX-License-Identifier: Apache-2.0
"""Read any part of a file that is read in ranges, such as by HTTP: with few requests, and each byte only once.

The bytes that were received are kept in a temporary file, because readers return to them: first for the index of the
messages, then for the messages.
"""

from __future__ import annotations

import errno
import io
import shutil
import tempfile
import threading
import weakref
from collections import OrderedDict
from typing import IO, TYPE_CHECKING, Final, Protocol, cast

from coframe._sources.remote_error import RemoteFileError

if TYPE_CHECKING:
    from typing_extensions import Buffer

__all__ = ["BLOCK_SIZE", "MAX_CACHED", "MAX_RANGE", "BlockCache", "ByteRanges", "RangedFile"]

BLOCK_SIZE: Final = 64 << 10  # bytes; ranges begin and end at multiples of it
MAX_RANGE: Final = 8 << 20  # bytes of one request
MAX_CACHED: Final = 16 << 30  # bytes, and at most half of the free space for temporary files
MAX_IN_MEMORY: Final = 16 << 20  # bytes; more are written to a temporary file
_MAX_BLOCKS: Final = MAX_RANGE // BLOCK_SIZE
_TAIL_SIZE: Final = 256 << 10  # bytes that are read at once at the end of a file, where the index of a recording is


class ByteRanges(Protocol):
    """A file that is read in ranges.

    Attributes:
        name: Its name in error messages.
        size: Its size in bytes.
        version: What changes when the file does, such as its ETag; may be empty.
    """

    name: str
    size: int
    version: tuple[str, ...]

    def read_range(self, start: int, end: int) -> bytes:
        """Return the bytes from ``start`` to ``end``, which is after the last one, or fewer.

        Raises:
            RemoteFileError: They cannot be read.
        """

    def close(self) -> None:
        """Close connections."""


class BlockCache:
    """The blocks of a file that were read most recently. Thread-safe.

    A read that continues where the last request ended requests twice as much as that one, because it is probably one of
    many in a row.
    """

    def __init__(self, ranges: ByteRanges) -> None:
        self.ranges = ranges
        self._lock = threading.Lock()
        self._blocks = _Blocks()
        self._last_end = -1  # number of the block after those of the last request
        self._blocks_ahead = 1  # blocks of the next request in a row

    def read(self, offset: int, size: int) -> bytes:
        """Return bytes; fewer at the end of the file."""
        end = min(offset + size, self.ranges.size)
        parts = []
        with self._lock:
            while offset < end:
                first = offset // BLOCK_SIZE
                stop = min(-(-end // BLOCK_SIZE), first + MAX_RANGE // BLOCK_SIZE)
                self._fetch(first, stop)
                data = b"".join(map(self._blocks.get, range(first, stop)))
                part = data[offset - first * BLOCK_SIZE : end - first * BLOCK_SIZE]
                parts.append(part)
                offset += len(part)
        return parts[0] if len(parts) == 1 else b"".join(parts)

    def prefetch(self, offset: int, end: int) -> None:
        """Read a range of at most `MAX_RANGE` bytes with one request, as far as it is not cached."""
        with self._lock:
            first = offset // BLOCK_SIZE
            self._fetch(first, min(-(-min(end, self.ranges.size) // BLOCK_SIZE), first + _MAX_BLOCKS), ahead=False)

    def read_once(self, offset: int, size: int) -> bytes:
        """Return bytes without keeping them."""
        with self._lock:
            return self._cached_bytes(offset, min(offset + size, self.ranges.size))

    def close(self) -> None:
        """Close connections, and forget all blocks."""
        with self._lock:
            self.ranges.close()
            self._blocks.close()
            self._blocks = _Blocks()

    def _fetch(self, first: int, stop: int, *, ahead: bool = True) -> None:
        """Make the blocks from ``first`` until ``stop`` available, and with ``ahead`` those that are needed next."""
        missing = [number for number in range(first, stop) if not self._blocks.touch(number)]
        if not missing:
            return
        begin, last = missing[0], missing[-1] + 1
        if ahead:
            last = self._prefetch_end(begin, last)
        data = self._cached_bytes(begin * BLOCK_SIZE, min(last * BLOCK_SIZE, self.ranges.size))
        try:
            for number in range(begin, last):
                self._blocks.put(number, data[(number - begin) * BLOCK_SIZE : (number - begin + 1) * BLOCK_SIZE])
        except OSError as error:
            reason = f"the bytes that were received cannot be written to a temporary file: {error.strerror or error}"
            hint = f"Free space in {tempfile.gettempdir()}, or set TMPDIR to another folder."
            raise RemoteFileError.because(self.ranges.name, reason, hint, errno.ENOSPC) from None
        self._last_end = last

    def _cached_bytes(self, start: int, end: int) -> bytes:
        data = self.ranges.read_range(start, end)
        if len(data) != end - start:
            reason = f"only {len(data)} of the {end - start} bytes from byte {start} on were received"
            raise RemoteFileError.because(self.ranges.name, reason)
        return data

    def _prefetch_end(self, begin: int, stop: int) -> int:
        """Return where a request ends: later in a sequence of reads, and at the end of the file."""
        blocks = -(-self.ranges.size // BLOCK_SIZE)
        self._blocks_ahead = min(2 * self._blocks_ahead, _MAX_BLOCKS) if begin == self._last_end else 1
        if self.ranges.size - begin * BLOCK_SIZE <= _TAIL_SIZE:
            return blocks
        return min(max(stop, begin + self._blocks_ahead), begin + _MAX_BLOCKS, blocks)


class _Blocks:
    """Blocks by number, in memory or in a temporary file; the least recently used ones are replaced."""

    def __init__(self) -> None:
        self._places: OrderedDict[int, tuple[int, int]] = OrderedDict()  # place in the file, size
        self._file = cast("IO[bytes]", tempfile.SpooledTemporaryFile(MAX_IN_MEMORY))  # noqa: SIM115 - closed below
        weakref.finalize(self, self._file.close)
        self._max_blocks = max(
            min(MAX_CACHED, shutil.disk_usage(tempfile.gettempdir()).free // 2) // BLOCK_SIZE, 2 * _MAX_BLOCKS
        )

    def touch(self, number: int) -> bool:
        """Return whether a block is cached, and mark it as the most recently used."""
        if number not in self._places:
            return False
        self._places.move_to_end(number)
        return True

    def get(self, number: int) -> bytes:
        """Return a block."""
        place, size = self._places[number]
        self._file.seek(place * BLOCK_SIZE)
        return self._file.read(size)

    def put(self, number: int, data: bytes) -> None:
        """Keep a block."""
        if number in self._places:
            place = self._places.pop(number)[0]
        elif len(self._places) >= self._max_blocks:
            place = self._places.popitem(last=False)[1][0]
        else:
            place = len(self._places)
        self._file.seek(place * BLOCK_SIZE)
        self._file.write(data)
        self._places[number] = place, len(data)

    def close(self) -> None:
        """Delete the temporary file."""
        self._file.close()


class RangedFile(io.RawIOBase):
    """A file for reading whose bytes come from a `BlockCache`."""

    def __init__(self, cache: BlockCache) -> None:
        super().__init__()
        self._cache = cache
        self._position = 0

    @property
    def name(self) -> str:
        """The name of the file."""
        return self._cache.ranges.name

    def readable(self) -> bool:
        """Return True."""
        return True

    def seekable(self) -> bool:
        """Return True."""
        return True

    def readinto(self, target: Buffer) -> int:
        """Fill a buffer; return the number of bytes, 0 at the end of the file."""
        view = memoryview(target).cast("B")
        data = self._cache.read(self._position, len(view))
        view[: len(data)] = data
        self._position += len(data)
        return len(data)

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        """Change the position; return it."""
        origin = {io.SEEK_SET: 0, io.SEEK_CUR: self._position, io.SEEK_END: self._cache.ranges.size}[whence]
        self._position = max(origin + offset, 0)
        return self._position

    def tell(self) -> int:
        """Return the position."""
        return self._position
