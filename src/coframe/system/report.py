# SPDX-License-Identifier: Apache-2.0
"""The report of `coframe doctor --system`: what was found, before any advice."""

from __future__ import annotations

import functools
import os
import time
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final, TypeVar

from coframe.errors import WireError
from coframe.system.installation import Installation, installation
from coframe.system.network import Limits, Probe, limits, probe_participant
from coframe.system.variables import Variable, variables
from coframe.system.zenoh_session import ZenohProbe, probe_session
from coframe.wire import domains, selection
from coframe.wire.dds import config, library, participants
from coframe.wire.participant import Participant

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from coframe.wire.dds.library import Place

ValueT = TypeVar("ValueT")

_SETTLED: Final = 1.0  # seconds without a further node; the rest are found within a few round trips of the first one


@dataclass(frozen=True)
class Problem:
    """Something that failed: what, and what to do."""

    text: str
    hint: str


@dataclass(frozen=True)
class LibraryReport:
    """The DDS library: `path` and `version` are empty if there is none; `searched` has the places in their order."""

    source: str
    path: str
    version: str
    searched: list[Place]
    refused: list[str]


@dataclass(frozen=True)
class SystemReport:
    """What this machine offers a process that joins the ROS graph.

    Attributes:
        installation: The software.
        variables: The environment variables that are set.
        library: The DDS library.
        domain: The domain ID; None if ROS_DOMAIN_ID is invalid.
        discovery: The discovery range; None if a variable is invalid.
        participants: How many participant indexes of the domain are in use on this machine, and how many there are.
        probe: What a DDS participant does on the network; None if it could not be created or Zenoh is selected.
        limits: What the system grants.
        nodes: The names of the other nodes that were found; None if the graph could not be joined.
        listened: For how long nodes were searched, in seconds.
        wire: The selected middleware and why it was selected; None if COFRAME_WIRE is invalid.
        zenoh: What a Zenoh session connects to; None if it could not be opened or DDS is selected.
        problems: What failed.
    """

    installation: Installation
    variables: list[Variable]
    library: LibraryReport
    domain: int | None
    discovery: str | None
    participants: tuple[int, int] | None
    probe: Probe | None
    limits: Limits
    nodes: list[str] | None
    listened: float
    wire: selection.Selection | None
    zenoh: ZenohProbe | None
    problems: list[Problem] = field(default_factory=list)


def collect(
    domain: int | None = None, *, listen: float = 10.0, environment: Mapping[str, str] = os.environ
) -> SystemReport:
    """Examine this machine. Failures are part of the report.

    Args:
        domain: The domain ID. If None, it is ROS_DOMAIN_ID.
        listen: How long other nodes are searched, in seconds.
        environment: The environment variables.
    """
    problems: list[Problem] = []

    def attempt(action: Callable[[], ValueT]) -> ValueT | None:
        try:
            return action()
        except WireError as error:
            problems.append(Problem(str(error), error.hint))
            return None

    number = attempt(lambda: domains.domain_id(environment) if domain is None else domains.check_domain_id(domain))
    discovery = attempt(lambda: config.discovery_range(environment))
    peers = attempt(lambda: config.static_peers(environment))
    wire = attempt(lambda: selection.select(environment))
    on_zenoh = wire is not None and wire.wire == "zenoh"
    found = None if on_zenoh else attempt(library.load)
    used = probe = nodes = zenoh = None
    if number is not None and on_zenoh:
        zenoh = attempt(lambda: probe_session(environment))
        nodes = attempt(functools.partial(_other_nodes, number, listen)) if zenoh is not None else None
    elif number is not None:
        used = participants.participant_indexes(number)
        if found is not None and discovery is not None and peers is not None:
            probe = attempt(functools.partial(probe_participant, number, environment))
            nodes = attempt(functools.partial(_other_nodes, number, listen)) if probe is not None else None
    return SystemReport(
        installation(environment),
        variables(environment),
        _library_report(found, environment),
        number,
        discovery,
        used,
        probe,
        limits(),
        nodes,
        listen,
        wire,
        zenoh,
        problems,
    )


def _library_report(found: library.Library | None, environment: Mapping[str, str]) -> LibraryReport:
    searched = list(library.places(environment))
    if found is None:
        return LibraryReport("", "", "", searched, [])
    return LibraryReport(found.place.source, str(found.place.path), found.version, searched, list(found.refused))


def _other_nodes(domain: int, listen: float) -> list[str]:
    """Return the nodes that are found within this time; return early once no further ones appear."""
    participant = Participant.get(domain)
    try:
        end = time.monotonic() + listen
        nodes: list[str] = []
        changed = time.monotonic()
        while time.monotonic() < end and not (nodes and time.monotonic() > changed + _SETTLED):
            now = sorted(f"{namespace.rstrip('/')}/{name}" for namespace, name in participant.nodes())
            if now != nodes:
                nodes, changed = now, time.monotonic()
            time.sleep(0.02)
        return nodes
    finally:
        participant.close()
