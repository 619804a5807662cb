"""What a recording holds, in numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.analysis.tree import FrameTrees
from coframe.errors import DecodeError, TransformException

if TYPE_CHECKING:
    from coframe.bags.recording import Recording, Topic
    from coframe.buffer import Buffer, EdgeInfo

__all__ = ["EdgeSummary", "SensorSummary", "Summary", "TreeSummary", "summarize"]


class EdgeSummary(NamedTuple):
    """What is told of one edge. Times are nanoseconds, ``rate`` is Hz."""

    parent: str
    child: str
    static: bool
    samples: int
    rate: float
    longest_gap: int
    oldest: int
    newest: int


class TreeSummary(NamedTuple):
    """A root, and of how many frames it is one, itself included."""

    root: str
    size: int


class SensorSummary(NamedTuple):
    """Whether a topic's messages can be brought into the root of their tree.

    Attributes:
        topic: The topic.
        frame: What its first message says that it is told in.
        messages: How many there are.
        root: The root of that frame's tree; "" if no transform tells of the frame.
        possible: For how many stamps there is a transform.
        why_not: Of the first one without.
    """

    topic: str
    frame: str
    messages: int
    root: str
    possible: int
    why_not: str


class Summary(NamedTuple):
    """What :func:`summarize` gives. Times are nanoseconds.

    Attributes:
        path: The recording.
        start: When the first message was received.
        end: When the last one was.
        span: The first and the last stamp of transforms.
        topics: All topics.
        trees: The largest first.
        edges: All links between frames.
        sensors: The topics whose messages have a header with a frame, other than transforms.
        problems: What could not be read.
    """

    path: str
    start: int
    end: int
    span: tuple[int, int]
    topics: list[Topic]
    trees: list[TreeSummary]
    edges: list[EdgeSummary]
    sensors: list[SensorSummary]
    problems: list[str]


def summarize(recording: Recording) -> Summary:
    """What a recording holds: topics, trees, edges with their gaps, and which sensors could be transformed."""
    edges = [edge for edge in recording.buffer.edges() if edge.parent]
    trees = FrameTrees.from_parents({edge.child: edge.parent for edge in edges})
    sensors = [_sensor(recording, topic, trees) for topic in recording.topics.values()]
    sizes = [TreeSummary(trees.root(members[0]), len(members)) for members in trees.members]
    return Summary(
        path=str(recording.path),
        start=recording.start,
        end=recording.end,
        span=recording.span,
        topics=list(recording.topics.values()),
        trees=sorted(sizes, key=lambda tree: (-tree.size, tree.root)),
        edges=[_edge(edge) for edge in edges],
        sensors=[sensor for sensor in sensors if sensor is not None],
        problems=recording.problems,
    )


def _edge(edge: EdgeInfo) -> EdgeSummary:
    facts = (edge.samples, edge.rate, edge.longest_gap, edge.oldest, edge.newest)
    return EdgeSummary(edge.parent, edge.child, edge.static, *facts)


def _sensor(recording: Recording, topic: Topic, trees: FrameTrees) -> SensorSummary | None:
    """None for messages that name no frame, or cannot be decoded."""
    try:
        first: Any = next(recording.messages(topic.name)).message
        frame = recording.frame(str(first.header.frame_id))
    except (StopIteration, DecodeError, AttributeError):
        return None
    if not frame:
        return None
    if frame not in trees.index:
        return SensorSummary(topic.name, frame, topic.messages, "", 0, f"no transform tells of {frame!r}")
    root = trees.root(frame)
    possible, why = _possible(recording.buffer, root, frame, recording.stamps(topic.name))
    return SensorSummary(topic.name, frame, topic.messages, root, possible, why)


def _possible(buffer: Buffer, root: str, frame: str, stamps: Any) -> tuple[int, str]:
    try:
        found = buffer.lookup_many(root, frame, stamps, on_error="nan").translation[:, 0]
    except TransformException as error:
        return 0, str(error)
    missing = np.flatnonzero(np.isnan(found))
    if not missing.size:
        return len(found), ""
    try:
        buffer.lookup(root, frame, int(stamps[missing[0]]))
    except TransformException as error:
        return len(found) - missing.size, str(error)
    return len(found) - missing.size, ""
