# SPDX-License-Identifier: Apache-2.0
"""Reader for ROS 1 bags (http://wiki.ros.org/Bags/Format/2.0), with or without an index."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe import time
from coframe.bags._compression import MAX_UNPACKED_BYTES, DamagedError, unpack
from coframe.bags._offered_qos import OfferedQos, to_yaml
from coframe.bags.formats import ROS1
from coframe.bags.storage import (
    MAX_DAMAGED_PLACES,
    Batch,
    Channel,
    ChunkedStorage,
    ListedChunk,
    Listing,
    are_consistent,
    next_chunk,
)
from coframe.messages.slices import Slices

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe._sources.sources import Readable
    from coframe.bags._problems import Problems

__all__ = ["Ros1Storage"]

_MESSAGE, _CHUNK, _CHUNK_INFO, _CONNECTION = 0x02, 0x05, 0x06, 0x07
_KNOWN_OPCODES = {0x02, 0x03, 0x04, 0x05, 0x06, 0x07}
_LENGTH = struct.Struct("<I")
_TIME = struct.Struct("<II")
_COUNT = struct.Struct("<II")  # connection, messages
_MAX_HEADER_BYTES = 1 << 16


class _ChunkInfo(NamedTuple):
    """A chunk as listed in the index: its offset, its receive times, and its messages by connection."""

    offset: int
    first: int
    last: int
    counts: dict[int, int]


class Ros1Storage(ChunkedStorage):
    """A ROS 1 bag."""

    format = ROS1

    def __init__(self, path: Readable, problems: Problems) -> None:
        super().__init__(path, problems)
        self._channels: dict[int, Channel] = {}
        self._chunk_infos: list[_ChunkInfo] = []
        self._index_start = self._chunk_count = 0

    def channels(self) -> list[Channel]:
        """Return the channels found so far."""
        return list(self._channels.values())

    def batches(self, is_selected: Callable[[Channel], bool], progress: Callable[[int], object]) -> Iterator[Batch]:
        """Yield all messages in file order, including the bytes of unwanted ones, because chunks contain both."""
        del is_selected
        for offset, opcode, header, start, end in self._walk(self._read_index()):
            if opcode == _CHUNK:
                yield from self._chunk_batches(offset)
                progress(min(end, self.size))
            elif end - offset > MAX_UNPACKED_BYTES:
                self.add_problem(f"the record at byte {offset} claims to have {end - offset} bytes")
            elif opcode == _CONNECTION:
                self._connect(header, self.bytes_at(start, end - start))
            elif opcode == _MESSAGE:
                yield from self._inner(self.bytes_at(offset, end - offset), offset)
        progress(self.size)

    def listing(self) -> Listing | None:
        """Return the index at the end of the file, or None if there is none."""
        self._read_index()
        infos = sorted(self._chunk_infos)
        ends = [*(info.offset for info in infos[1:]), self._index_start]
        counts = dict.fromkeys(self._channels.values(), 0)
        chunks = []
        for info, end in zip(infos, ends, strict=True):
            if not all(number in self._channels for number in info.counts):
                return None
            for number, messages in info.counts.items():
                counts[self._channels[number]] += messages
            listed = frozenset(self._channels[number] for number in info.counts)
            chunks.append(ListedChunk(info.offset, end, info.first, info.last, listed or None, 0))
        if not chunks or len(chunks) != self._chunk_count or not are_consistent(chunks, len(ROS1.magic), self.size):
            return None
        for chunk in chunks:
            self.add_chunk(chunk.offset)
        header, _, _ = self._record(chunks[0].offset)
        self.compressions.add(_compression(header))
        return Listing(chunks, counts)

    def read_chunk(self, chunk: ListedChunk) -> Iterator[Batch]:
        """Yield the messages of a chunk of the index."""
        yield from self._chunk_batches(chunk.offset)

    def _walk(self, chunks: list[int]) -> Iterator[tuple[int, int, dict[bytes, bytes], int, int]]:
        """Yield offset, opcode, header, start and end of each record, and continue at the next chunk after damage."""
        offset, damaged = len(ROS1.magic), 0
        while offset < self.size:
            later = next_chunk(chunks, offset)
            try:
                header, start, end = self._record(offset, may_be_truncated=later is None)
            except DamagedError as error:
                damaged += 1
                if self.bytes_at(offset, len(ROS1.magic)) == ROS1.magic:
                    self.add_problem(
                        f"the last {self.size - offset} bytes were not read, because another bag begins there"
                    )
                    return
                if later is None or damaged > MAX_DAMAGED_PLACES:
                    self.add_problem(f"truncated at byte {offset} of {self.size}: {error}")
                    return
                self.add_problem(f"bytes {offset} to {later} are damaged")
                offset = later
                continue
            yield offset, _opcode(header), header, start, end
            offset = end

    def _read_index(self) -> list[int]:
        """Read the connections in the index at the end of the file; return the offsets of the chunks it lists."""
        self._chunk_infos = []
        try:
            header, _, _ = self._record(len(ROS1.magic))
            offset = self._index_start = int.from_bytes(header.get(b"index_pos", b"")[:8], "little")
            self._chunk_count = int.from_bytes(header.get(b"chunk_count", b"")[:4], "little")
            while len(ROS1.magic) < offset < self.size:
                header, start, end = self._record(offset)
                if _opcode(header) == _CONNECTION:
                    self._connect(header, self.bytes_at(start, end - start))
                elif _opcode(header) == _CHUNK_INFO:
                    self._chunk_infos.append(_chunk_info(header, self.bytes_at(start, end - start)))
                offset = end
        except DamagedError:
            pass  # A recorder that is killed leaves a bag without an index.
        return sorted(info.offset for info in self._chunk_infos if len(ROS1.magic) < info.offset < self.size)

    def _record(self, offset: int, *, may_be_truncated: bool = True) -> tuple[dict[bytes, bytes], int, int]:
        """Return the header of a record of the file and the start and end of its data. A chunk may be truncated."""
        length = self._length(offset)
        if length > _MAX_HEADER_BYTES:
            raise DamagedError("the header of the record is damaged")
        header = _fields(self.bytes_at(offset + 4, length))
        if _opcode(header) not in _KNOWN_OPCODES:
            raise DamagedError("the header of the record is damaged")
        start = offset + 8 + length
        end = start + self._length(start - 4)
        if end > self.size and not (may_be_truncated and _opcode(header) == _CHUNK):
            raise DamagedError("the record is truncated")
        return header, start, end

    def _length(self, offset: int) -> int:
        data = self.bytes_at(offset, _LENGTH.size)
        if len(data) < _LENGTH.size:
            raise DamagedError("the record is truncated")
        return int(_LENGTH.unpack(data)[0])

    def _chunk_batches(self, offset: int) -> Iterator[Batch]:
        base = self.add_chunk(offset)
        try:
            data = self.unpack_chunk(offset)
        except DamagedError as error:
            self.add_problem(f"the chunk at byte {offset} cannot be unpacked: {error}")
            return
        yield from self._inner(data, base)

    def unpack_chunk(self, offset: int) -> bytes:
        """Return the records of the chunk at an offset of the file."""
        header, start, end = self._record(offset)
        compression = _compression(header)
        self.compressions.add(compression)
        size = int.from_bytes(header.get(b"size", b"")[:4], "little")
        packed = self.bytes_at(start, min(end, self.size) - start)
        self.check_budget(offset, len(packed), size)
        data = unpack(compression, packed, size)
        if end > self.size:
            self.add_problem(f"truncated inside the chunk at byte {offset}")
        elif len(data) < size:
            self.add_problem(f"the chunk at byte {offset} is damaged; only its first {len(data)} bytes were read")
        return data

    def _inner(self, data: bytes, base: int) -> Iterator[Batch]:
        """Yield the messages in a sequence of records; ``base`` plus an offset in ``data`` is a position."""
        found: dict[int, list[tuple[int, int, int, int]]] = {}
        position = 0
        while position < len(data):
            try:
                header, start, end = _record_in(data, position)
            except DamagedError:
                self.add_problem(f"{len(data) - position} bytes inside a chunk are damaged or missing")
                break
            opcode = _opcode(header)
            if opcode == _CONNECTION:
                self._connect(header, data[start:end])
            elif opcode == _MESSAGE:
                row = (_time(header, b"time"), base + position, start, end)
                found.setdefault(_number(header), []).append(row)
            position = end
        for number, rows in found.items():
            channel = self._channels.get(number)
            if channel is None:
                self.add_problem("messages of a connection that is not defined", len(rows))
                continue
            received, positions, starts, ends = np.array(rows, dtype=np.uint64).T.copy()
            yield Batch(channel, received.astype(np.int64), positions, Slices(data, starts, ends))

    def payload(self, source: bytes | None, offset: int) -> bytes | memoryview:
        """Return the message in the record at an offset."""
        if source is None:
            _, start, end = self._record(offset)
            return self.bytes_at(start, end - start)
        _, start, end = _record_in(source, offset)
        return memoryview(source)[start:end]

    def _connect(self, header: dict[bytes, bytes], data: bytes) -> None:
        number = _number(header)
        if number in self._channels:
            return
        try:
            fields = _fields(data)
        except DamagedError:
            self.add_problem("the definition of a connection is damaged")
            return
        package, _, name = fields.get(b"type", b"").decode("utf-8", "replace").rpartition("/")
        self._channels[number] = Channel(
            topic=(header.get(b"topic") or fields.get(b"topic", b"")).decode("utf-8", "replace"),
            type=f"{package}/msg/{name}" if package else name,
            encoding="ros1",
            definition=fields.get(b"message_definition", b""),
            definition_format="ros1msg",
            offered_qos=to_yaml([OfferedQos(1, transient_local=True)]) if fields.get(b"latching") == b"1" else "",
            publisher=fields.get(b"callerid", b"").decode("utf-8", "replace"),
        )


def _chunk_info(header: dict[bytes, bytes], counts: bytes) -> _ChunkInfo:
    offset = int.from_bytes(header.get(b"chunk_pos", b"")[:8], "little")
    whole = counts[: len(counts) // _COUNT.size * _COUNT.size]
    return _ChunkInfo(offset, _time(header, b"start_time"), _time(header, b"end_time"), dict(_COUNT.iter_unpack(whole)))


def _time(header: dict[bytes, bytes], field: bytes) -> int:
    seconds, nanoseconds = _TIME.unpack(header.get(field, b"").ljust(8, b"\0")[:8])
    return int(seconds * time.SECOND + nanoseconds)


def _compression(header: dict[bytes, bytes]) -> str:
    return header.get(b"compression", b"none").decode("ascii", "replace")


def _record_in(data: bytes, position: int) -> tuple[dict[bytes, bytes], int, int]:
    """Return the header of a record of a chunk and the start and end of its data."""
    try:
        (length,) = _LENGTH.unpack_from(data, position)
        start = position + 8 + length
        (size,) = _LENGTH.unpack_from(data, start - 4)
    except struct.error:
        raise DamagedError("the record is truncated") from None
    if start + size > len(data):
        raise DamagedError("the record is truncated")
    return _fields(data[position + 4 : start - 4]), start, start + size


def _fields(header: bytes) -> dict[bytes, bytes]:
    fields, position = {}, 0
    while position + _LENGTH.size <= len(header):
        (length,) = _LENGTH.unpack_from(header, position)
        position += _LENGTH.size
        name, separator, value = header[position : position + length].partition(b"=")
        if not separator or position + length > len(header):
            raise DamagedError("the header of the record is damaged")
        fields[name] = value
        position += length
    return fields


def _opcode(header: dict[bytes, bytes]) -> int:
    return int.from_bytes(header.get(b"op", b"\0")[:1], "little")


def _number(header: dict[bytes, bytes]) -> int:
    return int.from_bytes(header.get(b"conn", b"")[:4], "little")
