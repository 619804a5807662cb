"""One MCAP file that is whole at any moment; the format is described at https://mcap.dev/spec.

What was written is followed by a file's end, and each next chunk goes over that end and brings its own. So a recorder
that is killed leaves a file that any reader opens. The end has the index of all chunks as long as that is small, since
there are readers that want one (Rerun's); then only `close` writes it.
"""

from __future__ import annotations

import importlib
import os
import struct
import zlib
from array import array
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from coframe.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

__all__ = ["COMPRESSIONS", "McapWriter", "compressor"]

COMPRESSIONS = ("none", "zstd", "lz4")

_MAGIC = b"\x89MCAP0\r\n"
_HEADER, _FOOTER, _SCHEMA, _CHANNEL, _CHUNK, _MESSAGE_INDEX, _CHUNK_INDEX = 0x01, 0x02, 0x03, 0x04, 0x06, 0x07, 0x08
_STATISTICS, _SUMMARY_OFFSET, _DATA_END = 0x0B, 0x0E, 0x0F
_RECORD = struct.Struct("<BQ")  # opcode, length
_MESSAGE_RECORD = struct.Struct("<BQHIQQ")  # opcode, length, channel, sequence, log time, publish time
_MESSAGE = 0x05
_MESSAGE_HEAD = _MESSAGE_RECORD.size - _RECORD.size
_LARGEST_INDEX = 1 << 20  # bytes that are written with each chunk: those of half an hour or more
_ZSTD_LEVEL = 1  # a recorder is to be light: level 3 takes half as long again for some percent


class McapWriter:
    """Writes one file; not for several threads at once.

    Args:
        path: The file, which must not be there yet.
        compression: One of `COMPRESSIONS`.

    Attributes:
        size: Bytes of the file so far, and of what waits for the next flush.
        counts: Messages that were flushed, by channel.
        start: Their first log time, in nanoseconds; 0 before there is one.
        end: Their last log time.

    Raises:
        OSError: It cannot be made.
        RecordingError: The package for that compression is not installed.
    """

    def __init__(self, path: Path, compression: str = "zstd") -> None:
        self._compress = compressor(compression)
        self._compression = _text("" if compression == "none" else compression)
        self._file = path.open("xb", buffering=0)
        self._definitions = bytearray()  # schemas and channels, which are said again at the end
        self._schemas: dict[tuple[str, str, str], int] = {}
        self._sequences: list[int] = []  # messages by channel, which are numbered from 0
        self._pending = bytearray()
        self._index: dict[int, array[int]] = {}  # by channel: log time and offset of each pending message
        self._first, self._last = 0, 0  # log times of what is pending
        self._chunks: list[bytes] = []
        self._end = 0  # where the next chunk goes
        self._tail = _END  # what follows there
        self._index_size = 0  # bytes of the chunks' indices
        self.counts: list[int] = []
        self.start = 0
        self.end = 0
        self._append(_MAGIC + _record(_HEADER, _text("ros2") + _text("coframe")), _END)

    @property
    def size(self) -> int:  # noqa: D102 - described above
        return self._end + len(self._pending)

    @property
    def count(self) -> int:
        """Messages that were flushed."""
        return sum(self.counts)

    @property
    def pending(self) -> int:
        """Bytes that wait for the next flush."""
        return len(self._pending)

    def add_channel(
        self,
        topic: str,
        ros_type: str,
        *,
        encoding: str,
        definition: str,
        definition_format: str,
        about: Mapping[str, str],
    ) -> int:
        """A channel for messages of a type on a topic: its number."""
        key = (ros_type, definition_format, definition)
        if key not in self._schemas:
            self._schemas[key] = len(self._schemas) + 1
            text = struct.pack("<H", self._schemas[key]) + b"".join(
                map(_text, (ros_type, definition_format, definition))
            )
            self._define(_record(_SCHEMA, text))
        number = len(self.counts)
        self.counts.append(0)
        self._sequences.append(0)
        metadata = b"".join(_text(part) for pair in about.items() for part in pair)
        head = struct.pack("<HH", number, self._schemas[key]) + _text(topic) + _text(encoding)
        self._define(_record(_CHANNEL, head + struct.pack("<I", len(metadata)) + metadata))
        return number

    def write(self, channel: int, data: bytes, log_time: int, publish_time: int) -> None:
        """A message, which is on the disk after the next flush. Times are nanoseconds."""
        if channel not in self._index:
            self._index[channel] = array("Q")
        self._index[channel].extend((log_time, len(self._pending)))
        if len(self._index) == 1 and len(self._index[channel]) == 2:
            self._first = self._last = log_time
        self._first, self._last = min(self._first, log_time), max(self._last, log_time)
        length = _MESSAGE_HEAD + len(data)
        sequence = self._sequences[channel] & 0xFFFFFFFF
        self._pending += _MESSAGE_RECORD.pack(_MESSAGE, length, channel, sequence, log_time, publish_time)
        self._pending += data
        self._sequences[channel] += 1

    def flush(self) -> None:
        """Gives what is pending to the operating system, as one chunk: it survives the end of this process.

        Raises:
            OSError: The disk is full, for example. The file is then as it was before, and what was pending is lost.
        """
        if not self._index:
            return
        packed = self._compress(bytes(self._pending))
        times = struct.pack("<QQ", self._first, self._last)
        head = times + struct.pack("<QI", len(self._pending), zlib.crc32(self._pending)) + self._compression
        chunk = _record(_CHUNK, head + struct.pack("<Q", len(packed)) + packed)
        indices, offsets = self._message_indices(self._end + len(chunk))
        about = times + struct.pack("<QQI", self._end, len(chunk), len(offsets)) + offsets
        about += (
            struct.pack("<Q", len(indices)) + self._compression + struct.pack("<QQ", len(packed), len(self._pending))
        )
        before = self._noted()
        self._note(_record(_CHUNK_INDEX, about))
        try:
            self._append(chunk + indices, self._tail_at(self._end + len(chunk) + len(indices)))
        except OSError:
            self._forget(before)
            raise

    def close(self) -> None:
        """Writes the rest and the index, and waits until the disk has it all.

        Raises:
            OSError: The disk is full, for example. The file is then whole, but has no index.
        """
        try:
            self.flush()
            summary = self._summary(self._end)
            if self._tail != summary:
                self._append(b"", summary)
            self._end += len(summary)
            os.fsync(self._file.fileno())
        finally:
            self._file.close()

    def _note(self, chunk_index: bytes) -> None:
        """Counts what is pending as written."""
        self.start = min(self.start, self._first) if self.count else self._first
        self.end = max(self.end, self._last)
        for channel, entries in self._index.items():
            self.counts[channel] += len(entries) // 2
        self._chunks.append(chunk_index)
        self._index_size += len(chunk_index)
        self._index = {}
        self._pending.clear()

    def _noted(self) -> tuple[int, int, list[int]]:
        return self.start, self.end, self.counts.copy()

    def _forget(self, before: tuple[int, int, list[int]]) -> None:
        """Undoes the last `_note`."""
        self.start, self.end, self.counts = before
        self._index_size -= len(self._chunks.pop())

    def _tail_at(self, offset: int) -> bytes:
        """The end of the file behind a chunk that ends there."""
        small = self._index_size + len(self._definitions) <= _LARGEST_INDEX
        return self._summary(offset) if small else _END

    def _define(self, record: bytes) -> None:
        self._definitions += record
        self._pending += record

    def _message_indices(self, offset: int) -> tuple[bytes, bytes]:
        """The records that follow a chunk, and where each of them is."""
        records, offsets = bytearray(), bytearray()
        for channel, entries in self._index.items():
            offsets += struct.pack("<HQ", channel, offset + len(records))
            packed = struct.pack(f"<{len(entries)}Q", *entries)
            records += _record(_MESSAGE_INDEX, struct.pack("<HI", channel, len(packed)) + packed)
        return bytes(records), bytes(offsets)

    def _summary(self, offset: int) -> bytes:
        """The end of a file with an index, which begins there."""
        counts = b"".join(struct.pack("<HQ", *pair) for pair in enumerate(self.counts))
        statistics = struct.pack(
            "<QHIIIIQQ",
            *(self.count, len(self._schemas), len(self.counts), 0, 0, len(self._chunks), self.start, self.end),
        )
        groups = [*self._definition_groups(), (_CHUNK_INDEX, b"".join(self._chunks))]
        groups.append((_STATISTICS, _record(_STATISTICS, statistics + struct.pack("<I", len(counts)) + counts)))
        data_end = _record(_DATA_END, bytes(4))
        start = offset + len(data_end)
        summary, offsets = bytearray(), bytearray()
        for opcode, records in groups:
            if records:
                place = struct.pack("<BQQ", opcode, start + len(summary), len(records))
                offsets += _record(_SUMMARY_OFFSET, place)
                summary += records
        footer = _RECORD.pack(_FOOTER, 20) + struct.pack("<QQ", start, start + len(summary))
        checksum = zlib.crc32(summary + offsets + footer)
        return data_end + bytes(summary + offsets) + footer + struct.pack("<I", checksum) + _MAGIC

    def _definition_groups(self) -> list[tuple[int, bytes]]:
        """The schemas, then the channels."""
        groups = {_SCHEMA: bytearray(), _CHANNEL: bytearray()}
        position = 0
        while position < len(self._definitions):
            opcode, length = _RECORD.unpack_from(self._definitions, position)
            end = position + _RECORD.size + length
            groups[opcode] += self._definitions[position:end]
            position = end
        return [(opcode, bytes(records)) for opcode, records in groups.items()]

    def _append(self, data: bytes, tail: bytes) -> None:
        """Puts data and an end of the file behind what is there, or leaves the file as it was."""
        try:
            self._write_at(self._end, data + tail)
            self._file.truncate()
        except OSError:
            for old in (self._tail, _END):  # somebody else may have taken the room meanwhile
                with suppress(OSError):
                    self._file.truncate(self._end)
                    self._write_at(self._end, old)
                    break
            raise
        self._end += len(data)
        self._tail = tail

    def _write_at(self, offset: int, data: bytes) -> None:
        self._file.seek(offset)
        rest = memoryview(data)
        while rest:
            rest = rest[self._file.write(rest) :]


def _record(opcode: int, content: bytes) -> bytes:
    return _RECORD.pack(opcode, len(content)) + content


def _text(text: str) -> bytes:
    encoded = text.encode("utf-8", "replace")
    return struct.pack("<I", len(encoded)) + encoded


# The end of a file without an index.
_END = _record(_DATA_END, bytes(4)) + _record(_FOOTER, bytes(20)) + _MAGIC


def compressor(name: str) -> Callable[[bytes], bytes]:
    """What compresses a chunk.

    Raises:
        ValueError: There is no such compression.
        RecordingError: The package for it is not installed.
    """
    if name not in COMPRESSIONS:
        raise ValueError(f"there is no compression {name!r}: it is one of {', '.join(COMPRESSIONS)}")
    if name == "none":
        return bytes
    module: Any
    try:
        module = importlib.import_module("zstandard" if name == "zstd" else "lz4.frame")
    except ModuleNotFoundError as error:
        raise RecordingError(
            f"compressing by {name} needs the package {str(error.name).partition('.')[0]}, which is not installed",
            hint="pip install 'coframe[bags]', or choose no compression.",
        ) from None
    compress: Callable[[bytes], bytes] = (
        module.ZstdCompressor(level=_ZSTD_LEVEL).compress if name == "zstd" else module.compress
    )
    return compress
