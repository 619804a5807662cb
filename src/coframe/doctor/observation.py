"""Observation: what was heard on the wire or is in a recording, frozen, with what several checks ask of it.

The rows are the transforms as they were sent, those that a buffer refuses too. All times are int64 nanoseconds.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.edge import Edge
from coframe.doctor.transforms import Transforms, bare

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

__all__ = ["NEVER", "Clock", "Endpoint", "JointStates", "LogLine", "Observation", "Sensor", "TopicFacts", "Transforms"]

DEFAULT_CACHE = 10_000_000_000
_HOUR = 3_600_000_000_000
_MINUTE = 60_000_000_000
NEVER = np.iinfo(np.int64).max


@dataclass(frozen=True)
class Endpoint:
    """A publisher or a subscription: its node's full name, and whether late joiners get what was sent before.

    A recording does not tell the node: it is "" there.
    """

    node: str
    transient_local: bool


@dataclass(frozen=True)
class TopicFacts:
    """A topic: its type, how many messages were heard, and who is on it.

    Of a recording, only the publishers of static transforms are told.
    """

    name: str
    type: str
    messages: int
    publishers: tuple[Endpoint, ...] = ()
    subscribers: tuple[Endpoint, ...] = ()


@dataclass(frozen=True, eq=False)
class Sensor:
    """Messages with a header that names a frame.

    Attributes:
        topic: The topic.
        type: Of its messages.
        frame: What they are told in, without a leading slash.
        stamp: (N,) of their headers.
        arrived: (N,) when they came.
        publisher: The node's full name; "" where nobody says.
    """

    topic: str
    type: str
    frame: str
    stamp: NDArray[np.int64]
    arrived: NDArray[np.int64]
    publisher: str = ""


@dataclass(frozen=True, eq=False)
class JointStates:
    """Joint states: (N,) stamps, and the (N,) positions of each joint, NaN where a message does not tell of it."""

    topic: str
    stamp: NDArray[np.int64]
    positions: dict[str, NDArray[np.float64]]


@dataclass(frozen=True, eq=False)
class Clock:
    """Simulated time: when ticks of /clock came, and what they said. (N,) each."""

    arrived: NDArray[np.int64]
    stamp: NDArray[np.int64]

    def at(self, arrived: NDArray[np.int64]) -> NDArray[np.int64]:
        """What it said, or would have, when these came."""
        between = np.interp((arrived - self.arrived[0]).astype(np.float64), self.arrived - self.arrived[0], self._since)
        return np.asarray(self.stamp[0] + np.rint(between).astype(np.int64))

    @cached_property
    def _since(self) -> NDArray[np.int64]:
        return np.asarray(self.stamp - self.stamp[0])


@dataclass(frozen=True)
class LogLine:
    """What a node has said on /rosout."""

    node: str
    text: str
    arrived: int


@dataclass(frozen=True, eq=False)
class Observation:
    """All that the checks know.

    Attributes:
        live: Heard on the wire rather than read from a recording.
        start: When listening, or the recording, began.
        end: When it ended.
        transforms: As they were sent.
        empty_messages: How many messages held no transform at all.
        damaged_messages: How many messages are no TFMessage.
        messages_left_out: How many messages were not looked at, as too many names had come before them.
        topics: By name.
        sensors: Messages with a header that names a frame.
        descriptions: The robot descriptions, in the order in which they came.
        joint_states: One a topic.
        clock: Simulated time; None where there is none.
        travel: By publisher, how long its transforms took to arrive, by the clocks of two machines; live only.
        log: What nodes have said.
        cache: How far back a listener's buffer is taken to reach.
        unread: What could not be read of a recording, a sentence each.
        link_name: What a link of the descriptions is called among the frames.
    """

    live: bool
    start: int
    end: int
    transforms: Transforms
    empty_messages: int = 0
    damaged_messages: int = 0
    messages_left_out: int = 0
    topics: dict[str, TopicFacts] = field(default_factory=dict)
    sensors: tuple[Sensor, ...] = ()
    descriptions: tuple[str, ...] = ()
    joint_states: tuple[JointStates, ...] = ()
    clock: Clock | None = None
    travel: dict[str, NDArray[np.int64]] = field(default_factory=dict)
    log: tuple[LogLine, ...] = ()
    cache: int = DEFAULT_CACHE
    unread: tuple[str, ...] = ()
    link_name: Callable[[str], str] = str

    @property
    def duration(self) -> int:
        """From start to end."""
        return self.end - self.start

    @cached_property
    def edges(self) -> tuple[Edge, ...]:
        """The links, static and dynamic ones apart, by the rows that tf2 takes."""
        told = self.transforms
        rows = np.flatnonzero(told.taken)
        if not len(rows):
            return ()
        # With and without a slash in front they are one.
        numbers: dict[tuple[str, str], int] = {}
        names = [bare(told.pair(link)) for link in range(len(told.links))]
        same = np.array([numbers.setdefault(pair, len(numbers)) for pair in names], dtype=np.int64)
        groups = same[told.link[rows]] * 2 + told.static[rows]
        order = np.argsort(groups.astype(np.min_scalar_type(2 * len(numbers))), kind="stable")
        ends = np.cumsum(np.bincount(groups))
        parts = [rows[part] for part in np.split(order, ends[:-1]) if len(part)]
        found = [self._edge(part, names[int(told.link[part[0]])]) for part in parts]
        return tuple(sorted(found, key=lambda edge: int(edge.arrived[0])))

    def _edge(self, rows: NDArray[np.intp], names: tuple[str, str]) -> Edge:
        told = self.transforms
        publisher = told.publisher[rows]
        numbers, first = np.unique(publisher, return_index=True)
        senders = (told.publishers[number] for number in numbers[np.argsort(first)].tolist())
        return Edge(
            parent=names[0],
            child=names[1],
            static=bool(told.static[rows[0]]),
            arrived=told.arrived[rows],
            stamp=told.stamp[rows],
            publisher=publisher,
            values=told.values[rows],
            publishers=tuple(name for name in senders if name),
        )

    @cached_property
    def dynamic(self) -> tuple[Edge, ...]:
        """The links that were told of on topics of moving transforms."""
        return tuple(edge for edge in self.edges if not edge.static)

    @cached_property
    def static(self) -> tuple[Edge, ...]:
        """The links that were told of on topics of static transforms."""
        return tuple(edge for edge in self.edges if edge.static)

    @cached_property
    def last(self) -> dict[str, Edge]:
        """By child: the link that was told of last, which is what a buffer holds."""
        found: dict[str, Edge] = {}
        for edge in self.edges:
            other = found.get(edge.child)
            if other is None or edge.arrived[-1] >= other.arrived[-1]:
                found[edge.child] = edge
        return found

    @cached_property
    def frames(self) -> tuple[str, ...]:
        """All frames, in the order in which they came up."""
        return tuple(dict.fromkeys(name for edge in self.edges for name in edge.key))

    @cached_property
    def roots(self) -> dict[str, str]:
        """By frame the root of its tree; of a loop, and of what hangs on it, one of the loop's frames."""
        found: dict[str, str] = {}
        for start in self.frames:
            frame, way = start, dict[str, None]()
            while frame not in found and frame not in way and frame in self.last:
                way[frame] = None
                frame = self.last[frame].parent
            found |= dict.fromkeys([*way, frame], found.get(frame, frame))
        return found

    def root(self, frame: str) -> str:
        """Of the tree that a frame is in; of one that nobody tells of, itself."""
        return self.roots.get(frame, frame)

    def path(self, frame: str) -> list[Edge]:
        """The links from a frame up to its root; a loop is walked once."""
        found: list[Edge] = []
        seen = {frame}
        while frame in self.last:
            edge = self.last[frame]
            found.append(edge)
            frame = edge.parent
            if frame in seen:
                break
            seen.add(frame)
        return found

    @cached_property
    def trees(self) -> dict[str, tuple[str, ...]]:
        """By root: the frames of its tree, itself included, the largest tree first."""
        members: dict[str, list[str]] = {}
        for frame in self.frames:
            members.setdefault(self.root(frame), []).append(frame)
        return {root: tuple(members[root]) for root in sorted(members, key=lambda root: (-len(members[root]), root))}

    # Clocks: stamps may be told by the wall's clock, by a simulation's, or by one that is hours off and not known.

    @cached_property
    def clocks(self) -> dict[str, str]:
        """By moving link, as ``parent -> child``, and by sensor's topic: what clock its stamps are told by."""
        times = {f"{edge.parent} -> {edge.child}": (edge.stamp, edge.arrived) for edge in self.dynamic}
        times |= {sensor.topic: (sensor.stamp, sensor.arrived) for sensor in self.sensors if len(sensor.stamp)}
        found = {name: self.clock_of(*columns) for name, columns in times.items()}
        unknown = [(int(np.median(times[name][1] - times[name][0])), name) for name in found if not found[name]]
        number, before = 0, 0
        for offset, name in sorted(unknown):
            number += not number or offset - before > _HOUR
            before = offset
            found[name] = f"unknown {number}"
        return found

    def clock_of(self, stamp: NDArray[np.int64], arrived: NDArray[np.int64]) -> str:
        """What clock stamps are told by: ``wall``, ``simulated``; "" for one that is hours off."""
        if self.clock is not None and abs(float(np.median(self.clock.at(arrived) - stamp))) < _MINUTE:
            return "simulated"
        return "wall" if abs(float(np.median(arrived - stamp))) < _HOUR else ""

    def lags(self, stamp: NDArray[np.int64], arrived: NDArray[np.int64]) -> NDArray[np.int64] | None:
        """How long after their stamps things came, by the stamps' own clock; None where that is not known."""
        clock = self.clock_of(stamp, arrived)
        if clock == "simulated" and self.clock is not None:
            return self.clock.at(arrived) - stamp
        return np.asarray(arrived - stamp) if clock == "wall" else None

    def waits(self, sensor: Sensor) -> NDArray[np.int64]:
        """(N,) how long after each message its transform to the root of its tree is there; 0: at once, NEVER: not."""
        ready = np.zeros(len(sensor.stamp), dtype=np.int64)
        for edge in self.path(sensor.frame):
            if not edge.static:
                newest = np.maximum.accumulate(edge.stamp)
                row = np.searchsorted(newest, sensor.stamp)
                came = edge.arrived[np.minimum(row, edge.count - 1)]
                told = (row < edge.count) & (sensor.stamp >= edge.stamp.min())
                ready = np.maximum(ready, np.where(told, came, NEVER))
        return np.where(ready == NEVER, NEVER, np.maximum(ready - sensor.arrived, 0))
