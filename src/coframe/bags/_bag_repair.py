# SPDX-License-Identifier: Apache-2.0
"""Write a repaired copy of a recording: with an index, metadata, static transforms first and valid frame names."""

from __future__ import annotations

import re
import shutil
from collections import Counter
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from coframe._output import html_tables
from coframe._output.formatting import count
from coframe.bags._offered_qos import OfferedQos, from_yaml, to_yaml
from coframe.bags._writer import Writer
from coframe.bags.cdr_conversion import cdr_conversion, copied_definition, decode_transforms
from coframe.bags.message_frames import FrameNames
from coframe.bags.namespaces import namespace_of
from coframe.bags.recording import open_bag
from coframe.bags.storage import Channel
from coframe.bags.summary import summarize
from coframe.bags.transforms import is_static
from coframe.buffer import Buffer
from coframe.errors import RecordingError
from coframe.frame_names import absolute, is_robot_topic, renaming
from coframe.messages import deserialize, find, serialize
from coframe.messages.conversions import to_transform_stamped
from coframe.type_names import TF_MESSAGE

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable

    from coframe._sources.sources import Location
    from coframe.bags.recording import Recording
    from coframe.messages.generated.geometry_msgs.msg import TransformStamped

__all__ = ["RepairReport", "repair"]

_PLURAL_NOUNS = re.compile(r"\b(messages|transforms|names)\b")  # nouns that are counted in messages
_PROGRESS_STEP = 1000  # messages between two calls of the progress function
_STATIC_QOS = OfferedQos(1, transient_local=True)


class RepairReport(NamedTuple):
    """The result of :func:`repair`.

    Attributes:
        path: The repaired recording.
        messages: Number of messages in it.
        problems: Problems of the original recording, one message each.
        changes: Differences from the original recording, one message each.
        remaining: Problems of the repaired recording, one message each.
    """

    path: Path
    messages: int
    problems: list[str]
    changes: list[str]
    remaining: list[str]

    def _repr_html_(self) -> str:
        return html_tables.record(f"Repaired {self.path}", self._asdict().items())


def repair(
    source: Location,
    target: str | os.PathLike[str],
    *,
    statics: Location | None = None,
    tf_topic: str = "/tf",
    tf_static_topic: str = "/tf_static",
    prefix: str = "",
    keep: Iterable[str] = (),
    compression: str = "zstd",
    progress: Callable[[str, int, int], object] = lambda _what, _done, _total: None,
) -> RepairReport:
    """Write a repaired copy of a recording. The original is not changed.

    The copy contains everything that can be read, with an index, metadata and the definitions of the types that coframe
    supports. Leading slashes of frame names and transforms that tf2 rejects are removed. Static transforms come first.
    Messages of ROS 1 are converted to ROS 2.

    Args:
        source: A file, a folder of rosbag2, or its URL.
        target: The new folder, which must not exist.
        statics: Another recording, whose static transforms are added for child frames that the robot's topics do not
            contain.
        tf_topic: The topic with the robot's transforms. ``prefix`` applies to all topics in its namespace; for ``/tf``
            these are all topics.
        tf_static_topic: The topic with the robot's static transforms.
        prefix: A prefix for all frame names, such as "robot1/".
        keep: Frame names without the prefix, such as "map"; a list, or a comma-separated string.
        compression: ``zstd``, ``lz4`` or ``none``.
        progress: Called regularly with the step (``reading``, ``writing`` or ``checking``) and the completed and total
            amount, in bytes or messages.

    Raises:
        RecordingError: Nothing can be read, or the copy cannot be written.
        ValueError: The prefix begins with a slash.
    """
    robot = _Robot(absolute(tf_topic), absolute(tf_static_topic))
    rename = _FrameRenaming(prefix, keep, robot)
    with open_bag(source, progress=partial(progress, "reading")) as recording:
        added = [] if statics is None else _read_statics(statics)
        problems = recording.problems
        if problems and not any(topic.messages for topic in recording.topics.values()):
            raise RecordingError(f"{recording.path} cannot be repaired, because no message can be read: {problems[0]}")
        writer = Writer(target, compression=compression)
        work = _Repair(recording, writer, robot, rename)
        try:
            with writer:
                work.run(added, partial(progress, "writing"))
        except KeyboardInterrupt:  # An incomplete recording would look like a complete one.
            shutil.rmtree(writer.path, ignore_errors=True)
            raise
        problems = list(dict.fromkeys([*problems, *recording.problems]))
    with open_bag(target, progress=partial(progress, "checking")) as repaired:
        remaining = summarize(repaired).problems
        return RepairReport(Path(target), writer.messages, problems, work.changes(), remaining)


class _Robot(NamedTuple):
    """The topics of the robot whose frames get the prefix and the added static transforms."""

    tf_topic: str
    tf_static_topic: str


class _FrameRenaming:
    """Maps a frame name to its new name: without leading slashes, and with the prefix if there is one."""

    def __init__(self, prefix: str, keep: Iterable[str], robot: _Robot) -> None:
        self._rename_frame = renaming(prefix, keep)
        self._robot = robot
        self.change = f"given the prefix {prefix!r}" if prefix else "stripped of leading slashes"

    def on(self, topic: str) -> _FrameRenaming:
        """Return the mapping for the messages on a topic. Only topics of the robot get the prefix."""
        return (
            self
            if self._rename_frame is None or is_robot_topic(topic, *self._robot)
            else _FrameRenaming("", (), self._robot)
        )

    @property
    def has_prefix(self) -> bool:
        return self._rename_frame is not None

    def __call__(self, name: str) -> str:
        bare = name.lstrip("/")
        return self._rename_frame(bare) if bare and self._rename_frame is not None else bare


class _Route(NamedTuple):
    """How the messages of a channel are written.

    Attributes:
        topic: Number of the topic in the new recording.
        convert: Converts a message to CDR.
        names: The frame names in the messages, or None if there are none to change.
        rename: Maps frame names to new ones.
        transforms: Whether the messages are TFMessages.
    """

    topic: int
    convert: Callable[[bytes], bytes]
    names: FrameNames | None
    rename: _FrameRenaming
    transforms: bool


class _Repair:
    """Copies one recording to another and repairs the messages."""

    def __init__(self, recording: Recording, writer: Writer, robot: _Robot, rename: _FrameRenaming) -> None:
        self._recording = recording
        self._writer = writer
        self._robot = robot
        self._rename = rename
        self._routes: dict[Channel, _Route | None] = {}
        self._change_counts: Counter[tuple[str, str]] = Counter()  # keys: the text before and after the count
        self._copied_messages = 0
        self._moving_edges = {
            name: {edge.child for edge in buffer.edges() if edge.parent and not edge.static}
            for name, buffer in recording.buffers.items()
        }

    def run(self, added_transforms: list[TransformStamped], progress: Callable[[int, int], object]) -> None:
        """Copy all messages, the static transforms first."""
        self._write_statics_first(added_transforms)
        total = sum(topic.messages for topic in self._recording.topics.values())
        for number, (channel, received, data) in enumerate(self._recording.in_order()):
            if number % _PROGRESS_STEP == 0:
                progress(number, total)
            route = self._route(channel)
            if route is None:
                self._count(channel, "messages skipped, because their ROS 1 type cannot be converted to ROS 2")
            elif not 0 <= received < 1 << 63:
                self._count(channel, "messages skipped, because their receive time is not valid")
            elif (message := self._repair_message(channel, route, data)) is not None:
                self._writer.write(route.topic, message, received)
                self._copied_messages += 1
        progress(total, total)

    def changes(self) -> list[str]:
        """Return the differences from the original, one message each."""
        topics = len({channel.topic for channel, route in self._routes.items() if route is not None})
        amounts = f"{count(self._copied_messages, 'message')} on {count(topics, 'topic')}"
        copied = f"{amounts} copied, with an index and metadata.yaml"
        return [
            copied,
            *(f"{topic}{_count_text(what, number)}" for (topic, what), number in self._change_counts.items()),
        ]

    def _count(self, channel: Channel, what: str, number: int = 1) -> None:
        self._change_counts[f"{channel.topic}: ", what] += number

    def _route(self, channel: Channel) -> _Route | None:
        if channel not in self._routes:
            self._routes[channel] = self._new_route(channel)
        return self._routes[channel]

    def _new_route(self, channel: Channel) -> _Route | None:
        offered = from_yaml(channel.offered_qos)
        rename = self._rename.on(channel.topic)
        converted = cdr_conversion(channel, self._recording.types)
        if converted is None:
            if channel.encoding == "ros1":
                return None
            text = channel.definition.decode("utf-8", "replace")
            topic = self._writer.add_topic(
                channel.topic,
                channel.type,
                offered_qos=offered,
                encoding=channel.encoding,
                definition=text,
                definition_format=channel.definition_format,
            )
            return _Route(topic, bytes, None, rename, transforms=False)
        definition, format_ = converted.definition, "ros2msg"
        if channel.encoding == "cdr":
            definition, format_ = copied_definition(channel, self._recording.types)
        topic = self._writer.add_topic(
            channel.topic, converted.type, offered_qos=offered, definition=definition, definition_format=format_
        )
        names = FrameNames.of(channel, converted.type, self._recording.types)
        frames = names if names and names.exist else None
        return _Route(topic, converted.convert, frames, rename, converted.type == TF_MESSAGE)

    def _repair_message(self, channel: Channel, route: _Route, data: bytes) -> bytes | None:
        """Return the repaired message, or None if it is damaged."""
        try:
            message = self._correct_message(channel, route, route.convert(data))
        except Exception:  # noqa: BLE001 - the libraries raise errors of many kinds for damaged bytes
            self._count(channel, "damaged messages skipped")
            return None
        if channel.encoding == "ros1":
            self._change_counts["", "messages converted from ROS 1 to ROS 2"] += 1
        return message

    def _correct_message(self, channel: Channel, route: _Route, message: bytes) -> bytes:
        """Return a message of ROS 2 with new frame names and without the transforms that tf2 rejects."""
        if route.transforms:
            message = self._remove_rejected(channel, message)
        if route.names is not None and (route.rename.has_prefix or b"/" in message):
            message, change_count = route.names.rename(message, route.rename)
            if change_count:
                self._count(channel, f"frame names {route.rename.change}", change_count)
        return message

    def _remove_rejected(self, channel: Channel, data: bytes) -> bytes:
        """Return a TFMessage without transforms that tf2 rejects, and without static transforms of moving frames."""
        message = deserialize(data, find(TF_MESSAGE))
        good = [transform for transform in message.transforms if _is_accepted(transform)]
        if rejected := len(message.transforms) - len(good):
            self._count(channel, "transforms removed that tf2 rejects as invalid", rejected)
        if is_static(channel.topic):
            moving = self._moving_edges.get(namespace_of(channel.topic), set())
            fixed = [transform for transform in good if transform.child_frame_id.lstrip("/") not in moving]
            if len(fixed) < len(good):
                self._count(channel, "static transforms of moving frames removed", len(good) - len(fixed))
            good = fixed
        return data if len(good) == len(message.transforms) else serialize(find(TF_MESSAGE)(transforms=good))

    def _write_statics_first(self, added_transforms: list[TransformStamped]) -> None:
        """Write the static transforms that were recorded late and those to be added, at the start of the recording."""
        for channel, transforms in self._find_late_statics().items():
            route = self._route(channel)
            if route is not None:
                self._write_statics(channel, route, transforms, "static transforms moved to the beginning")
        known = self._known_child_frames()
        if new := [transform for transform in added_transforms if self._rename(transform.child_frame_id) not in known]:
            topic = self._robot.tf_static_topic
            default = Channel(topic, TF_MESSAGE, "cdr", offered_qos=to_yaml([_STATIC_QOS]))
            channel = next((each for each in self._routes if absolute(each.topic) == topic), default)
            route = self._route(channel)
            if route is not None:
                self._write_statics(channel, route, new, "static transforms added")
        if len(new) < len(added_transforms):
            skipped = len(added_transforms) - len(new)
            self._change_counts["", "static transforms not added because the recording contains their frames"] += (
                skipped
            )

    def _known_child_frames(self) -> set[str]:
        """Return the new names of the child frames in the namespaces of the robot's topics."""
        buffers = self._recording.buffers
        of_robot = [buffers[name] for name in {*map(namespace_of, self._robot)} if name in buffers]
        return {self._rename(edge.child) for buffer in of_robot for edge in buffer.edges() if edge.parent}

    def _write_statics(self, channel: Channel, route: _Route, transforms: list[TransformStamped], what: str) -> None:
        message = self._correct_message(channel, route, serialize(find(TF_MESSAGE)(transforms=transforms)))
        self._writer.write(route.topic, message, self._recording.received_start, publisher=what)
        self._count(channel, what, len(transforms))

    def _find_late_statics(self) -> dict[Channel, list[TransformStamped]]:
        """Return the first value of each static transform that is not at the start of the recording, by channel."""
        found: dict[str, tuple[Channel, dict[str, TransformStamped]]] = {}
        early: set[tuple[str, str]] = set()
        for channel, received, data in self._recording.in_order(filter(is_static, self._recording.topics)):
            converted = cdr_conversion(channel, self._recording.types)
            if converted is None or converted.type != TF_MESSAGE:
                continue
            known = found.setdefault(channel.topic, (channel, {}))[1]
            for transform in decode_transforms(converted.convert, data):
                key = (channel.topic, transform.child_frame_id)
                if received <= self._recording.received_start:
                    early.add(key)
                elif key not in early:
                    known.setdefault(transform.child_frame_id, transform)
        return {channel: list(known.values()) for channel, known in found.values() if known}


def _read_statics(path: Location) -> list[TransformStamped]:
    """Return the static transforms of another recording.

    Raises:
        RecordingError: There are none, or the recording cannot be read.
    """
    with open_bag(path) as other:
        statics = [edge for edge in other.buffer.edges() if edge.static and edge.parent]
        transforms = [(edge.parent, edge.child, other.buffer.lookup(edge.parent, edge.child)) for edge in statics]
    if not transforms:
        raise RecordingError(f"{other.path} has no static transforms to add", hint="Give a recording with /tf_static.")
    return [to_transform_stamped(parent, child, transform, 0) for parent, child, transform in transforms]


def _count_text(what: str, number: int) -> str:
    """Return a number with its noun, in the singular if the number is 1."""
    text = f"{number} {what}"
    return _PLURAL_NOUNS.sub(lambda match: match[0].removesuffix("s"), text, count=1) if number == 1 else text


def _is_accepted(transform: TransformStamped) -> bool:
    """Return whether tf2 accepts a transform."""
    t, q = transform.transform.translation, transform.transform.rotation
    names = (transform.header.frame_id, transform.child_frame_id)
    return Buffer(None)._set_values(*names, 0, t.x, t.y, t.z, q.x, q.y, q.z, q.w, True, "") == 0
