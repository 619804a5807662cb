# SPDX-License-Identifier: Apache-2.0
"""Observe a recording, once per namespace, because robots with their own /tf may use the same frame names."""

from __future__ import annotations

from contextlib import suppress
from itertools import islice
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from coframe.bags import from_yaml
from coframe.bags.namespaces import TransformChoice, namespace_of
from coframe.bags.recording import open_with_choice
from coframe.bags.transforms import ingest_for, is_static
from coframe.doctor._joints import joint_states
from coframe.doctor._message_evidence import (
    CAMERA_INFO,
    IMU,
    ODOMETRY,
    observed_camera,
    observed_imu,
    observed_poses,
)
from coframe.doctor._sampled_points import sampled_points
from coframe.doctor.collector import Collector
from coframe.doctor.observation import (
    DEFAULT_CACHE,
    NEVER,
    Observation,
    ObservedClock,
    ObservedEndpoint,
    ObservedJointStates,
    ObservedLogLine,
    ObservedPositions,
    Sensor,
    TopicFacts,
)
from coframe.errors import DecodeError
from coframe.frame_names import absolute
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from numpy.typing import NDArray

    from coframe._sources.sources import Location
    from coframe.bags import Recording
    from coframe.bags.storage import Channel
    from coframe.messages.slices import Slices

__all__ = ["collecting_callback", "observe_recording"]

_Evidence = TypeVar("_Evidence")
_MAX_DECODED = 2000  # limit of messages per topic
_MAX_CAMERA_INFOS = 1
_MAX_DESCRIPTIONS = 10
_PART_COUNT, _MESSAGES_PER_PART = 20, 25  # parts of a topic that are looked at, and successive messages in each
_MIN_RATE = 1.0  # Hz; what is published more slowly, such as goals, need not be on one track
_POSE_FIELDS: dict[str, Callable[[Any], Any]] = {
    ODOMETRY: lambda message: message.pose.pose.position,
    "geometry_msgs/msg/PoseStamped": lambda message: message.pose.position,
    "geometry_msgs/msg/PoseWithCovarianceStamped": lambda message: message.pose.pose.position,
}
_LOG_TYPES = {"rcl_interfaces/msg/Log", "rosgraph_msgs/msg/Log"}


def observe_recording(
    path: Location,
    *,
    namespace: str | None = None,
    tf_topic: str | None = None,
    tf_static_topic: str | None = None,
    prefix: str = "",
    keep: Iterable[str] = (),
    cache: int = DEFAULT_CACHE,
    progress: Callable[[int, int], object] | None = None,
) -> dict[str, Observation]:
    """Return the observations of a recording by namespace: ``""`` for ``/tf``, ``/robot1`` for ``/robot1/tf``.

    Args:
        path: A file, the folder of a rosbag2 recording, or its URL.
        namespace: Only the transforms of this namespace, or None for all.
        tf_topic: Only the transforms of this topic and of ``tf_static_topic``, as those of one robot in the namespace
            of this topic. None means all topics, or ``/tf`` if only the other topic is given.
        tf_static_topic: Only the transforms of this topic and of ``tf_topic``. None: all, or ``/tf_static``.
        prefix: A prefix for all frame names, including the frames of sensors, used as given.
        keep: The frames without the prefix, because they are shared.
        cache: The cache length of the buffers of listeners, in nanoseconds.
        progress: Called repeatedly with the number of bytes read and the total number.

    Raises:
        RecordingError: The recording cannot be read.
        ValueError: The prefix begins with a slash.
    """
    choice = TransformChoice(namespace, tf_topic, tf_static_topic, prefix, keep)
    return observe_chosen(path, choice, cache=cache, progress=progress)


def observe_chosen(
    path: Location,
    choice: TransformChoice,
    *,
    cache: int = DEFAULT_CACHE,
    progress: Callable[[int, int], object] | None = None,
    examine: Callable[[Recording], object] | None = None,
) -> dict[str, Observation]:
    """Return the same as :func:`observe_recording`, with the choice of transforms as one value.

    `examine` is called with the open recording, for callers that also need other data of it.
    """
    collectors: dict[str, Collector] = {}
    with open_with_choice(
        path, choice, progress=progress, on_transforms=collecting_callback(collectors, choice)
    ) as recording:
        if examine is not None:
            examine(recording)
        facts = _Facts(recording)
        return {
            name: Observation(
                live=False,
                start=recording.received_start,
                end=recording.received_end,
                transforms=collector.transforms(),
                empty_messages=collector.empty,
                damaged_messages=collector.damaged,
                messages_ignored=collector.ignored,
                topics=facts.topics,
                sensors=tuple(s for s in facts.sensors if _is_in_namespace(s.topic, name, collectors)),
                descriptions=tuple(
                    text for topic, text in facts.descriptions if _is_in_namespace(topic, name, collectors)
                ),
                joint_states=tuple(j for j in facts.joints if _is_in_namespace(j.topic, name, collectors)),
                positions=tuple(p for p in facts.positions if _is_in_namespace(p.topic, name, collectors)),
                poses=tuple(p for p in facts.poses if _is_in_namespace(p.topic, name, collectors)),
                imus=tuple(i for i in facts.imus if _is_in_namespace(i.topic, name, collectors)),
                cameras=tuple(c for c in facts.cameras if _is_in_namespace(c.topic, name, collectors)),
                clock=facts.clock,
                log=facts.log,
                cache=cache,
                unread=tuple(recording.problems),
                link_name=choice.renaming or str,
            )
            for name, collector in sorted((collectors or {"": Collector()}).items())
        }


def collecting_callback(
    collectors: dict[str, Collector], choice: TransformChoice
) -> Callable[[Channel, NDArray[np.int64], Slices], None]:
    """Return a callback for :func:`coframe.open_bag` that fills a collector for each namespace.

    If topics are chosen, it fills only the collector of the namespace of the first one, as for one robot.
    """
    names = choice.renaming
    together = namespace_of(choice.topics[0]) if choice.topics else None

    def collect(channel: Channel, receive_times: NDArray[np.int64], messages: Slices) -> None:
        take = ingest_for(channel)
        if take is not None:
            namespace = namespace_of(channel.topic) if together is None else together
            collector = collectors.setdefault(namespace, Collector(names))
            unknown = np.zeros(len(receive_times), dtype=np.int64)
            collector.add(channel.topic, take.static, take.columns(messages), receive_times, unknown, [""])

    return collect


def _is_in_namespace(topic: str, namespace: str, namespaces: dict[str, Collector]) -> bool:
    """Return whether a namespace is the longest one that contains the topic."""
    around = [name for name in namespaces if absolute(topic).startswith(f"{name}/")]
    return namespace == max(around, key=len, default=namespace)


class _Facts:
    """The data that all namespaces of a recording share."""

    def __init__(self, recording: Recording) -> None:
        self._recording = recording
        self.topics = {
            topic.name: TopicFacts(topic.name, topic.type, topic.messages, self._publishers(topic.name))
            for topic in recording.topics.values()
        }
        self.clock = self._clock()
        self.sensors = [sensor for name in self.topics for sensor in self._sensors(name)]
        self.positions = [
            ObservedPositions(name, tuple(self._parts(name)))
            for name in self._topics_of_type(set(_POSE_FIELDS))
            if recording.topics[name].rate >= _MIN_RATE
        ]
        self.descriptions = [
            (name, str(message.data))
            for name in self._topics_of_type({"std_msgs/msg/String"})
            if name.endswith("robot_description")
            for message in self._decode_first(name, _MAX_DESCRIPTIONS)
            if hasattr(message, "data")
        ]
        self.joints = [
            joints
            for name in self._topics_of_type({"sensor_msgs/msg/JointState"})
            if (joints := self._joints(name)) is not None
        ]
        self.poses = self._evidence(ODOMETRY, observed_poses)
        self.imus = self._evidence(IMU, observed_imu)
        self.cameras = [
            camera
            for name in self._topics_of_type({CAMERA_INFO})
            for message in self._decode_first(name, _MAX_CAMERA_INFOS)
            if (camera := observed_camera(name, message, recording.frame)) is not None
        ]
        self.log = tuple(line for name in self._topics_of_type(_LOG_TYPES) for line in self._log_lines(name))

    def _publishers(self, topic: str) -> tuple[ObservedEndpoint, ...]:
        """Return the publishers of a static transform topic: only their QoS, because recordings have no node names."""
        if not is_static(topic):
            return ()
        channels = (channel for channel in self._recording.channels() if channel.topic == topic)
        offers = (offered for channel in channels for offered in from_yaml(channel.offered_qos))
        return tuple(dict.fromkeys(ObservedEndpoint("", offered.transient_local) for offered in offers))

    def _topics_of_type(self, types: set[str]) -> list[str]:
        return [topic.name for topic in self.topics.values() if topic.type in types]

    def _clock(self) -> ObservedClock | None:
        if "/clock" not in self._topics_of_type({"rosgraph_msgs/msg/Clock"}):
            return None
        arrival_times, stamp = self._recording.received("/clock"), self._recording.stamps("/clock")
        return ObservedClock(arrival_times, stamp) if len(stamp) else None

    def _decode_first(self, topic: str, limit: int) -> Iterator[Any]:
        """Yield the first messages on a topic; damaged ones are reported as problems of the recording.

        The definition in a recording can differ from the usual one: any field can be missing, and a message without
        a usable definition is returned as bytes.
        """
        messages = islice(self._recording.messages(topic), limit)
        while (recorded := next(messages, None)) is not None:
            try:
                yield recorded.message
            except DecodeError:
                continue

    def _sensors(self, topic: str) -> Iterator[Sensor]:
        """Yield the headers of a topic, one sensor for each frame; none if its messages have no frame."""
        facts, recording = self.topics[topic], self._recording
        first = recording.first_frame(topic)
        if not first.lstrip("/") or facts.type == "sensor_msgs/msg/JointState":
            return
        stamps, received = recording.stamps(topic), recording.received(topic)
        rows_of: dict[str, list[int]] = {}
        if len(set(recording.frames(topic, np.concatenate(_spread_messages(len(stamps))).tolist()))) > 1:
            for row, frame in enumerate(recording.frames(topic)):
                rows_of.setdefault(frame.lstrip("/"), []).append(row)
        points = sampled_points(recording, topic, facts.type)
        for name, rows in rows_of.items() or [(first.lstrip("/"), slice(None))]:
            if name:
                frame = recording.frame(name)
                own = tuple(one for one in points if one.frame == frame)
                yield Sensor(topic, facts.type, frame, stamps[rows], received[rows], points=own)

    def _parts(self, topic: str) -> Iterator[NDArray[np.float64]]:
        """Yield the positions in successive messages, for parts of the recording."""
        stamps, position = self._recording.stamps(topic), _POSE_FIELDS[self.topics[topic].type]
        for rows in _spread_messages(len(stamps)):
            messages = self._recording.messages(topic, int(stamps[rows].min(initial=NEVER)))
            found = []
            for recorded in islice(messages, len(rows)):
                with suppress(DecodeError, AttributeError, TypeError, ValueError):
                    point = position(recorded.message)
                    found.append((float(point.x), float(point.y), float(point.z)))
            yield np.array(found).reshape(-1, 3)

    def _joints(self, topic: str) -> ObservedJointStates | None:
        """Return the joint states of a topic, or None if its messages have other fields."""
        if not self._recording.may_have_header(topic):
            return None
        messages = list(self._decode_first(topic, _MAX_DECODED))
        try:
            stamps = [int(message.header.stamp.sec) * SECOND + message.header.stamp.nanosec for message in messages]
            return joint_states(topic, stamps, messages)
        except (AttributeError, TypeError, ValueError, OverflowError):
            return None

    def _evidence(
        self, ros_type: str, convert: Callable[[str, Iterable[Any], Callable[[str], str]], _Evidence | None]
    ) -> list[_Evidence]:
        """Return what the first messages on each topic of a type show."""
        found = (
            convert(name, self._decode_first(name, _MAX_DECODED), self._recording.frame)
            for name in self._topics_of_type({ros_type})
        )
        return [one for one in found if one is not None]

    def _log_lines(self, topic: str) -> Iterator[ObservedLogLine]:
        received = self._recording.received(topic)
        for arrival_time, message in zip(received.tolist(), self._decode_first(topic, _MAX_DECODED), strict=False):
            if hasattr(message, "name") and hasattr(message, "msg"):
                yield ObservedLogLine(str(message.name), str(message.msg), arrival_time)


def _spread_messages(messages: int) -> list[NDArray[np.int64]]:
    """Return the numbers of successive messages in parts that are spread over a topic, or of all messages."""
    if messages <= _PART_COUNT * _MESSAGES_PER_PART:
        return [np.arange(messages)]
    return [
        start + np.arange(_MESSAGES_PER_PART)
        for start in np.linspace(0, messages - _MESSAGES_PER_PART, _PART_COUNT).astype(np.int64)
    ]
