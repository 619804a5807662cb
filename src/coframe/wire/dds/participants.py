# SPDX-License-Identifier: Apache-2.0
"""Create participants of the DDS library."""

from __future__ import annotations

import socket

from coframe import _core
from coframe.errors import WireError
from coframe.wire import _descriptors
from coframe.wire.dds import config

_DESCRIPTORS = 16  # Cyclone DDS opens about 8, and more for each network interface; it crashes if none are left.


def join(domain: int, xml: str, user_data: str) -> _core.DomainParticipant:
    """Return a new participant in `domain`.

    Args:
        domain: The domain ID.
        xml: The configuration of Cyclone DDS.
        user_data: The DDS user data of the participant.

    Raises:
        WireError: DDS cannot create the participant.
    """
    _descriptors.check(_DESCRIPTORS, "DDS", domain)
    try:
        return _core.DomainParticipant(domain, xml, user_data)
    except _core.EndpointError as error:
        used, every = participant_indexes(domain)
        if used == every:
            raise WireError(
                f"Domain {domain} is full on this machine: all {every} participant indexes are in use.",
                hint="Stop some ROS processes, or use another domain: ROS_DOMAIN_ID=1.",
            ) from error
        raise WireError(
            f"Joining domain {domain} failed: {error}.",
            hint="DDS wrote the reason to stderr. If CYCLONEDDS_URI is set, check it. "
            "Otherwise, check that this machine has the configured network interface.",
        ) from error


def discovery_ports(domain: int) -> range:
    """Return the UDP ports for discovery that RTPS assigns to the participant indexes of `domain` on a machine.

    Those of high domains end at the last port.
    """
    first = 7400 + 250 * domain + 10
    return range(first, min(first + 2 * config.MAX_PARTICIPANT_INDEX, 65535) + 1, 2)


def participant_indexes(domain: int) -> tuple[int, int]:
    """Return the number of participant indexes of `domain` in use on this machine, and the total number."""
    ports = discovery_ports(domain)
    used = 0
    for port in ports:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                used += 1
    return used, len(ports)
