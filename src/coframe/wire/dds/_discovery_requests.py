# SPDX-License-Identifier: Apache-2.0
"""Request the endpoints of participants on Fast DDS that this process has just discovered.

When a process joins the domain, Fast DDS answers with its own announcement and, 0.1 ms later, with heartbeats for its
endpoints. Cyclone DDS ignores heartbeats of participants that it does not know yet, and mostly has not processed the
announcement by then. Fast DDS repeats the heartbeats after 1 s, and until then neither side knows the other's nodes.

Fast DDS also sends heartbeats in response to an acknowledgement with the base 0, which is the first one of its own
readers; that of Cyclone DDS has the base 1 and the count 0 and is ignored. Therefore this module sends the missing one,
to the participants of this machine. Its count is 1, so Fast DDS ignores the next request of Cyclone DDS, whose count is
1 as well; Cyclone DDS repeats it after AutoReschedNackDelay (`coframe.wire.dds.config`). If the heartbeats were not
lost, Fast DDS ignores the acknowledgement sent here.
"""

from __future__ import annotations

import contextlib
import socket
import struct
import time
from typing import TYPE_CHECKING, Final

from coframe.time import MILLISECOND, SECOND
from coframe.wire import vendors
from coframe.wire.dds.participants import discovery_ports

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.wire.rtps.graph import DdsGraph

# Participants that start later than this process are known before they send heartbeats.
_PERIOD: Final = 2 * SECOND
_DELAY: Final = 10 * MILLISECOND  # in which Cyclone DDS processes the announcement
_MAX_PARTICIPANTS: Final = 20  # in one datagram

# Version 2.1, and the vendor ID of Fast DDS: other processes accept the base 0 only of messages that have its form.
_HEADER: Final = b"RTPS\x02\x01\x01\x0f"
_PREFIX_SIZE: Final = 12  # bytes of a GUID that identify the participant
_INFO_DST: Final = struct.pack("<BBH", 0x0E, 1, _PREFIX_SIZE)
_ACKNACK: Final = 0x06
_BUILTIN_ENDPOINTS: Final = ((0x3C7, 0x3C2), (0x4C7, 0x4C2))  # reader, writer: of publications, of subscriptions


def acknowledgement(sender: bytes, receivers: Iterable[bytes]) -> bytes:
    """Return the RTPS message that requests heartbeats from the discovery writers of participants.

    Args:
        sender: The GUID of the participant that requests them.
        receivers: The GUIDs of the participants.
    """
    message = bytearray(_HEADER + sender[:_PREFIX_SIZE])
    for receiver in receivers:
        message += _INFO_DST + receiver[:_PREFIX_SIZE]
        for reader, writer in _BUILTIN_ENDPOINTS:
            # Little endian, not final; the base 0 as a high and a low part, no missing numbers, the count 1.
            message += struct.pack("<BBH", _ACKNACK, 1, 24) + struct.pack(">II", reader, writer)
            message += struct.pack("<iIIi", 0, 0, 0, 1)
    return bytes(message)


class DiscoveryRequests:
    """Requests the endpoints of participants on Fast DDS that started before this process.

    Args:
        participant: The GUID of the participant of this process.
        domain: The domain ID.
        graph: The graph, which knows the other participants.
    """

    def __init__(self, participant: bytes, domain: int, graph: DdsGraph) -> None:
        self._participant = participant
        self._domain = domain
        self._graph = graph
        self._end = time.monotonic_ns() + _PERIOD
        self._known: set[bytes] = set()
        self._waiting: dict[bytes, int] = {}  # the participants to ask, and when

    def update(self) -> int:
        """Send the requests that are due. Return the time until the next call in nanoseconds."""
        now = time.monotonic_ns()
        if now < self._end:
            for guid in self._graph.participants() - self._known:
                self._known.add(guid)
                if vendors.vendor(guid) == vendors.FAST_DDS:
                    self._waiting[guid] = now + _DELAY
        due = [guid for guid, when in self._waiting.items() if when <= now]
        for guid in due:
            del self._waiting[guid]
        for start in range(0, len(due), _MAX_PARTICIPANTS):
            self._send(acknowledgement(self._participant, due[start : start + _MAX_PARTICIPANTS]))
        return min((when - now for when in self._waiting.values()), default=SECOND)

    def _send(self, message: bytes) -> None:
        # Cyclone DDS does not tell the ports of other participants, so all of this machine get the message, as they do
        # with an announcement.
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            for port in discovery_ports(self._domain):
                with contextlib.suppress(OSError):
                    sender.sendto(message, ("127.0.0.1", port))
