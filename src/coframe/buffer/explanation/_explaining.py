# SPDX-License-Identifier: Apache-2.0
"""Build an explanation from a buffer.

The buffer itself decides whether there is a transform. The edges are those that the lookup uses, or would use if the
edges without data had some.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from coframe.analysis.clocks import current_time_for
from coframe.analysis.liveness import buffered_period, is_stale
from coframe.analysis.missing_edges import MissingEdge, missing_edge
from coframe.analysis.tree import FrameTrees
from coframe.buffer.explanation._advice import advice
from coframe.buffer.explanation._facts import ChainEdge, Explanation
from coframe.errors import TransformException
from coframe.time import stamp_ns

if TYPE_CHECKING:
    from coframe.buffer import Buffer, EdgeInfo
    from coframe.time import StampLike

__all__ = ["explain"]

# The authorities that buffers record for transforms whose publisher is unknown.
_UNKNOWN_AUTHORITIES = {"", "no recorded authority", "default_authority", "<no authority available>"}
# The codes of errors that concern the name of a frame: there is no chain to examine.
_NAME_ERRORS = {"empty_name", "leading_slash", "unknown_frame"}


class _Step(NamedTuple):
    """An edge of the buffer at the requested time."""

    parent: str
    child: str
    state: str
    gap: int


class _Chain(NamedTuple):
    """The frames and edges from the target to the source, and the two roots if these are not connected."""

    frames: tuple[str, ...]
    steps: list[_Step]
    roots: tuple[str, str] | None


def explain(
    buffer: Buffer, target: str, source: str, at: StampLike | None = None, *, now: StampLike | None = None
) -> Explanation:
    """Return why a lookup succeeds or fails.

    Args:
        buffer: The buffer to look up in.
        target: The target frame of the lookup.
        source: The source frame of the lookup.
        at: The requested time; 0 or None is the latest common time.
        now: The current time on the clock of the stamps. The default is the system time if the stamps can be from the
            system clock; there is no default for buffers that are frozen or keep everything, such as those of
            recordings.

    Raises:
        TypeError: `at` or `now` is not a point in time.
    """
    stamp = 0 if at is None else stamp_ns(at)
    recorded = buffer.frozen or buffer.cache_ns < 0
    seen = buffer if buffer.frozen else buffer.snapshot()
    answered, error = _look_up(seen, target, source, stamp)
    when = stamp or answered or _latest_common_time(seen, target, source)
    code = error.code if error else ""
    frames, steps, roots = _Chain((), [], None) if code in _NAME_ERRORS else _chain(seen, target, source, when)
    infos = {info.child: info for info in seen.edges([step.child for step in steps])}
    present = _current_time(now, max((info.newest for info in infos.values()), default=0), is_recorded=recorded)
    edges = tuple(_edge(seen, step, infos[step.child], when, stamp, present) for step in steps)
    found = Explanation(
        target=target,
        source=source,
        stamp=stamp,
        answered=answered,
        code=code,
        text=str(error) if error else "",
        hint="",
        unknown=tuple(frame for frame in dict.fromkeys((target, source)) if code in _NAME_ERRORS and frame not in seen),
        edges=edges,
        frames=frames,
        roots=roots,
        missing=None if roots is None else _find_missing_edge(seen, roots),
        limit=_limit(edges, when) if stamp == 0 else None,
        span=_span(edges) if roots is None else None,
        possible_at=None if roots is None else _find_possible_time(seen, target, source, edges),
        cache=seen.cache_ns,
        now=present,
    )
    return found if error is None else replace(found, hint=advice(found, error, is_recorded=recorded))


def _look_up(buffer: Buffer, target: str, source: str, stamp: int) -> tuple[int | None, TransformException | None]:
    try:
        return buffer.lookup(target, source, stamp).stamp or 0, None
    except TransformException as error:
        return None, error


def _latest_common_time(buffer: Buffer, target: str, source: str) -> int:
    try:
        return buffer.latest_common_time(target, source)
    except TransformException:
        return 0


def _chain(buffer: Buffer, target: str, source: str, stamp: int) -> _Chain:
    steps = _find_steps_above(buffer, (target, source), stamp)
    trees = FrameTrees.from_parents({child: step.parent for child, step in steps.items()}, (target, source))
    chain = trees.chain(target, source)
    if chain is None:
        up, down = trees.path(target), trees.path(source)
        frames, roots = [*up, *reversed(down)], (up[-1], down[-1])
        return _Chain(tuple(frames), [steps[frame] for frame in frames if frame in steps], roots)
    # Going from the target to the source, each frame is below the next one until the top of the chain.
    top = next((a for a, b in pairwise(chain) if steps.get(a) is None or steps[a].parent != b), chain[-1])
    return _Chain(tuple(chain), [steps[frame] for frame in chain if frame != top], None)


def _find_steps_above(buffer: Buffer, frames: tuple[str, ...], stamp: int) -> dict[str, _Step]:
    """Return the edges above the frames by child: at that time, or of the newest sample if there is none."""
    steps: dict[str, _Step] = {}
    for start in frames:
        frame = start
        while frame and frame not in steps and (found := buffer._edge_at(frame, stamp)) is not None:
            state, parent, before, after = found
            steps[frame] = _Step(parent, frame, state, after - before if state == "ok" else 0)
            frame = parent
    return steps


def _current_time(now: StampLike | None, newest: int, *, is_recorded: bool) -> int | None:
    if now is not None:
        return stamp_ns(now)
    return None if is_recorded else current_time_for(newest)


def _edge(
    buffer: Buffer, step: _Step, info: EdgeInfo, lookup_time: int, stamp: int, current_time: int | None
) -> ChainEdge:
    late = step.state == "too_new" or (step.state == "only_other" and lookup_time > info.newest)
    moving = bool(info.samples) and not info.static
    reference = stamp or current_time
    period = buffered_period(buffer, info.parent, info.child, info.oldest, info.newest, info.samples) if moving else 0.0
    stale = None if current_time is None else moving and is_stale(current_time - info.newest, period)
    return ChainEdge(
        parent=step.parent,
        child=step.child,
        static=info.static,
        state=step.state,
        by=0 if step.state in {"ok", "no_data"} else lookup_time - (info.newest if late else info.oldest),
        oldest=info.oldest,
        newest=info.newest,
        age=reference - info.newest if moving and reference is not None else None,
        gap=step.gap,
        rate=info.rate,
        period=period,
        stale=stale if moving else False,
        publisher="" if info.authority in _UNKNOWN_AUTHORITIES else info.authority,
        later=info.parent if info.parent != step.parent else "",
    )


def _limit(edges: tuple[ChainEdge, ...], lookup_time: int) -> tuple[str, str] | None:
    if lookup_time == 0:
        return None
    return next(((edge.parent, edge.child) for edge in edges if not edge.static and edge.newest == lookup_time), None)


def _span(edges: tuple[ChainEdge, ...]) -> tuple[int, int] | None:
    moving_edges = [edge for edge in edges if not edge.static]
    if not moving_edges or any(edge.state == "no_data" for edge in moving_edges):
        return None
    first, last = max(edge.oldest for edge in moving_edges), min(edge.newest for edge in moving_edges)
    return (first, last) if first <= last else None


def _find_missing_edge(buffer: Buffer, roots: tuple[str, str]) -> MissingEdge | None:
    """Return the edge that the frame names suggest, otherwise the edge between the roots."""
    trees = FrameTrees.from_parents({frame.name: frame.parent for frame in buffer.frames()})
    if not all(root in trees.index for root in roots):
        return None
    frames = [trees.tree(root) for root in roots]
    return missing_edge(*sorted(frames, key=len, reverse=True)) or MissingEdge(*roots, misspelled=False)


def _find_possible_time(buffer: Buffer, target: str, source: str, edges: tuple[ChainEdge, ...]) -> int | None:
    """Return a time at which the frames are connected: frames may change their parents."""
    times = sorted({edge.oldest for edge in edges if edge.oldest}, reverse=True)
    return next((time for time in (0, *times) if buffer.can_transform(target, source, time)), None)
