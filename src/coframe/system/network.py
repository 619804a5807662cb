# SPDX-License-Identifier: Apache-2.0
"""Test the network as DDS uses it: a participant, multicast, ports and socket buffers.

The participant is a real one. The trace of Cyclone DDS contains which interfaces it selects; no function returns them.
"""

from __future__ import annotations

import os
import re
import socket
import struct
import tempfile
import time
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

from coframe import _core
from coframe._files.os_errors import explain
from coframe.errors import WireError
from coframe.wire.dds import config, participants
from coframe.wire.dds.session import native_qos
from coframe.wire.dds.topics import create_topic
from coframe.wire.qos import QoS

if TYPE_CHECKING:
    from collections.abc import Mapping

_MULTICAST_GROUP: Final = "239.255.0.1"  # the multicast group in which RTPS announces participants
_RECEIVE_TIMEOUT: Final = 2.0  # seconds; much longer than a datagram or sample takes within one machine
_REQUESTED_BUFFER: Final = 64 << 20  # bytes; more than any system grants without configuration


@dataclass(frozen=True)
class Interface:
    """A network interface that Cyclone DDS found.

    Attributes:
        name: The name of the interface, such as ``eth0``.
        address: The IP address of the interface.
        used: Whether the participant uses it.
        multicast: Whether the interface receives multicast datagrams that it sends, or None if not tested.
        problem: Why the test failed; empty if it did not.
    """

    name: str
    address: str
    used: bool
    multicast: bool | None
    problem: str = ""


@dataclass(frozen=True)
class Probe:
    """The network usage of a participant of this process.

    Attributes:
        version: The version that the library writes into its trace; empty for 0.10, which does not.
        interfaces: The network interfaces.
        unicast_ports: The ports of this participant for discovery and data.
        multicast_ports: The ports of the domain for discovery and data.
        receive_buffer: The size of the receive buffer of its sockets, in bytes, or None if it is unknown.
        exchanged: Whether a message that was sent through the library was received through it.
    """

    version: str
    interfaces: list[Interface]
    unicast_ports: list[int]
    multicast_ports: list[int]
    receive_buffer: int | None
    exchanged: bool


def probe_participant(domain: int, environment: Mapping[str, str]) -> Probe:
    """Join the domain with a separate participant, exchange a message within it, and read the trace.

    Raises:
        WireError: An environment variable is invalid, or DDS cannot create the participant.
    """
    with tempfile.TemporaryDirectory(prefix="coframe_", ignore_cleanup_errors=True) as folder:
        trace = Path(folder) / "trace.log"
        tracing = f"<Tracing><Verbosity>config</Verbosity><OutputFile>{trace}</OutputFile></Tracing>"
        xml = f'{config.cyclone_config(environment)},<CycloneDDS><Domain id="any">{tracing}</Domain></CycloneDDS>'
        participant = participants.join(domain, xml, "")
        try:
            exchanged = _exchange_message(participant.entity)
        finally:
            participant.close()
        text = trace.read_text(errors="replace") if trace.is_file() else ""
    return _read_trace(text, exchanged=exchanged)


def _exchange_message(participant: int) -> bool:
    """Send a message through the library to a reader of the same participant. Return whether it arrived unchanged."""
    message = b"\0\1\0\0" + bytes(range(200))
    message_event = _core.Event()
    qos = native_qos(QoS(depth=1))
    name = "rt/_coframe_doctor"
    try:
        topics = [create_topic(participant, name, "coframe::msg::dds_::Probe_") for _ in range(2)]
        reader = _core.Reader(participant, topics[0], qos, "", message_event)
        writer = _core.Writer(participant, topics[1], qos, "")
        message_event.clear()
        writer.write(message)
        deadline = time.monotonic() + _RECEIVE_TIMEOUT
        received: list[tuple[bytes, int, int]] = []
        while not received and time.monotonic() < deadline:
            message_event.wait(20_000_000)
            received = reader.take(1)
        writer.close()
        reader.close()
    except (_core.EndpointError, WireError):
        return False
    return [data for data, _, _ in received] == [message]


def _read_trace(text: str, *, exchanged: bool) -> Probe:
    found = re.search(r": interfaces: (.*)", text)
    addresses = re.findall(r"(\S+) (?:\w+/)?\[?([0-9a-fA-F:.]+?)\]?\(q\d+\)", found[1]) if found else []
    selected = re.search(r": selected interfaces: (.*)", text)
    used = set(re.findall(r"(\S+) \(index", selected[1])) if selected else set()
    interfaces = []
    for name, address in addresses:
        problem = multicast_problem(address) if name in used else None
        works = None if problem is None else problem == ""
        interfaces.append(Interface(name, address, name in used, works, problem or ""))
    version = re.search(r"Version: CycloneDDS (\S+)", text)
    buffers = [int(size) for size in re.findall(r"socket receive buffer size set to (\d+) bytes", text)]
    return Probe(
        version=version[1] if version else "",
        interfaces=interfaces,
        unicast_ports=_ports("Unicast", text),
        multicast_ports=_ports("Multicast", text),
        receive_buffer=min(buffers, default=None),
        exchanged=exchanged,
    )


def _ports(kind: str, text: str) -> list[int]:
    found = re.search(rf"{kind} Ports: discovery (\d+) data (\d+)", text)
    return [int(found[1]), int(found[2])] if found else []


def multicast_problem(address: str) -> str:
    """Send a datagram to a multicast group on an interface and receive it there.

    Args:
        address: The IPv4 address of the interface.

    Returns:
        Why it did not arrive; empty if it did.
    """
    if ":" in address:
        return "the test supports only IPv4"
    interface = socket.inet_aton(address)
    try:
        with (
            socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver,
            socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender,
        ):
            receiver.bind(("", 0))
            receiver.settimeout(_RECEIVE_TIMEOUT)
            group = socket.inet_aton(_MULTICAST_GROUP) + interface
            receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, group)
            sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, interface)
            sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_LOOP, 1)
            sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, struct.pack("b", 0))  # stays on this machine
            word = b"coframe " + struct.pack("d", time.time())
            sender.sendto(word, (_MULTICAST_GROUP, receiver.getsockname()[1]))
            while receiver.recv(64) != word:
                pass
    except OSError as error:
        return "nothing was received within 2 s" if isinstance(error, TimeoutError) else explain(error)
    return ""


@dataclass(frozen=True)
class SocketLimits:
    """Limits of the system.

    Attributes:
        default_buffer: The size of the receive buffer of a new UDP socket, in bytes.
        largest_buffer: The maximum size that a process may set, in bytes.
        ephemeral_ports: The first and the last port that the system gives to other sockets, or None if not known.
        shared_memory: The free memory in /dev/shm in bytes, which nodes on Fast DDS use, or None if there is none.
    """

    default_buffer: int
    largest_buffer: int
    ephemeral_ports: tuple[int, int] | None
    shared_memory: int | None


def limits() -> SocketLimits:
    """Return the limits of the system."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        default = probe.getsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF)
        with suppress(OSError):  # macOS rejects sizes above its limit instead of reducing them
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _REQUESTED_BUFFER)
        largest = probe.getsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF)
    ports = None
    with suppress(OSError, ValueError):
        first, last = Path("/proc/sys/net/ipv4/ip_local_port_range").read_text().split()
        ports = int(first), int(last)
    memory = None
    with suppress(OSError, AttributeError):  # no os.statvfs on Windows
        free = os.statvfs("/dev/shm")  # noqa: S108 - it is measured, not written
        memory = free.f_bavail * free.f_frsize
    return SocketLimits(default, largest, ports, memory)
