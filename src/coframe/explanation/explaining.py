"""From a buffer to an explanation.

Whether there is a transform is the buffer's own answer. The links are those that a look-up walks, and would walk if
the ones without a sample had one.
"""

from __future__ import annotations

import time as system_time
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from coframe.analysis.missing_edges import MissingEdge, missing_edge, tree_of
from coframe.errors import TransformException
from coframe.explanation.advice import advice
from coframe.explanation.facts import Explanation, Link
from coframe.time import stamp_ns

if TYPE_CHECKING:
    from coframe.buffer import Buffer, EdgeInfo
    from coframe.time import StampLike

__all__ = ["explain"]

_HOUR = 3_600_000_000_000
# What buffers note where nobody says who it was.
_NOBODY = {"", "no recorded authority", "default_authority", "<no authority available>"}


# What is wrong with a name, before there is any way to walk.
_NAMES = {"empty_name", "leading_slash", "unknown_frame"}


class _Step(NamedTuple):
    """A link as the buffer has it for a time."""

    parent: str
    child: str
    state: str
    gap: int


def explain(
    buffer: Buffer, target: str, source: str, at: StampLike | None = None, *, now: StampLike | None = None
) -> Explanation:
    """Why a look-up has an answer, or why not.

    Args:
        buffer: What is asked.
        target: The frame that the answer is told in.
        source: The frame that is asked about.
        at: When; 0 or None is the latest.
        now: The present, by the clock of the stamps. By default the system's, where the stamps are within an hour of
            it; a buffer that is frozen or keeps everything, as of a recording, has none.

    Raises:
        TypeError: `at` or `now` is no point in time.
    """
    stamp = 0 if at is None else stamp_ns(at)
    recorded = buffer.frozen or buffer.cache_ns < 0
    seen = buffer if buffer.frozen else buffer.snapshot()
    answered, error = _ask(seen, target, source, stamp)
    when = stamp or answered or _latest_common_time(seen, target, source)
    code = error.code if error else ""
    frames, steps, roots = ((), [], None) if code in _NAMES else _between(seen, target, source, when)
    edges = {edge.child: edge for edge in seen.edges([step.child for step in steps])}
    present = _present(now, max((edge.newest for edge in edges.values()), default=0), recorded)
    links = tuple(_link(step, edges[step.child], when, stamp or present) for step in steps)
    found = Explanation(
        target=target,
        source=source,
        stamp=stamp,
        answered=answered,
        code=code,
        text=str(error) if error else "",
        hint="",
        unknown=tuple(frame for frame in dict.fromkeys((target, source)) if code in _NAMES and frame not in seen),
        links=links,
        frames=frames,
        roots=roots,
        missing=None if roots is None else _missing(seen, roots),
        limit=_limit(links, when) if stamp == 0 else None,
        span=_span(links) if roots is None else None,
        possible_at=None if roots is None else _possible_at(seen, target, source, links),
        cache=seen.cache_ns,
        now=present,
    )
    return found if error is None else replace(found, hint=advice(found, error, recorded=recorded))


def _ask(buffer: Buffer, target: str, source: str, stamp: int) -> tuple[int | None, TransformException | None]:
    try:
        return buffer.lookup(target, source, stamp).stamp or 0, None
    except TransformException as error:
        return None, error


def _latest_common_time(buffer: Buffer, target: str, source: str) -> int:
    try:
        return buffer.latest_common_time(target, source)
    except TransformException:
        return 0


def _way(buffer: Buffer, frame: str, stamp: int) -> list[_Step]:
    """The links from a frame up to its root; where one has no sample at that time, by its newest one."""
    steps: list[_Step] = []
    seen: set[str] = set()
    while frame and frame not in seen and (found := buffer._edge_at(frame, stamp)) is not None:
        seen.add(frame)
        state, parent, before, after = found
        steps.append(_Step(parent, frame, state, after - before if state == "ok" else 0))
        frame = parent
    return steps


def _between(
    buffer: Buffer, target: str, source: str, stamp: int
) -> tuple[tuple[str, ...], list[_Step], tuple[str, str] | None]:
    """Frames and links from the target to the source, and the two roots where nothing joins them."""
    up, down = _way(buffer, target, stamp), _way(buffer, source, stamp)
    above, below = _passed(target, up), _passed(source, down)
    places = {frame: place for place, frame in reversed(list(enumerate(below)))}
    for position, frame in enumerate(above):
        if (meeting := places.get(frame)) is not None:
            return tuple(above[: position + 1] + below[:meeting][::-1]), up[:position] + down[:meeting][::-1], None
    return tuple(above + below[::-1]), up + down[::-1], (above[-1], below[-1])


def _passed(frame: str, way: list[_Step]) -> list[str]:
    return [frame, *(step.parent for step in way if step.parent)]


def _present(now: StampLike | None, newest: int, recorded: bool) -> int | None:
    if now is not None:
        return stamp_ns(now)
    clock = system_time.time_ns()
    return clock if not recorded and abs(clock - newest) < _HOUR else None


def _link(step: _Step, edge: EdgeInfo, when: int, reference: int | None) -> Link:
    late = step.state == "too_new" or (step.state == "only_other" and when > edge.newest)
    timeless = edge.static or not edge.samples
    return Link(
        parent=step.parent,
        child=step.child,
        static=edge.static,
        state=step.state,
        by=0 if step.state in {"ok", "no_data"} else when - (edge.newest if late else edge.oldest),
        oldest=edge.oldest,
        newest=edge.newest,
        age=None if timeless or reference is None else reference - edge.newest,
        gap=step.gap,
        rate=edge.rate,
        publisher="" if edge.authority in _NOBODY else edge.authority,
        later=edge.parent if edge.parent != step.parent else "",
    )


def _limit(links: tuple[Link, ...], when: int) -> tuple[str, str] | None:
    if when == 0:
        return None
    return next(((link.parent, link.child) for link in links if not link.static and link.newest == when), None)


def _span(links: tuple[Link, ...]) -> tuple[int, int] | None:
    moving = [link for link in links if not link.static]
    if not moving or any(link.state == "no_data" for link in moving):
        return None
    first, last = max(link.oldest for link in moving), min(link.newest for link in moving)
    return (first, last) if first <= last else None


def _missing(buffer: Buffer, roots: tuple[str, str]) -> MissingEdge | None:
    """The likely link by the names of the frames; without a likely one, that between the roots."""
    parents = {frame.name: frame.parent for frame in buffer.frames()}
    if not all(root in parents for root in roots):
        return None
    trees = [tree_of(root, parents) for root in roots]
    return missing_edge(*sorted(trees, key=len, reverse=True)) or MissingEdge(*roots, misspelt=False)


def _possible_at(buffer: Buffer, target: str, source: str, links: tuple[Link, ...]) -> int | None:
    """Frames that change their parents were connected before, or are later."""
    times = sorted({link.oldest for link in links if link.oldest}, reverse=True)
    return next((time for time in (0, *times) if buffer.can_transform(target, source, time)), None)
