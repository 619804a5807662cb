# SPDX-License-Identifier: Apache-2.0
"""Edit a recording in a format that coframe only reads, such as a ROS 1 bag: the result is one MCAP file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.bags._offered_qos import OfferedQos, from_yaml, to_yaml
from coframe.bags.cdr_conversion import Conversion, cdr_conversion, copied_definition
from coframe.bags.editing._message import EditedMessage
from coframe.bags.editing._survey import Source
from coframe.bags.formats import MCAP
from coframe.bags.recording import open_bag
from coframe.bags.storage import Channel
from coframe.messages.definition_texts import definition_of
from coframe.type_names import TF_MESSAGE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from contextlib import ExitStack
    from pathlib import Path

    from coframe.bags._problems import Problems
    from coframe.bags._recorded_types import RecordedTypes
    from coframe.bags.editing._metadata import EditedFile
    from coframe.bags.editing._pipeline import InsertedMessage, Pipeline

__all__ = ["ConvertingEditor", "ConvertingSource"]

_PROGRESS_STEP = 1000  # messages
_MAX_CHUNK_BYTES = 4 << 20


class ConvertingSource(Source):
    """The messages of a recording in receive order, in CDR where that is possible."""

    def __init__(self, path: Path, types: RecordedTypes, problems: Problems, closing: ExitStack) -> None:
        self.recording = closing.enter_context(open_bag(path, transforms=False))
        self._problems = problems
        self._conversions: dict[Channel, tuple[Channel, Callable[[bytes], bytes]] | None] = {}
        for channel in self.recording.channels():
            self._conversions[channel] = self._conversion(channel, types)

    def _conversion(self, channel: Channel, types: RecordedTypes) -> tuple[Channel, Callable[[bytes], bytes]] | None:
        found: Conversion | None = cdr_conversion(channel, types)
        if channel.encoding != "ros1":
            definition, format_ = copied_definition(channel, types)
            text = definition_of(channel.type) if definition is None else definition
            return Channel(
                channel.topic,
                channel.type,
                channel.encoding,
                text.encode(),
                format_,
                channel.offered_qos,
                channel.publisher,
            ), bytes
        if found is None:
            self._problems.add(
                f"{channel.topic}: its type {channel.type} of ROS 1 cannot be converted; it was left out"
            )
            return None
        text = definition_of(found.type) if found.definition is None else found.definition
        kept = (text.encode(), "ros2msg" if text else "", channel.offered_qos, channel.publisher)
        return Channel(channel.topic, found.type, "cdr", *kept), found.convert

    def channels(self) -> list[Channel]:
        """Return all channels that can be written."""
        return [found[0] for found in self._conversions.values() if found is not None]

    def span(self) -> tuple[int, int] | None:
        """Return the first and last receive time."""
        recording = self.recording
        return (recording.received_start, recording.received_end) if recording.received_end else None

    def messages(self, is_selected: Callable[[Channel], bool]) -> Iterator[tuple[Channel, int, bytes]]:
        """Yield the messages of some channels in receive order."""
        names = {found[0].topic for found in self._conversions.values() if found is not None and is_selected(found[0])}
        for channel, received, data in self.recording.in_order(sorted(names)):
            found = self._conversions.get(channel)
            if found is None or not is_selected(found[0]):
                continue
            try:
                converted = found[1](data)
            except Exception:  # noqa: BLE001 - the libraries raise errors of many kinds for damaged bytes
                self._problems.add(f"{channel.topic}: damaged messages were left out")
                continue
            yield found[0], received, converted


class ConvertingEditor:
    """Writes one MCAP file.

    Args:
        source: The messages.
        target: The file to write, which must not exist; None to write nothing.
        pipeline: What to change.
        inserted: Messages to add at the beginning.
        compression: ``zstd``, ``lz4`` or ``none``; None is ``zstd``.
        edited: Receives the counts.
    """

    def __init__(
        self,
        source: ConvertingSource,
        target: Path | None,
        pipeline: Pipeline,
        inserted_messages: list[InsertedMessage],
        compression: str | None,
        edited: EditedFile,
    ) -> None:
        self._source = source
        self._writer = None if target is None else MCAP.create(target, compression or "zstd")
        self._pipeline = pipeline
        self._inserted_messages = inserted_messages
        self._edited_file = edited
        self._numbers: dict[tuple[str, str], int] = {}

    def run(self, progress: Callable[[int], object]) -> None:
        """Write the file; `progress` is called with the part of its bytes that has been read."""
        total = sum(topic.messages for topic in self._source.recording.topics.values())
        size = sum(size for _, size in self._source.recording.files)
        try:
            for topic, data, received in self._inserted_messages:
                known = {self._pipeline.route(each).topic: each for each in self._source.channels()}
                if topic not in known:
                    self._edited_file.new_topics.append(topic)
                qos = to_yaml([OfferedQos(1, transient_local=True)])
                definition = definition_of(TF_MESSAGE).encode()
                channel = known.get(topic) or Channel(topic, TF_MESSAGE, "cdr", definition, "ros2msg", qos)
                self._write(topic, channel, data, received)
            for number, (channel, received, data) in enumerate(self._source.messages(lambda _: True)):
                if number % _PROGRESS_STEP == 0:
                    progress(size * number // max(total, 1))
                route = self._pipeline.route(channel)
                message = EditedMessage(data, received, received)
                kept = route.topic is not None and route.edit(message)
                if route.topic is None or kept:
                    route.count(1)
                if route.topic is not None and kept:
                    self._write(route.topic, channel, message.data, message.received)
        finally:
            if self._writer is not None:
                self._writer.close()

    def _write(self, topic: str, channel: Channel, data: bytes, receive_time: int) -> None:
        self._edited_file.counts[topic] = self._edited_file.counts.get(topic, 0) + 1
        self._edited_file.add_span(receive_time, receive_time)
        if self._writer is None:
            return
        key = (topic, channel.type)
        if key not in self._numbers:
            qos = channel.offered_qos if from_yaml(channel.offered_qos) else ""
            self._numbers[key] = self._writer.add_channel(
                topic,
                channel.type,
                encoding=channel.encoding,
                definition=channel.definition.decode("utf-8", "replace"),
                definition_format=channel.definition_format,
                metadata={"offered_qos_profiles": qos},
            )
        self._writer.write(self._numbers[key], data, receive_time, receive_time)
        if self._writer.pending >= _MAX_CHUNK_BYTES:
            self._writer.flush()
