# SPDX-License-Identifier: Apache-2.0
"""Observe a live graph: a node that subscribes to transforms, sensors, joint states and log messages."""

from __future__ import annotations

import contextlib
import time
from collections import deque
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from coframe._process.freed_memory import return_freed_blocks
from coframe.connection.listener_config import ListenerConfig
from coframe.doctor._joints import joint_states
from coframe.doctor._message_evidence import (
    CAMERA_INFO,
    IMU,
    ODOMETRY,
    observed_camera,
    observed_imu,
    observed_poses,
)
from coframe.doctor.collector import Collector
from coframe.doctor.observation import (
    Observation,
    ObservedClock,
    ObservedEndpoint,
    ObservedJointStates,
    ObservedLogLine,
    Sensor,
    TopicFacts,
)
from coframe.errors import DecodeError
from coframe.messages import deserialize, find
from coframe.messages.header_peek import HEADER_BYTES, begins_with_header, peek_header
from coframe.messages.slices import Slices
from coframe.messages.tf_columns import tf_columns
from coframe.time import SECOND
from coframe.type_names import TF_MESSAGE
from coframe.wire.names import full_name
from coframe.wire.participant import Participant
from coframe.wire.qos import TF, TF_STATIC_READER, QoS
from coframe.wire.tf_reader import STATICS_TIMEOUT

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Iterator, Sequence

    from numpy.typing import NDArray
    from typing_extensions import Self

    from coframe.doctor._transforms import Transforms
    from coframe.wire.batch_subscription import BatchSubscription, MessageBatch
    from coframe.wire.graph import EndpointInfo

__all__ = ["LiveObserver"]

_Evidence = TypeVar("_Evidence")
_ANY_PUBLISHER = QoS(depth=100, reliable=False)  # matches every publisher
_LATCHED = QoS(depth=10, transient_local=True)
_WHOLE_MESSAGE = 16 << 20  # bytes; enough for a description, a joint state or a log message
# Images need several megabytes per second, and their CameraInfo has the same header.
_LARGE_TYPES = {"sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage"}
_DECODED_TYPES = {"sensor_msgs/msg/JointState", "rcl_interfaces/msg/Log", "rosgraph_msgs/msg/Clock"}
_EVIDENCE_MESSAGES = {CAMERA_INFO: 1, IMU: 1000, ODOMETRY: 1000}  # the latest ones of each topic that are decoded
_MAX_EVIDENCE = 1 << 14  # bytes of one of these messages; larger ones are not decoded
_DESCRIPTION = "robot_description"
MAX_TRANSFORMS = 1_000_000
MAX_MESSAGES = 20_000  # for each topic
MAX_DECODED_BYTES = 64 << 20  # of the messages on one topic that are decoded: descriptions, joint states, log messages
_MEMORY_RETURN_PERIOD = 10.0  # seconds
MAX_TOPICS = 4000  # subscriptions; a typical graph has hundreds of topics


class _ReceivedHeader(NamedTuple):
    """The header of a received message. Times are nanoseconds since 1970."""

    frame: str
    stamp: int
    arrived: int
    writer: int


class _Writer(NamedTuple):
    """A publisher of another process."""

    node: str  # the full name of the node
    process: bytes  # the GUID prefix, which identifies the DDS participant


class _Delays(NamedTuple):
    """The transport times of a batch of messages from one writer, in nanoseconds."""

    arrived: int  # the arrival of the last one, in nanoseconds since 1970
    values: NDArray[np.int64]


class _Topic:
    """A subscribed topic without transforms, with the received data."""

    def __init__(self, name: str, ros_type: str, subscription: BatchSubscription) -> None:
        self.name = name
        self.type = ros_type
        self.subscription = subscription
        self.since = time.monotonic_ns()
        self.messages = 0
        self.headers: deque[_ReceivedHeader] = deque()
        self.evidence: deque[tuple[int, bytes]] = deque(maxlen=_EVIDENCE_MESSAGES.get(ros_type, 0))
        self.decoded: deque[tuple[int, Any]] = deque()
        self._sizes: deque[int] = deque()  # bytes of the decoded messages
        self._bytes = 0
        self.forgotten_until = 0  # the time of the last message dropped because of a limit

    def add_header(self, header: _ReceivedHeader) -> None:
        """Store a header, and drop the oldest one if there are too many."""
        self.headers.append(header)
        if len(self.headers) > MAX_MESSAGES:
            self.forgotten_until = self.headers.popleft().arrived

    def add_decoded(self, size: int, arrived: int, message: Any) -> None:
        """Store a message, and drop the oldest ones beyond the limits on number and bytes."""
        self.decoded.append((arrived, message))
        self._sizes.append(size)
        self._bytes += size
        while len(self.decoded) > MAX_MESSAGES or (self._bytes > MAX_DECODED_BYTES and len(self.decoded) > 1):
            self.forgotten_until = self.decoded[0][0]
            self._drop_oldest()

    def forget(self, before: int) -> None:
        """Remove headers and decoded messages that arrived before a time, except latched descriptions."""
        while self.headers and self.headers[0].arrived < before:
            self.headers.popleft()
        while self.evidence and self.evidence[0][0] < before:
            self.evidence.popleft()
        while self.type in _DECODED_TYPES and self.decoded and self.decoded[0][0] < before:
            self._drop_oldest()

    def _drop_oldest(self) -> None:
        self.decoded.popleft()
        self._bytes -= self._sizes.popleft()

    def is_over(self, before: int) -> bool:
        """Return whether nothing has arrived since a time."""
        return not self.headers and not (self.decoded and self.decoded[-1][0] >= before)


class LiveObserver:
    """Joins the graph and collects the data that the doctor checks. Can be used as a context manager.

    Args:
        config: The topics to observe. Its cache is the assumed cache length of the listeners' buffers. If None, the
            transforms on /tf and /tf_static are observed, in the domain of ROS_DOMAIN_ID.
        window: The duration that observations cover, in nanoseconds. If None, they cover everything since the start.
        also: The names of topics to which it subscribes even if the checks do not need their messages.
        node_name: The name of the node.
        node_namespace: The namespace of the node: "/" or "/a/b".

    Raises:
        WireError: The graph cannot be joined.
    """

    def __init__(
        self,
        config: ListenerConfig | None = None,
        *,
        window: int | None = None,
        also: Collection[str] = (),
        node_name: str = "coframe_doctor",
        node_namespace: str = "/",
    ) -> None:
        config = config or ListenerConfig.of()
        self._rename: Callable[[str], str] = config.renaming or str
        self.cache = config.cache
        self.window = window
        self._more_topics = frozenset(also)
        self.start = time.time_ns()
        self._started_at = time.monotonic_ns()
        self._participant = Participant.get(config.domain, config.wire)
        self._collector = Collector(config.renaming)
        self._writers: dict[int, _Writer] = {}
        self._delays: dict[int, deque[_Delays]] = {}
        self._static_writers: set[int] = set()  # those that have delivered
        self._topics: dict[str, _Topic] = {}
        self._topics_ignored = 0
        self._dropped_at: dict[str, int] = {}  # by transform topic: the time of the last dropped message
        self._next_memory_return = 0.0
        try:
            self._node = self._participant.add_node(node_namespace, node_name)
            self._transforms = {
                topic: (self._subscribe(topic, TF_MESSAGE, qos, _WHOLE_MESSAGE), static)
                for topic, qos, static in zip(config.topics, (TF, TF_STATIC_READER), (False, True), strict=True)
            }
        except BaseException:
            self._participant.close()
            raise

    def close(self) -> None:
        """Leave the graph. Received data remains available."""
        self._node.close()
        self._participant.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def poll(self) -> None:
        """Process received messages and subscribe to new topics. Call this a few times per second."""
        published = self._participant.published()
        for handles in published.values():
            for handle, endpoint in handles.items():
                self._add_writer(handle, endpoint)
        before = 0 if self.window is None else time.time_ns() - self.window
        # Done before new transforms are added, so that they reuse the space of old ones, even after a pause.
        self._collector.forget(before, MAX_TRANSFORMS)
        for topic, (subscription, static) in self._transforms.items():
            self._take_transforms(topic, subscription.take(), static)
        self._topics_ignored = 0
        for name, handles in published.items():
            if name in self._topics or name in self._transforms:
                continue
            if len(self._topics) >= MAX_TOPICS:
                self._topics_ignored += 1
            else:
                self._subscribe_if_relevant(name, sorted({endpoint.ros_type for endpoint in handles.values()}))
        for other in self._topics.values():
            self._take_messages(other)
        self._forget(before, {handle for handles in published.values() for handle in handles})
        if self.window is not None:
            self._unsubscribe(
                [name for name, topic in self._topics.items() if name not in published and topic.is_over(before)]
            )
            self._return_memory()

    def listen(self, seconds: float) -> None:
        """Poll for a duration in seconds."""
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            time.sleep(min(0.2, left))
            self.poll()

    def listen_for_statics(self) -> None:
        """Poll until every publisher of static transforms has delivered them, or until STATICS_TIMEOUT has passed."""
        end = self._started_at / SECOND + STATICS_TIMEOUT
        while self._awaited_statics() and (left := end - time.monotonic()) > 0:
            self.listen(min(0.1, left))

    def observe(self) -> Observation:
        """Return the data received within the window."""
        self._next_memory_return = 0.0  # The caller discards a large report; the next poll returns its memory.
        end = time.time_ns()
        start = self.start if self.window is None else max(self.start, end - self.window)
        return Observation(
            live=True,
            start=start,
            end=end,
            transforms=self._add_node_names(self._collector.transforms()),
            empty_messages=self._collector.empty,
            damaged_messages=self._collector.damaged,
            messages_ignored=self._collector.ignored,
            topics_ignored=self._topics_ignored,
            transforms_since=self._collector.forgotten_until if self._collector.forgotten_until >= start else 0,
            incomplete=(
                *(topic for topic, dropped_at in self._dropped_at.items() if dropped_at >= start),
                *(topic.name for topic in self._topics.values() if topic.forgotten_until >= start),
            ),
            topics=self._facts(),
            sensors=tuple(
                s for topic in self._topics.values() for s in _sensors(topic, start, self._rename, self._node_of)
            ),
            descriptions=tuple(str(message.data) for _, message in self._decoded_messages("std_msgs/msg/String")),
            joint_states=tuple(
                _joints(topic, start) for topic in self._topics.values() if topic.type == "sensor_msgs/msg/JointState"
            ),
            poses=self._evidence(ODOMETRY, start, observed_poses),
            imus=self._evidence(IMU, start, observed_imu),
            cameras=self._evidence(
                CAMERA_INFO, start, lambda topic, messages, rename: observed_camera(topic, messages[-1], rename)
            ),
            clock=self._clock(start),
            travel=self._delays_by_node(),
            log=tuple(
                ObservedLogLine(_node_of_logger(message.name), message.msg, arrived)
                for arrived, message in self._decoded_messages("rcl_interfaces/msg/Log")
                if arrived >= start
            ),
            cache=self.cache,
            link_name=self._rename,
        )

    def _subscribe(self, topic: str, ros_type: str, qos: QoS, max_bytes: int) -> BatchSubscription:
        return self._participant.batch_subscription(self._node, topic, ros_type, qos, max_bytes=max_bytes)

    def _add_writer(self, handle: int, endpoint: EndpointInfo) -> None:
        if not endpoint.node.startswith("_NODE_NAME_UNKNOWN"):
            self._writers[handle] = _Writer(full_name(endpoint.namespace, endpoint.node), endpoint.guid[:12])

    def _node_of(self, handle: int) -> str:
        """Return the full name of a writer's node, or "" until it is known. This may be after its first messages.

        If several processes have a node with the same name, the name of the second one ends with "(copy 2)".
        """
        writer = self._writers.get(handle)
        if writer is None:
            return ""
        processes = dict.fromkeys(other.process for other in self._writers.values() if other.node == writer.node)
        number = list(processes).index(writer.process)
        return writer.node if number == 0 else f"{writer.node} (copy {number + 1})"

    def _forget(self, before: int, present: set[int]) -> None:
        """Discard messages that arrived before a time, and departed writers without later messages."""
        self._collector.forget(before, MAX_TRANSFORMS)
        for topic in self._topics.values():
            topic.forget(before)
        for delays in self._delays.values():
            while delays and delays[0].arrived < before:
                delays.popleft()
        self._static_writers &= present
        if (self._writers.keys() | self._delays.keys()) <= present:
            return
        active = present | set(map(int, self._collector.publishers()))
        active |= {head.writer for topic in self._topics.values() for head in topic.headers}
        self._writers = {handle: writer for handle, writer in self._writers.items() if handle in active}
        self._delays = {handle: delays for handle, delays in self._delays.items() if handle in active}

    def _return_memory(self) -> None:
        """Periodically return the memory of discarded messages and reports to the system."""
        if time.monotonic() >= self._next_memory_return:
            self._next_memory_return = time.monotonic() + _MEMORY_RETURN_PERIOD
            return_freed_blocks()

    def _add_node_names(self, received: Transforms) -> Transforms:
        """Replace the writer handles of the collector with the names of nodes."""
        names = [self._node_of(int(handle)) for handle in received.publishers]
        number = {name: i for i, name in enumerate(dict.fromkeys(names))}
        numbers = np.array([number[name] for name in names], dtype=np.int64)
        return replace(received, publisher=numbers[received.publisher], publishers=tuple(number))

    def _delays_by_node(self) -> dict[str, NDArray[np.int64]]:
        by_name: dict[str, list[NDArray[np.int64]]] = {}
        for handle, delays in self._delays.items():
            by_name.setdefault(self._node_of(handle), []).extend(batch.values for batch in delays)
        return {name: np.concatenate(batches) for name, batches in by_name.items() if batches}

    def _awaited_statics(self) -> set[int]:
        """Return the handles of matched publishers of static transforms that have not delivered anything."""
        readers = [subscription for subscription, static in self._transforms.values() if static]
        return {writer for reader in readers for writer in reader.matched_handles()} - self._static_writers

    def _take_transforms(self, topic: str, messages: MessageBatch, static: bool) -> None:
        if messages.dropped:
            self._dropped_at[topic] = time.time_ns()
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
        if static:
            self._static_writers.update(handles.tolist())
        else:  # latched messages may have been sent long before this node subscribed
            delay = messages.arrived - messages.sent
            for number, handle in enumerate(handles.tolist()):
                delays = self._delays.setdefault(handle, deque())
                delays.append(_Delays(int(messages.arrived[-1]), delay[publisher == number]))
                while sum(len(batch.values) for batch in delays) > MAX_MESSAGES and len(delays) > 1:
                    delays.popleft()

    def _unsubscribe(self, topics: Iterable[str]) -> None:
        """Close the subscriptions to topics that are no longer published."""
        for name in topics:
            self._topics.pop(name).subscription.close()

    def _subscribe_if_relevant(self, name: str, types: list[str]) -> None:
        ros_type = types[0]
        if name.endswith(_DESCRIPTION) and ros_type == "std_msgs/msg/String":
            subscription = self._subscribe(name, ros_type, _LATCHED, _WHOLE_MESSAGE)
        elif ros_type in _DECODED_TYPES:
            subscription = self._subscribe(name, ros_type, _ANY_PUBLISHER, _WHOLE_MESSAGE)
        elif ros_type in _EVIDENCE_MESSAGES:
            subscription = self._subscribe(name, ros_type, _ANY_PUBLISHER, _MAX_EVIDENCE)
        elif name in self._more_topics or (ros_type not in _LARGE_TYPES and begins_with_header(ros_type)):
            subscription = self._subscribe(name, ros_type, _ANY_PUBLISHER, HEADER_BYTES)
        else:
            return
        self._topics[name] = _Topic(name, ros_type, subscription)

    def _take_messages(self, topic: _Topic) -> None:
        messages = topic.subscription.take()
        topic.messages += len(messages.ends)
        if messages.dropped:
            topic.forgotten_until = time.time_ns()
        whole = Slices.contiguous(messages.data, messages.ends).each()
        rows = zip(map(bytes, whole), messages.arrived.tolist(), messages.writers.tolist(), strict=True)
        if topic.type in _DECODED_TYPES or topic.name.endswith(_DESCRIPTION):
            for size, arrived, message in _decode(topic.type, rows):
                topic.add_decoded(size, arrived, message)
            return
        for data, arrived, writer in rows if begins_with_header(topic.type) else ():
            header = peek_header(data)
            if header is not None:
                stamp, frame = header
                topic.add_header(_ReceivedHeader(frame.lstrip("/"), stamp, arrived, writer))
                topic.evidence.append((arrived, data))

    def _evidence(
        self, ros_type: str, start: int, convert: Callable[[str, Sequence[Any], Callable[[str], str]], _Evidence | None]
    ) -> tuple[_Evidence, ...]:
        """Return what the latest messages on each topic of a type show."""
        found = []
        for topic in self._topics.values():
            rows = ((data, arrived, 0) for arrived, data in topic.evidence if arrived >= start)
            messages = [message for *_, message in _decode(ros_type, rows)] if topic.type == ros_type else []
            found.append(convert(topic.name, messages, self._rename) if messages else None)
        return tuple(one for one in found if one is not None)

    def _decoded_messages(self, ros_type: str) -> list[tuple[int, Any]]:
        return [pair for topic in self._topics.values() if topic.type == ros_type for pair in topic.decoded]

    def _clock(self, start: int) -> ObservedClock | None:
        received = [
            (arrived, message.clock.sec * SECOND + message.clock.nanosec)
            for arrived, message in self._decoded_messages("rosgraph_msgs/msg/Clock")
            if arrived >= start
        ]
        if not received:
            return None
        arrived, stamp = np.array(received, dtype=np.int64).T
        return ObservedClock(arrived, stamp)

    def publishers(self, topic: str) -> tuple[ObservedEndpoint, ...]:
        """Return the publishers of a topic."""
        return self._endpoints(self._participant.publishers(topic))

    def _facts(self) -> dict[str, TopicFacts]:
        now = time.monotonic_ns()
        facts = {
            topic: TopicFacts(
                topic,
                TF_MESSAGE,
                self._collector.messages.get(topic, 0),
                self._endpoints(self._participant.publishers(topic)),
                self._endpoints(self._participant.subscribers(topic)),
                now - self._started_at,
            )
            for topic in self._transforms
        }
        published = self._participant.published()
        for topic in self._topics.values():
            # Publishers are examined only for topics without messages.
            publishers = self._endpoints(published.get(topic.name, {}).values()) if not topic.messages else ()
            facts[topic.name] = TopicFacts(
                topic.name, topic.type, topic.messages, publishers, observed=now - topic.since
            )
        return facts

    def _endpoints(self, endpoints: Iterable[EndpointInfo]) -> tuple[ObservedEndpoint, ...]:
        """Return the endpoints with a known node. Others are not ROS programs, or are not fully discovered yet."""
        return tuple(
            ObservedEndpoint(
                full_name(endpoint.namespace, endpoint.node), endpoint.qos.transient_local, endpoint.qos.reliable
            )
            for endpoint in endpoints
            if not endpoint.node.startswith("_NODE_NAME_UNKNOWN")
        )


def _decode(ros_type: str, messages: Iterable[tuple[bytes, int, int]]) -> Iterator[tuple[int, int, Any]]:
    """Yield the size, arrival time and content of each valid message."""
    message_type = find(ros_type)
    for data, arrived, _ in messages:
        with contextlib.suppress(DecodeError):
            yield len(data), arrived, deserialize(data, message_type)


def _node_of_logger(logger: str) -> str:
    """Return the node of a logger: "/lab/listener" for "lab.listener"."""
    return f"/{logger.replace('.', '/')}"


def _sensors(topic: _Topic, start: int, rename: Callable[[str], str], node_of: Callable[[int], str]) -> list[Sensor]:
    """Return one sensor for each frame, because several devices may publish on one topic."""
    by_frame: dict[str, list[_ReceivedHeader]] = {}
    for head in topic.headers:
        if head.arrived >= start and head.frame:
            by_frame.setdefault(head.frame, []).append(head)
    return [_sensor(topic, rename(frame), headers, node_of) for frame, headers in by_frame.items()]


def _sensor(topic: _Topic, frame: str, headers: list[_ReceivedHeader], node_of: Callable[[int], str]) -> Sensor:
    nodes = {writer: node_of(writer) for writer in dict.fromkeys(head.writer for head in headers)}
    publishers = tuple(dict.fromkeys(filter(None, nodes.values())))
    numbers = {writer: publishers.index(node) if node else -1 for writer, node in nodes.items()}
    return Sensor(
        topic.name,
        topic.type,
        frame,
        np.array([head.stamp for head in headers], dtype=np.int64),
        np.array([head.arrived for head in headers], dtype=np.int64),
        nodes[headers[-1].writer],
        publishers,
        np.array([numbers[head.writer] for head in headers], dtype=np.int64),
    )


def _joints(topic: _Topic, start: int) -> ObservedJointStates:
    messages = [message for arrived, message in topic.decoded if arrived >= start]
    stamps = [message.header.stamp.sec * SECOND + message.header.stamp.nanosec for message in messages]
    return joint_states(topic.name, stamps, messages)
