# SPDX-License-Identifier: Apache-2.0
"""The DDS implementations of other nodes, from the vendor ID that RTPS puts at the start of a GUID."""

from __future__ import annotations

_NAMES = {
    b"\x01\x01": "RTI Connext",
    b"\x01\x03": "OpenDDS",
    b"\x01\x0f": "Fast DDS",
    b"\x01\x10": "Cyclone DDS",
    b"\x01\x11": "GurumDDS",
    b"\x01\x12": "RustDDS",
}
# rmw_cyclonedds sends the client and the sequence number of a request in front of it. rmw_fastrtps sends them as inline
# QoS of the RTPS message (related_sample_identity), which the library of Cyclone DDS neither writes nor returns.
_OTHER_SERVICES = {"Fast DDS"}


def vendor(guid: bytes) -> str:
    """Return the DDS implementation that created an entity; "" if it is not known.

    Args:
        guid: The GUID of an endpoint or a participant.
    """
    return _NAMES.get(guid[:2], "")


def shares_services(guid: bytes) -> bool:
    """Return whether an endpoint of a service sends requests and replies as Cyclone DDS does."""
    return vendor(guid) not in _OTHER_SERVICES
