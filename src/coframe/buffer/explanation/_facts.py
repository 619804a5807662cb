# SPDX-License-Identifier: Apache-2.0
"""Explanation: the chain between two frames, edge by edge, with its problems."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from coframe.buffer.explanation.drawing import draw, draw_html

if TYPE_CHECKING:
    from coframe.analysis.missing_edges import MissingEdge

__all__ = ["ChainEdge", "Explanation"]


class ChainEdge(NamedTuple):
    """An edge of the chain between two frames at the requested time. All times are nanoseconds.

    Attributes:
        parent: The parent frame at that time, or in the newest sample, or "" if the buffer has no sample.
        child: The child frame.
        static: Whether the edge is static.
        state: ``"ok"``, or what is wrong: ``"too_new"`` (the requested time is after the newest sample), ``"too_old"``
            (before the oldest sample), ``"only_other"`` (there is one sample, at another time), ``"no_data"``.
        by: The distance from the newest sample to the requested time, or, negative, from the oldest sample, or 0 if ok.
        oldest: Stamp of the oldest sample, or 0 when static.
        newest: Stamp of the newest sample, or 0 when static.
        age: The time from the newest sample to the requested time, or to the current time, or None if unknown.
        gap: The interval between the two samples around the requested time; 0 at a sample.
        rate: Samples per second, from the mean interval between their stamps.
        period: The usual period: the median interval between the stamps; 0.0 with fewer than two samples.
        stale: Whether the edge is currently stale (see :mod:`coframe.analysis.liveness`); None if the current time is
            unknown.
        publisher: The publisher of the newest sample: a node, or the topic of a recording, or "" if it is unknown.
        later: The parent in the newest sample, if the parent has changed since the requested time; otherwise "".
    """

    parent: str
    child: str
    static: bool
    state: str
    by: int
    oldest: int
    newest: int
    age: int | None
    gap: int
    rate: float
    period: float
    stale: bool | None
    publisher: str
    later: str

    @property
    def name(self) -> str:
        """The edge as ``parent -> child``."""
        return f"{self.parent or '?'} -> {self.child}"

    @property
    def due(self) -> int:
        """The time from the requested time to the next sample expected from the period, in nanoseconds."""
        return -self.by % round(self.period) if self.period >= 1.0 else 0


@dataclass(frozen=True)
class Explanation:
    """The reason why a transform between two frames exists or not; ``str()`` formats it. All times are nanoseconds.

    Attributes:
        target: The target frame of the lookup.
        source: The source frame of the lookup.
        stamp: The requested time; 0 is the latest common time.
        answered: The time of the transform (0: every edge is static), or None if there is no transform.
        code: The kind of problem, as the ``code`` of an exception, or "" if there is no problem.
        text: The message of that exception, as in tf2.
        hint: What to do, with the line to change, or "" if nothing needs to be done.
        unknown: Which of the two frames do not exist.
        edges: The edges from the target to the source through their nearest common ancestor; empty if a frame does not
            exist.
        frames: The frames of the chain in the same order. With two trees: from the target up to its root, then from
            the root of the source down to the source.
        roots: The roots of the trees of target and source if these are two trees; else None.
        missing: The edge that would connect the two trees: a likely one, or one between the roots; else None.
        limit: The edge, as (parent, child), whose newest sample limits the latest common time, or None if another time
            was requested, or if all edges are static.
        span: The first and the last time at which all edges have samples, or None if there is no such time, or if all
            edges are static.
        possible_at: If there is no chain at the requested time: another time with a transform, 0 for the latest; else
            None.
        cache: How far back the buffer keeps samples; negative if it keeps everything.
        now: The current time on the clock of the stamps, or None if it is unknown.
    """

    target: str
    source: str
    stamp: int
    answered: int | None
    code: str
    text: str
    hint: str
    unknown: tuple[str, ...]
    edges: tuple[ChainEdge, ...]
    frames: tuple[str, ...]
    roots: tuple[str, str] | None
    missing: MissingEdge | None
    limit: tuple[str, str] | None
    span: tuple[int, int] | None
    possible_at: int | None
    cache: int
    now: int | None

    @property
    def possible(self) -> bool:
        """Whether there is a transform."""
        return self.answered is not None

    @property
    def broken(self) -> tuple[ChainEdge, ...]:
        """The edges that have no data at the requested time."""
        return tuple(edge for edge in self.edges if edge.state != "ok")

    def __str__(self) -> str:
        return "\n".join(draw(self))

    def _repr_html_(self) -> str:
        return draw_html(self)
