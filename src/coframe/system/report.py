# SPDX-License-Identifier: Apache-2.0
"""The report of `coframe doctor --system`: the collected data, before any advice."""

from __future__ import annotations

import functools
import os
import time
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from coframe._output import html_tables
from coframe._output.formatting import count
from coframe.system._installation import Installation, installation
from coframe.system._middleware_check import StepRunner
from coframe.system._variables import Variable, variables
from coframe.system.advice import advise
from coframe.system.middleware_checks import check_of
from coframe.system.network import Probe, SocketLimits, limits
from coframe.system.sections import sections
from coframe.wire import domains, selection
from coframe.wire.dds import config, library
from coframe.wire.participant import Participant

if TYPE_CHECKING:
    from collections.abc import Mapping

    from coframe.system._middleware_check import FailedStep
    from coframe.system._zenoh_session import ZenohProbe
    from coframe.wire.dds.library import Place

_SETTLE_TIME: Final = 1.0  # seconds without a new node; the others are found within a few round trips of the first one


@dataclass(frozen=True)
class LibraryReport:
    """The DDS library: `path` and `version` are empty if there is none; `searched` lists the places in order."""

    source: str
    path: str
    version: str
    searched: list[Place]
    rejected: list[str]


@dataclass(frozen=True)
class SystemReport:
    """The state of this machine, as far as it affects processes that join the ROS graph.

    Attributes:
        installation: The software.
        variables: The environment variables that are set.
        library: The DDS library.
        domain: The domain ID, or None if ROS_DOMAIN_ID is invalid.
        discovery: The discovery range, or None if a variable is invalid.
        participants: The numbers of used and of all participant indexes of the domain on this machine.
        probe: The behavior of a DDS participant on the network; None if it could not be created or Zenoh is selected.
        limits: The limits of the system.
        nodes: The names of the other nodes that were found, or None if the graph could not be joined.
        listened: The duration of the search for nodes, in seconds.
        wire: The selected middleware and why it was selected, or None if COFRAME_WIRE is invalid.
        zenoh: The connections of a Zenoh session, or None if it could not be opened or DDS is selected.
        middleware: Lines about the selected middleware if it is another one.
        problems: The failed steps.
    """

    installation: Installation
    variables: list[Variable]
    library: LibraryReport
    domain: int | None
    discovery: str | None
    limits: SocketLimits
    nodes: list[str] | None
    listened: float
    wire: selection.Selection | None
    participants: tuple[int, int] | None = None
    probe: Probe | None = None
    zenoh: ZenohProbe | None = None
    middleware: list[str] = field(default_factory=list)
    problems: list[FailedStep] = field(default_factory=list)

    def _repr_html_(self) -> str:
        findings = [(one.severity, one.text, one.action) for one in advise(self)]
        lines = [(title, line) for title, part in sections(self) for line in part]
        return html_tables.section(
            count(len(findings), "finding"),
            html_tables.table(("severity", "what was found", "what to do"), findings, len(findings)),
            html_tables.table(("part", "state"), lines, len(lines)),
        )


def collect(
    domain: int | None = None, *, listen: float = 10.0, environment: Mapping[str, str] = os.environ
) -> SystemReport:
    """Examine this machine. Failures are part of the report.

    Args:
        domain: The domain ID. If None, it is ROS_DOMAIN_ID.
        listen: How long to search for other nodes, in seconds.
        environment: The environment variables.
    """
    attempt = StepRunner()
    number = attempt(lambda: domains.domain_id(environment) if domain is None else domains.check_domain_id(domain))
    discovery = attempt(lambda: config.discovery_range(environment))
    wire = attempt(lambda: selection.select(environment))
    examined = check_of(wire).examine(number, environment, attempt)
    nodes = None
    if examined.joins and number is not None and wire is not None:
        nodes = attempt(functools.partial(_other_nodes, number, wire.wire, listen))
    return SystemReport(
        installation=installation(environment),
        variables=variables(environment),
        library=_library_report(environment),
        domain=number,
        discovery=discovery,
        limits=limits(),
        nodes=nodes,
        listened=listen,
        wire=wire,
        problems=attempt.problems,
        **examined.fields,
    )


def _library_report(environment: Mapping[str, str]) -> LibraryReport:
    searched, found = list(library.places(environment)), library.loaded()
    if found is None:
        return LibraryReport("", "", "", searched, [])
    return LibraryReport(found.place.source, str(found.place.path), found.version, searched, list(found.rejected))


def _other_nodes(domain: int, wire: str, listen: float) -> list[str]:
    """Return the nodes that are found within this time, and return early once no more appear."""
    participant = Participant.get(domain, wire)
    try:
        end = time.monotonic() + listen
        nodes: list[str] = []
        changed = time.monotonic()
        while time.monotonic() < end and not (nodes and time.monotonic() > changed + _SETTLE_TIME):
            now = sorted(f"{namespace.rstrip('/')}/{name}" for namespace, name in participant.nodes())
            if now != nodes:
                nodes, changed = now, time.monotonic()
            time.sleep(0.02)
        return nodes
    finally:
        participant.close()
