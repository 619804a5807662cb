"""Finding: one thing that is wrong, with its numbers and what to do about it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from enum import IntEnum
from typing import TYPE_CHECKING

from coframe.doctor.codes import page

if TYPE_CHECKING:
    from typing_extensions import Self

__all__ = ["Finding", "Severity"]


class Severity(IntEnum):
    """How bad it is; from WARNING on, `coframe doctor` ends with exit code 1."""

    NOTE = 1
    WARNING = 2
    ERROR = 3

    def __str__(self) -> str:
        return self.name.lower()


@dataclass(frozen=True)
class Finding:
    """One thing that is wrong.

    Attributes:
        code: Stable, ``TF001``; the catalogue has a page for it.
        severity: How bad it is.
        text: What is there, in numbers, without the names of edge and publishers.
        fix: What to do: the very command, or the line of code to change.
        edge: The link as (parent, child), or None where it is about something else.
        frames: Frames that it is about, for joining it with its cause; an edge's two are among them.
        topic: Which topic it is about, or "".
        first_stamp: Of the first transform or message concerned, in nanoseconds; None where there is none.
        publishers: The full names of the nodes that are to blame, as far as they are known.
        explains: Findings that would go if this one did.
        harm: Why it matters, where that is not what the page of the code opens with.
    """

    code: str
    severity: Severity
    text: str
    fix: str
    edge: tuple[str, str] | None = None
    frames: frozenset[str] = frozenset()
    topic: str = ""
    first_stamp: int | None = None
    publishers: tuple[str, ...] = ()
    explains: tuple[Finding, ...] = field(default=())
    harm: str = ""

    def __post_init__(self) -> None:
        if self.edge is not None:
            object.__setattr__(self, "frames", self.frames | set(self.edge))

    @property
    def why(self) -> str:
        """Why it matters, in a sentence."""
        return self.harm or page(self.code).why

    @property
    def subject(self) -> str:
        """What it is about: the edge, or else the topic; may be empty."""
        return " -> ".join(self.edge) if self.edge else self.topic

    def explaining(self, others: tuple[Finding, ...]) -> Self:
        """The same with what it explains."""
        return replace(self, explains=others)
