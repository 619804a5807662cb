# SPDX-License-Identifier: Apache-2.0
"""Reader for MCAP files, including damaged and unfinished ones. The format is described at https://mcap.dev/spec."""

from __future__ import annotations

import struct
import sys
import zlib
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe import _core
from coframe._output.formatting import count
from coframe.bags._compression import MAX_UNPACKED_BYTES, DamagedError, unpack
from coframe.bags.formats import MCAP
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
from coframe.messages.schemas import ros_name
from coframe.messages.slices import Slices

if TYPE_CHECKING:
    from collections.abc import Callable, Generator, Iterator

    from numpy.typing import NDArray

    from coframe._sources.sources import Readable
    from coframe.bags._problems import Problems

__all__ = ["McapStorage"]

_FOOTER, _SCHEMA, _CHANNEL, _MESSAGE, _CHUNK, _CHUNK_INDEX, _DATA_END = 0x02, 0x03, 0x04, 0x05, 0x06, 0x08, 0x0F
_STATISTICS = 0x0B
_LAST_OPCODE = 0x0F  # opcodes from 0x80 are reserved for applications
_RECORD = struct.Struct("<BQ")  # opcode, length
_MESSAGE_RECORD = struct.Struct("<BQHIQQ")  # opcode, length, channel, sequence, log time, publish time
_CHUNK_HEAD = struct.Struct("<QQQI")  # first and last log time, unpacked size, its CRC or 0
_BLOCK_BYTES = 4 << 20  # bytes to read at once from records outside chunks
_FOOTER_RECORD = struct.Struct("<BQQQI")  # opcode, length, start of the summary, of its offsets, CRC
_STATISTICS_HEAD = struct.Struct("<QHIIIIQQI")  # messages, other counts, times, bytes of the counts by channel
_CHANNEL_COUNT = struct.Struct("<HQ")
_CHUNK_INDEX_HEAD = struct.Struct("<QQQQI")  # times, offset, size, bytes of the offsets by channel
_MAX_GAPS = 100  # parts of the data section that the index does not describe, such as attachments
_MAX_GAP_RECORDS = 1000
_CRC_AND_MAGIC = 4 + len(MCAP.magic)  # bytes at the end of the file that the CRC of the summary does not cover


class _ChunkIndex(NamedTuple):
    """A chunk as listed in the summary: its position, its receive times, and the numbers of its channels."""

    offset: int
    end: int
    index_end: int  # of the records behind the chunk that list its messages
    first: int
    last: int
    channels: tuple[int, ...]
    compression: str
    unpacked: int


class McapStorage(ChunkedStorage):
    """An MCAP file."""

    format = MCAP

    def __init__(self, path: Readable, problems: Problems) -> None:
        super().__init__(path, problems)
        self._schemas: dict[int, tuple[str, str, bytes]] = {}
        self._channels: dict[int, Channel] = {}
        self._channel_records: dict[int, bytes] = {}  # the records of channels
        self._counts: dict[int, int] = {}  # messages by channel
        self._listed_counts: dict[int, int] | None = None  # the same by the statistics in the summary
        self._listed_total: int | None = None
        self._chunk_indexes: list[_ChunkIndex] = []

    def channels(self) -> list[Channel]:
        """Return the channels found so far."""
        return list(self._channels.values())

    def batches(self, is_selected: Callable[[Channel], bool], progress: Callable[[int], object]) -> Iterator[Batch]:
        """Yield all messages in file order, including the bytes of unwanted ones, because chunks contain both."""
        del is_selected
        done = 0
        chunks = self._read_summary()
        missing = set(chunks)
        for offset, opcode, end in self._walk_records(chunks):
            if opcode == _CHUNK:
                missing.discard(offset)
                yield from self._chunk_batches(offset)
                progress(end)
            elif opcode in {_SCHEMA, _CHANNEL, _MESSAGE} and offset >= done:
                if end - offset > MAX_UNPACKED_BYTES:
                    self.add_problem(f"the record at byte {offset} claims to have {end - offset} bytes")
                    continue
                data = self.bytes_at(offset, max(end - offset, _BLOCK_BYTES))
                done = offset + (yield from self._read_records(data, offset))
                progress(done)
        if missing:
            self.add_problem(f"there is no chunk at byte {min(missing)}, where the index lists one", len(missing))
        self._check_statistics()
        progress(self.size)

    def listing(self) -> Listing | None:
        """Return the index in the summary, or None if there is none, or if it cannot be that of all messages."""
        self._read_summary()
        indexes = sorted(self._chunk_indexes)
        chunks = [
            ListedChunk(each.offset, each.end, each.first, each.last, self._listed_channels(each), each.unpacked)
            for each in indexes
        ]
        ends = [len(MCAP.magic), *(each.index_end for each in indexes)]
        gaps = [(end, index.offset) for end, index in zip(ends, indexes, strict=False) if end != index.offset]
        is_complete = (
            self._listed_counts is not None
            and bool(chunks)
            and are_consistent(chunks, len(MCAP.magic), self.size)
            and len(gaps) <= _MAX_GAPS
            and not any(self._has_messages(*gap) for gap in [*gaps, (ends[-1], self.size)])
        )
        if not is_complete:
            return None
        for index in indexes:
            self.add_chunk(index.offset)
            self.compressions.add(index.compression)
        counts = {channel: (self._listed_counts or {}).get(number, 0) for number, channel in self._channels.items()}
        return Listing(chunks, counts)

    def _listed_channels(self, index: _ChunkIndex) -> frozenset[Channel] | None:
        if not index.channels or not all(number in self._channels for number in index.channels):
            return None
        return frozenset(self._channels[number] for number in index.channels)

    def _has_messages(self, offset: int, end: int) -> bool:
        """Return whether a part of the file has messages or chunks that the index does not list."""
        for _ in range(_MAX_GAP_RECORDS):
            head = self.bytes_at(offset, _RECORD.size)
            if offset >= end or len(head) < _RECORD.size:
                return False
            opcode, length = _RECORD.unpack(head)
            if opcode in {_MESSAGE, _CHUNK}:
                return True
            if opcode in {_DATA_END, _FOOTER} or not _is_record(opcode):
                return opcode not in {_DATA_END, _FOOTER}
            offset += _RECORD.size + length
        return True

    def read_chunk(self, chunk: ListedChunk) -> Iterator[Batch]:
        """Yield the messages of a chunk of the index."""
        head = self.bytes_at(chunk.offset, _RECORD.size)
        if len(head) < _RECORD.size or head[0] != _CHUNK:
            self.add_problem(f"there is no chunk at byte {chunk.offset}, where the index lists one")
            return
        yield from self._chunk_batches(chunk.offset)

    def _walk_records(self, chunks: list[int]) -> Iterator[tuple[int, int, int]]:
        """Yield offset, opcode and end of each record of the data section; continue at the next chunk after damage."""
        offset, damaged = len(MCAP.magic), 0
        while (head := self.bytes_at(offset, _RECORD.size)) and len(head) == _RECORD.size:
            opcode, length = _RECORD.unpack(head)
            end = offset + _RECORD.size + length
            is_intact = _is_record(opcode) and end <= self.size
            if is_intact and opcode in {_DATA_END, _FOOTER}:
                self._check_footer(offset if opcode == _FOOTER else end)
                self._check_end(offset)
                return
            if not is_intact and self._is_followed(opcode, end):
                self.add_problem(f"a record of the unknown type 0x{opcode:02x} was skipped")
                offset = end
                continue
            damaged += not is_intact
            later = None if is_intact or damaged > MAX_DAMAGED_PLACES else next_chunk(chunks, offset)
            if later is not None:
                self.add_problem(f"bytes {offset} to {later} are damaged")
                end = later
            elif is_intact or opcode == _CHUNK:
                yield offset, opcode, min(end, self.size)
            else:
                break
            offset = end
        end = min(offset, self.size)
        self.add_problem(f"truncated at byte {end} of {self.size}; the recorder may have been killed")

    def _is_followed(self, opcode: int, end: int) -> bool:
        """Return whether a record may have a type of a later version of MCAP and is followed by another record."""
        head = self.bytes_at(end, _RECORD.size)
        if opcode == 0 or _is_record(opcode) or len(head) < _RECORD.size:
            return False
        following, length = _RECORD.unpack(head)
        return _is_record(following) and end + _RECORD.size + length <= self.size

    def _check_end(self, offset: int) -> None:
        """Report bytes behind the first footer, from the record at an offset on."""
        while len(head := self.bytes_at(offset, _RECORD.size)) == _RECORD.size:
            opcode, length = _RECORD.unpack(head)
            offset += _RECORD.size + length
            if opcode == _FOOTER:
                break
        rest = self.size - offset - len(MCAP.magic)
        if rest > 0:
            what = "another MCAP file begins there" if self.bytes_at(offset + len(MCAP.magic), 8) == MCAP.magic else ""
            self.add_problem(
                f"the last {rest} bytes were not read, because they follow the end of the recording; {what}".rstrip(
                    "; "
                )
            )

    def _read_summary(self) -> list[int]:
        """Read the channels in the summary at the end of the file, and return the offsets of the chunks it lists."""
        tail = self.bytes_at(self.size - _FOOTER_RECORD.size - len(MCAP.magic), _FOOTER_RECORD.size)
        if len(tail) < _FOOTER_RECORD.size:
            return []
        opcode, _, start, _, crc = _FOOTER_RECORD.unpack(tail)
        if opcode != _FOOTER or not 0 < start < self.size or self.size - start > MAX_UNPACKED_BYTES:
            return []
        summary = self.bytes_at(start, self.size - start)
        if crc and zlib.crc32(summary[:-_CRC_AND_MAGIC]) != crc:  # A recorder may have been killed while writing it.
            return []
        position = 0
        self._chunk_indexes = []
        while position + _RECORD.size <= len(summary):
            opcode, length = _RECORD.unpack_from(summary, position)
            content = summary[position + _RECORD.size : position + _RECORD.size + length]
            if opcode == _STATISTICS:
                self._read_statistics(content)
            elif opcode == _CHUNK_INDEX:
                self._read_chunk_index(content)
            elif opcode in {_SCHEMA, _CHANNEL}:
                self._define(opcode, content)
            position += _RECORD.size + length
        return sorted(each.offset for each in self._chunk_indexes if 0 < each.offset < self.size)

    def _read_chunk_index(self, content: bytes) -> None:
        try:
            first, last, offset, size, channels = _CHUNK_INDEX_HEAD.unpack_from(content)
            numbers = [number for number, _ in _CHANNEL_COUNT.iter_unpack(content[_CHUNK_INDEX_HEAD.size :][:channels])]
            position = _CHUNK_INDEX_HEAD.size + channels
            (after,) = struct.unpack_from("<Q", content, position)
            compression, position = _read_string(content, position + 8)
            _, unpacked = struct.unpack_from("<QQ", content, position)
        except (struct.error, ValueError):
            offset = int.from_bytes(content[16:24], "little")
            first = last = size = after = unpacked = 0
            numbers, compression = [], ""
        self._chunk_indexes.append(
            _ChunkIndex(
                offset,
                offset + size,
                offset + size + after,
                first,
                last,
                tuple(numbers),
                compression or "none",
                unpacked,
            )
        )

    def _read_statistics(self, content: bytes) -> None:
        """Read how many messages the recorder counted."""
        if len(content) < _STATISTICS_HEAD.size:
            return
        self._listed_total, *_, size = _STATISTICS_HEAD.unpack_from(content)
        counts = content[_STATISTICS_HEAD.size :][:size]
        if size and len(counts) == size and size % _CHANNEL_COUNT.size == 0:
            self._listed_counts = dict(_CHANNEL_COUNT.iter_unpack(counts))

    def _check_statistics(self) -> None:
        """Report differences between the recorder's message counts and the messages in the file."""
        read = sum(self._counts.values())
        if self._listed_counts is None:
            if self._listed_total not in {None, read}:
                self.add_problem(f"the statistics count {self._listed_total} messages, but {read} were read")
            return
        for number in sorted(self._listed_counts.keys() | self._counts.keys()):
            listed, found = self._listed_counts.get(number, 0), self._counts.get(number, 0)
            if listed != found:
                topic = self._channels[number].topic if number in self._channels else f"channel {number}"
                text = f"the statistics count {count(listed, 'message')} on {topic}, but {found}"
                self.add_problem(f"{text} {'was' if found == 1 else 'were'} read")
        if self._listed_total != sum(self._listed_counts.values()):
            self.add_problem(
                f"the statistics contradict themselves: {self._listed_total} messages in total, but "
                f"{sum(self._listed_counts.values())} on all topics"
            )

    def _check_footer(self, data_end: int) -> None:
        """Report a footer that does not match the end of the data."""
        tail = self.bytes_at(self.size - _FOOTER_RECORD.size - len(MCAP.magic), _FOOTER_RECORD.size)
        if len(tail) < _FOOTER_RECORD.size or tail[0] != _FOOTER:
            self.add_problem("the footer is missing; the recorder may have been killed")
            return
        start = _FOOTER_RECORD.unpack(tail)[2]
        if start not in {0, data_end}:
            self.add_problem(
                f"the footer is damaged: it places the summary at byte {start}, but the data end at byte {data_end}"
            )

    def _chunk_batches(self, offset: int) -> Iterator[Batch]:
        base = self.add_chunk(offset)
        try:
            data, is_intact = self._unpack(offset)
        except DamagedError as error:
            self.add_problem(f"the chunk at byte {offset} cannot be unpacked: {error}")
            return
        if not is_intact:
            self.add_problem(f"the chunk at byte {offset} is damaged: its checksum does not match")
        done = yield from self._read_records(data, base, is_intact=is_intact)
        if done < len(data):
            self.add_problem(f"{len(data) - done} bytes inside a chunk are damaged or missing")

    def unpack_chunk(self, offset: int) -> bytes:
        """Return the records of the chunk at an offset of the file."""
        return self._unpack(offset)[0]

    def _unpack(self, offset: int) -> tuple[bytes, bool]:
        """Return the records of a chunk, and whether they match its checksum."""
        opcode, length = _RECORD.unpack(self.bytes_at(offset, _RECORD.size))
        assert opcode == _CHUNK
        chunk = memoryview(self.bytes_at(offset + _RECORD.size, min(length, self.size - offset - _RECORD.size)))
        try:
            _, _, size, crc = _CHUNK_HEAD.unpack_from(chunk)
            compression, start = _read_string(chunk, _CHUNK_HEAD.size)
        except (struct.error, ValueError):
            raise DamagedError("the header of the file is damaged or truncated") from None
        self.compressions.add(compression or "none")
        packed = chunk[start + 8 :]
        self.check_budget(offset, len(packed), size)
        data = unpack(compression, packed, size)
        return data, crc in {0, zlib.crc32(data)}

    def _read_records(self, data: bytes, base: int, *, is_intact: bool = True) -> Generator[Batch, None, int]:
        """Yield the messages in a sequence of records, and return the number of bytes that were read.

        Args:
            data: The records.
            base: Added to an offset in ``data`` to get a position.
            is_intact: Whether the records are as they were written.
        """
        *columns, definitions, done = _core.mcap_records(data)
        before: dict[int, list[tuple[int, Channel]]] = {}  # definitions until a record, by number
        for opcode, start, end in definitions:
            if not is_intact and int.from_bytes(data[start : start + 2], "little") in self._channels:
                continue
            if (replaced := self._define(opcode, data[start:end])) is not None:
                before.setdefault(replaced[0], []).append((start, replaced[1]))
        channels = np.frombuffer(columns[0], dtype=np.uint16)
        times, records, starts, ends = (np.frombuffer(column, dtype=np.uint64) for column in columns[1:])
        for number in np.unique(channels).tolist() if len(channels) > 1 else channels.tolist():
            of_channel = channels == number
            self._counts[number] = self._counts.get(number, 0) + int(np.count_nonzero(of_channel))
            valid = of_channel & (times < _MAX_RECEIVE_TIME)
            parts = [(valid, self._channels.get(number))]
            if number in before:
                parts = _split_at_definitions(valid, records, before[number], parts[0][1])
            for rows, channel in parts:
                if channel is None:
                    self.add_problem(f"messages of channel {number}, which is not defined", int(np.count_nonzero(rows)))
                else:
                    messages = Slices(data, starts[rows], ends[rows])
                    positions = records[rows] + np.uint64(base)
                    yield Batch(channel, times[rows].astype(np.int64), positions, messages, is_intact)
        if (times >= _MAX_RECEIVE_TIME).any():
            self.add_problem("messages with an invalid receive time", int(np.count_nonzero(times >= _MAX_RECEIVE_TIME)))
        return done

    def payload(self, source: bytes | None, offset: int) -> bytes | memoryview:
        """Return the message in the record at an offset."""
        if source is None:
            source, start = self.bytes_at(offset, _RECORD.size), 0
            if len(source) == _RECORD.size:
                source = self.bytes_at(offset, _RECORD.size + _RECORD.unpack(source)[1])
        else:
            start = offset
        if len(source) < start + _MESSAGE_RECORD.size:
            raise DamagedError("the message no longer exists")
        return memoryview(source)[
            start + _MESSAGE_RECORD.size : start + _RECORD.size + _RECORD.unpack_from(source, start)[1]
        ]

    def _define(self, opcode: int, data: bytes) -> tuple[int, Channel] | None:
        """Read a schema or a channel unless it is already known. The summary and later chunks repeat them.

        Returns:
            The number of a channel and its definition so far, if this is another one.
        """
        identifier = int.from_bytes(data[:2], "little")
        if opcode == _CHANNEL and self._channel_records.get(identifier) == data:
            return None
        try:
            if opcode == _SCHEMA:
                known = self._schemas.get(identifier)
                if known is not None and known[2] and data.endswith(known[2]):
                    return None
                name, position = _read_string(data, 2)
                kind, position = _read_string(data, position)
                name, kind = sys.intern(name), sys.intern(kind)  # Tens of thousands of schemas can have the same name.
                (length,) = struct.unpack_from("<I", data, position)
                self._schemas[identifier] = (name, kind, data[position + 4 : position + 4 + length])
                return None
            number, schema = struct.unpack_from("<HH", data)
            topic, position = _read_string(data, 4)
            encoding, position = _read_string(data, position)
            encoding = sys.intern(encoding)
            offered_qos = _entry(data, position, "offered_qos_profiles")
        except (struct.error, ValueError, IndexError):
            self.add_problem("the definition of a channel is damaged")
            return None
        name, kind, definition = self._schemas.get(schema, ("", "", b""))
        if encoding in {"cdr", "ros1"}:
            name = _ros_type(name)
        channel = Channel(topic, name, encoding, definition, kind, offered_qos)
        known_channel = self._channels.get(number)
        if known_channel is not None and _channel_key(known_channel) == _channel_key(channel):
            self._channel_records[number] = data
            return None  # Messages of a channel are one track, even if its metadata are written in another order.
        if known_channel is not None and known_channel.type:
            self.add_problem(f"channel {number} is defined differently for {known_channel.topic} and for {topic}")
        self._channels[number], self._channel_records[number] = channel, data
        return None if known_channel is None else (number, known_channel)


_MAX_RECEIVE_TIME = np.uint64(1 << 63)


def _ros_type(name: str) -> str:
    """Return the full name of a message type, whose form differs in DDS and ROS 1."""
    try:
        return name if "/msg/" in name else sys.intern(ros_name(name))
    except ValueError:
        return name


def _split_at_definitions(
    rows: NDArray[np.bool_],
    records: NDArray[np.uint64],
    before: list[tuple[int, Channel]],
    channel: Channel | None,
) -> list[tuple[NDArray[np.bool_], Channel | None]]:
    """Return the rows before and after each new definition of their channel, with the definition."""
    parts: list[tuple[NDArray[np.bool_], Channel | None]] = []
    for end, old in before:
        parts.append((rows & (records < end), old))
        rows = rows & (records >= end)
    return [(part, definition) for part, definition in [*parts, (rows, channel)] if part.any()]


def _channel_key(channel: Channel) -> tuple[str, str, str, bytes]:
    return channel.topic, channel.type, channel.encoding, channel.definition


def _is_record(opcode: int) -> bool:
    return 0 < opcode <= _LAST_OPCODE or opcode >= 0x80


def _entry(data: bytes, position: int, wanted: str) -> str:
    """Return a value of the map of strings at a position, or "" if the key is missing."""
    end = min(position + 4 + int.from_bytes(data[position : position + 4], "little"), len(data))
    position += 4
    while position < end:
        key, position = _read_string(data, position)
        value, position = _read_string(data, position)
        if key == wanted:
            return value
    return ""


def _read_string(data: bytes | memoryview, position: int) -> tuple[str, int]:
    """Return the length-prefixed string at a position, and the offset of its end."""
    (length,) = struct.unpack_from("<I", data, position)
    end = position + 4 + length
    if end > len(data):
        raise ValueError("a string is longer than its record")
    return bytes(data[position + 4 : end]).decode("utf-8", "replace"), end
