# SPDX-License-Identifier: Apache-2.0
"""The check of Zenoh: its package, a session, and whether there is a router."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from coframe.system._middleware_check import CheckResult, MiddlewareCheck, SystemFinding
from coframe.system._zenoh_session import probe_session

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from coframe.system._middleware_check import StepRunner
    from coframe.system.report import SystemReport


def _examine(domain: int | None, environment: Mapping[str, str], attempt: StepRunner) -> CheckResult:
    session = None if domain is None else attempt(lambda: probe_session(environment))
    return CheckResult(session is not None, {"zenoh": session})


def _lines(report: SystemReport) -> Iterator[str]:
    session = report.zenoh
    if session is None:
        return
    configured_by = ", ".join(session.configured_by) or "the defaults of ROS 2"
    yield f"eclipse-zenoh {session.version}, configured by {configured_by}"
    yield f"connects to {', '.join(session.connect) or 'no endpoint'}"
    yield f"routers found: {', '.join(session.routers) or 'none'}; peers found: {session.peers}"


def _router(report: SystemReport) -> Iterator[SystemFinding]:
    if report.zenoh is not None and not report.zenoh.routers:
        yield SystemFinding(
            "warning",
            f"No Zenoh router was found at {' or '.join(report.zenoh.connect) or 'any endpoint'}. Nodes of ROS 2 and "
            "processes on other machines are found only with one.",
            "Start one: coframe router, or ros2 run rmw_zenoh_cpp rmw_zenohd. To use a router at another address, set "
            "ZENOH_CONFIG_OVERRIDE='connect/endpoints=[\"tcp/HOST:7447\"]'.",
        )


CHECK: Final = MiddlewareCheck("zenoh", _examine, _lines, (_router,))
