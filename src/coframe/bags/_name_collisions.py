# SPDX-License-Identifier: Apache-2.0
"""Find frames and topics of different robots that a merged recording would mix up."""

from __future__ import annotations

from itertools import combinations, islice
from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import count, join_names
from coframe.bags._trajectory_query import sample_stamps
from coframe.bags.transforms import ingest_for
from coframe.errors import CoframeError, RecordingError
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from numpy.typing import NDArray

    from coframe.bags._clock_shift import ClockShift
    from coframe.bags._merging import MergedNames
    from coframe.bags.recording import Recording
    from coframe.buffer import Buffer

__all__ = ["require_one_robot_per_name"]

_MIN_OVERLAP = SECOND
_MIN_STAMPS = 10  # of each recording during the common time
_MAX_EQUAL_SHARE = 0.1  # of the stamps; two recorders of one robot have more in common
_MAX_EDGES = 20


def require_one_robot_per_name(
    recordings: Sequence[Recording],
    topics: Sequence[Sequence[str]],
    merged_names: MergedNames,
    shifts: Sequence[ClockShift | None],
) -> None:
    """Raise an error if two recordings contain different messages with one name at the same time.

    Recordings that follow each other are of one robot, and so are two with the same messages.

    Args:
        recordings: The recordings to merge.
        topics: The topics that are copied, for each recording.
        merged_names: The new names.
        shifts: The shift of the times of each recording, or None.

    Raises:
        RecordingError: The names of the frames and topics, and how to keep them apart.
    """
    for one, other in combinations(range(len(recordings)), 2):
        spans = [_span(recordings[number], shifts[number]) for number in (one, other)]
        begin, end = max(spans[0][0], spans[1][0]), min(spans[0][1], spans[1][1])
        if end - begin <= _MIN_OVERLAP:
            continue
        found = [*_frames(recordings, merged_names, one, other), *_topics(recordings, topics, merged_names, one, other)]
        if found:
            raise RecordingError(
                f"{recordings[one].path} and {recordings[other].path} were recorded at the same time, and "
                f"{count(len(found), 'name')} would be mixed up: {join_names(found)}",
                hint="Give each recording a prefix for its frames and topics, such as robot1/, or a namespace for its "
                "topics, such as /robot1. If all of them are of one robot, join the names.",
            )


def _span(recording: Recording, shift: ClockShift | None) -> tuple[int, int]:
    times = recording.received_start, recording.received_end
    return times if shift is None else (shift.apply(times[0]), shift.apply(times[1]))


def _frames(recordings: Sequence[Recording], merged_names: MergedNames, one: int, other: int) -> Iterator[str]:
    """Yield the moving frames that both recordings contain with different stamps, on topics that are joined."""
    pair = [_buffers(recordings[number], merged_names, number) for number in (one, other)]
    for topic in sorted(pair[0].keys() & pair[1].keys()):
        first, second = (
            _moving_edges(each[topic], merged_names.frame(n)) for each, n in zip(pair, (one, other), strict=True)
        )
        for name in islice(sorted(first.keys() & second.keys()), _MAX_EDGES):
            stamps = (_edge_stamps(each[topic], edges[name]) for each, edges in zip(pair, (first, second), strict=True))
            if _differ(*stamps):
                yield f"frame {name}"


def _buffers(recording: Recording, merged_names: MergedNames, number: int) -> dict[str, Buffer]:
    """Return the transforms of each namespace by the new name of their topic."""
    return {merged_names.topic(number, f"{namespace}/tf"): buffer for namespace, buffer in recording.buffers.items()}


def _moving_edges(buffer: Buffer, rename: Callable[[str], str]) -> dict[str, tuple[str, str]]:
    """Return the moving edges by the new names of their child frames."""
    edges = [edge for edge in buffer.edges() if edge.parent and not edge.static]
    return {rename(edge.child): (edge.parent, edge.child) for edge in edges}


def _edge_stamps(buffer: Buffer, edge: tuple[str, str]) -> NDArray[np.int64]:
    try:
        return sample_stamps(buffer, *edge, None, None)
    except CoframeError:  # The parent has changed, so the frames are not connected throughout.
        return np.empty(0, np.int64)


def _topics(
    recordings: Sequence[Recording], topics: Sequence[Sequence[str]], merged_names: MergedNames, first: int, second: int
) -> Iterator[str]:
    """Yield the topics that both recordings contain with different stamps."""
    new = [{merged_names.topic(number, name): name for name in topics[number]} for number in (first, second)]
    for name in sorted(new[0].keys() & new[1].keys()):
        if merged_names.is_shared(name):
            continue
        pair = [(recordings[n], new[i][name]) for i, n in enumerate((first, second))]
        if any(_has_transforms(recording, topic) or not recording.may_have_header(topic) for recording, topic in pair):
            continue
        if _differ(*(recording.stamps(topic) for recording, topic in pair)):
            yield f"topic {name}"


def _has_transforms(recording: Recording, topic: str) -> bool:
    return any(ingest_for(channel) for channel in recording.channels() if channel.topic == topic)


def _differ(first: NDArray[np.int64], second: NDArray[np.int64]) -> bool:
    """Return whether two publishers set the stamps: during their common time, hardly any are equal."""
    if not len(first) or not len(second):
        return False
    begin, end = max(first.min(), second.min()), min(first.max(), second.max())
    first, second = (each[(each >= begin) & (each <= end)] for each in (first, second))
    if min(len(first), len(second)) < _MIN_STAMPS:
        return False
    return float(np.isin(second, first).mean()) < _MAX_EQUAL_SHARE
