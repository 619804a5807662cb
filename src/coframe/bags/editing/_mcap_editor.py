# SPDX-License-Identifier: Apache-2.0
"""Edit one MCAP file: read it once, copy unchanged parts as they are, and write a new index.

Chunks without a message that changes are copied with their compression. All other records outside of chunks, such as
attachments, are copied as well.
"""

from __future__ import annotations

import os
import struct
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe import _core
from coframe._files.regular_files import open_regular
from coframe.bags._compression import MAX_UNPACKED_BYTES, DamagedError
from coframe.bags._offered_qos import OfferedQos, to_yaml
from coframe.bags.editing import _mcap_layout as mcap
from coframe.bags.editing._mcap_output import IndexedRecords, McapOutput
from coframe.bags.editing._message import EditedMessage
from coframe.bags.editing._metadata import ROSBAG2, edit_text
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


class _EditedRecords(NamedTuple):
    """Edited records, and whether they differ from what was read."""

    records: IndexedRecords
    is_changed: bool


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
        inserted_messages: list[InsertedMessage],
        compression: str | None,
        edited: EditedFile,
    ) -> None:
        self._source = source
        self._target = target
        self._pipeline = pipeline
        self._all = definitions
        self._inserted_messages = inserted_messages
        self._compression = None if compression is None else ("" if compression == "none" else compression)
        self._edited_file = edited
        self._definitions = mcap.Definitions()
        self._routes: dict[int, Route] = {}
        self._editing: list[int] = []  # channels whose messages are edited or dropped
        self._channels: dict[int, bytes] = {}  # contents of the edited records
        self._schemas: dict[int, bytes] = {}
        self._counts: dict[int, int] = {}
        self._copies_indexes = False

    def run(self, progress: Callable[[int], object]) -> None:
        """Edit the file; `progress` is called with the number of bytes that have been read."""
        with open_regular(self._source) as file:
            has_crc = mcap.has_data_crc(file, os.fstat(file.fileno()).st_size)
            file.seek(0)
            if self._target is None:
                with McapOutput(_NullFile(), has_crc=False) as self._out:
                    self._edit(file, progress)
                return
            with self._target.open("xb") as target, McapOutput(target, has_crc=has_crc) as self._out:
                self._edit(file, progress)
                target.flush()
                os.fsync(target.fileno())

    def _edit(self, file: BinaryIO, progress: Callable[[int], object]) -> None:
        if file.read(len(MCAP.magic)) != MCAP.magic:
            raise DamagedError("it does not begin like an MCAP file")
        self._out.write(MCAP.magic)
        while True:
            head = mcap.read_head(file)
            if head is None:
                raise DamagedError("it is truncated: the recorder may have been killed")
            opcode, length = head
            if opcode != mcap.MESSAGE_INDEX:
                self._out.finish_chunk()
            if opcode in {mcap.DATA_END, mcap.FOOTER}:
                break
            self._edit_record(file, opcode, length)
            progress(file.tell())
        self._insert("")
        self._finish()

    def _edit_record(self, file: BinaryIO, opcode: int, length: int) -> None:
        """Edit or copy the record whose content begins at the position of the file."""
        if opcode == mcap.CHUNK:
            self._edit_chunk(self._edit_content(file, length))
        elif opcode in {mcap.SCHEMA, mcap.CHANNEL, mcap.MESSAGE}:
            self._edit_block(file, length)
        elif opcode == mcap.MESSAGE_INDEX:
            content = self._edit_content(file, length)
            if self._copies_indexes:
                self._out.copy_message_index(content)
        elif opcode in {mcap.HEADER, mcap.ATTACHMENT, mcap.METADATA} or opcode > mcap.DATA_END:
            self._copy_other(file, opcode, length)
        else:
            raise DamagedError(f"a record of the type 0x{opcode:02x} is in the wrong place")

    def _edit_content(self, file: BinaryIO, length: int) -> bytes:
        if length > MAX_UNPACKED_BYTES:
            raise DamagedError(f"a record claims to have {length} bytes")
        content = file.read(length)
        if len(content) < length:
            raise DamagedError("it is truncated inside a record")
        return content

    def _edit_chunk(self, content: bytes) -> None:
        chunk = mcap.read_chunk(content)
        edited = self._edit_records(chunk.data)
        compression = chunk.compression if self._compression is None else self._compression
        self._insert(compression)
        self._copies_indexes = not edited.is_changed and compression == chunk.compression
        if self._copies_indexes:
            self._out.copy_chunk(content, chunk)
        elif edited.records.data:
            self._out.write_chunk(edited.records, compression, has_crc=chunk.has_crc)
        self._count(edited.records)

    def _edit_block(self, file: BinaryIO, length: int) -> None:
        """Edit records outside of chunks."""
        start = file.tell() - mcap.RECORD.size
        file.seek(start)
        data = file.read(max(_BLOCK_BYTES, min(length, MAX_UNPACKED_BYTES) + mcap.RECORD.size))
        done = _core.mcap_records(data)[6]
        if not done:
            raise DamagedError("it is truncated inside a record")
        records = self._edit_records(data[:done]).records
        if len(records.channels):
            self._insert(None)
        self._out.write(records.data)
        self._count(records)
        file.seek(start + done)

    def _edit_records(self, data: bytes) -> _EditedRecords:
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
            return _EditedRecords(IndexedRecords(data, channels, times, records), is_changed=False)
        return _EditedRecords(_apply_patches(data, patches, channels, times, records, kept), is_changed=True)

    def _edit_messages(
        self,
        data: bytes,
        rows: NDArray[np.intp],
        channels: NDArray[np.uint16],
        times: NDArray[np.uint64],
        records: NDArray[np.uint64],
        starts: NDArray[np.uint64],
        ends: NDArray[np.uint64],
        keep_mask: NDArray[np.bool_],
    ) -> list[tuple[int, int, bytes]]:
        """Edit the messages in some rows. Return their replacements, and update their times and `keep_mask`."""
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
            keep_mask[row] = False
            patches.append((record, end, b""))
        return patches

    def _check_channels(self, channels: NDArray[np.uint16]) -> None:
        for number in np.flatnonzero(np.bincount(channels, minlength=1)).tolist() if len(channels) else []:
            if number not in self._routes:
                raise DamagedError(f"messages of channel {number}, which is not defined")

    def _edit_definitions(self, data: bytes, places: list[tuple[int, int, int]]) -> list[tuple[int, int, bytes]]:
        """Read the schemas and channels in records, and return their replacements."""
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
        old, position = mcap.text_at(content, 4)
        new = content if topic == old else content[:4] + mcap.encoded_text(topic) + content[position:]
        self._channels[number] = new
        return new

    def _count(self, records: IndexedRecords) -> None:
        if not len(records.times):
            return
        self._edited_file.add_span(int(records.times.min()), int(records.times.max()))
        counts = np.bincount(records.channels)
        for number in np.flatnonzero(counts).tolist():
            self._counts[number] = self._counts.get(number, 0) + int(counts[number])

    def _insert(self, compression: str | None) -> None:
        """Write the messages to add, before the first message of the file: as a chunk, or as records if it has none."""
        inserted, self._inserted_messages = self._inserted_messages, []
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
        numbers = (np.array(channels, np.uint16), np.array(times, np.uint64), np.array(offsets, np.uint64))
        if compression is None:
            self._out.write(records)
        else:
            self._out.write_chunk(IndexedRecords(records, *numbers), compression, has_crc=True)
            self._out.finish_chunk()
        self._count(IndexedRecords(records, *numbers))

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
        self._edited_file.new_topics.append(topic)
        return number, mcap.record(mcap.SCHEMA, schema) + mcap.record(mcap.CHANNEL, channel)

    def _copy_other(self, file: BinaryIO, opcode: int, length: int) -> None:
        self._out.begin_indexed()
        if opcode == mcap.METADATA:
            content = self._edit_metadata(self._edit_content(file, length))
            self._out.write(mcap.record(opcode, content))
            self._out.end_indexed(mcap.METADATA_INDEX, after=mcap.encoded_text(mcap.text_at(content, 0)[0]))
            return
        self._out.write(mcap.RECORD.pack(opcode, length))
        beginning = b""
        left = length
        while left:
            part = file.read(min(left, _BLOCK_BYTES))
            if not part:
                raise DamagedError("it is truncated inside a record")
            beginning = beginning or part
            self._out.write(part)
            left -= len(part)
        if opcode == mcap.ATTACHMENT:
            self._out.end_indexed(mcap.ATTACHMENT_INDEX, after=_attachment_facts(beginning))

    def _edit_metadata(self, content: bytes) -> bytes:
        """Return the content of a metadata record, in which rosbag2 repeats its metadata.yaml."""
        try:
            name, position = mcap.text_at(content, 0)
            values = mcap.read_map(content, position)
        except (struct.error, ValueError):
            raise DamagedError("a metadata record is damaged") from None
        text = values.get("serialized_metadata", "")
        if name != ROSBAG2 or not text:
            return content
        new = edit_text(text, self._pipeline, {self._channel_topic(n): count for n, count in self._counts.items()})
        return (
            content
            if new == text
            else mcap.encoded_text(name) + mcap.encoded_map({**values, "serialized_metadata": new})
        )

    def _channel_topic(self, number: int) -> str:
        return mcap.text_at(self._channels[number], 4)[0]

    def _finish(self) -> None:
        for number, count in self._counts.items():
            topic = self._channel_topic(number)
            self._edited_file.counts[topic] = self._edited_file.counts.get(topic, 0) + count
            if number in self._routes:
                self._routes[number].count(count)
        self._out.finish(self._schemas.values(), self._channels.values(), self._make_statistics)

    def _make_statistics(self, attachments: int, metadata: int, chunks: int) -> bytes:
        """Return the content of the record of statistics."""
        total, numbers = sum(self._counts.values()), (len(self._schemas), len(self._channels))
        times = self._edited_file.span or (0, 0)
        counts = b"".join(struct.pack("<HQ", *pair) for pair in sorted(self._counts.items()))
        head = struct.pack("<QHIIIIQQ", total, *numbers, attachments, metadata, chunks, *times)
        return head + struct.pack("<I", len(counts)) + counts


def _attachment_facts(content: bytes) -> bytes:
    """Return what the index repeats of an attachment."""
    try:
        name, position = mcap.text_at(content, 16)
        media_type, position = mcap.text_at(content, position)
        (size,) = struct.unpack_from("<Q", content, position)
    except (struct.error, ValueError):
        raise DamagedError("an attachment is damaged") from None
    return content[:16] + struct.pack("<Q", size) + mcap.encoded_text(name) + mcap.encoded_text(media_type)


class _NullFile:
    """Discards the output of a dry run."""

    def write(self, data: bytes) -> int:
        return len(data)


def _apply_patches(
    data: bytes,
    patches: list[tuple[int, int, bytes]],
    channels: NDArray[np.uint16],
    times: NDArray[np.uint64],
    records: NDArray[np.uint64],
    keep_mask: NDArray[np.bool_],
) -> IndexedRecords:
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
    before = np.searchsorted(starts, records[keep_mask].astype(np.int64), side="left")
    shift = np.where(before > 0, moved[before - 1], 0)
    offsets = (records[keep_mask].astype(np.int64) + shift).astype(np.uint64)
    return IndexedRecords(out, channels[keep_mask], times[keep_mask], offsets)
