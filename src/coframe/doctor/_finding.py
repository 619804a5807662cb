# SPDX-License-Identifier: Apache-2.0
"""Finding: one problem with its values and what to do about it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from enum import IntEnum
from typing import TYPE_CHECKING

from coframe._output import html_tables
from coframe.doctor.codes import page

if TYPE_CHECKING:
    from collections.abc import Sequence

    from typing_extensions import Self

__all__ = ["Finding", "Severity"]


class Severity(IntEnum):
    """The severity of a finding. With WARNING and ERROR, the exit code of `coframe doctor` is 1."""

    NOTE = 1
    WARNING = 2
    ERROR = 3

    def __str__(self) -> str:
        return self.name.lower()


@dataclass(frozen=True)
class Finding:
    """One problem.

    Attributes:
        code: The code, such as ``TF001``; each code has a page.
        severity: How serious the problem is.
        text: The problem, with values, but without the names of the edge and the publishers.
        fix: What to do: the command to run, or the line of code to change.
        edge: The edge as (parent, child), or None if the finding concerns something else.
        frames: The affected frames, including the frames of the edge; used to find its cause.
        topic: The topic that it concerns, or "".
        first_stamp: The stamp of the first affected transform or message, in nanoseconds, or None if there is none.
        publishers: The full names of the affected publishers, as far as they are known.
        explains: Its consequences: findings that disappear with this one.
        harm: Why it matters, if it differs from the page of the code.
        edges: All edges with the same problem, if it was found for many of them; the text describes the first one.
        topics: All topics with the same problem, if it was found for many of them.
        repairs: The rules of `coframe bag edit` that repair a recording, such as ``rename-frame Lidar=lidar``, if there
            is one safe repair.
        choices: Rules, or forms of rules, of which one repairs it, if a user has to choose.
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
    edges: tuple[tuple[str, str], ...] = ()
    topics: tuple[str, ...] = ()
    repairs: tuple[str, ...] = ()
    choices: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if self.edge is not None:
            object.__setattr__(self, "frames", self.frames | set(self.edge))

    @property
    def why(self) -> str:
        """Why it matters."""
        return self.harm or page(self.code).why

    @property
    def page(self) -> str:
        """The page and section of the documentation site that describe the code."""
        return page(self.code).location

    @property
    def subject(self) -> str:
        """The edge or topic that it concerns; may be empty."""
        return " -> ".join(self.edge) if self.edge else self.topic

    def with_consequences(self, others: tuple[Finding, ...]) -> Self:
        """Return the finding with its consequences."""
        return replace(self, explains=others)

    def _repr_html_(self) -> str:
        title = f"{self.code} {self.severity}" + (f": {self.subject}" if self.subject else "")
        rows = [("problem", self.text), ("why it matters", self.why), ("fix", self.fix)]
        return html_tables.section(
            title,
            html_tables.table(("", ""), rows, len(rows)),
            findings_table(self.explains, "consequence") if self.explains else "",
        )


def findings_table(findings: Sequence[Finding], noun: str = "finding") -> str:
    """Return findings as an HTML table for notebooks; only the first ones if there are many."""
    rows = ((one.code, one.severity, one.subject, one.text, one.fix) for one in findings)
    return html_tables.table(("code", "severity", "subject", "problem", "fix"), rows, len(findings), noun)
