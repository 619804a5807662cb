"""`mend`: a recording once more, whole: with an index and metadata, statics in front, and names as tf2 wants them."""

from __future__ import annotations

import shutil
from collections import Counter
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from coframe.bags.as_cdr import as_cdr, transforms_of
from coframe.bags.message_frames import FrameNames
from coframe.bags.offered_qos import OfferedQos, from_yaml, to_yaml
from coframe.bags.recording import open_bag
from coframe.bags.storage import Channel
from coframe.bags.summary import summarize
from coframe.bags.transforms import is_static
from coframe.bags.tree import namespace_of
from coframe.bags.writer import Writer
from coframe.buffer import Buffer
from coframe.errors import RecordingError
from coframe.frame_names import absolute, belongs, renaming
from coframe.messages import deserialize, find, serialize
from coframe.messages.conversions import to_transform_stamped

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable

    from coframe.bags.recording import Recording
    from coframe.messages.generated.geometry_msgs.msg import TransformStamped

__all__ = ["Mended", "mend"]

_TF = "tf2_msgs/msg/TFMessage"
_STEP = 1000  # messages between two reports of progress
_STATIC_QOS = OfferedQos(1, transient_local=True)


class Mended(NamedTuple):
    """What `mend` did.

    Attributes:
        path: The new recording.
        messages: How many it has.
        found: What was wrong with the old one, a sentence each.
        done: What is different, a sentence each.
        left: What is still odd about the new one.
    """

    path: Path
    messages: int
    found: list[str]
    done: list[str]
    left: list[str]


def mend(
    source: str | os.PathLike[str],
    target: str | os.PathLike[str],
    *,
    statics: str | os.PathLike[str] | None = None,
    tf_topic: str = "/tf",
    tf_static_topic: str = "/tf_static",
    prefix: str = "",
    keep: Iterable[str] = (),
    compression: str = "zstd",
    progress: Callable[[str, int, int], object] = lambda _what, _done, _total: None,
) -> Mended:
    """Writes a recording anew, as far as it can be read: the old one stays as it is.

    The new one has an index and metadata, and descriptions of the types that coframe knows. Slashes in front of names
    of frames go, and so do transforms that tf2 refuses. Static transforms come first. What ROS 1 wrote becomes ROS 2's.

    Args:
        source: A file, or a folder of rosbag2.
        target: The new folder, which must not be there yet.
        statics: Another recording, whose static transforms are added to those of the robot, as far as its topics say
            nothing of their children.
        tf_topic: Where the transforms of the robot are that `prefix` is for; the other topics of its namespace are
            that robot's, too: of ``/tf`` all.
        tf_static_topic: Where its static transforms are.
        prefix: Is put before all names of frames, such as "robot1/".
        keep: Names that get no prefix, such as "map"; a text is one name, or several behind commas.
        compression: ``zstd``, ``lz4`` or ``none``.
        progress: Called now and then with what is under way (``reading``, ``writing``, ``checking``), how far it is,
            and how far it will be: bytes, or messages that are written.

    Raises:
        RecordingError: Nothing can be read, or the new one cannot be written.
        ValueError: The prefix begins with a slash.
    """
    robot = _Robot(absolute(tf_topic), absolute(tf_static_topic))
    rename = _Renaming(prefix, keep, robot)
    with open_bag(source, progress=partial(progress, "reading")) as recording:
        added = [] if statics is None else _statics_of(statics)
        found = recording.problems
        writer = Writer(target, compression=compression)
        work = _Mending(recording, writer, robot, rename)
        try:
            with writer:
                work.run(added, partial(progress, "writing"))
        except KeyboardInterrupt:  # half a recording would look like a whole one
            shutil.rmtree(writer.path, ignore_errors=True)
            raise
        found = list(dict.fromkeys([*found, *recording.problems]))
    with open_bag(target, progress=partial(progress, "checking")) as anew:
        left = summarize(anew).problems
        return Mended(Path(target), writer.messages, found, work.done(), left)


class _Robot(NamedTuple):
    """Whose frames get the prefix, and are given the other recording's statics."""

    tf_topic: str
    tf_static_topic: str


class _Renaming:
    """A frame's new name: without slashes in front, and with the prefix where one is wanted."""

    def __init__(self, prefix: str, keep: Iterable[str], robot: _Robot) -> None:
        self._renamed = renaming(prefix, keep)
        self._robot = robot
        self.what = f"put under {prefix!r}" if prefix else "freed of '/' in front"

    def on(self, topic: str) -> _Renaming:
        """That of the messages of a topic: only those of the robot get the prefix."""
        return self if self._renamed is None or belongs(topic, *self._robot) else _Renaming("", (), self._robot)

    @property
    def has_prefix(self) -> bool:
        return self._renamed is not None

    def __call__(self, name: str) -> str:
        bare = name.lstrip("/")
        return self._renamed(bare) if bare and self._renamed is not None else bare


class _Route(NamedTuple):
    """What becomes of a channel's messages."""

    topic: int
    convert: Callable[[bytes], bytes]
    names: FrameNames | None
    rename: _Renaming
    transforms: bool


class _Mending:
    """One recording on its way into another."""

    def __init__(self, recording: Recording, writer: Writer, robot: _Robot, rename: _Renaming) -> None:
        self._recording = recording
        self._writer = writer
        self._robot = robot
        self._rename = rename
        self._routes: dict[Channel, _Route | None] = {}
        self._counts: Counter[str] = Counter()  # by what was done, "{}" standing for how often
        self._copied = 0
        self._moving = {
            name: {edge.child for edge in buffer.edges() if edge.parent and not edge.static}
            for name, buffer in recording.buffers.items()
        }

    def run(self, added: list[TransformStamped], progress: Callable[[int, int], object]) -> None:
        """Copies everything, the static transforms first."""
        self._put_statics_first(added)
        total = sum(topic.messages for topic in self._recording.topics.values())
        for number, (channel, received, data) in enumerate(self._recording.in_order()):
            if number % _STEP == 0:
                progress(number, total)
            route = self._route(channel)
            if route is None:
                self._note(channel, "messages left out: ROS 2 has no such type as ROS 1 recorded it")
            elif not 0 <= received < 1 << 63:
                self._note(channel, "messages left out whose times are none")
            elif (message := self._mended(channel, route, data)) is not None:
                self._writer.write(route.topic, message, received)
                self._copied += 1
        progress(total, total)

    def done(self) -> list[str]:
        """What is different, in sentences."""
        topics = len({channel.topic for channel, route in self._routes.items() if route is not None})
        told = [f"{self._copied} messages of {topics} topics written anew, with an index and metadata.yaml"]
        return told + [sentence.format(count) for sentence, count in self._counts.items()]

    def _note(self, channel: Channel, what: str, count: int = 1) -> None:
        self._counts[f"{channel.topic}: {{}} {what}"] += count

    def _route(self, channel: Channel) -> _Route | None:
        if channel not in self._routes:
            self._routes[channel] = self._new_route(channel)
        return self._routes[channel]

    def _new_route(self, channel: Channel) -> _Route | None:
        offered = from_yaml(channel.offered_qos)
        rename = self._rename.on(channel.topic)
        converted = as_cdr(channel)
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
        ros_type, convert = converted
        described = channel.encoding == "cdr" and channel.definition
        topic = self._writer.add_topic(
            channel.topic,
            ros_type,
            offered_qos=offered,
            definition=channel.definition.decode("utf-8", "replace") if described else None,
            definition_format=channel.definition_format if described else "ros2msg",
        )
        names = FrameNames.of(channel, ros_type)
        return _Route(topic, convert, names if names and names.are_there else None, rename, ros_type == _TF)

    def _mended(self, channel: Channel, route: _Route, data: bytes) -> bytes | None:
        """The message as it is to be; None if it is to go."""
        try:
            message = self._amended(channel, route, route.convert(data))
        except Exception:  # noqa: BLE001 - the libraries have many ways to say that bytes are damaged
            self._note(channel, "damaged messages left out")
            return None
        if channel.encoding == "ros1":
            self._counts["{} messages of ROS 1 turned into ROS 2's"] += 1
        return message

    def _amended(self, channel: Channel, route: _Route, message: bytes) -> bytes:
        """A message of ROS 2 without what tf2 refuses, and with the new names of frames."""
        if route.transforms:
            message = self._without_refused(channel, message)
        if route.names is not None and (route.rename.has_prefix or b"/" in message):
            message, changed = route.names.renamed(message, route.rename)
            if changed:
                self._note(channel, f"names of frames {route.rename.what}", changed)
        return message

    def _without_refused(self, channel: Channel, data: bytes) -> bytes:
        """A message without the transforms that tf2 refuses, and without statics of what moves."""
        message = deserialize(data, find(_TF))
        good = [transform for transform in message.transforms if _is_taken(transform)]
        if refused := len(message.transforms) - len(good):
            self._note(channel, "transforms left out that tf2 refuses", refused)
        if is_static(channel.topic):
            moving = self._moving.get(namespace_of(channel.topic), set())
            still = [transform for transform in good if transform.child_frame_id.lstrip("/") not in moving]
            if len(still) < len(good):
                self._note(channel, "static transforms left out of frames that also move", len(good) - len(still))
            good = still
        return data if len(good) == len(message.transforms) else serialize(find(_TF)(transforms=good))

    def _put_statics_first(self, added: list[TransformStamped]) -> None:
        """At the very beginning, the static transforms that were recorded later, and those that are to be added."""
        for channel, transforms in self._late_statics().items():
            route = self._route(channel)
            if route is not None:
                self._write_statics(channel, route, transforms, "static transforms put in front, which came later")
        known = self._known()
        if new := [transform for transform in added if self._rename(transform.child_frame_id) not in known]:
            topic = self._robot.tf_static_topic
            default = Channel(topic, _TF, "cdr", offered_qos=to_yaml([_STATIC_QOS]))
            channel = next((each for each in self._routes if absolute(each.topic) == topic), default)
            route = self._route(channel)
            if route is not None:
                self._write_statics(channel, route, new, "static transforms added")
        if len(new) < len(added):
            self._counts["{} static transforms not added, since the recording tells of their frames"] += len(
                added
            ) - len(new)

    def _known(self) -> set[str]:
        """The new names of the frames that the robot's topics tell of, or the namespaces that these are in."""
        buffers = self._recording.buffers
        there = [buffers[name] for name in {*map(namespace_of, self._robot)} if name in buffers]
        return {self._rename(edge.child) for buffer in there for edge in buffer.edges() if edge.parent}

    def _write_statics(self, channel: Channel, route: _Route, transforms: list[TransformStamped], what: str) -> None:
        message = self._amended(channel, route, serialize(find(_TF)(transforms=transforms)))
        self._writer.write(route.topic, message, self._recording.start, publisher=what)
        self._note(channel, what, len(transforms))

    def _late_statics(self) -> dict[Channel, list[TransformStamped]]:
        """The first value of each static transform that was not there from the beginning, by channel."""
        found: dict[str, tuple[Channel, dict[str, TransformStamped]]] = {}
        early: set[tuple[str, str]] = set()
        for channel, received, data in self._recording.in_order(filter(is_static, self._recording.topics)):
            converted = as_cdr(channel)
            if converted is None or converted[0] != _TF:
                continue
            known = found.setdefault(channel.topic, (channel, {}))[1]
            for transform in transforms_of(converted[1], data):
                key = (channel.topic, transform.child_frame_id)
                if received <= self._recording.start:
                    early.add(key)
                elif key not in early:
                    known.setdefault(transform.child_frame_id, transform)
        return {channel: list(known.values()) for channel, known in found.values() if known}


def _statics_of(path: str | os.PathLike[str]) -> list[TransformStamped]:
    """The static transforms of another recording.

    Raises:
        RecordingError: It has none, or cannot be read.
    """
    with open_bag(path) as other:
        statics = [edge for edge in other.buffer.edges() if edge.static and edge.parent]
        transforms = [(edge.parent, edge.child, other.buffer.lookup(edge.parent, edge.child)) for edge in statics]
    if not transforms:
        raise RecordingError(f"{path} has no static transforms to add", hint="Give a recording that has /tf_static.")
    return [to_transform_stamped(parent, child, transform, 0) for parent, child, transform in transforms]


def _is_taken(transform: TransformStamped) -> bool:
    """Whether tf2 takes a transform in."""
    t, q = transform.transform.translation, transform.transform.rotation
    names = (transform.header.frame_id, transform.child_frame_id)
    return Buffer(None)._set_values(*names, 0, t.x, t.y, t.z, q.x, q.y, q.z, q.w, True, "") == 0
