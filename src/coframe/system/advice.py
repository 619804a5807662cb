# SPDX-License-Identifier: Apache-2.0
"""Findings about a `SystemReport`: problems that prevent discovery or slow nodes down, and their remedies."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from coframe.system._middleware_check import SystemFinding
from coframe.system.middleware_checks import check_of
from coframe.wire import selection

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.system.report import SystemReport

_ORDER: Final = {"error": 0, "warning": 1, "note": 2}


def advise(report: SystemReport) -> list[SystemFinding]:
    """Return the findings, the most severe first."""
    found = [SystemFinding("error", problem.text, problem.hint) for problem in report.problems]
    for check in (_ros, _middleware, *check_of(report.wire).checks):
        found += check(report)
    return sorted(found, key=lambda advice: _ORDER[advice.severity])


def _ros(report: SystemReport) -> Iterator[SystemFinding]:
    foreign = report.installation.foreign
    if not foreign:
        return
    folders = ", ".join(sorted(set(foreign.values())))
    if report.installation.ros is None:
        yield SystemFinding(
            "error",
            f"Python imports {', '.join(sorted(foreign))} from {folders}, but no ROS 2 is sourced. Packages of coframe "
            "and of a ROS installation cannot be mixed.",
            "Remove the folder from PYTHONPATH, or source a complete ROS 2.",
        )
    else:
        name = f"ROS 2 {report.installation.ros}".strip()
        yield SystemFinding(
            "note",
            f"{name} is sourced: `import rclpy` and `import tf2_ros` load its packages from {folders}.",
            "Start a shell in which no ROS 2 is sourced to use the packages of coframe.",
        )


def _middleware(report: SystemReport) -> Iterator[SystemFinding]:
    if report.wire is None:
        return
    used = selection.row_of(report.wire.wire)
    implementation = {variable.name: variable.value for variable in report.variables}.get(selection.RMW_VARIABLE)
    others = selection.row_of_rmw(implementation or "")
    if others.protocol != used.protocol:
        yield SystemFinding(
            "note" if implementation is None else "warning",
            f"coframe uses {used.title}, but ROS 2 nodes started in this shell use "
            f"{implementation or others.rmw}: they do not find each other.",
            f"Set RMW_IMPLEMENTATION={used.rmw} and COFRAME_WIRE={used.wire}, or unset both.",
        )
