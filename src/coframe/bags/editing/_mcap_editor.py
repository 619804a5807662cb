# SPDX-License-Identifier: Apache-2.0
"""Edit one MCAP file: read it once, write what does not change as it is, and a new index.

Chunks without a message that changes are copied with their compression. All other records outside of chunks, such as
attachments, are copied as well.
"""

from __future__ import annotations

import os
import struct
import zlib
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe import _core
from coframe._files.regular_files import open_regular
from coframe.bags._compression import MAX_UNPACKED_BYTES, DamagedError
from coframe.bags._mcap_writer import compressor
from coframe.bags._offered_qos import OfferedQos, to_yaml
from coframe.bags.editing import _mcap_layout as mcap
from coframe.bags.editing._message import EditedMessage
from coframe.bags.editing._metadata import ROSBAG2, edited_text
from coframe.bags.formats import MCAP
from coframe.messages.definition_texts import definition_of
from coframe.type_names import TF_MESSAGE

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path
    from typing import BinaryIO

    from numpy.typing import NDArray

    from coframe.bags.editing._metadata import EditedFile
    from coframe.bags.editing._pipeline import InsertedMessage, Pipeline, Route

__all__ = ["McapEditor"]

_BLOCK_BYTES = 4 << 20  # bytes to read or copy at once
_MAX_TIME = np.uint64((1 << 63) - 1)


class _Edited(NamedTuple):
    """Edited records: their bytes, and of each message the channel, the log time and the offset."""

    data: bytes | bytearray
    channels: NDArray[np.uint16]
    times: NDArray[np.uint64]
    offsets: NDArray[np.uint64]
    is_changed: bool


@dataclass
class _Indexed:
    """The chunk whose message indexes come next in the input."""

    times: tuple[int, int]
    offset: int
    length: int
    compression: str
    packed: int
    unpacked: int
    index: dict[int, int]  # channel: offset of its message index
    end: int  # offset of the end of the last one


class McapEditor:
    """Edits one file.

    Args:
        source: The file to read.
        target: The file to write, which must not exist; None to write nothing.
        pipeline: What to change.
        definitions: The schemas and channels of the whole file, for messages that are added.
        inserted: Messages to add at the beginning.
        compression: The compression of chunks; None keeps it, and copies chunks that do not change.

    Raises:
        OSError: The file cannot be read or written.
        DamagedError: The file is damaged.
    """

    def __init__(
        self,
        source: Path,
        target: Path | None,
        pipeline: Pipeline,
        definitions: mcap.Definitions,
        inserted: list[InsertedMessage],
        compression: str | None,
        edited: EditedFile,
    ) -> None:
        self._source = source
        self._target = target
        self._pipeline = pipeline
        self._all = definitions
        self._inserted = inserted
        self._compression = None if compression is None else ("" if compression == "none" else compression)
        self._compressors: dict[str, Callable[[bytes], bytes]] = {}
        self._edited = edited
        self._definitions = mcap.Definitions()
        self._routes: dict[int, Route] = {}
        self._editing: list[int] = []  # channels whose messages are edited or dropped
        self._channels: dict[int, bytes] = {}  # contents of the edited records
        self._schemas: dict[int, bytes] = {}
        self._counts: dict[int, int] = {}
        self._indexes: dict[int, list[bytes]] = {}  # index records by opcode
        self._chunk: _Indexed | None = None
        self._copies_indexes = False
        self._crc = 0
        self._end = 0

    def run(self, progress: Callable[[int], object]) -> None:
        """Edit the file; `progress` is called with the number of bytes that have been read."""
        with open_regular(self._source) as file:
            if self._target is None:
                self._edit(file, _Nowhere(), progress)
            else:
                with self._target.open("xb") as out:
                    self._edit(file, out, progress)

    def _edit(self, file: BinaryIO, out: Any, progress: Callable[[int], object]) -> None:
        self._out = out
        if file.read(len(MCAP.magic)) != MCAP.magic:
            raise DamagedError("it does not begin like an MCAP file")
        self._write(MCAP.magic)
        has_crc = False
        while True:
            head = mcap.read_head(file)
            if head is None:
                raise DamagedError("it is truncated: the recorder may have been killed")
            opcode, length = head
            if opcode != mcap.MESSAGE_INDEX:
                self._finish_chunk()
            if opcode in {mcap.DATA_END, mcap.FOOTER}:
                has_crc = opcode == mcap.DATA_END and any(file.read(4))
                break
            if opcode == mcap.CHUNK:
                self._edit_chunk(self._content(file, length))
            elif opcode in {mcap.SCHEMA, mcap.CHANNEL, mcap.MESSAGE}:
                self._edit_block(file, length)
            elif opcode == mcap.MESSAGE_INDEX:
                self._copy_message_index(self._content(file, length))
            elif opcode in {mcap.ATTACHMENT, mcap.METADATA} or opcode == mcap.HEADER or opcode > mcap.DATA_END:
                self._copy_other(file, opcode, length)
            else:
                raise DamagedError(f"a record of the type 0x{opcode:02x} is in the wrong place")
            progress(file.tell())
        self._insert("")
        self._write_end(has_crc)

    def _content(self, file: BinaryIO, length: int) -> bytes:
        if length > MAX_UNPACKED_BYTES:
            raise DamagedError(f"a record claims to have {length} bytes")
        content = file.read(length)
        if len(content) < length:
            raise DamagedError("it is truncated inside a record")
        return content

    def _write(self, data: bytes | bytearray | memoryview) -> None:
        self._crc = zlib.crc32(data, self._crc)
        self._out.write(data)
        self._end += len(data)

    # Chunks

    def _edit_chunk(self, content: bytes) -> None:
        chunk = mcap.read_chunk(content)
        edited = self._edit_records(chunk.data)
        compression = chunk.compression if self._compression is None else self._compression
        self._insert(compression)
        if not edited.is_changed and compression == chunk.compression:
            self._begin_chunk(chunk.first, chunk.last, chunk.compression, chunk.packed, len(chunk.data))
            self._write(mcap.RECORD.pack(mcap.CHUNK, len(content)))
            self._write(content)
            self._copies_indexes = True
            self._end_of_chunk()
        elif edited.data:
            self._write_chunk(edited, compression, has_crc=chunk.has_crc)
        self._count(edited)

    def _begin_chunk(self, first: int, last: int, compression: str, packed: int, unpacked: int) -> None:
        self._chunk = _Indexed((first, last), self._end, 0, compression, packed, unpacked, {}, 0)

    def _end_of_chunk(self) -> None:
        assert self._chunk is not None
        self._chunk.length = self._end - self._chunk.offset
        self._chunk.end = self._end

    def _write_chunk(self, edited: _Edited, compression: str, *, has_crc: bool) -> None:
        data = bytes(edited.data)
        packed = self._packed(data, compression)
        first, last = (int(edited.times.min()), int(edited.times.max())) if len(edited.times) else (0, 0)
        self._begin_chunk(first, last, compression, len(packed), len(data))
        head = struct.pack("<QQQI", first, last, len(data), zlib.crc32(data) if has_crc else 0)
        head += mcap.encoded_text(compression) + struct.pack("<Q", len(packed))
        self._write(mcap.RECORD.pack(mcap.CHUNK, len(head) + len(packed)) + head)
        self._write(packed)
        self._copies_indexes = False
        self._end_of_chunk()
        for number in np.unique(edited.channels).tolist():
            rows = edited.channels == number
            entries = np.column_stack((edited.times[rows], edited.offsets[rows])).astype("<u8").tobytes()
            self._write_message_index(number, struct.pack("<HI", number, len(entries)) + entries)

    def _packed(self, data: bytes, compression: str) -> bytes:
        if compression not in self._compressors:
            self._compressors[compression] = compressor(compression or "none")
        return self._compressors[compression](data)

    def _copy_message_index(self, content: bytes) -> None:
        if self._chunk is not None and self._copies_indexes:
            self._write_message_index(int.from_bytes(content[:2], "little"), content)

    def _write_message_index(self, number: int, content: bytes) -> None:
        assert self._chunk is not None
        self._chunk.index[number] = self._end
        self._write(mcap.record(mcap.MESSAGE_INDEX, content))
        self._chunk.end = self._end

    def _finish_chunk(self) -> None:
        """Add the index record of the last chunk."""
        chunk = self._chunk
        if chunk is None:
            return
        self._chunk = None
        offsets = b"".join(struct.pack("<HQ", *pair) for pair in chunk.index.items())
        head = struct.pack("<QQQQI", *chunk.times, chunk.offset, chunk.length, len(offsets)) + offsets
        head += struct.pack("<Q", chunk.end - chunk.offset - chunk.length) + mcap.encoded_text(chunk.compression)
        self._add_index(mcap.CHUNK_INDEX, head + struct.pack("<QQ", chunk.packed, chunk.unpacked))

    def _add_index(self, opcode: int, content: bytes) -> None:
        self._indexes.setdefault(opcode, []).append(mcap.record(opcode, content))

    # Records

    def _edit_block(self, file: BinaryIO, length: int) -> None:
        """Edit records outside of chunks."""
        start = file.tell() - mcap.RECORD.size
        file.seek(start)
        data = file.read(max(_BLOCK_BYTES, min(length, MAX_UNPACKED_BYTES) + mcap.RECORD.size))
        done = _core.mcap_records(data)[6]
        if not done:
            raise DamagedError("it is truncated inside a record")
        edited = self._edit_records(data[:done])
        if len(edited.channels):
            self._insert(None)
        self._write(edited.data)
        self._count(edited)
        file.seek(start + done)

    def _edit_records(self, data: bytes) -> _Edited:
        *columns, places, done = _core.mcap_records(data)
        if done != len(data):
            raise DamagedError("the records in a chunk are damaged")
        patches = self._edit_definitions(data, places)
        channels = np.frombuffer(columns[0], np.uint16)
        times, records, starts, ends = (np.frombuffer(column, np.uint64) for column in columns[1:])
        if len(times) and times.max() > _MAX_TIME:
            raise DamagedError("a message has an invalid log time")
        self._check_channels(channels)
        kept = np.ones(len(channels), np.bool_)
        edits = np.isin(channels, self._editing) if self._editing else ~kept
        if edits.any():
            rows = np.flatnonzero(edits)
            times = times.copy()
            message_patches = self._edit_messages(data, rows, channels, times, records, starts, ends, kept)
            patches = sorted([*patches, *message_patches]) if patches else message_patches
        if not patches:
            return _Edited(data, channels, times, records, is_changed=False)
        return _Edited(*_patched(data, patches, channels, times, records, kept), is_changed=True)

    def _edit_messages(
        self,
        data: bytes,
        rows: NDArray[np.intp],
        channels: NDArray[np.uint16],
        times: NDArray[np.uint64],
        records: NDArray[np.uint64],
        starts: NDArray[np.uint64],
        ends: NDArray[np.uint64],
        kept: NDArray[np.bool_],
    ) -> list[tuple[int, int, bytes]]:
        """Edit the messages in some rows; return what replaces them, and update their times and `kept`."""
        patches: list[tuple[int, int, bytes]] = []
        unpack, size = mcap.MESSAGE_HEAD.unpack_from, mcap.MESSAGE_HEAD.size
        columns = (rows, channels[rows], records[rows], starts[rows], ends[rows])
        for row, number, record, start, end in zip(*(column.tolist() for column in columns), strict=True):
            route = self._routes[number]
            if route.topic is None:
                route.count(1)
            else:
                _, _, _, sequence, received, published = unpack(data, record)
                old = data[start:end]
                message = EditedMessage(old, received, published)
                if route.edit(message):
                    new = message.data
                    if message.received == received and message.published == published and len(new) == len(old):
                        if new != old:
                            patches.append((start, end, new))
                        continue
                    head = (sequence, message.received, message.published)
                    length = size - mcap.RECORD.size + len(new)
                    packed = mcap.MESSAGE_HEAD.pack(mcap.MESSAGE, length, number, *head)
                    patches.append((record, end, packed + new))
                    times[row] = message.received
                    continue
            kept[row] = False
            patches.append((record, end, b""))
        return patches

    def _check_channels(self, channels: NDArray[np.uint16]) -> None:
        for number in np.flatnonzero(np.bincount(channels, minlength=1)).tolist() if len(channels) else []:
            if number not in self._routes:
                raise DamagedError(f"messages of channel {number}, which is not defined")

    def _edit_definitions(self, data: bytes, places: list[tuple[int, int, int]]) -> list[tuple[int, int, bytes]]:
        """Read the schemas and channels in records; return what replaces them."""
        patches = []
        for opcode, start, end in places:
            content = data[start:end]
            if opcode == mcap.SCHEMA:
                self._definitions.add_schema(content)
                self._schemas[int.from_bytes(content[:2], "little")] = content
                continue
            new = self._edit_channel(content)
            if new is None:
                patches.append((start - mcap.RECORD.size, end, b""))
            elif new != content:
                patches.append((start - mcap.RECORD.size, end, mcap.record(mcap.CHANNEL, new)))
        return patches

    def _edit_channel(self, content: bytes) -> bytes | None:
        """Read a channel; return the new content of its record, None if its topic is dropped."""
        number = int.from_bytes(content[:2], "little")
        self._definitions.add_channel(content)
        if number not in self._routes:
            # The survey has the same channel, so that a rule sees each one once.
            known = self._all.channels.get(number, self._definitions.channels[number])
            route = self._routes[number] = self._pipeline.route(known)
            if route.topic is None or route.steps:
                self._editing.append(number)
        topic = self._routes[number].topic
        if topic is None:
            return None
        old, position = mcap.read_text(content, 4)
        new = content if topic == old else content[:4] + mcap.encoded_text(topic) + content[position:]
        self._channels[number] = new
        return new

    def _count(self, edited: _Edited) -> None:
        if not len(edited.times):
            return
        self._edited.add_span(int(edited.times.min()), int(edited.times.max()))
        counts = np.bincount(edited.channels)
        for number in np.flatnonzero(counts).tolist():
            self._counts[number] = self._counts.get(number, 0) + int(counts[number])

    # Insertions

    def _insert(self, compression: str | None) -> None:
        """Write the messages to add, before the first message of the file: as a chunk, or as records if it has none."""
        inserted, self._inserted = self._inserted, []
        if not inserted:
            return
        records = bytearray()
        channels, times, offsets = [], [], []
        for topic, data, received in inserted:
            number, definitions = self._channel_of(topic)
            records += definitions
            channels.append(number)
            times.append(received)
            offsets.append(len(records))
            length = mcap.MESSAGE_HEAD.size - mcap.RECORD.size + len(data)
            records += mcap.MESSAGE_HEAD.pack(mcap.MESSAGE, length, number, 0, received, received) + data
        edited = _Edited(
            records, np.array(channels, np.uint16), np.array(times, np.uint64), np.array(offsets, np.uint64), True
        )
        if compression is None:
            self._write(records)
        else:
            self._write_chunk(edited, compression, has_crc=True)
            self._finish_chunk()
        self._count(edited)

    def _channel_of(self, topic: str) -> tuple[int, bytes]:
        """Return the number of a channel for TFMessages on a topic, and the records that define it."""
        for number, channel in self._all.channels.items():
            route = self._pipeline.route(channel)
            if route.topic == topic and channel.type == TF_MESSAGE and channel.encoding == "cdr":
                content = self._all.channel_records[number]
                schema_number = int.from_bytes(content[2:4], "little")
                schema = self._all.schema_records.get(schema_number, b"")
                new = self._edit_channel(content)
                assert new is not None
                self._schemas.setdefault(schema_number, schema)
                if schema:
                    self._definitions.add_schema(schema)
                return number, (mcap.record(mcap.SCHEMA, schema) if schema else b"") + mcap.record(mcap.CHANNEL, new)
        return self._new_channel(topic)

    def _new_channel(self, topic: str) -> tuple[int, bytes]:
        used, schemas = self._all.channels.keys() | self._routes.keys(), self._all.schema_records.keys() | {0}
        number, schema_number = max(used, default=-1) + 1, max(schemas) + 1
        texts = b"".join(map(mcap.encoded_text, (TF_MESSAGE, "ros2msg", definition_of(TF_MESSAGE))))
        schema = struct.pack("<H", schema_number) + texts
        qos = mcap.encoded_map({"offered_qos_profiles": to_yaml([OfferedQos(1, transient_local=True)])})
        channel = struct.pack("<HH", number, schema_number) + mcap.encoded_text(topic) + mcap.encoded_text("cdr") + qos
        self._schemas[schema_number], self._channels[number] = schema, channel
        self._edited.new_topics.append(topic)
        return number, mcap.record(mcap.SCHEMA, schema) + mcap.record(mcap.CHANNEL, channel)

    # Other records

    def _copy_other(self, file: BinaryIO, opcode: int, length: int) -> None:
        start = self._end
        if opcode == mcap.METADATA:
            content = self._edit_metadata(self._content(file, length))
            name, _ = mcap.read_text(content, 0)
            self._write(mcap.record(opcode, content))
            index = struct.pack("<QQ", start, self._end - start) + mcap.encoded_text(name)
            self._add_index(mcap.METADATA_INDEX, index)
            return
        self._write(mcap.RECORD.pack(opcode, length))
        beginning = b""
        left = length
        while left:
            part = file.read(min(left, _BLOCK_BYTES))
            if not part:
                raise DamagedError("it is truncated inside a record")
            beginning = beginning or part
            self._write(part)
            left -= len(part)
        if opcode == mcap.ATTACHMENT:
            self._index_attachment(beginning, start)

    def _edit_metadata(self, content: bytes) -> bytes:
        """Return the content of a metadata record, in which rosbag2 repeats its metadata.yaml."""
        try:
            name, position = mcap.read_text(content, 0)
            values = mcap.read_map(content, position)
        except (struct.error, ValueError):
            raise DamagedError("a metadata record is damaged") from None
        text = values.get("serialized_metadata", "")
        if name != ROSBAG2 or not text:
            return content
        new = edited_text(text, self._pipeline, {self._channel_topic(n): count for n, count in self._counts.items()})
        return (
            content
            if new == text
            else mcap.encoded_text(name) + mcap.encoded_map({**values, "serialized_metadata": new})
        )

    def _index_attachment(self, content: bytes, start: int) -> None:
        try:
            times = content[:16]
            name, position = mcap.read_text(content, 16)
            media_type, position = mcap.read_text(content, position)
            (size,) = struct.unpack_from("<Q", content, position)
        except (struct.error, ValueError):
            raise DamagedError("an attachment is damaged") from None
        index = struct.pack("<QQ", start, self._end - start) + times + struct.pack("<Q", size)
        self._add_index(mcap.ATTACHMENT_INDEX, index + mcap.encoded_text(name) + mcap.encoded_text(media_type))

    def _channel_topic(self, number: int) -> str:
        return mcap.read_text(self._channels[number], 4)[0]

    # End

    def _write_end(self, has_crc: bool) -> None:
        for number, count in self._counts.items():
            topic = self._channel_topic(number)
            self._edited.counts[topic] = self._edited.counts.get(topic, 0) + count
            if number in self._routes:
                self._routes[number].count(count)
        end = struct.pack("<I", self._crc if has_crc else 0)
        self._write(mcap.record(mcap.DATA_END, end))
        start = self._end
        first, last = self._edited.span or (0, 0)
        counts = b"".join(struct.pack("<HQ", *pair) for pair in sorted(self._counts.items()))
        sizes = [
            len(self._indexes.get(opcode, ()))
            for opcode in (mcap.ATTACHMENT_INDEX, mcap.METADATA_INDEX, mcap.CHUNK_INDEX)
        ]
        statistics = struct.pack(
            "<QHIIIIQQ", sum(self._counts.values()), len(self._schemas), len(self._channels), *sizes, first, last
        )
        groups = {
            mcap.SCHEMA: [mcap.record(mcap.SCHEMA, each) for each in self._schemas.values()],
            mcap.CHANNEL: [mcap.record(mcap.CHANNEL, each) for each in self._channels.values()],
            mcap.STATISTICS: [mcap.record(mcap.STATISTICS, statistics + struct.pack("<I", len(counts)) + counts)],
            **{each: self._indexes[each] for each in sorted(self._indexes)},
        }
        summary, offsets = bytearray(), bytearray()
        for opcode, records in groups.items():
            if records:
                group = b"".join(records)
                offsets += mcap.record(
                    mcap.SUMMARY_OFFSET, struct.pack("<BQQ", opcode, start + len(summary), len(group))
                )
                summary += group
        footer = mcap.RECORD.pack(mcap.FOOTER, 20) + struct.pack("<QQ", start, start + len(summary))
        checksum = zlib.crc32(summary + offsets + footer)
        self._write(bytes(summary + offsets) + footer + struct.pack("<I", checksum) + MCAP.magic)
        self._out.flush()
        if self._target is not None:
            os.fsync(self._out.fileno())


class _Nowhere:
    """Takes what a dry run writes."""

    def write(self, data: bytes) -> int:
        return len(data)

    def flush(self) -> None:
        pass


def _patched(
    data: bytes,
    patches: list[tuple[int, int, bytes]],
    channels: NDArray[np.uint16],
    times: NDArray[np.uint64],
    records: NDArray[np.uint64],
    kept: NDArray[np.bool_],
) -> tuple[bytearray, NDArray[np.uint16], NDArray[np.uint64], NDArray[np.uint64]]:
    """Return the records with replaced parts, and of each message that is kept its channel, time and new offset."""
    out, position = bytearray(), 0
    view = memoryview(data)
    for start, end, new in patches:
        out += view[position:start]
        out += new
        position = end
    out += view[position:]
    starts = np.fromiter((patch[0] for patch in patches), np.int64, len(patches))
    moved = np.cumsum(np.fromiter((len(new) - (end - start) for start, end, new in patches), np.int64, len(patches)))
    before = np.searchsorted(starts, records[kept].astype(np.int64), side="left")
    shift = np.where(before > 0, moved[before - 1], 0)
    return out, channels[kept], times[kept], (records[kept].astype(np.int64) + shift).astype(np.uint64)
