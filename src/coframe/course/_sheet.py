# SPDX-License-Identifier: Apache-2.0
"""The result of a check: facts with points, expected and observed behavior, and advice about lost points."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from typing_extensions import Self

    from coframe.course.rubric import Criterion

__all__ = ["Fact", "GradeReport", "Sheet"]

_MAX_OBSERVATION_LENGTH = 500  # characters of an observation


@dataclass
class Fact:
    """One observable fact.

    Attributes:
        name: The checked property.
        points: The available points.
        earned: The earned points.
        expected: The behavior of a correct solution.
        observed: The observed behavior, or "" if all points were earned.
        cause: The likely cause of lost points, or "" if it is not known.
        read: Where to read about it.
    """

    name: str
    points: float
    earned: float
    expected: str
    observed: str = ""
    cause: str = ""
    read: str = ""


@dataclass
class Sheet:
    """The facts of one criterion of the rubric.

    Attributes:
        name: The name of the criterion.
        file: The checked file.
        bonus: Whether its points are added to the 100.
        problem: Why the program could not be checked completely, or "" if it could.
        last_lines: The last lines of the program's output, if there was a problem.
        facts: The checked facts, each with its points and the observed behavior.
    """

    name: str
    file: str
    bonus: bool = False
    problem: str = ""
    last_lines: list[str] = field(default_factory=list)
    facts: list[Fact] = field(default_factory=list)

    @classmethod
    def of(cls, criterion: Criterion) -> Self:
        """Return the empty sheet of a criterion."""
        return cls(criterion.name, criterion.file, criterion.bonus)

    @classmethod
    def not_reached(cls, criterion: Criterion, reason: str) -> Self:
        """Return the sheet of a criterion that was not reached."""
        sheet = cls.of(criterion)
        sheet.add_problem(f"Not checked: {reason}.")
        sheet.check(criterion.points, "the check reaches this criterion", False, expected="a grade", observed=reason)
        return sheet

    @classmethod
    def from_dict(cls, content: dict[str, Any]) -> Self:
        """Return a sheet from the plain data of `as_dict`."""
        facts = [Fact(**fact) for fact in content["facts"]]
        return cls(content["name"], content["file"], content["bonus"], content["problem"], content["last_lines"], facts)

    def check(
        self,
        points: float,
        name: str,
        good: bool | float,
        *,
        expected: str,
        observed: str,
        cause: str = "",
        read: str = "",
    ) -> bool:
        """Add a fact.

        Args:
            points: The available points.
            name: The checked property.
            good: Whether the property is fulfilled; a number from 0 to 1 for partial credit.
            expected: The behavior of a correct solution.
            observed: The observed behavior.
            cause: The likely cause if it is not fulfilled, or "" if it is not known.
            read: Where to read about it.

        Returns:
            Whether the fact is completely fulfilled.
        """
        share = min(1.0, max(0.0, float(good)))
        lost = share < 1.0
        earned = round(points * share, 2)
        details = (_truncate(observed), cause, read) if lost else ("", "", "")
        self.facts.append(Fact(name, points, earned, expected, *details))
        return not lost

    def add_problem(self, sentence: str) -> None:
        """Add a reason that prevents a check, unless it is already present or empty."""
        if sentence not in self.problem:
            self.problem = f"{self.problem} {sentence}".strip()

    def withdraw(self, first: int, observed: str) -> None:
        """Withdraw the points of all facts from index `first` on, with one explanation.

        Args:
            first: The index of the first of these facts.
            observed: The explanation.
        """
        self.add_problem(observed)
        for fact in self.facts[first:]:
            fact.earned, fact.observed, fact.cause = 0.0, observed, ""

    def set_cause(self, first: int, cause: str, *, replace: bool = False) -> None:
        """Set the cause of all lost points from fact index `first` on.

        Args:
            first: The index of the first fact.
            cause: The cause.
            replace: Whether to replace causes that are known for single facts.
        """
        for fact in self.facts[first:]:
            if fact.earned < fact.points and (replace or not fact.cause):
                fact.cause = cause

    @property
    def points(self) -> float:
        """The points of all facts."""
        return round(sum(fact.points for fact in self.facts), 2)

    @property
    def earned(self) -> float:
        """The earned points."""
        return round(sum(fact.earned for fact in self.facts), 2)

    def as_dict(self) -> dict[str, Any]:
        """Return the sheet as plain data for JSON."""
        return {
            "name": self.name,
            "file": self.file,
            "bonus": self.bonus,
            "earned": self.earned,
            "points": self.points,
            "problem": self.problem,
            "last_lines": self.last_lines,
            "facts": [vars(fact) for fact in self.facts],
        }


def _truncate(text: str) -> str:
    """Truncate untrusted text from a submission, such as a frame name."""
    return text if len(text) <= _MAX_OBSERVATION_LENGTH else f"{text[:_MAX_OBSERVATION_LENGTH]} ..."


@dataclass
class GradeReport:
    """The grade of one folder."""

    folder: str
    variant: int | None
    sheets: list[Sheet]
    notices: list[str] = field(default_factory=list)

    @property
    def earned(self) -> float:
        """The points of the rubric that were earned, of 100."""
        return round(sum(sheet.earned for sheet in self.sheets if not sheet.bonus), 2)

    @property
    def bonus(self) -> float:
        """The points of the extensions that were earned, of 40."""
        return round(sum(sheet.earned for sheet in self.sheets if sheet.bonus), 2)

    def as_dict(self) -> dict[str, Any]:
        """Return the report as plain data for JSON."""
        return {
            "folder": self.folder,
            "variant": self.variant,
            "earned": self.earned,
            "points": 100,
            "bonus": self.bonus,
            "notices": self.notices,
            "criteria": [sheet.as_dict() for sheet in self.sheets],
        }
