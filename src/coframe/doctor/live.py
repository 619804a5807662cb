"""What arrives on the wire as an observation: a node that listens to transforms, sensors, joints and the log."""

from __future__ import annotations

import time
from collections import deque
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.doctor.collector import Collector
from coframe.doctor.joints import joint_states
from coframe.doctor.observation import (
    DEFAULT_CACHE,
    Clock,
    Endpoint,
    JointStates,
    LogLine,
    Observation,
    Sensor,
    TopicFacts,
)
from coframe.errors import DecodeError
from coframe.frame_names import renaming
from coframe.messages import deserialize, find
from coframe.messages.header_peek import HEADER_BYTES, opens_with_header, peek_header
from coframe.messages.slices import Slices
from coframe.messages.tf_columns import tf_columns
from coframe.wire.names import full_name
from coframe.wire.participant import Participant
from coframe.wire.qos import TF, TF_STATIC_READER, QoS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray
    from typing_extensions import Self

    from coframe.doctor.transforms import Transforms
    from coframe.wire.endpoints import Tap, TappedMessages
    from coframe.wire.graph import Endpoint as WireEndpoint

__all__ = ["LiveObserver"]

TF_TYPE = "tf2_msgs/msg/TFMessage"
_ANY = QoS(depth=100, reliable=False)  # best-effort and volatile: what every publisher offers
_LATCHED = QoS(depth=10, transient_local=True)
_WHOLE = 16 << 20  # bytes: a description, a joint state or a line of the log as a whole
# Megabytes a second, and their CameraInfo has the same header.
_TOO_LARGE = {"sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage"}
_DECODED = {"sensor_msgs/msg/JointState", "rcl_interfaces/msg/Log", "rosgraph_msgs/msg/Clock"}
_DESCRIPTION = "robot_description"
_MOST_ROWS = 1_000_000
_MOST_MESSAGES = 20_000  # of one topic
_SECOND = 1_000_000_000


class _Head(NamedTuple):
    frame: str
    stamp: int
    arrived: int
    writer: int


class _Writer(NamedTuple):
    node: str  # its full name
    process: bytes


class _Topic:
    """A topic that is listened to beside those of transforms."""

    def __init__(self, name: str, ros_type: str, tap: Tap) -> None:
        self.name = name
        self.type = ros_type
        self.tap = tap
        self.messages = 0
        self.heads: deque[_Head] = deque(maxlen=_MOST_MESSAGES)
        self.decoded: deque[tuple[int, Any]] = deque(maxlen=_MOST_MESSAGES)


class LiveObserver:
    """Joins the graph and listens; usable as a context manager.

    Args:
        domain: The ROS domain; None: ROS_DOMAIN_ID, or 0.
        tf_topic: Where transforms are sent.
        tf_static_topic: Where static transforms are sent.
        cache: How far back a listener's buffer is taken to reach, in nanoseconds.
        window: So much is kept, in nanoseconds; None: everything since the start.
        node_name: As the others will see it.
        prefix: In front of the names of frames, as it is; those that sensors name, too.
        keep: The frames that get no prefix, as they are shared.

    Raises:
        ValueError: The prefix begins with a slash.
        WireError: The graph cannot be joined.
    """

    def __init__(
        self,
        domain: int | None = None,
        *,
        tf_topic: str = "/tf",
        tf_static_topic: str = "/tf_static",
        cache: int = DEFAULT_CACHE,
        window: int | None = None,
        node_name: str = "coframe_doctor",
        prefix: str = "",
        keep: Iterable[str] = (),
    ) -> None:
        names = renaming(prefix, keep)
        self._renamed: Callable[[str], str] = names or str
        self.cache = cache
        self.window = window
        self.start = time.time_ns()
        self._participant = Participant.get(domain)
        self._collector = Collector(names)
        self._writers: dict[int, _Writer] = {}
        self._travel: dict[int, deque[int]] = {}
        self._topics: dict[str, _Topic] = {}
        try:
            self._node = self._participant.add_node("/", node_name)
            self._transforms = {
                topic: (self._tap(topic, TF_TYPE, qos, _WHOLE), static)
                for topic, qos, static in ((tf_topic, TF, False), (tf_static_topic, TF_STATIC_READER, True))
            }
        except BaseException:
            self._participant.close()
            raise

    def close(self) -> None:
        """Leaves the graph; what was heard stays."""
        self._node.close()
        self._participant.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def poll(self) -> None:
        """Takes in what has come, and looks for new topics; to be called a few times a second."""
        published = self._participant.published()
        for handles in published.values():
            for handle, endpoint in handles.items():
                self._meet(handle, endpoint)
        for topic, (tap, static) in self._transforms.items():
            self._take_transforms(topic, tap.take(), static)
        for name, handles in published.items():
            if name not in self._topics and name not in self._transforms:
                self._listen(name, sorted({endpoint.ros_type for endpoint in handles.values()}))
        for heard in self._topics.values():
            self._take(heard)
        if self.window is not None:
            self._forget(time.time_ns() - self.window, {handle for handles in published.values() for handle in handles})

    def listen(self, seconds: float) -> None:
        """Polls for so long."""
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            time.sleep(min(0.2, left))
            self.poll()

    def observe(self) -> Observation:
        """What has been heard, within the window."""
        end = time.time_ns()
        start = self.start if self.window is None else max(self.start, end - self.window)
        return Observation(
            live=True,
            start=start,
            end=end,
            transforms=self._named(self._collector.transforms()),
            empty_messages=self._collector.empty,
            damaged_messages=self._collector.damaged,
            messages_left_out=self._collector.left_out,
            topics=self._facts(),
            sensors=tuple(
                s for topic in self._topics.values() for s in _sensors(topic, start, self._renamed, self._node_of)
            ),
            descriptions=tuple(str(message.data) for _, message in self._decoded("std_msgs/msg/String")),
            joint_states=tuple(
                _joints(topic, start) for topic in self._topics.values() if topic.type == "sensor_msgs/msg/JointState"
            ),
            clock=self._clock(start),
            travel=self._travel_by_name(),
            log=tuple(
                LogLine(_node(message.name), message.msg, arrived)
                for arrived, message in self._decoded("rcl_interfaces/msg/Log")
                if arrived >= start
            ),
            cache=self.cache,
            link_name=self._renamed,
        )

    def _tap(self, topic: str, ros_type: str, qos: QoS, head: int) -> Tap:
        return self._participant.tap(self._node, topic, ros_type, qos, head=head)

    def _meet(self, handle: int, endpoint: WireEndpoint) -> None:
        if not endpoint.node.startswith("_NODE_NAME_UNKNOWN"):
            self._writers[handle] = _Writer(full_name(endpoint.namespace, endpoint.node), endpoint.guid[:12])

    def _node_of(self, handle: int) -> str:
        """The full name of a writer's node; "" as long as it is not known, which may be after its first messages.

        Of several processes with one name the second one is called a copy.
        """
        writer = self._writers.get(handle)
        if writer is None:
            return ""
        namesakes = dict.fromkeys(other.process for other in self._writers.values() if other.node == writer.node)
        number = list(namesakes).index(writer.process)
        return writer.node if number == 0 else f"{writer.node} (copy {number + 1})"

    def _forget(self, before: int, present: set[int]) -> None:
        """Lets go of what came before a time, and of the writers that have left and sent nothing since."""
        self._collector.forget(before, _MOST_ROWS)
        for topic in self._topics.values():
            while topic.heads and topic.heads[0].arrived < before:
                topic.heads.popleft()
        if (self._writers.keys() | self._travel.keys()) <= present:
            return
        kept = present | set(map(int, self._collector.publishers()))
        kept |= {head.writer for topic in self._topics.values() for head in topic.heads}
        self._writers = {handle: writer for handle, writer in self._writers.items() if handle in kept}
        self._travel = {handle: travel for handle, travel in self._travel.items() if handle in kept}

    def _named(self, told: Transforms) -> Transforms:
        """Publishers by name, of the collector's by the handles of their writers."""
        names = [self._node_of(int(handle)) for handle in told.publishers]
        number = {name: i for i, name in enumerate(dict.fromkeys(names))}
        numbers = np.array([number[name] for name in names], dtype=np.int64)
        return replace(told, publisher=numbers[told.publisher], publishers=tuple(number))

    def _travel_by_name(self) -> dict[str, NDArray[np.int64]]:
        by_name: dict[str, list[int]] = {}
        for handle, travel in self._travel.items():
            by_name.setdefault(self._node_of(handle), []).extend(travel)
        return {name: np.array(travel, dtype=np.int64) for name, travel in by_name.items()}

    def _take_transforms(self, topic: str, messages: TappedMessages, static: bool) -> None:
        if not len(messages.ends):
            return
        handles, publisher = np.unique(messages.writers, return_inverse=True)
        self._collector.add(
            topic,
            static,
            tf_columns(Slices.contiguous(messages.data, messages.ends)),
            messages.arrived,
            publisher,
            list(map(str, handles.tolist())),
        )
        if not static:  # what was sent before we came was long under way
            took = messages.arrived - messages.sent
            for number, handle in enumerate(handles.tolist()):
                travel = self._travel.setdefault(handle, deque(maxlen=_MOST_MESSAGES))
                travel.extend(took[publisher == number].tolist())

    def _listen(self, name: str, types: list[str]) -> None:
        ros_type = types[0]
        if name.endswith(_DESCRIPTION) and ros_type == "std_msgs/msg/String":
            tap = self._tap(name, ros_type, _LATCHED, _WHOLE)
        elif ros_type in _DECODED:
            tap = self._tap(name, ros_type, _ANY, _WHOLE)
        elif ros_type not in _TOO_LARGE and opens_with_header(ros_type):
            tap = self._tap(name, ros_type, _ANY, HEADER_BYTES)
        else:
            return
        self._topics[name] = _Topic(name, ros_type, tap)

    def _take(self, heard: _Topic) -> None:
        messages = heard.tap.take()
        heard.messages += len(messages.ends)
        whole = Slices.contiguous(messages.data, messages.ends).each()
        rows = zip(map(bytes, whole), messages.arrived.tolist(), messages.writers.tolist(), strict=True)
        if heard.type in _DECODED or heard.name.endswith(_DESCRIPTION):
            heard.decoded += _decode(heard.type, rows)
            return
        for data, arrived, writer in rows:
            header = peek_header(data)
            if header is not None:
                stamp, frame = header
                heard.heads.append(_Head(frame.lstrip("/"), stamp, arrived, writer))

    def _decoded(self, ros_type: str) -> list[tuple[int, Any]]:
        return [pair for topic in self._topics.values() if topic.type == ros_type for pair in topic.decoded]

    def _clock(self, start: int) -> Clock | None:
        ticks = [
            (arrived, message.clock.sec * _SECOND + message.clock.nanosec)
            for arrived, message in self._decoded("rosgraph_msgs/msg/Clock")
            if arrived >= start
        ]
        if not ticks:
            return None
        arrived, stamp = np.array(ticks, dtype=np.int64).T
        return Clock(arrived, stamp)

    def _facts(self) -> dict[str, TopicFacts]:
        facts = {
            topic: TopicFacts(
                topic,
                TF_TYPE,
                self._collector.messages.get(topic, 0),
                self._endpoints(self._participant.publishers(topic)),
                self._endpoints(self._participant.subscribers(topic)),
            )
            for topic in self._transforms
        }
        facts |= {topic.name: TopicFacts(topic.name, topic.type, topic.messages) for topic in self._topics.values()}
        return facts

    def _endpoints(self, endpoints: Iterable[WireEndpoint]) -> tuple[Endpoint, ...]:
        """Named ones: one without a node is no ROS program, or has just come."""
        return tuple(
            Endpoint(full_name(endpoint.namespace, endpoint.node), endpoint.qos.transient_local)
            for endpoint in endpoints
            if not endpoint.node.startswith("_NODE_NAME_UNKNOWN")
        )


def _decode(ros_type: str, messages: Iterable[tuple[bytes, int, int]]) -> list[tuple[int, Any]]:
    message_type = find(ros_type)
    found = []
    for data, arrived, _ in messages:
        try:
            found.append((arrived, deserialize(data, message_type)))
        except DecodeError:
            continue
    return found


def _node(logger: str) -> str:
    """A logger is called by its node: "lab.listener" is that of /lab/listener."""
    return f"/{logger.replace('.', '/')}"


def _sensors(topic: _Topic, start: int, renamed: Callable[[str], str], node_of: Callable[[int], str]) -> list[Sensor]:
    """One a frame: several devices may share a topic."""
    by_frame: dict[str, list[_Head]] = {}
    for head in topic.heads:
        if head.arrived >= start and head.frame:
            by_frame.setdefault(head.frame, []).append(head)
    return [
        Sensor(
            topic.name,
            topic.type,
            renamed(frame),
            np.array([head.stamp for head in heads], dtype=np.int64),
            np.array([head.arrived for head in heads], dtype=np.int64),
            node_of(heads[-1].writer),
        )
        for frame, heads in by_frame.items()
    ]


def _joints(topic: _Topic, start: int) -> JointStates:
    messages = [message for arrived, message in topic.decoded if arrived >= start]
    stamps = [message.header.stamp.sec * _SECOND + message.header.stamp.nanosec for message in messages]
    return joint_states(topic.name, stamps, messages)
