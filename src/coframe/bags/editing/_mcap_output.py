# SPDX-License-Identifier: Apache-2.0
"""Write an MCAP file: chunks are compressed on other threads, and everything is written in order with its index."""

from __future__ import annotations

import os
import struct
import threading
import zlib
from collections import deque
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.bags._mcap_writer import compressor
from coframe.bags.editing import _mcap_layout as mcap
from coframe.bags.formats import MCAP

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray
    from typing_extensions import Self

    Data = bytes | bytearray | memoryview

__all__ = ["IndexedRecords", "McapOutput"]

_MAX_THREADS = 4


class IndexedRecords(NamedTuple):
    """Records, and of each message in them the channel, the log time and the offset.

    Attributes:
        data: The records.
        channels: (N,) uint16.
        times: (N,) uint64 nanoseconds.
        offsets: (N,) uint64 bytes.
    """

    data: bytes | bytearray
    channels: NDArray[np.uint16]
    times: NDArray[np.uint64]
    offsets: NDArray[np.uint64]


@dataclass
class _Chunk:
    """The chunk that was written last, whose message indexes follow."""

    times: tuple[int, int]
    compression: str
    packed: int
    unpacked: int
    offset: int = 0
    length: int = 0
    index: dict[int, int] = field(default_factory=dict)  # offset of the message index of each channel


class McapOutput:
    """Writes one file; a context manager.

    Args:
        file: The file, or anything with ``write``.
        has_crc: Whether the file has a checksum of its data section.
    """

    def __init__(self, file: Any, *, has_crc: bool) -> None:
        self._file = file
        self._has_crc = has_crc
        self._crc = 0
        self._end = 0
        self._start = 0  # of the record that gets an index record
        self._chunk: _Chunk | None = None
        self._indexes: dict[int, list[bytes]] = {}  # index records by opcode
        self._threads = min(_MAX_THREADS, max(1, (os.cpu_count() or 2) - 1))
        self._pool = ThreadPoolExecutor(self._threads)
        self._local = threading.local()
        self._waiting_chunks: deque[tuple[Future[bytes] | None, Callable[[bytes], object]]] = deque()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._pool.shutdown(cancel_futures=True)

    def write(self, data: Data) -> None:
        """Write bytes."""
        self._submit_job(lambda _: self._write(data))

    def begin_indexed(self) -> None:
        """Begin a record that gets an index record."""
        self._submit_job(lambda _: setattr(self, "_start", self._end))

    def end_indexed(self, opcode: int, *, before: bytes = b"", after: bytes = b"") -> None:
        """Add the index record of the record written since :meth:`begin_indexed`: offset, length, `after`."""

        def add(_: bytes) -> None:
            place = struct.pack("<QQ", self._start, self._end - self._start)
            self._add_index(opcode, before + place + after)

        self._submit_job(add)

    def copy_chunk(self, content: bytes, chunk: mcap.Chunk) -> None:
        """Write a chunk as it was read."""
        new = _Chunk((chunk.first, chunk.last), chunk.compression, chunk.packed, len(chunk.data))
        self._submit_job(lambda _: self._write_chunk(new, b"", content))

    def write_chunk(self, records: IndexedRecords, compression: str, *, has_crc: bool) -> None:
        """Write a new chunk with its message indexes."""
        data, times = records.data, records.times
        first, last = (int(times.min()), int(times.max())) if len(times) else (0, 0)
        head = struct.pack("<QQQI", first, last, len(data), zlib.crc32(data) if has_crc else 0)
        head += mcap.encoded_text(compression)
        indexes = list(_message_indexes(records))

        def write(packed_data: Data) -> None:
            chunk = _Chunk((first, last), compression, len(packed_data), len(data))
            self._write_chunk(chunk, head + struct.pack("<Q", len(packed_data)), packed_data)
            for index in indexes:
                self._write_message_index(index)

        if compression:
            self._submit_job(write, self._pool.submit(self._compress, data, compression))
        else:
            self._submit_job(lambda _: write(data))

    def copy_message_index(self, content: bytes) -> None:
        """Write a message index of a copied chunk."""
        self._submit_job(lambda _: self._write_message_index(content))

    def finish_chunk(self) -> None:
        """Add the index record of the last chunk, if there is one without it."""
        self._submit_job(lambda _: self._finish_chunk())

    def finish(self, schemas: Iterable[bytes], channels: Iterable[bytes], statistics: Callable[..., bytes]) -> None:
        """Write the end of the file.

        Args:
            schemas: The contents of the records of schemas.
            channels: The contents of the records of channels.
            statistics: Returns the content of their record, for the numbers of attachments, metadata and chunks.
        """
        while self._waiting_chunks:
            self._finish_next_job()
        self._write(mcap.record(mcap.DATA_END, struct.pack("<I", self._crc if self._has_crc else 0)))
        start = self._end
        kinds = (mcap.ATTACHMENT_INDEX, mcap.METADATA_INDEX, mcap.CHUNK_INDEX)
        numbers = [len(self._indexes.get(opcode, ())) for opcode in kinds]
        groups = {
            mcap.SCHEMA: [mcap.record(mcap.SCHEMA, each) for each in schemas],
            mcap.CHANNEL: [mcap.record(mcap.CHANNEL, each) for each in channels],
            mcap.STATISTICS: [mcap.record(mcap.STATISTICS, statistics(*numbers))],
            **{each: self._indexes[each] for each in sorted(self._indexes)},
        }
        summary, offsets = bytearray(), bytearray()
        for opcode, records in groups.items():
            if records:
                group = b"".join(records)
                place = struct.pack("<BQQ", opcode, start + len(summary), len(group))
                offsets += mcap.record(mcap.SUMMARY_OFFSET, place)
                summary += group
        footer = mcap.RECORD.pack(mcap.FOOTER, 20) + struct.pack("<QQ", start, start + len(summary))
        checksum = zlib.crc32(summary + offsets + footer)
        self._write(bytes(summary + offsets) + footer + struct.pack("<I", checksum) + MCAP.magic)

    def _submit_job(self, action: Callable[[bytes], object], packed: Future[bytes] | None = None) -> None:
        """Do something when everything before has been done, with the result of another thread."""
        if packed is None and not self._waiting_chunks:
            action(b"")
            return
        self._waiting_chunks.append((packed, action))
        while self._waiting_chunks and (
            self._is_full() or self._waiting_chunks[0][0] is None or self._waiting_chunks[0][0].done()
        ):
            self._finish_next_job()

    def _is_full(self) -> bool:
        return sum(packed is not None for packed, _ in self._waiting_chunks) > self._threads + 1

    def _finish_next_job(self) -> None:
        packed, action = self._waiting_chunks.popleft()
        action(b"" if packed is None else packed.result())

    def _compress(self, data: Data, compression: str) -> bytes:
        """Compress a chunk, on another thread; each has its own compressor."""
        if compression not in self._local.__dict__:
            self._local.__dict__[compression] = compressor(compression)
        packed: bytes = self._local.__dict__[compression](data)
        return packed

    def _write(self, data: Data) -> None:
        if self._has_crc:
            self._crc = zlib.crc32(data, self._crc)
        self._file.write(data)
        self._end += len(data)

    def _write_chunk(self, chunk: _Chunk, head: bytes, content: Data) -> None:
        chunk.offset = self._end
        self._write(mcap.RECORD.pack(mcap.CHUNK, len(head) + len(content)) + head)
        self._write(content)
        chunk.length = self._end - chunk.offset
        self._chunk = chunk

    def _write_message_index(self, content: bytes) -> None:
        if self._chunk is not None:
            self._chunk.index[int.from_bytes(content[:2], "little")] = self._end
            self._write(mcap.record(mcap.MESSAGE_INDEX, content))

    def _finish_chunk(self) -> None:
        chunk = self._chunk
        if chunk is None:
            return
        self._chunk = None
        offsets = b"".join(struct.pack("<HQ", *pair) for pair in chunk.index.items())
        head = struct.pack("<QQQQI", *chunk.times, chunk.offset, chunk.length, len(offsets)) + offsets
        indexed = self._end - chunk.offset - chunk.length
        head += struct.pack("<Q", indexed) + mcap.encoded_text(chunk.compression)
        self._add_index(mcap.CHUNK_INDEX, head + struct.pack("<QQ", chunk.packed, chunk.unpacked))

    def _add_index(self, opcode: int, content: bytes) -> None:
        self._indexes.setdefault(opcode, []).append(mcap.record(opcode, content))


def _message_indexes(records: IndexedRecords) -> Iterable[bytes]:
    """Yield the contents of the message indexes of a chunk."""
    for number in np.flatnonzero(np.bincount(records.channels)).tolist() if len(records.channels) else []:
        rows = records.channels == number
        entries = np.column_stack((records.times[rows], records.offsets[rows])).astype("<u8").tobytes()
        yield struct.pack("<HI", number, len(entries)) + entries
