# SPDX-License-Identifier: Apache-2.0
"""Copy the messages of one or more recordings to a new one, to convert, merge or slice them."""

from __future__ import annotations

import heapq
import re
import shutil
from collections import Counter
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from coframe._output import html_tables
from coframe._output.formatting import count
from coframe.bags._clock_shift import ClockShift, measured_shift
from coframe.bags._merging import MergedNames
from coframe.bags._message_fields import StampFields
from coframe.bags._name_collisions import require_one_robot_per_name
from coframe.bags._offered_qos import from_yaml
from coframe.bags._recorded_types import RecordedTypes
from coframe.bags._signed_duration import parse_offset
from coframe.bags._writer import Writer
from coframe.bags.cdr_conversion import cdr_conversion, copied_definition
from coframe.bags.message_frames import FrameNames
from coframe.bags.recording import open_bag
from coframe.bags.transforms import is_static
from coframe.errors import RecordingError
from coframe.messages.schema_classes import known_class

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from datetime import timedelta

    from coframe._sources.sources import Location
    from coframe.bags.recording import Recording
    from coframe.bags.storage import Channel

__all__ = ["CopyReport", "copy_recordings"]

_DURATION = re.compile(r"[+-]?\s*\d", re.ASCII)
_PROGRESS_STEP = 1000  # messages between two calls of the progress function
_Message = tuple[int, "Channel", int, bytes]  # with the number of the recording


class CopyReport(NamedTuple):
    """The result of :func:`copy_recordings`.

    Attributes:
        path: The new recording.
        messages: Number of messages in it.
        problems: Read and conversion errors, one message each.
        notes: Topics of several recordings that were joined or kept apart, one message each.
    """

    path: Path
    messages: int
    problems: list[str]
    notes: list[str]

    def _repr_html_(self) -> str:
        return html_tables.record(f"Copied to {self.path}", self._asdict().items())


def copy_recordings(
    sources: Sequence[Location],
    target: str | os.PathLike[str],
    *,
    topics: Iterable[str] | None = None,
    span: Callable[[Recording], tuple[int | None, int | None]] = lambda _recording: (None, None),
    prefixes: Sequence[str] | None = None,
    namespaces: Sequence[str] | None = None,
    keep: Iterable[str] = (),
    offsets: Sequence[str | None] | None = None,
    join: bool = False,
    storage: str = "mcap",
    compression: str = "zstd",
    max_size: int | None = None,
    max_duration: str | int | timedelta | None = None,
    progress: Callable[[str, int, int], object] = lambda _what, _done, _total: None,
) -> CopyReport:
    """Copy the messages of recordings in receive order to a new recording in rosbag2's layout.

    Messages are read and written one by one; ROS 1 messages are converted to ROS 2. Static transforms received before
    the start of the span are copied as well, at its start.

    Topics with the same name are joined. If the frames of each recording have their own prefix, such as
    ``robot1/``, the topics are kept apart as ``/robot1/scan`` and so on, except those that all robots share, such as
    ``/tf``, ``/clock`` and ``/rosout``. The notes of the report say which.

    Args:
        sources: Files, folders of rosbag2, or their URLs.
        target: The new folder, which must not exist.
        topics: Names of the topics to copy, or None for all. Each must exist in at least one recording.
        span: Returns the first receive time and the end (excluded) of the messages of a recording, in nanoseconds.
        prefixes: A prefix for the frames and topics of each recording: ``["robot1/", "robot2/"]`` gives
            ``robot1/base_link`` and ``/robot1/scan``.
        namespaces: A namespace for the topics of each recording: ``["/robot1", ""]`` gives ``/robot1/tf``. The
            frames keep their names, because they are in separate trees.
        keep: Frames without the prefix because they are shared: ``["map"]``.
        offsets: For each recording, what is added to its receive times and stamps: a duration such as ``"+35ms"``, or
            how it is measured against the first recording: ``"auto"``, ``"topic:/scan"``, ``"motion:map:base_link"`` or
            ``"motion:map:base_link=world:camera"``; None for nothing. Stamps on another clock, such as simulated time,
            stay.
        join: Whether frames and topics with the same names are joined even if they seem to be of different robots.
        storage: The format of the files, ``mcap`` or ``sqlite3``.
        compression: ``zstd``, ``lz4`` or ``none``; SQLite files are not compressed.
        max_size: The size in bytes after which a new file begins, or None for no limit.
        max_duration: The duration after which a new file begins, such as "10min", or None for no limit.
        progress: Called regularly with the step (``reading`` or ``writing``) and the completed and total amount.

    Raises:
        RecordingError: Nothing can be read, a topic does not exist, two robots seem to have the same names, an offset
            cannot be measured, or the copy cannot be written.
        ValueError: There is not one prefix, namespace or offset for each recording, or a prefix begins with a slash.
    """
    topic_names = None if topics is None else list(topics)
    with ExitStack() as stack:
        recordings = [
            stack.enter_context(open_bag(source, progress=lambda done, total: progress("reading", done, total)))
            for source in sources
        ]
        selections = [_selected_topics(recording, recordings, topic_names) for recording in recordings]
        merged = MergedNames(recordings, prefixes, keep, namespaces)
        shifts = _shifts(recordings, offsets)
        if not join:
            require_one_robot_per_name(recordings, selections, merged, shifts)
        streams = [
            _messages(number, recording, names, shifts[number], *span(recording))
            for number, (recording, names) in enumerate(zip(recordings, selections, strict=True))
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
        writer = Writer(target, storage=storage, compression=compression, max_size=max_size, max_duration=max_duration)
        try:
            with writer:
                copy = _Copy(writer, merged, shifts, skipped)
                for done, message in enumerate(heapq.merge(*streams, key=lambda message: message[2])):
                    if done % _PROGRESS_STEP == 0:
                        progress("writing", done, total)
                    copy.add(*message)
                progress("writing", total, total)
        except KeyboardInterrupt:  # An incomplete recording would look like a complete one.
            shutil.rmtree(writer.path, ignore_errors=True)
            raise
        problems = [problem for recording in recordings for problem in recording.problems]
        problems += [f"{topic}: {count(number, 'message')} could not be converted" for topic, number in skipped.items()]
        problems += copy.problems
        notes = [
            f"{recording.path}: {shift.evidence}"
            for recording, shift in zip(recordings, shifts, strict=True)
            if shift is not None and shift.evidence
        ]
        notes += merged.notes(selections)
        return CopyReport(Path(target), writer.messages, list(dict.fromkeys(problems)), notes)


def _shifts(recordings: list[Recording], offsets: Sequence[str | None] | None) -> list[ClockShift | None]:
    """Return the shift of each recording, or None for those that keep their times."""
    if offsets is None:
        return [None] * len(recordings)
    if len(offsets) != len(recordings):
        raise ValueError(
            f"each of the {len(recordings)} recordings needs one offset, in the same order; {len(offsets)} given"
        )
    return [
        None if text is None else _shift(recordings[0], recording, text)
        for recording, text in zip(recordings, offsets, strict=True)
    ]


def _shift(first: Recording, recording: Recording, text: str) -> ClockShift | None:
    if not _DURATION.match(text.strip()):
        return measured_shift(first, recording, text)
    offset = parse_offset(text)
    return ClockShift(offset) if offset else None


def _selected_topics(recording: Recording, recordings: list[Recording], topics: list[str] | None) -> list[str]:
    """Return the topics to copy from a recording. A topic that no recording contains is an error."""
    if topics is None:
        return list(recording.topics)
    for topic in topics:
        if not any({topic, f"/{topic}"} & set(each.topics) for each in recordings):
            recordings[0].received(topic)  # Raises the error with a suggestion.
    return [name for topic in topics for name in (topic, f"/{topic}") if name in recording.topics]


def _messages(
    number: int,
    recording: Recording,
    topics: list[str],
    shift: ClockShift | None,
    start: int | None,
    stop: int | None,
) -> Iterator[_Message]:
    new_time = (lambda time: time) if shift is None else shift.apply
    if start is not None:
        for channel, _, data in recording.in_order(filter(is_static, topics), None, start):
            yield number, channel, new_time(start), data
    for channel, received, data in recording.in_order(topics, start, stop):
        yield number, channel, new_time(received), data


class _Route(NamedTuple):
    """The number of a topic in the copy, and the conversion of its messages."""

    topic: int
    convert: Callable[[bytes], bytes]
    stamps: StampFields | None = None


class _Copy:
    """Converts and writes messages.

    Args:
        writer: The new recording.
        merged: The new names.
        shifts: The shift of the times of each recording, or None.
        skipped: Receives the number of messages that could not be converted, by topic.
    """

    def __init__(
        self, writer: Writer, merged_names: MergedNames, shifts: list[ClockShift | None], skipped: Counter[str]
    ) -> None:
        self._writer = writer
        self._merged_names = merged_names
        self._shifts = shifts
        self._skipped_counts = skipped
        self._routes: dict[Channel, _Route | None] = {}
        self._types = RecordedTypes()
        self.problems: list[str] = []

    def add(self, recording: int, channel: Channel, receive_time: int, data: bytes) -> None:
        """Write a message, or count it if that is not possible."""
        if channel not in self._routes:
            self._routes[channel] = self._route(recording, channel)
        route = self._routes[channel]
        try:
            converted = None if route is None else route.convert(data)
            shift = self._shifts[recording]
            if converted is not None and shift is not None and route is not None and route.stamps is not None:
                new_stamp = partial(shift.of_stamp, receive_time=receive_time - shift.offset)
                converted, _ = route.stamps.change(converted, new_stamp)
        except Exception:  # noqa: BLE001 - the libraries raise errors of many kinds for damaged bytes
            converted = None
        if route is None or converted is None or receive_time < 0:
            self._skipped_counts[channel.topic] += 1
        else:
            self._writer.write(route.topic, converted, receive_time)

    def _route(self, recording: int, channel: Channel) -> _Route | None:
        """Return the route of a channel, or None if its messages cannot be converted."""
        converted = cdr_conversion(channel, self._types)
        if channel.encoding == "ros1":
            if converted is None:
                return None
            type_, definition, format_, encoding = converted.type, converted.definition, "ros2msg", "cdr"
        else:
            definition, format_ = copied_definition(channel, self._types)
            type_, encoding = channel.type, channel.encoding
        topic = self._writer.add_topic(
            self._merged_names.topic(recording, channel.topic),
            type_,
            offered_qos=from_yaml(channel.offered_qos),
            encoding=encoding,
            definition=definition,
            definition_format=format_,
        )
        convert = bytes if converted is None else converted.convert
        stamps = None if self._shifts[recording] is None else self._stamps(channel, type_)
        rename = self._merged_names.frames(recording)
        if rename is None:
            return _Route(topic, convert, stamps)
        names = None if converted is None else FrameNames.of(channel, type_, self._types)
        if names is None:
            self.problems.append(f"{channel.topic}: frame names in {type_} were not given the prefix")
        if names is None or not names.exist:
            return _Route(topic, convert, stamps)
        return _Route(topic, lambda data: names.rename(convert(data), rename)[0], stamps)

    def _stamps(self, channel: Channel, ros_type: str) -> StampFields | None:
        """Return the stamps of the messages after their conversion to CDR."""
        if channel.encoding == "ros1":
            return StampFields.of_class(known_class(ros_type))
        return StampFields.of(channel, self._types)
