# SPDX-License-Identifier: Apache-2.0
"""The interface of middleware checks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeVar

from coframe.errors import WireError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from coframe.system.report import SystemReport

ValueT = TypeVar("ValueT")
Severity = Literal["error", "warning", "note"]


@dataclass(frozen=True)
class SystemFinding:
    """A finding.

    Attributes:
        severity: "error": the graph cannot be joined; "warning": some nodes are not found, or messages are lost;
            "note": worth knowing if a node is missing.
        text: The problem.
        action: The recommended action.
    """

    severity: Severity
    text: str
    action: str


@dataclass(frozen=True)
class FailedStep:
    """A failed step, and the recommended action."""

    text: str
    hint: str


class StepRunner:
    """Runs parts of a check, whose failures are part of the report.

    Attributes:
        problems: The failed steps, with recommended actions.
    """

    def __init__(self) -> None:
        self.problems: list[FailedStep] = []

    def __call__(self, action: Callable[[], ValueT]) -> ValueT | None:
        """Return the result of an action, or None if it failed."""
        try:
            return action()
        except WireError as error:
            self.problems.append(FailedStep(str(error), error.hint))
            return None


class CheckResult(NamedTuple):
    """The result of a check.

    Attributes:
        joins: Whether a process can join the graph.
        fields: The fields of the `SystemReport` that only this middleware has.
    """

    joins: bool
    fields: dict[str, Any]


class MiddlewareCheck(NamedTuple):
    """The check of a middleware.

    Attributes:
        wire: The name of the middleware.
        examine: Examines it in a domain (None if that is not known) with some environment variables.
        lines: Returns lines about it for the report.
        checks: Return advice.
    """

    wire: str
    examine: Callable[[int | None, Mapping[str, str], StepRunner], CheckResult]
    lines: Callable[[SystemReport], Iterator[str]]
    checks: tuple[Callable[[SystemReport], Iterator[SystemFinding]], ...]
