# SPDX-License-Identifier: Apache-2.0
"""Summary of a recording: its topics, trees and edges, and which sensor data can be transformed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe._output import html_tables
from coframe.analysis.tree import FrameTrees
from coframe.errors import TransformException

if TYPE_CHECKING:
    from coframe.bags.recording import RecordedTopic, Recording
    from coframe.buffer import Buffer, EdgeInfo

__all__ = ["EdgeSummary", "SensorSummary", "Summary", "TreeSummary", "summarize"]


class EdgeSummary(NamedTuple):
    """The samples of one edge. Times are in nanoseconds, ``rate`` is in Hz."""

    parent: str
    child: str
    static: bool
    samples: int
    rate: float
    longest_gap: int
    oldest: int
    newest: int


class TreeSummary(NamedTuple):
    """A tree: its root, and its number of frames including the root."""

    root: str
    size: int


class SensorSummary(NamedTuple):
    """Whether the messages on a topic can be transformed into the root of their tree.

    Attributes:
        topic: Name of the topic.
        frame: The frame_id of its first message.
        messages: Number of messages.
        root: Root of the tree of that frame, or "" if no transform contains the frame.
        possible: Number of messages for whose stamps there is a transform.
        why_not: The error for the first stamp without a transform.
    """

    topic: str
    frame: str
    messages: int
    root: str
    possible: int
    why_not: str


class Summary(NamedTuple):
    """The result of :func:`summarize`. Times are in nanoseconds.

    Attributes:
        path: Path of the recording.
        start: Receive time of the first message.
        end: Receive time of the last message.
        span: First and last stamp of the transforms.
        topics: All topics.
        trees: All trees, the largest first.
        edges: All edges in tree order, each after that of its parent.
        sensors: The topics whose messages have a header with a frame, except transforms.
        problems: Problems of the recording, one message each.
        size: Size of all files in bytes.
        files: Number of files.
        format: File format: ``MCAP``, ``SQLite`` or ``ROS 1 bag``.
        compression: Compression of chunks or messages: ``zstd``, ``lz4``, ``bz2`` or ``none``.
    """

    path: str
    start: int
    end: int
    span: tuple[int, int]
    topics: list[RecordedTopic]
    trees: list[TreeSummary]
    edges: list[EdgeSummary]
    sensors: list[SensorSummary]
    problems: list[str]
    size: int
    files: int
    format: str
    compression: str

    def _repr_html_(self) -> str:
        return html_tables.record(self.path, self._asdict().items())


def summarize(recording: Recording) -> Summary:
    """Summarize a recording: topics, trees, edges with their gaps, and which sensor data can be transformed."""
    edges = [edge for edge in recording.buffer.edges() if edge.parent]
    trees = FrameTrees.from_parents({edge.child: edge.parent for edge in edges})
    position = {trees.names[number]: place for place, number in enumerate(trees.order)}
    sensors = [_sensor(recording, topic, trees) for topic in recording.topics.values()]
    sizes = [TreeSummary(trees.root(members[0]), len(members)) for members in trees.members]
    return Summary(
        path=str(recording.path),
        start=recording.received_start,
        end=recording.received_end,
        span=recording.span,
        topics=list(recording.topics.values()),
        trees=sorted(sizes, key=lambda tree: (-tree.size, tree.root)),
        edges=[_edge(edge) for edge in sorted(edges, key=lambda edge: position[edge.child])],
        sensors=[sensor for sensor in sensors if sensor is not None],
        problems=recording.problems,
        size=sum(size for _, size in recording.files),
        files=len(recording.files),
        format=recording.format,
        compression=recording.compression,
    )


def _edge(edge: EdgeInfo) -> EdgeSummary:
    facts = (edge.samples, edge.rate, edge.longest_gap, edge.oldest, edge.newest)
    return EdgeSummary(edge.parent, edge.child, edge.static, *facts)


def _sensor(recording: Recording, topic: RecordedTopic, trees: FrameTrees) -> SensorSummary | None:
    """Return the summary of a sensor topic, or None if its messages have no frame or cannot be decoded."""
    frame = recording.frame(recording.first_frame(topic.name))
    if not frame:
        return None
    if frame not in trees.index:
        return SensorSummary(
            topic.name, frame, topic.messages, "", 0, f"No frame named {frame!r}: no transform contains it."
        )
    root = trees.root(frame)
    possible, why = _count_possible(recording.buffer, root, frame, recording.stamps(topic.name))
    return SensorSummary(topic.name, frame, topic.messages, root, possible, why)


def _count_possible(buffer: Buffer, root: str, frame: str, stamps: Any) -> tuple[int, str]:
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
