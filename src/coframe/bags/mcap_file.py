"""MCAP files, chunked or not, whole or not; the format is described at https://mcap.dev/spec."""

from __future__ import annotations

import struct
import zlib
from typing import TYPE_CHECKING

import numpy as np

from coframe import _core
from coframe.bags.compression import LARGEST, DamagedError, unpack
from coframe.bags.storage import Batch, Channel, ChunkedStorage
from coframe.messages.slices import Slices

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterator
    from pathlib import Path

    from coframe.bags.problems import Problems

__all__ = ["MAGIC", "McapStorage"]

MAGIC = b"\x89MCAP0\r\n"

_FOOTER, _SCHEMA, _CHANNEL, _MESSAGE, _CHUNK, _CHUNK_INDEX, _DATA_END = 0x02, 0x03, 0x04, 0x05, 0x06, 0x08, 0x0F
_LAST_OPCODE = 0x0F  # those from 0x80 on are somebody's own
_RECORD = struct.Struct("<BQ")  # opcode, length
_MESSAGE_RECORD = struct.Struct("<BQHIQQ")  # opcode, length, channel, sequence, log time, publish time
_CHUNK_HEAD = struct.Struct("<QQQI")  # first and last log time, unpacked size, its CRC or 0
_BLOCK = 4 << 20  # bytes of records that are in no chunk are read together
_FOOTER_RECORD = struct.Struct("<BQQQI")  # opcode, length, start of the summary, of its offsets, CRC
_CRC_AND_MAGIC = 4 + len(MAGIC)  # bytes behind what the CRC is of


class McapStorage(ChunkedStorage):
    """An MCAP file."""

    def __init__(self, path: Path, problems: Problems) -> None:
        super().__init__(path, problems)
        self._schemas: dict[int, tuple[str, str, bytes]] = {}
        self._channels: dict[int, Channel] = {}

    def batches(self, wanted: Callable[[Channel], bool], progress: Callable[[int], object]) -> Iterator[Batch]:
        """All messages, in the order in which they lie in the file."""
        del wanted  # all data lie together
        done = 0
        for offset, opcode, end in self._walk(self._read_summary()):
            if opcode == _CHUNK:
                yield from self._chunk_batches(offset)
                progress(end)
            elif opcode in {_SCHEMA, _CHANNEL, _MESSAGE} and offset >= done:
                if end - offset > LARGEST:
                    self.problem(f"the record at byte {offset} claims to be {end - offset} bytes")
                    continue
                data = self.bytes_at(offset, max(end - offset, _BLOCK))
                done = offset + (yield from self._inner(data, offset))
                progress(done)
        progress(self.size)

    def _walk(self, chunks: list[int]) -> Iterator[tuple[int, int, int]]:
        """Offset, opcode and end of every record of the data; from a damaged one on to the next of the known chunks."""
        offset = len(MAGIC)
        while (head := self.bytes_at(offset, _RECORD.size)) and len(head) == _RECORD.size:
            opcode, length = _RECORD.unpack(head)
            end = offset + _RECORD.size + length
            whole = _is_record(opcode) and end <= self.size
            if whole and opcode in {_DATA_END, _FOOTER}:
                return
            later = [] if whole else [chunk for chunk in chunks if chunk > offset]
            if later:
                self.problem(f"bytes {offset} to {later[0]} are damaged")
                end = later[0]
            elif whole or opcode == _CHUNK:
                yield offset, opcode, min(end, self.size)
            else:
                break
            offset = end
        self.problem(f"it breaks off at byte {min(offset, self.size)} of {self.size}: was the recorder stopped hard?")

    def _read_summary(self) -> list[int]:
        """Takes in the channels that the summary at the end describes; gives where it says that chunks begin."""
        tail = self.bytes_at(self.size - _FOOTER_RECORD.size - len(MAGIC), _FOOTER_RECORD.size)
        if len(tail) < _FOOTER_RECORD.size:
            return []
        opcode, _, start, _, crc = _FOOTER_RECORD.unpack(tail)
        if opcode != _FOOTER or not 0 < start < self.size or self.size - start > LARGEST:
            return []
        summary = self.bytes_at(start, self.size - start)
        if crc and zlib.crc32(summary[:-_CRC_AND_MAGIC]) != crc:  # a recorder was killed as it wrote over it, perhaps
            return []
        chunks, position = [], 0
        while position + _RECORD.size <= len(summary):
            opcode, length = _RECORD.unpack_from(summary, position)
            content = summary[position + _RECORD.size : position + _RECORD.size + length]
            if opcode == _CHUNK_INDEX:
                chunks.append(int.from_bytes(content[16:24], "little"))
            elif opcode in {_SCHEMA, _CHANNEL}:
                self._define(opcode, content)
            position += _RECORD.size + length
        return sorted(chunk for chunk in chunks if 0 < chunk < self.size)

    def _chunk_batches(self, offset: int) -> Iterator[Batch]:
        base = self.add_chunk(offset)
        try:
            data = self.unpack_chunk(offset)
        except DamagedError as error:
            self.problem(f"the chunk at byte {offset} cannot be unpacked: {error}")
            return
        done = yield from self._inner(data, base)
        if done < len(data):
            self.problem(f"{len(data) - done} bytes are damaged or cut off inside a chunk")

    def unpack_chunk(self, offset: int) -> bytes:
        """The records of the chunk at this offset of the file."""
        opcode, length = _RECORD.unpack(self.bytes_at(offset, _RECORD.size))
        assert opcode == _CHUNK
        chunk = memoryview(self.bytes_at(offset + _RECORD.size, min(length, self.size - offset - _RECORD.size)))
        try:
            _, _, size, crc = _CHUNK_HEAD.unpack_from(chunk)
            compression, start = _text(chunk, _CHUNK_HEAD.size)
        except (struct.error, ValueError):
            raise DamagedError("its first bytes are damaged or cut off") from None
        packed = chunk[start + 8 :]
        data = unpack(compression, packed, size)
        if crc and zlib.crc32(data) != crc:
            self.problem(f"the chunk at byte {offset} is damaged: its checksum differs")
        return data

    def _inner(self, data: bytes, base: int) -> Generator[Batch, None, int]:
        """The messages among records, whose positions are offsets in ``data`` plus ``base``; returns where it ended."""
        *columns, definitions, done = _core.mcap_records(data)
        for opcode, start, end in definitions:
            self._define(opcode, data[start:end])
        channels = np.frombuffer(columns[0], dtype=np.uint16)
        times, records, starts, ends = (np.frombuffer(column, dtype=np.uint64) for column in columns[1:])
        for number in np.unique(channels).tolist():
            channel = self._channels.get(number)
            mine = (channels == number) & (times < _TOO_LATE)
            if channel is None:
                self.problem(f"messages of channel {number}, which nothing describes", int(np.count_nonzero(mine)))
            else:
                messages = Slices(data, starts[mine], ends[mine])
                yield Batch(channel, times[mine].astype(np.int64), records[mine] + np.uint64(base), messages)
        if (times >= _TOO_LATE).any():
            self.problem("messages with times that are none", int(np.count_nonzero(times >= _TOO_LATE)))
        return done

    def payload(self, source: bytes | None, offset: int) -> bytes | memoryview:
        """The message in the record at this offset."""
        if source is None:
            source, start = self.bytes_at(offset, _RECORD.size), 0
            if len(source) == _RECORD.size:
                source = self.bytes_at(offset, _RECORD.size + _RECORD.unpack(source)[1])
        else:
            start = offset
        if len(source) < start + _MESSAGE_RECORD.size:
            raise DamagedError("the message is gone")
        return memoryview(source)[
            start + _MESSAGE_RECORD.size : start + _RECORD.size + _RECORD.unpack_from(source, start)[1]
        ]

    def _define(self, opcode: int, data: bytes) -> None:
        try:
            if opcode == _SCHEMA:
                name, position = _text(data, 2)
                kind, position = _text(data, position)
                (length,) = struct.unpack_from("<I", data, position)
                self._schemas[data[0] | data[1] << 8] = (name, kind, data[position + 4 : position + 4 + length])
                return
            number, schema = struct.unpack_from("<HH", data)
            topic, position = _text(data, 4)
            encoding, position = _text(data, position)
            offered_qos = _entry(data, position, "offered_qos_profiles")
        except (struct.error, ValueError, IndexError):
            self.problem("a damaged description of a channel")
            return
        if number not in self._channels:
            name, kind, definition = self._schemas.get(schema, ("", "", b""))
            self._channels[number] = Channel(topic, name, encoding, definition, kind, offered_qos)


_TOO_LATE = np.uint64(1 << 63)


def _is_record(opcode: int) -> bool:
    return 0 < opcode <= _LAST_OPCODE or opcode >= 0x80


def _entry(data: bytes, position: int, wanted: str) -> str:
    """A value of the map of texts that begins there; "" where it has none."""
    end = min(position + 4 + int.from_bytes(data[position : position + 4], "little"), len(data))
    position += 4
    while position < end:
        key, position = _text(data, position)
        value, position = _text(data, position)
        if key == wanted:
            return value
    return ""


def _text(data: bytes | memoryview, position: int) -> tuple[str, int]:
    """A string behind its length, and where it ends."""
    (length,) = struct.unpack_from("<I", data, position)
    end = position + 4 + length
    if end > len(data):
        raise ValueError("a text is longer than what it is in")
    return bytes(data[position + 4 : end]).decode("utf-8", "replace"), end
