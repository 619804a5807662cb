# SPDX-License-Identifier: Apache-2.0
"""The check of DDS: its library, a participant, the network, and system limits."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Final

from coframe.errors import WireError
from coframe.system._middleware_check import CheckResult, MiddlewareCheck, SystemFinding
from coframe.system.network import probe_participant
from coframe.wire import selection
from coframe.wire.dds import config, library, participants

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from coframe.system._middleware_check import StepRunner
    from coframe.system.report import SystemReport

_SMALL_BUFFER: Final = 1 << 20  # bytes; a burst of fragments of a large message does not fit into less
_MAX_USED_SHARE: Final = 0.8  # of the participant indexes
_MAX_SAFE_DOMAIN: Final = 101  # the last domain whose ports are below those that Linux gives to other sockets


def _examine(domain: int | None, environment: Mapping[str, str], attempt: StepRunner) -> CheckResult:
    peers = attempt(lambda: config.static_peers(environment))
    found = attempt(library.load)
    used = probe = None
    if domain is not None:
        used = participants.participant_indexes(domain)
        if found is not None and peers is not None and _has_range(environment):
            probe = attempt(partial(probe_participant, domain, environment))
    return CheckResult(probe is not None, {"participants": used, "probe": probe})


def _has_range(environment: Mapping[str, str]) -> bool:
    try:
        config.discovery_range(environment)
    except WireError:  # part of the report for all middlewares
        return False
    return True


def _lines(report: SystemReport) -> Iterator[str]:
    """Return nothing, because the library and the network have separate sections."""
    del report
    yield from ()


def _library(report: SystemReport) -> Iterator[SystemFinding]:
    for sentence in report.library.rejected:
        yield SystemFinding("note", sentence, "Remove that library, or name another one in COFRAME_DDS_LIBRARY.")
    if report.probe and not report.probe.exchanged:
        yield SystemFinding(
            "error",
            f"A message that was sent through {report.library.path} was not received unchanged in the same process.",
            "Name another library in COFRAME_DDS_LIBRARY.",
        )


def _rmw(report: SystemReport) -> Iterator[SystemFinding]:
    values = {variable.name: variable.value for variable in report.variables}
    implementation = values.get(selection.RMW_VARIABLE, "")
    used = selection.row_of("dds")
    if selection.row_of_rmw(implementation) is used and implementation not in ("", used.rmw):
        yield SystemFinding(
            "warning",
            f"RMW_IMPLEMENTATION is {implementation}: ROS 2 nodes that are started in this shell exchange topics with "
            "coframe, but no services, actions and parameters.",
            f"Start them with RMW_IMPLEMENTATION={used.rmw}.",
        )
    if "ROS_DISCOVERY_SERVER" in values:
        yield SystemFinding(
            "warning",
            "ROS_DISCOVERY_SERVER is set: nodes on Fast DDS that are started in this shell announce themselves only "
            "there, and coframe does not find them.",
            "Unset ROS_DISCOVERY_SERVER before you start them.",
        )


def _network(report: SystemReport) -> Iterator[SystemFinding]:
    if report.probe is None or report.discovery not in ("SUBNET", "SYSTEM_DEFAULT"):
        return
    used = [interface.name for interface in report.probe.interfaces if interface.used]
    others = [interface.name for interface in report.probe.interfaces if not interface.used]
    if used and all(name.startswith("lo") or "Loopback" in name for name in used):
        yield SystemFinding(
            "warning",
            f"The range is {report.discovery}, but the only network interface with an address is {', '.join(used)}.",
            "Connect this machine to a network, or start the container with --network host.",
        )
    elif others:
        yield SystemFinding(
            "note",
            f"DDS uses the interface {', '.join(used)} of {', '.join([*used, *others])}.",
            "If the robot is on another interface, select it: CYCLONEDDS_URI='<CycloneDDS><Domain><General>"
            f'<Interfaces><NetworkInterface name="{others[0]}"/></Interfaces></General></Domain></CycloneDDS>\'.',
        )


def _multicast(report: SystemReport) -> Iterator[SystemFinding]:
    for interface in report.probe.interfaces if report.probe else []:
        if interface.multicast is False and report.discovery != "OFF":
            local = report.discovery == "LOCALHOST"
            yield SystemFinding(
                "warning",
                f"Multicast does not work on {interface.name} ({interface.address}): {interface.problem}. "
                + (
                    "Nodes that announce themselves only by multicast are not found."
                    if local
                    else "No node on another machine is found."
                ),
                f"Enable it as root: ip link set {interface.name} multicast on. If a firewall drops it, allow UDP "
                "ports 7400 and higher, or list the other hosts in ROS_STATIC_PEERS on both sides.",
            )


def _check_free_indexes(report: SystemReport) -> Iterator[SystemFinding]:
    used, every = report.participants or (0, 1)
    if used >= _MAX_USED_SHARE * every:
        yield SystemFinding(
            "error" if used == every else "warning",
            f"{used} of {every} participant indexes of domain {report.domain} are in use on this machine.",
            "Stop some ROS processes, or use another domain: ROS_DOMAIN_ID=1.",
        )
    ports = report.limits.ephemeral_ports
    if report.domain is not None and report.domain > _MAX_SAFE_DOMAIN and ports:
        yield SystemFinding(
            "warning",
            f"The ports of domain {report.domain} begin at {7400 + 250 * report.domain}, and this system assigns the "
            f"ports {ports[0]} to {ports[1]} to any program.",
            f"Use a domain up to {_MAX_SAFE_DOMAIN}.",
        )


def _check_buffers(report: SystemReport) -> Iterator[SystemFinding]:
    size = report.probe.receive_buffer if report.probe else None
    if size is not None and size < _SMALL_BUFFER:
        yield SystemFinding(
            "warning",
            f"The receive buffer of a socket has {size} bytes. Fragments of large messages are lost and sent again.",
            "Linux, as root: sysctl -w net.core.rmem_max=2147483647",
        )


def _check_discovery_range(report: SystemReport) -> Iterator[SystemFinding]:
    set_by = {variable.name for variable in report.variables}
    if report.discovery == "OFF":
        yield SystemFinding(
            "warning",
            "Discovery is disabled (ROS_AUTOMATIC_DISCOVERY_RANGE=OFF): no other process is found.",
            "Set ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST or SUBNET.",
        )
    elif report.discovery == "LOCALHOST":
        default = {"ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_LOCALHOST_ONLY"}.isdisjoint(set_by)
        yield SystemFinding(
            "note",
            f"Only processes on this machine are found{' (the default of coframe)' if default else ''}. ROS 2 nodes "
            "with default settings use the network, and may not answer on the loopback interface.",
            "To communicate with other machines and with default ROS 2 nodes: ROS_AUTOMATIC_DISCOVERY_RANGE=SUBNET",
        )
    if "CYCLONEDDS_URI" in set_by:
        yield SystemFinding(
            "note",
            "CYCLONEDDS_URI overrides the interfaces, peers and limits that coframe sets.",
            "Unset it to check whether its configuration is the cause.",
        )


def _nodes(report: SystemReport) -> Iterator[SystemFinding]:
    if report.nodes == []:
        yield SystemFinding(
            "note",
            f"No other node was found in domain {report.domain} within {report.listened:g} s.",
            "Check for each missing node that it runs; that it has the same ROS_DOMAIN_ID; that its range and yours "
            "include each other; that it uses DDS (RMW_IMPLEMENTATION); and that no firewall or container separates "
            "them.",
        )
        if report.installation.container:
            yield SystemFinding(
                "note",
                "This process runs in a container.",
                "Nodes on the host are found with --network host; nodes on Fast DDS also need --ipc host.",
            )


CHECK: Final = MiddlewareCheck(
    "dds",
    _examine,
    _lines,
    (_library, _rmw, _network, _multicast, _check_free_indexes, _check_buffers, _check_discovery_range, _nodes),
)
