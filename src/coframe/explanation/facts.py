"""Explanation: the way between two frames, link by link, and what is wrong with it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from coframe.analysis.liveness import usual_silence
from coframe.explanation.drawing import draw

if TYPE_CHECKING:
    from coframe.analysis.missing_edges import MissingEdge

__all__ = ["Explanation", "Link"]

_SECOND = 1_000_000_000


class Link(NamedTuple):
    """A link on the way between two frames, for the time that is asked for. All times are nanoseconds.

    Attributes:
        parent: The frame it is told in at that time, or else by the newest sample; "" where no sample is left.
        child: The frame it tells of.
        static: Whether it is valid for all time.
        state: ``"ok"``, or what is wrong: ``"too_new"`` (asked after the newest sample), ``"too_old"`` (before the
            oldest), ``"only_other"`` (there is one sample, of another time), ``"no_data"``.
        by: By how much: from the newest sample to the time that is asked for, or, negative, from the oldest; 0 if ok.
        oldest: Stamp of the oldest sample; 0 when static.
        newest: Stamp of the newest.
        age: From the newest sample to the time that is asked for, or to now; None when static or not known.
        gap: Between the two samples around that time; 0 at a sample.
        rate: Samples a second, by their stamps.
        publisher: Who told of it last: a node, or a recording's topic; "" where that is not known.
        later: The parent by the newest sample, where it has changed since; else "".
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
    publisher: str
    later: str

    @property
    def name(self) -> str:
        """``parent -> child``."""
        return f"{self.parent or '?'} -> {self.child}"

    @property
    def period(self) -> int:
        """The mean time between samples, in nanoseconds; 0 where there are not two."""
        return round(_SECOND / self.rate) if self.rate else 0

    @property
    def due(self) -> int:
        """How long after the time that is asked for its next sample is due by its rate, in nanoseconds."""
        return -self.by % self.period if self.period else 0

    @property
    def patience(self) -> int:
        """For how long it may be silent without having stopped, in nanoseconds."""
        return usual_silence(self.period)


@dataclass(frozen=True)
class Explanation:
    """Why there is a transform, or why not; ``str()`` draws it. All times are nanoseconds.

    Attributes:
        target: The frame that the answer would be told in.
        source: The frame that is asked about.
        stamp: The time that is asked for; 0 is the latest.
        answered: The time of the answer (0: every link is static); None where there is none.
        code: What is wrong, as an exception's ``code``; "" where nothing is.
        text: The same in tf2's words.
        hint: What to do, with the line to change; "" where nothing is to be done.
        unknown: Which of the two frames nobody has told of.
        links: From the target to the source, by way of the frame that they have in common; none where a name is no
            frame's.
        frames: Likewise. Of two trees: up to the target's root, then from the source's root down.
        roots: Those of the target's tree and the source's, where they are two; else None.
        missing: The link that would make one tree of the two: a likely one, or that between the roots; else None.
        limit: The link, as (parent, child), that knows no later time than the latest that all of them know; None
            where another time is asked for, or nothing moves.
        span: From when until when all links have samples; None where they never have, or none of them moves.
        possible_at: Where the two are not connected: another time at which they are, 0 for the latest; else None.
        cache: How far back the buffer keeps samples; negative: everything.
        now: The present; None where that is not known.
    """

    target: str
    source: str
    stamp: int
    answered: int | None
    code: str
    text: str
    hint: str
    unknown: tuple[str, ...]
    links: tuple[Link, ...]
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
    def broken(self) -> tuple[Link, ...]:
        """The links that have no sample at the time that is asked for."""
        return tuple(link for link in self.links if link.state != "ok")

    def __str__(self) -> str:
        return "\n".join(draw(self))
