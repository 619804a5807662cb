# SPDX-License-Identifier: Apache-2.0
"""The records of MCAP files that an editor needs. The format is described at https://mcap.dev/spec."""

from __future__ import annotations

import struct
import sys
import zlib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

from coframe.bags._compression import MAX_UNPACKED_BYTES, DamagedError, unpack
from coframe.bags.formats import MCAP
from coframe.bags.storage import Channel
from coframe.messages.schemas import ros_name

if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import BinaryIO

__all__ = [
    "ATTACHMENT",
    "ATTACHMENT_INDEX",
    "CHANNEL",
    "CHUNK",
    "CHUNK_INDEX",
    "DATA_END",
    "FOOTER",
    "HEADER",
    "MESSAGE",
    "MESSAGE_HEAD",
    "MESSAGE_INDEX",
    "METADATA",
    "METADATA_INDEX",
    "RECORD",
    "SCHEMA",
    "STATISTICS",
    "SUMMARY_OFFSET",
    "Chunk",
    "ChunkPlace",
    "Definitions",
    "Summary",
    "encoded_map",
    "encoded_text",
    "has_data_crc",
    "read_chunk",
    "read_head",
    "read_map",
    "read_summary",
    "record",
    "text_at",
]

HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX, CHUNK_INDEX = range(1, 9)
ATTACHMENT, ATTACHMENT_INDEX, STATISTICS, METADATA, METADATA_INDEX, SUMMARY_OFFSET, DATA_END = range(9, 16)
RECORD = struct.Struct("<BQ")  # opcode, length
MESSAGE_HEAD = struct.Struct("<BQHIQQ")  # opcode, length, channel, sequence, log time, publish time
_CHUNK_HEAD = struct.Struct("<QQQI")  # first and last log time, unpacked size, its CRC or 0
_CHUNK_INDEX_HEAD = struct.Struct("<QQQQI")  # first and last log time, offset, length, bytes of the map
_FOOTER_RECORD = struct.Struct("<BQQQI")
_STATISTICS_HEAD = struct.Struct("<QHIIIIQQ")
_CHANNEL_OFFSET = struct.Struct("<HQ")
_CRC_AND_MAGIC = 4 + len(MCAP.magic)  # bytes at the end of the file that the CRC of the summary does not cover


class Chunk(NamedTuple):
    """An unpacked chunk.

    Attributes:
        first: First log time.
        last: Last log time.
        compression: As the file names it, or "" for none.
        packed: Number of packed bytes.
        data: The records.
        has_crc: Whether the chunk has a checksum.
    """

    first: int
    last: int
    compression: str
    packed: int
    data: bytes
    has_crc: bool


class ChunkPlace(NamedTuple):
    """An entry of the index: where a chunk is, its log times, and the channels in it."""

    offset: int
    first: int
    last: int
    channels: frozenset[int]


class Definitions:
    """The schemas and channels of one file, by their numbers."""

    def __init__(self) -> None:
        self.channels: dict[int, Channel] = {}
        self.channel_records: dict[int, bytes] = {}  # contents of the records
        self.schema_records: dict[int, bytes] = {}
        self._schemas: dict[int, tuple[str, str, bytes]] = {}

    def add_schema(self, content: bytes) -> None:
        """Read a schema.

        Raises:
            DamagedError: It is damaged, or its number has another schema.
        """
        number = int.from_bytes(content[:2], "little")
        if self.schema_records.get(number) == content:
            return
        try:
            name, position = text_at(content, 2)
            kind, position = text_at(content, position)
            (length,) = struct.unpack_from("<I", content, position)
        except (struct.error, ValueError):
            raise DamagedError("a schema is damaged") from None
        new = (sys.intern(name), sys.intern(kind), content[position + 4 : position + 4 + length])
        if self._schemas.setdefault(number, new) != new:
            raise DamagedError(f"schema {number} is defined twice, in different ways")
        self.schema_records[number] = content

    def add_channel(self, content: bytes) -> Channel | None:
        """Read a channel; return it if it is new.

        Raises:
            DamagedError: It is damaged, or its number has another channel.
        """
        number = int.from_bytes(content[:2], "little")
        if self.channel_records.get(number) == content:
            return None
        try:
            _, schema = struct.unpack_from("<HH", content)
            topic, position = text_at(content, 4)
            encoding, position = text_at(content, position)
            metadata = read_map(content, position)
        except (struct.error, ValueError):
            raise DamagedError("a channel is damaged") from None
        name, kind, definition = self._schemas.get(schema, ("", "", b""))
        if encoding in {"cdr", "ros1"}:
            name = _ros_type(name)
        qos = metadata.get("offered_qos_profiles", "")
        channel = Channel(topic, name, encoding, definition, kind, qos, metadata.get("callerid", ""))
        known = self.channels.get(number)
        if known is not None:
            if _facts(known) != _facts(channel):
                raise DamagedError(f"channel {number} is defined twice: for {known.topic} and for {topic}")
            return None
        self.channels[number], self.channel_records[number] = channel, content
        return channel


@dataclass
class Summary:
    """What the end of a file contains about it."""

    definitions: Definitions = field(default_factory=Definitions)
    chunks: list[ChunkPlace] = field(default_factory=list)
    span: tuple[int, int] | None = None
    messages: int | None = None


def read_head(file: BinaryIO) -> tuple[int, int] | None:
    """Return the opcode and the length of the record at the position of a file; None at its end."""
    head = file.read(RECORD.size)
    return RECORD.unpack(head) if len(head) == RECORD.size else None


def has_data_crc(file: BinaryIO, size: int) -> bool:
    """Return whether the data section of a file has a checksum."""
    tail_start = size - _FOOTER_RECORD.size - len(MCAP.magic)
    file.seek(max(tail_start, 0))
    tail = file.read(_FOOTER_RECORD.size)
    if len(tail) < _FOOTER_RECORD.size:
        return False
    opcode, _, start, _, _ = _FOOTER_RECORD.unpack(tail)
    end = (start or tail_start) - RECORD.size - 4
    if opcode != FOOTER or not 0 < end < size:
        return False
    file.seek(end)
    data_end = file.read(RECORD.size + 4)
    return data_end[:1] == bytes([DATA_END]) and any(data_end[RECORD.size :])


def read_summary(file: BinaryIO, size: int) -> Summary | None:
    """Return the summary of a file with an index of its chunks, or None if it has none.

    Raises:
        DamagedError: A definition in it is damaged.
    """
    tail_start = size - _FOOTER_RECORD.size - len(MCAP.magic)
    if tail_start <= 0:
        return None
    file.seek(tail_start)
    opcode, _, start, _, crc = _FOOTER_RECORD.unpack(file.read(_FOOTER_RECORD.size))
    if opcode != FOOTER or not 0 < start < size or size - start > MAX_UNPACKED_BYTES:
        return None
    file.seek(start)
    content = file.read(size - start)
    if crc and zlib.crc32(content[:-_CRC_AND_MAGIC]) != crc:
        return None
    summary, late = Summary(), []
    for opcode, body in _records(content):
        if opcode == SCHEMA:
            summary.definitions.add_schema(body)
        elif opcode == CHANNEL:
            late.append(body)
        elif opcode == CHUNK_INDEX and len(body) >= _CHUNK_INDEX_HEAD.size:
            first, last, offset, _, length = _CHUNK_INDEX_HEAD.unpack_from(body)
            entries = body[_CHUNK_INDEX_HEAD.size :][: length - length % _CHANNEL_OFFSET.size]
            channels = frozenset(number for number, _ in _CHANNEL_OFFSET.iter_unpack(entries))
            summary.chunks.append(ChunkPlace(offset, first, last, channels))
        elif opcode == STATISTICS and len(body) >= _STATISTICS_HEAD.size:
            summary.messages, *_, first, last = _STATISTICS_HEAD.unpack_from(body)
            summary.span = (first, last) if summary.messages else None
    for body in late:
        summary.definitions.add_channel(body)
    return summary


def read_chunk(content: bytes) -> Chunk:
    """Return the chunk in the content of its record.

    Raises:
        DamagedError: It is damaged.
    """
    try:
        first, last, size, crc = _CHUNK_HEAD.unpack_from(content)
        compression, position = text_at(content, _CHUNK_HEAD.size)
        (length,) = struct.unpack_from("<Q", content, position)
    except (struct.error, ValueError):
        raise DamagedError("the header of a chunk is damaged") from None
    packed = memoryview(content)[position + 8 :]
    if len(packed) != length:
        raise DamagedError("a chunk does not have the length in its header")
    data = unpack(compression, packed, size)
    if len(data) != size or crc not in {0, zlib.crc32(data)}:
        raise DamagedError("a chunk is damaged: its length or checksum does not match")
    return Chunk(first, last, compression, length, data, crc != 0)


def record(opcode: int, content: bytes | bytearray) -> bytes:
    """Return a record."""
    return RECORD.pack(opcode, len(content)) + content


def encoded_text(text: str) -> bytes:
    """Return a string with its length."""
    encoded = text.encode("utf-8", "surrogateescape")
    return struct.pack("<I", len(encoded)) + encoded


def encoded_map(values: dict[str, str]) -> bytes:
    """Return a map of strings with its length."""
    content = b"".join(encoded_text(part) for pair in values.items() for part in pair)
    return struct.pack("<I", len(content)) + content


def text_at(data: bytes, position: int) -> tuple[str, int]:
    """Return the string at a position, and the position of its end.

    Raises:
        ValueError: The string is longer than the record.
        struct.error: The record ends before the string.
    """
    (length,) = struct.unpack_from("<I", data, position)
    end = position + 4 + length
    if end > len(data):
        raise ValueError("a string is longer than its record")
    return str(data[position + 4 : end], "utf-8", "surrogateescape"), end


def read_map(data: bytes, position: int) -> dict[str, str]:
    """Return the map of strings at a position; the errors are those of :func:`read_text`."""
    (length,) = struct.unpack_from("<I", data, position)
    position += 4
    end = position + length
    found = {}
    while position < end:
        key, position = text_at(data, position)
        found[key], position = text_at(data, position)
    return found


def _records(content: bytes) -> Iterator[tuple[int, bytes]]:
    position = 0
    while position + RECORD.size <= len(content):
        opcode, length = RECORD.unpack_from(content, position)
        yield opcode, content[position + RECORD.size : position + RECORD.size + length]
        position += RECORD.size + length


def _ros_type(name: str) -> str:
    """Return the full name of a message type, whose form differs in DDS and ROS 1."""
    try:
        return name if "/msg/" in name else sys.intern(ros_name(name))
    except ValueError:
        return name


def _facts(channel: Channel) -> tuple[str, str, str, bytes]:
    return channel.topic, channel.type, channel.encoding, channel.definition
