# SPDX-License-Identifier: Apache-2.0
"""Copy the messages of one or more recordings to a new one, to convert, merge or slice them."""

from __future__ import annotations

import heapq
import shutil
from collections import Counter
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from coframe._output.formatting import count
from coframe.bags._offered_qos import from_yaml
from coframe.bags._recorded_types import RecordedTypes
from coframe.bags._writer import Writer
from coframe.bags.cdr_conversion import cdr_conversion, copied_definition
from coframe.bags.recording import open_bag
from coframe.bags.transforms import is_static
from coframe.errors import RecordingError

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from coframe.bags.recording import Recording
    from coframe.bags.storage import Channel

__all__ = ["CopyReport", "copy_recordings"]

_PROGRESS_STEP = 1000  # messages between two calls of the progress function
_Message = tuple["Channel", int, bytes]


class CopyReport(NamedTuple):
    """The result of :func:`copy_recordings`.

    Attributes:
        path: The new recording.
        messages: Number of messages in it.
        problems: What could not be read or converted, one message each.
    """

    path: Path
    messages: int
    problems: list[str]


def copy_recordings(
    sources: Sequence[str | os.PathLike[str]],
    target: str | os.PathLike[str],
    *,
    topics: Iterable[str] | None = None,
    span: Callable[[Recording], tuple[int | None, int | None]] = lambda _recording: (None, None),
    compression: str = "zstd",
    progress: Callable[[str, int, int], object] = lambda _what, _done, _total: None,
) -> CopyReport:
    """Copy the messages of recordings in receive order to a new recording in rosbag2's layout with MCAP.

    Messages are read and written one by one; ROS 1 messages are converted to ROS 2. Static transforms received before
    the start of the span are copied as well, at its start.

    Args:
        sources: Files, or folders of rosbag2.
        target: The new folder, which must not exist.
        topics: Names of the topics to copy; None for all. Each must exist in at least one recording.
        span: Returns the first receive time and the end (excluded) of the messages of a recording, in nanoseconds.
        compression: ``zstd``, ``lz4`` or ``none``.
        progress: Called regularly with the step (``reading`` or ``writing``) and the completed and total amount.

    Raises:
        RecordingError: Nothing can be read, a topic does not exist, or the copy cannot be written.
    """
    chosen = None if topics is None else list(topics)
    with ExitStack() as stack:
        recordings = [
            stack.enter_context(open_bag(source, progress=lambda done, total: progress("reading", done, total)))
            for source in sources
        ]
        selections = [_selected(recording, recordings, chosen) for recording in recordings]
        streams = [
            _messages(recording, names, *span(recording))
            for recording, names in zip(recordings, selections, strict=True)
        ]
        total = sum(
            recording.topics[name].messages
            for recording, names in zip(recordings, selections, strict=True)
            for name in names
        )
        found = [problem for recording in recordings for problem in recording.problems]
        if found and not any(topic.messages for recording in recordings for topic in recording.topics.values()):
            raise RecordingError(f"nothing can be copied, because no message can be read: {found[0]}")
        skipped: Counter[str] = Counter()
        writer = Writer(target, compression=compression)
        try:
            with writer:
                _write(writer, heapq.merge(*streams, key=lambda message: message[1]), skipped, total, progress)
        except KeyboardInterrupt:  # An incomplete recording would look like a complete one.
            shutil.rmtree(writer.path, ignore_errors=True)
            raise
        problems = [problem for recording in recordings for problem in recording.problems]
        problems += [f"{topic}: {count(number, 'message')} could not be converted" for topic, number in skipped.items()]
        return CopyReport(Path(target), writer.messages, list(dict.fromkeys(problems)))


def _selected(recording: Recording, recordings: list[Recording], topics: list[str] | None) -> list[str]:
    """Return the topics to copy from a recording; a topic that no recording contains is an error."""
    if topics is None:
        return list(recording.topics)
    for topic in topics:
        if not any({topic, f"/{topic}"} & set(each.topics) for each in recordings):
            recordings[0].received(topic)  # Raises the error with a suggestion.
    return [name for topic in topics for name in (topic, f"/{topic}") if name in recording.topics]


def _messages(recording: Recording, topics: list[str], start: int | None, stop: int | None) -> Iterator[_Message]:
    if start is not None:
        for channel, _, data in recording.in_order(filter(is_static, topics), None, start):
            yield channel, start, data
    yield from recording.in_order(topics, start, stop)


def _write(
    writer: Writer,
    messages: Iterator[_Message],
    skipped: Counter[str],
    total: int,
    progress: Callable[[str, int, int], object],
) -> None:
    routes: dict[Channel, tuple[int, Callable[[bytes], bytes]] | None] = {}
    types = RecordedTypes()
    for number, (channel, received, data) in enumerate(messages):
        if number % _PROGRESS_STEP == 0:
            progress("writing", number, total)
        if channel not in routes:
            routes[channel] = _route(writer, channel, types)
        route = routes[channel]
        try:
            converted = None if route is None else route[1](data)
        except Exception:  # noqa: BLE001 - the libraries raise errors of many kinds for damaged bytes
            converted = None
        if route is None or converted is None or received < 0:
            skipped[channel.topic] += 1
        else:
            writer.write(route[0], converted, received)
    progress("writing", total, total)


def _route(writer: Writer, channel: Channel, types: RecordedTypes) -> tuple[int, Callable[[bytes], bytes]] | None:
    """Return the topic number of a channel in the copy and the conversion of its messages; None if impossible."""
    offered = from_yaml(channel.offered_qos)
    if channel.encoding != "ros1":
        definition, definition_format = copied_definition(channel, types)
        topic = writer.add_topic(
            channel.topic,
            channel.type,
            offered_qos=offered,
            encoding=channel.encoding,
            definition=definition,
            definition_format=definition_format,
        )
        return topic, bytes
    converted = cdr_conversion(channel, types)
    if converted is None:
        return None
    topic = writer.add_topic(channel.topic, converted.type, offered_qos=offered, definition=converted.definition)
    return topic, converted.convert
