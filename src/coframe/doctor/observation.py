# SPDX-License-Identifier: Apache-2.0
"""Observation: received or recorded transforms and messages, with derived data that several checks need.

The rows are the transforms as published, including those that a buffer rejects. All times are int64 nanoseconds.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from coframe.analysis.clock_offset import clock_offset
from coframe.analysis.clocks import clock_of, group_by_clock
from coframe.analysis.liveness import is_stale
from coframe.analysis.missing_edges import is_base_frame
from coframe.analysis.tree import FrameTrees
from coframe.doctor._edge import Edge
from coframe.doctor._transforms import Transforms, without_slash
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from numpy.typing import NDArray

    from coframe.analysis.clock_offset import ClockOffset
    from coframe.analysis.clocks import ClockName
    from coframe.cameras import CameraModel

__all__ = [
    "NEVER",
    "Edge",
    "Observation",
    "ObservedCamera",
    "ObservedClock",
    "ObservedEndpoint",
    "ObservedImu",
    "ObservedJointStates",
    "ObservedLogLine",
    "ObservedPoints",
    "ObservedPoses",
    "ObservedPositions",
    "Sensor",
    "TopicFacts",
    "Transforms",
]

DEFAULT_CACHE = 10 * SECOND
NEVER = np.iinfo(np.int64).max


@dataclass(frozen=True)
class ObservedEndpoint:
    """A publisher or a subscription.

    Attributes:
        node: The full name of its node; "" in recordings, which do not contain it.
        transient_local: Whether its durability is transient local: late joiners receive earlier messages.
        reliable: Whether its reliability is reliable, not best effort.
    """

    node: str
    transient_local: bool
    reliable: bool = True


@dataclass(frozen=True)
class TopicFacts:
    """A topic: its type, the number of received messages, its publishers and its subscriptions.

    In a recording, only the publishers of static transforms are known. The time for which messages could be received,
    in nanoseconds, is 0 in a recording.
    """

    name: str
    type: str
    messages: int
    publishers: tuple[ObservedEndpoint, ...] = ()
    subscribers: tuple[ObservedEndpoint, ...] = ()
    observed: int = 0


@dataclass(frozen=True, eq=False)
class ObservedPoints:
    """Points of one message of a lidar.

    Attributes:
        topic: The topic on which the message was published.
        frame: The frame in which they are expressed.
        stamp: The stamp of the message.
        sweep: The time from the stamp to the last point, or 0 if the points have no times.
        times: (N,) the time of each point.
        points: (N, 3) coordinates in meters.
    """

    topic: str
    frame: str
    stamp: int
    sweep: int
    times: NDArray[np.int64]
    points: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Sensor:
    """Messages with a header that names a frame.

    Attributes:
        topic: The topic on which the messages were published.
        type: The type of its messages.
        frame: The frame in which they are expressed, without a leading slash.
        stamp: (N,) stamps of their headers.
        arrived: (N,) times of their arrival.
        publisher: The full name of the node, or "" if it is unknown.
        publishers: The full names of all nodes that published these messages, as far as they are known.
        source: (N,) index into `publishers` for each message, or -1 if the node is unknown.
        points: The points of some messages of a lidar, from recordings only.
    """

    topic: str
    type: str
    frame: str
    stamp: NDArray[np.int64]
    arrived: NDArray[np.int64]
    publisher: str = ""
    publishers: tuple[str, ...] = ()
    source: NDArray[np.int64] = field(default_factory=lambda: np.empty(0, np.int64))
    points: tuple[ObservedPoints, ...] = ()

    @cached_property
    def sweep(self) -> int:
        """The usual time from the stamp to the last point of a message, or 0 if its points have no times."""
        return int(np.median([one.sweep for one in self.points])) if self.points else 0


@dataclass(frozen=True, eq=False)
class ObservedJointStates:
    """Joint states: (N,) stamps, and the (N,) positions of each joint, NaN where a message does not contain it."""

    topic: str
    stamp: NDArray[np.int64]
    positions: dict[str, NDArray[np.float64]]


@dataclass(frozen=True, eq=False)
class ObservedPositions:
    """Positions in meters in successive messages on a topic with poses: parts of the recording, (N, 3) each."""

    topic: str
    parts: tuple[NDArray[np.float64], ...]


@dataclass(frozen=True, eq=False)
class ObservedPoses:
    """Poses in messages of an odometry topic: (N,) stamps and (N, 7) poses of one frame in another."""

    topic: str
    frame: str
    child: str
    stamp: NDArray[np.int64]
    values: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ObservedImu:
    """Messages of an IMU: (N, 3) accelerations in m/s^2 and rates of rotation in rad/s, in its frame."""

    topic: str
    frame: str
    acceleration: NDArray[np.float64]
    rates: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class ObservedCamera:
    """One CameraInfo of a topic.

    Attributes:
        topic: The topic on which it was published.
        frame: The optical frame.
        distortion_model: The name of the model as published.
        coefficients: Its coefficients.
        model: The camera, or None if it cannot be used.
        problem: Why it cannot be used, or "".
    """

    topic: str
    frame: str
    distortion_model: str
    coefficients: tuple[float, ...]
    model: CameraModel | None = None
    problem: str = ""


@dataclass(frozen=True, eq=False)
class ObservedClock:
    """Simulated time: the arrival times of the messages on /clock, and the times in them; (N,) each."""

    arrived: NDArray[np.int64]
    stamp: NDArray[np.int64]

    def at(self, arrival_times: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the simulated time at given arrival times, interpolated between the messages."""
        elapsed = (arrival_times - self.arrived[0]).astype(np.float64)
        between = np.interp(elapsed, self.arrived - self.arrived[0], self._elapsed_times)
        return np.asarray(self.stamp[0] + np.rint(between).astype(np.int64))

    @cached_property
    def _elapsed_times(self) -> NDArray[np.int64]:
        return np.asarray(self.stamp - self.stamp[0])


@dataclass(frozen=True)
class ObservedLogLine:
    """A message of a node on /rosout."""

    node: str
    text: str
    arrived: int


@dataclass(frozen=True, eq=False)
class Observation:
    """The data that all checks examine.

    Attributes:
        live: Whether it was received from the ROS graph, not read from a recording.
        start: The start of the observation, or of the recording.
        end: The end of the observation, or of the recording.
        transforms: The transforms as published.
        empty_messages: The number of messages without any transform.
        damaged_messages: The number of messages that are not valid TFMessages.
        messages_ignored: The number of messages ignored because the limit of frame names was reached.
        topics_ignored: The number of topics that were not examined because of the limit.
        transforms_since: The arrival time since which all transforms are included, if older ones were dropped because
            of the limit; otherwise 0.
        incomplete: The topics with messages that are not included because of a limit.
        topics: The topics by name.
        sensors: Messages with a header that names a frame.
        descriptions: The robot descriptions, in the order of arrival.
        joint_states: The joint states, one entry per topic.
        positions: The positions in messages with poses, one entry per topic; recordings only.
        poses: The poses of odometry topics, one entry per topic.
        imus: Some messages of each IMU.
        cameras: One CameraInfo of each topic: the first one of a recording, the latest one of a live graph.
        clock: Simulated time, or None without /clock.
        travel: The transport times of the transforms of each publisher, measured with the clocks of two machines; only
        live.
        log: Messages of nodes on /rosout.
        cache: The cache length of the buffers of listeners.
        unread: Read errors of a recording, one message each.
        link_name: Returns the frame name of a link of the robot descriptions.
    """

    live: bool
    start: int
    end: int
    transforms: Transforms
    empty_messages: int = 0
    damaged_messages: int = 0
    messages_ignored: int = 0
    topics_ignored: int = 0
    transforms_since: int = 0
    incomplete: tuple[str, ...] = ()
    topics: dict[str, TopicFacts] = field(default_factory=dict)
    sensors: tuple[Sensor, ...] = ()
    descriptions: tuple[str, ...] = ()
    joint_states: tuple[ObservedJointStates, ...] = ()
    positions: tuple[ObservedPositions, ...] = ()
    poses: tuple[ObservedPoses, ...] = ()
    imus: tuple[ObservedImu, ...] = ()
    cameras: tuple[ObservedCamera, ...] = ()
    clock: ObservedClock | None = None
    travel: dict[str, NDArray[np.int64]] = field(default_factory=dict)
    log: tuple[ObservedLogLine, ...] = ()
    cache: int = DEFAULT_CACHE
    unread: tuple[str, ...] = ()
    link_name: Callable[[str], str] = str

    @property
    def duration(self) -> int:
        """The time from start to end."""
        return self.end - self.start

    @cached_property
    def edges(self) -> tuple[Edge, ...]:
        """The edges, from the rows that tf2 accepts, with static and dynamic ones separate, in the order of arrival."""
        rows_of = self.transforms
        rows = np.flatnonzero(rows_of.accepted)
        if not len(rows):
            return ()
        # Names with and without a leading slash are the same frame.
        numbers: dict[tuple[str, str], int] = {}
        names = [without_slash(rows_of.pair(number)) for number in range(len(rows_of.pairs))]
        same = np.array([numbers.setdefault(pair, len(numbers)) for pair in names], dtype=np.int64)
        groups = same[rows_of.edge[rows]] * 2 + rows_of.static[rows]
        order = np.argsort(groups.astype(np.min_scalar_type(2 * len(numbers))), kind="stable")
        ends = np.cumsum(np.bincount(groups))
        parts = [rows[part] for part in np.split(order, ends[:-1]) if len(part)]
        found = [self._edge(part, names[int(rows_of.edge[part[0]])]) for part in parts]
        return tuple(sorted(found, key=lambda edge: int(edge.arrived[0])))

    def _edge(self, rows: NDArray[np.intp], names: tuple[str, str]) -> Edge:
        rows_of = self.transforms
        publisher = rows_of.publisher[rows]
        numbers, first = np.unique(publisher, return_index=True)
        publishers = (rows_of.publishers[number] for number in numbers[np.argsort(first)].tolist())
        return Edge(
            parent=names[0],
            child=names[1],
            static=bool(rows_of.static[rows[0]]),
            arrived=rows_of.arrived[rows],
            stamp=rows_of.stamp[rows],
            publisher=publisher,
            values=rows_of.values[rows],
            publishers=tuple(name for name in publishers if name),
        )

    @cached_property
    def dynamic(self) -> tuple[Edge, ...]:
        """The edges that were published on topics of dynamic transforms."""
        return tuple(edge for edge in self.edges if not edge.static)

    @cached_property
    def static(self) -> tuple[Edge, ...]:
        """The edges that were published on topics of static transforms."""
        return tuple(edge for edge in self.edges if edge.static)

    @cached_property
    def last(self) -> dict[str, Edge]:
        """The edge of the last transform of each child frame, as in a buffer."""
        found: dict[str, Edge] = {}
        for edge in self.edges:
            other = found.get(edge.child)
            if other is None or edge.arrived[-1] >= other.arrived[-1]:
                found[edge.child] = edge
        return found

    def silence(self, edge: Edge) -> int:
        """Return how long no transform of an edge was received before the end."""
        return self.end - int(edge.arrived[-1])

    def is_stale(self, edge: Edge) -> bool:
        """Return whether an edge was stale at the end, or False if its child frame had another parent by then."""
        is_current = self.last[edge.child] is edge
        return is_current and is_stale(self.silence(edge), edge.period, static=edge.static)

    @cached_property
    def frames(self) -> tuple[str, ...]:
        """All frames, in the order of their first transform."""
        return tuple(dict.fromkeys(name for edge in self.edges for name in edge.key))

    @cached_property
    def structure(self) -> FrameTrees:
        """The frame trees at the end, from the last parent of each frame."""
        return FrameTrees.from_parents({child: edge.parent for child, edge in self.last.items()}, self.frames)

    @cached_property
    def roots(self) -> dict[str, str]:
        """The root of the tree of each frame, by frame; for a loop and the frames below it, a frame of the loop."""
        return {frame: self.structure.root(frame) for frame in self.frames}

    def root(self, frame: str) -> str:
        """Return the root of the tree of a frame, or the frame itself if no transform contains it."""
        return self.structure.root(frame)

    def path(self, frame: str) -> list[Edge]:
        """Return the edges from a frame up to its root, with the edges of a loop once."""
        return [self.last[name] for name in self.structure.path(frame) if name in self.last]

    def mounts(self, frame: str) -> list[Edge]:
        """Return the constant edges from a frame up to the base of its robot, or up to the first edge that moves."""
        chain: list[Edge] = []
        for edge in self.path(frame):
            if not (edge.static or edge.constant):
                break
            chain.append(edge)
            if is_base_frame(edge.parent):
                break
        return chain

    @cached_property
    def trees(self) -> dict[str, tuple[str, ...]]:
        """The frames of each tree by its root, the root included; the largest tree first."""
        trees = {self.structure.root(frames[0]): frames for frames in self.structure.members}
        return dict(sorted(trees.items(), key=lambda tree: (-len(tree[1]), tree[0])))

    @cached_property
    def clocks(self) -> dict[str, str]:
        """By name of a dynamic edge and by topic of a sensor: the clock of its stamps.

        The clock is ``wall``, ``simulated``, or ``other 1`` and so on for clocks that are hours off both. Edges and
        sensors whose stamps are all 0 have no clock.
        """
        times = {edge.name: (edge.stamp, edge.arrived) for edge in self.dynamic}
        times |= {sensor.topic: (sensor.stamp, sensor.arrived) for sensor in self.sensors if len(sensor.stamp)}
        # A stamp of 0 is not a time: it was never set.
        times = {
            name: (stamp[stamp != 0], arrival_times[stamp != 0])
            for name, (stamp, arrival_times) in times.items()
            if stamp.any()
        }
        found: dict[str, str] = {name: self.clock_of(*columns) for name, columns in times.items()}
        others = [name for name, clock in found.items() if clock == "other"]
        offsets = [int(np.median(times[name][1] - times[name][0])) for name in others]
        for number, group in enumerate(group_by_clock([(offset, offset) for offset in offsets]), 1):
            found |= {others[position]: f"other {number}" for position in group}
        return found

    @cached_property
    def usual_clock(self) -> str:
        """The clock of most edges and sensors, if equal the known one, or "" if there are none with stamps."""
        counts: dict[str, int] = {}
        for clock in self.clocks.values():
            counts[clock] = counts.get(clock, 0) + 1
        return min(counts, key=lambda clock: (-counts[clock], clock.startswith("other"), clock), default="")

    def offset(self, name: str) -> ClockOffset:
        """Return how far stamps are behind the usual clock on arrival.

        All findings, ``coframe frames`` and ``coframe why`` give these numbers.

        Args:
            name: A key of :attr:`clocks`: the name of a dynamic edge, or the topic of a sensor.
        """
        if name not in self._offsets:
            columns = [(edge.stamp, edge.arrived) for edge in self.dynamic if edge.name == name]
            columns += [(sensor.stamp, sensor.arrived) for sensor in self.sensors if sensor.topic == name]
            self._offsets[name] = self._offset(*[pair for pair in columns if pair[0].any()][-1])
        return self._offsets[name]

    @cached_property
    def _offsets(self) -> dict[str, ClockOffset]:
        return {}

    def _offset(self, stamp: NDArray[np.int64], arrival_times: NDArray[np.int64]) -> ClockOffset:
        stamp, arrival_times = stamp[stamp != 0], arrival_times[stamp != 0]
        is_simulated = self.usual_clock == "simulated" and self.clock is not None
        now = self.clock.at(arrival_times) if is_simulated and self.clock is not None else arrival_times
        return clock_offset(now - self._usual_lag - stamp, arrival_times)

    @cached_property
    def _usual_lag(self) -> int:
        """The usual delay of a clock that is neither the system clock nor simulated time; otherwise 0."""
        if self.usual_clock in {"", "wall", "simulated"}:
            return 0
        names = {name for name, clock in self.clocks.items() if clock == self.usual_clock}
        lags = [edge.arrived - edge.stamp for edge in self.dynamic if edge.name in names]
        lags += [sensor.arrived - sensor.stamp for sensor in self.sensors if sensor.topic in names]
        return int(np.median([int(np.median(lag)) for lag in lags]))

    def clock_of(self, stamp: NDArray[np.int64], arrival_times: NDArray[np.int64]) -> ClockName:
        """Return the clock of stamps, determined from their arrival times."""
        simulated = None if self.clock is None else float(np.median(self.clock.at(arrival_times) - stamp))
        return clock_of(float(np.median(arrival_times - stamp)), simulated)

    def lags(self, stamp: NDArray[np.int64], arrival_times: NDArray[np.int64]) -> NDArray[np.int64] | None:
        """Return the delays from stamp to arrival on the clock of the stamps, or None if that clock is unknown."""
        clock = self.clock_of(stamp, arrival_times)
        if clock == "simulated" and self.clock is not None:
            return self.clock.at(arrival_times) - stamp
        return np.asarray(arrival_times - stamp) if clock == "wall" else None

    def waits(self, sensor: Sensor) -> NDArray[np.int64]:
        """Return how long after the arrival of each message its transform to the root is available, (N,).

        The points of a lidar need transforms until the end of the sweep. 0 means immediately; NEVER, not at all. For
        the stamp 0, tf2 uses the latest transform.
        """
        last = np.where(sensor.stamp == 0, 0, sensor.stamp + sensor.sweep)
        return _waits(self.path(sensor.frame), sensor.stamp, last, sensor.arrived)

    def waits_between(
        self, target: str, source: str, stamp: NDArray[np.int64], arrival_times: NDArray[np.int64]
    ) -> NDArray[np.int64]:
        """Return how long after each arrival the transform between two frames at a stamp is available, (N,).

        0 means immediately; NEVER, not at all, as for frames that are not connected.
        """
        frames = self.structure.chain(target, source)
        if frames is None:
            return np.full(len(stamp), NEVER)
        on_chain = set(frames)
        edges = [self.last[frame] for frame in frames if frame in self.last]
        return _waits([edge for edge in edges if edge.parent in on_chain], stamp, stamp, arrival_times)


def _waits(
    edges: Iterable[Edge], stamp: NDArray[np.int64], last: NDArray[np.int64], arrival_times: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Return how long after each arrival all edges cover the time from a stamp to a last time; NEVER if they do not."""
    ready = np.zeros(len(stamp), dtype=np.int64)
    for edge in edges:
        if not edge.static:
            newest = np.maximum.accumulate(edge.stamp)
            row = np.searchsorted(newest, last)
            arrival = edge.arrived[np.minimum(row, edge.count - 1)]
            is_covered = (stamp == 0) | ((row < edge.count) & (stamp >= edge.stamp.min()))
            ready = np.maximum(ready, np.where(is_covered, arrival, NEVER))
    return np.where(ready == NEVER, NEVER, np.maximum(ready - arrival_times, 0))
