# SPDX-License-Identifier: Apache-2.0
"""A `SystemReport` as lines of text below titles."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.system.middleware_checks import check_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.system.network import Interface
    from coframe.system.report import SystemReport

__all__ = ["sections"]

_MEBIBYTE = 1 << 20


def sections(report: SystemReport) -> Iterator[tuple[str, list[str]]]:
    """Yield the title and the lines of each part of a report. The lines may contain text from outside."""
    yield "Software", list(_software(report))
    yield "Middleware", list(_middleware(report))
    yield "DDS library", list(_library(report))
    set_variables = [f"{each.name}={each.value}: {each.effect}" for each in report.variables]
    yield "Environment variables", set_variables or ["no variables of ROS 2, its middlewares or coframe are set"]
    yield "Network", list(_network(report))
    if report.nodes is not None:
        found = ", ".join(report.nodes) or "none"
        yield f"Nodes in domain {report.domain}", [found]


def _software(report: SystemReport) -> Iterator[str]:
    installed = report.installation
    yield f"Python {installed.python} on {installed.platform}{', in a container' if installed.container else ''}"
    yield ", ".join(f"{name} {version or 'not installed'}" for name, version in installed.packages.items())
    for extra, packages in installed.extras.items():
        versions = (f"{name} {version or 'not installed'}" for name, version in packages.items())
        yield f"extra {extra}: {', '.join(versions)}"
    if installed.ros is None:
        yield "no ROS 2 is sourced"
    else:
        yield f"ROS 2 {installed.ros} is sourced".replace("  ", " ")


def _middleware(report: SystemReport) -> Iterator[str]:
    if report.wire is not None:
        yield f"{report.wire.wire}, because {report.wire.reason}"
    yield from check_of(report.wire).lines(report)


def _library(report: SystemReport) -> Iterator[str]:
    used = report.library
    if used.path:
        version = report.probe.version if report.probe and report.probe.version else used.version
        yield f"{used.path}: Cyclone DDS {version}, from {used.source}"
    yield "searched in this order:"
    for place in used.searched:
        yield f"  {place.source}: {place.path or f'not found ({place.searched})'}"


def _network(report: SystemReport) -> Iterator[str]:
    yield f"domain {_value_text(report.domain)}, discovery range {_value_text(report.discovery)}"
    if report.participants:
        used, every = report.participants
        yield f"participants on this machine: {used} of {every} indexes in use, {every - used} free"
    if report.probe:
        for interface in report.probe.interfaces:
            yield f"interface {interface.name}, {interface.address}: {_state_text(interface)}"
        discovery, data = report.probe.unicast_ports or ("unknown", "unknown")
        yield f"UDP ports of a participant: {discovery} for discovery, {data} for data"
        discovery, data = report.probe.multicast_ports or ("none", "none")
        yield f"UDP ports of the domain for multicast: {discovery} for discovery, {data} for data"
        if report.probe.receive_buffer:
            yield f"receive buffer of a participant: {_mebibytes(report.probe.receive_buffer)}"
        received = "received" if report.probe.exchanged else "not received"
        yield f"a message through the library within this process: {received}"
    default, largest = _mebibytes(report.limits.default_buffer), _mebibytes(report.limits.largest_buffer)
    yield f"receive buffer of a UDP socket: {default} by default, at most {largest}"
    if report.limits.shared_memory is not None:
        yield f"shared memory (/dev/shm): {_mebibytes(report.limits.shared_memory)} free; shared transforms use it"


def _state_text(interface: Interface) -> str:
    if not interface.used:
        return "not used"
    if interface.multicast:
        return "used, multicast works"
    return f"in use, but multicast does not work ({interface.problem})"


def _value_text(value: object) -> str:
    return "unknown" if value is None else str(value)


def _mebibytes(size: int) -> str:
    return f"{size / _MEBIBYTE:.1f} MiB"
