# SPDX-License-Identifier: Apache-2.0
"""Writer for one MCAP file that is valid at any moment. The format is described at https://mcap.dev/spec.

Each flush writes a chunk and, after it, the end of the file. The next flush overwrites that end. If the recorder is
killed, any reader can therefore open the file. While the index of all chunks is small, the end contains it, because
some readers (Rerun's) require an index. Once it is large, only `close` writes it.
"""

from __future__ import annotations

import importlib
import os
import struct
import zlib
from array import array
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from coframe._process.optional_imports import pip_install
from coframe.bags.formats import MCAP
from coframe.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

__all__ = ["COMPRESSIONS", "McapWriter", "compressor"]

COMPRESSIONS = ("none", "zstd", "lz4")

_HEADER, _FOOTER, _SCHEMA, _CHANNEL, _CHUNK, _MESSAGE_INDEX, _CHUNK_INDEX = 0x01, 0x02, 0x03, 0x04, 0x06, 0x07, 0x08
_STATISTICS, _SUMMARY_OFFSET, _DATA_END = 0x0B, 0x0E, 0x0F
_RECORD = struct.Struct("<BQ")  # opcode, length
_MESSAGE_RECORD = struct.Struct("<BQHIQQ")  # opcode, length, channel, sequence, log time, publish time
_MESSAGE = 0x05
_MESSAGE_HEAD = _MESSAGE_RECORD.size - _RECORD.size
_MAX_INDEX_BYTES = 1 << 20  # bytes to write with each chunk: enough for half an hour or more
_ZSTD_LEVEL = 1  # level 3 takes 50 percent longer, and the files are only a few percent smaller


class McapWriter:
    """Writes one MCAP file; not thread-safe.

    Args:
        path: The file, which must not exist.
        compression: One of `COMPRESSIONS`.

    Attributes:
        size: Size of the file in bytes, including pending messages.
        counts: Number of flushed messages by channel.
        start: First log time of the flushed messages, in nanoseconds, or 0 if there are none.
        end: Last log time of the flushed messages, in nanoseconds, or 0 if there are none.

    Raises:
        OSError: The file cannot be created.
        RecordingError: The package for the compression is not installed.
    """

    def __init__(self, path: Path, compression: str = "zstd") -> None:
        self._compress = compressor(compression)
        self._compression = _text("" if compression == "none" else compression)
        self._file = path.open("xb", buffering=0)
        self._definitions = bytearray()  # schemas and channels, which the summary repeats
        self._schemas: dict[tuple[str, str, str], int] = {}
        self._sequences: list[int] = []  # the next sequence number by channel
        self._pending = bytearray()
        self._index: dict[int, array[int]] = {}  # by channel: log time and offset of each pending message
        self._first_time, self._last = 0, 0  # log times of the pending messages
        self._chunks = 0
        self._chunk_index = bytearray()  # their index records
        self._end = 0  # offset of the next chunk
        self._has_summary = False  # at that offset
        self.counts: list[int] = []
        self.start = 0
        self.end = 0
        self._append(MCAP.magic + _pack_record(_HEADER, _text("ros2") + _text("coframe")), with_summary=False)

    @property
    def size(self) -> int:
        """Size of the file in bytes, including pending messages."""
        return self._end + len(self._pending)

    @property
    def count(self) -> int:
        """Number of flushed messages."""
        return sum(self.counts)

    @property
    def pending(self) -> int:
        """Bytes to be written by the next flush, before compression."""
        return len(self._pending)

    def add_channel(
        self,
        topic: str,
        ros_type: str,
        *,
        encoding: str,
        definition: str,
        definition_format: str,
        metadata: Mapping[str, str],
    ) -> int:
        """Add a channel for messages of a type on a topic, and return its number."""
        key = (ros_type, definition_format, definition)
        if key not in self._schemas:
            self._schemas[key] = len(self._schemas) + 1
            text = struct.pack("<H", self._schemas[key]) + b"".join(
                map(_text, (ros_type, definition_format, definition))
            )
            self._define(_pack_record(_SCHEMA, text))
        number = len(self.counts)
        self.counts.append(0)
        self._sequences.append(0)
        pairs = b"".join(_text(part) for pair in metadata.items() for part in pair)
        head = struct.pack("<HH", number, self._schemas[key]) + _text(topic) + _text(encoding)
        self._define(_pack_record(_CHANNEL, head + struct.pack("<I", len(pairs)) + pairs))
        return number

    def write(self, channel: int, data: bytes, log_time: int, publish_time: int) -> None:
        """Add a message, which the next flush writes to the file. Times are in nanoseconds."""
        if channel not in self._index:
            self._index[channel] = array("Q")
        self._index[channel].extend((log_time, len(self._pending)))
        if len(self._index) == 1 and len(self._index[channel]) == 2:
            self._first_time = self._last = log_time
        self._first_time, self._last = min(self._first_time, log_time), max(self._last, log_time)
        length = _MESSAGE_HEAD + len(data)
        sequence = self._sequences[channel] & 0xFFFFFFFF
        self._pending += _MESSAGE_RECORD.pack(_MESSAGE, length, channel, sequence, log_time, publish_time)
        self._pending += data
        self._sequences[channel] += 1

    def flush(self) -> None:
        """Write the pending messages to the file as one chunk. They survive the end of this process.

        Raises:
            OSError: Writing failed, for example because the disk is full. The file is unchanged, and the pending
                messages are lost.
        """
        if not self._index:
            return
        packed = self._compress(bytes(self._pending))
        times = struct.pack("<QQ", self._first_time, self._last)
        head = times + struct.pack("<QI", len(self._pending), zlib.crc32(self._pending)) + self._compression
        chunk = _pack_record(_CHUNK, head + struct.pack("<Q", len(packed)) + packed)
        indices, offsets = self._message_indices(self._end + len(chunk))
        index = times + struct.pack("<QQI", self._end, len(chunk), len(offsets)) + offsets
        index += (
            struct.pack("<Q", len(indices)) + self._compression + struct.pack("<QQ", len(packed), len(self._pending))
        )
        statistics = (self.start, self.end, self.counts.copy())
        record = _pack_record(_CHUNK_INDEX, index)
        self._count_pending(record)
        try:
            self._append(chunk + indices, with_summary=self._is_index_small())
        except OSError:
            self.start, self.end, self.counts = statistics
            self._chunks -= 1
            del self._chunk_index[-len(record) :]
            self._restore_end()
            raise

    def close(self) -> None:
        """Write the pending messages and the index, and wait until all is on the disk.

        Raises:
            OSError: Writing failed, for example because the disk is full. The file is valid, but has no index.
        """
        try:
            self.flush()
            if not self._has_summary:
                self._end_with_summary()
            self._end = self._file.seek(0, os.SEEK_END)
            os.fsync(self._file.fileno())
        finally:
            self._file.close()

    def _end_with_summary(self) -> None:
        try:
            self._append(b"", with_summary=True)
        except OSError:
            self._restore_end()
            raise

    def _count_pending(self, chunk_index: bytes) -> None:
        """Count the pending messages as flushed."""
        self.start = min(self.start, self._first_time) if self.count else self._first_time
        self.end = max(self.end, self._last)
        for channel, entries in self._index.items():
            self.counts[channel] += len(entries) // 2
        self._chunks += 1
        self._chunk_index += chunk_index
        self._index = {}
        self._pending.clear()

    def _is_index_small(self) -> bool:
        return len(self._chunk_index) + len(self._definitions) <= _MAX_INDEX_BYTES

    def _define(self, record: bytes) -> None:
        self._definitions += record
        self._pending += record

    def _message_indices(self, offset: int) -> tuple[bytes, bytes]:
        """Return the message index records that follow a chunk, and the offset of each of them."""
        records, offsets = bytearray(), bytearray()
        for channel, entries in self._index.items():
            offsets += struct.pack("<HQ", channel, offset + len(records))
            packed = struct.pack(f"<{len(entries)}Q", *entries)
            records += _pack_record(_MESSAGE_INDEX, struct.pack("<HI", channel, len(packed)) + packed)
        return bytes(records), bytes(offsets)

    def _summary(self, offset: int) -> bytes:
        """Return the end of the file, with a summary that begins at an offset."""
        counts = b"".join(struct.pack("<HQ", *pair) for pair in enumerate(self.counts))
        statistics = struct.pack(
            "<QHIIIIQQ",
            *(self.count, len(self._schemas), len(self.counts), 0, 0, self._chunks, self.start, self.end),
        )
        groups: list[tuple[int, bytes | bytearray]] = [*self._definition_groups(), (_CHUNK_INDEX, self._chunk_index)]
        groups.append((_STATISTICS, _pack_record(_STATISTICS, statistics + struct.pack("<I", len(counts)) + counts)))
        data_end = _pack_record(_DATA_END, bytes(4))
        start = offset + len(data_end)
        summary, offsets = bytearray(), bytearray()
        for opcode, records in groups:
            if records:
                group = struct.pack("<BQQ", opcode, start + len(summary), len(records))
                offsets += _pack_record(_SUMMARY_OFFSET, group)
                summary += records
        footer = _RECORD.pack(_FOOTER, 20) + struct.pack("<QQ", start, start + len(summary))
        checksum = zlib.crc32(summary + offsets + footer)
        return data_end + bytes(summary + offsets) + footer + struct.pack("<I", checksum) + MCAP.magic

    def _definition_groups(self) -> list[tuple[int, bytearray]]:
        """Return the schemas and the channels, as two groups."""
        groups = {_SCHEMA: bytearray(), _CHANNEL: bytearray()}
        position = 0
        while position < len(self._definitions):
            opcode, length = _RECORD.unpack_from(self._definitions, position)
            end = position + _RECORD.size + length
            groups[opcode] += self._definitions[position:end]
            position = end
        return list(groups.items())

    def _append(self, data: bytes, *, with_summary: bool) -> None:
        """Append data and a file end."""
        end = self._end + len(data)
        self._write_at(self._end, data + (self._summary(end) if with_summary else _END))
        self._file.truncate()
        self._end = end
        self._has_summary = with_summary

    def _restore_end(self) -> None:
        """Restore the file end after a failed append. If the disk is full, only the short end may fit."""
        for with_summary in (self._has_summary, False):
            with suppress(OSError):
                self._file.truncate(self._end)
                self._append(b"", with_summary=with_summary)
                break

    def _write_at(self, offset: int, data: bytes) -> None:
        self._file.seek(offset)
        rest = memoryview(data)
        while rest:
            rest = rest[self._file.write(rest) :]


def _pack_record(opcode: int, content: bytes) -> bytes:
    return _RECORD.pack(opcode, len(content)) + content


def _text(text: str) -> bytes:
    encoded = text.encode("utf-8", "replace")
    return struct.pack("<I", len(encoded)) + encoded


# The end of a file without a summary.
_END = _pack_record(_DATA_END, bytes(4)) + _pack_record(_FOOTER, bytes(20)) + MCAP.magic


def compressor(name: str) -> Callable[[bytes], bytes]:
    """Return the function that compresses a chunk.

    Raises:
        ValueError: The compression is unknown.
        RecordingError: The package for the compression is not installed.
    """
    if name not in COMPRESSIONS:
        raise ValueError(f"No compression named {name!r}. Known compressions: {', '.join(COMPRESSIONS)}.")
    if name == "none":
        return bytes
    module: Any
    try:
        module = importlib.import_module("zstandard" if name == "zstd" else "lz4.frame")
    except ModuleNotFoundError as error:
        raise RecordingError(
            f"compression with {name} needs the package {str(error.name).partition('.')[0]}, which is not installed",
            hint=f"{pip_install('bags')}, or choose no compression.",
        ) from None
    compress: Callable[[bytes], bytes] = (
        module.ZstdCompressor(level=_ZSTD_LEVEL).compress if name == "zstd" else module.compress
    )
    return compress
