# SPDX-License-Identifier: Apache-2.0
"""The check of each middleware, for `coframe doctor --system`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from coframe.system import _dds_check, _zenoh_check
from coframe.system._middleware_check import CheckResult, MiddlewareCheck
from coframe.wire import selection

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from coframe.system._middleware_check import StepRunner
    from coframe.system.report import SystemReport
    from coframe.wire.selection import Selection

__all__ = ["MIDDLEWARE_CHECKS", "check_of"]

MIDDLEWARE_CHECKS: Final = (_dds_check.CHECK, _zenoh_check.CHECK)


def check_of(selected: Selection | None) -> MiddlewareCheck:
    """Return the check of the selected middleware, or the DDS check if the selection is invalid.

    A middleware without a check of its own describes itself, and joins the graph.
    """
    if selected is None:
        return _dds_check.CHECK
    for check in MIDDLEWARE_CHECKS:
        if check.wire == selected.wire:
            return check
    return MiddlewareCheck(selected.wire, _examine, _lines, ())


def _examine(domain: int | None, environment: Mapping[str, str], attempt: StepRunner) -> CheckResult:
    wire = selection.select(environment).wire
    lines = attempt(lambda: selection.row_of(wire).load().describe())
    return CheckResult(domain is not None and lines is not None, {"middleware": lines or []})


def _lines(report: SystemReport) -> Iterator[str]:
    yield from report.middleware
