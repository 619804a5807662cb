# SPDX-License-Identifier: Apache-2.0
"""The DDS implementations of other nodes, from the vendor ID that RTPS puts at the start of a GUID."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from coframe.wire.qos import QoS

FAST_DDS: Final = "Fast DDS"
_NAMES = {
    b"\x01\x01": "RTI Connext",
    b"\x01\x03": "OpenDDS",
    b"\x01\x0f": FAST_DDS,
    b"\x01\x10": "Cyclone DDS",
    b"\x01\x11": "GurumDDS",
    b"\x01\x12": "RustDDS",
}
# rmw_cyclonedds sends the client ID and the sequence number of a request before its payload. rmw_fastrtps and, by
# default, the others send them as inline QoS of the RTPS message (related_sample_identity), which the library of
# Cyclone DDS neither writes nor returns. A server that expects one form misreads the other.
_SAME_SERVICES = {"Cyclone DDS"}

_HEADER_PARTITION: Final = "request-header"
HEADER_PARTITIONS: Final = ("", _HEADER_PARTITION)
"""The partitions of endpoints on Fast DDS that use the request header of Cyclone DDS. They match all others."""

SERVICE_PARTITIONS: Final = ("*", _HEADER_PARTITION)
"""The partitions of the writers of requests and of the readers of requests and replies, which Fast DDS does not match.

Most endpoints are in the default partition, the empty name. Cyclone DDS matches "*" with it, as the DDS standard says.
Fast DDS compares patterns only with names in the list of the other side, which is empty. Patterns do not match each
other, so that the endpoints of two processes that use coframe match by the second name.

Writers of replies are in the default partition: a client on Fast DDS ignores replies without its identity. Cyclone DDS
itself matches a Fast DDS reader with "*". It waits for acknowledgements that the reader never sends (1 s when the
writer is closed), and keeps messages for it; therefore writers have these partitions only where necessary.
"""
_WITHOUT_DEFAULT_PARTITION = {FAST_DDS}


def vendor(guid: bytes) -> str:
    """Return the DDS implementation that created an entity, or "" if it is unknown.

    Args:
        guid: The GUID of an endpoint or a participant.
    """
    return _NAMES.get(guid[:2], "")


def unknown_vendor(guid: bytes) -> str:
    """Return a name for an unknown DDS implementation."""
    return f"an unknown DDS implementation (vendor ID {guid[0]}.{guid[1]})"


def uses_request_header(guid: bytes) -> bool:
    """Return whether the DDS implementation of an endpoint sends requests and replies as Cyclone DDS does."""
    return vendor(guid) in _SAME_SERVICES


def shares_services(guid: bytes, partitions: tuple[str, ...]) -> bool:
    """Return whether an endpoint of a service understands requests and replies of Cyclone DDS.

    Args:
        guid: The GUID of the endpoint.
        partitions: Its partitions, which tell whether it belongs to a process that uses coframe on Fast DDS.
    """
    return uses_request_header(guid) or _HEADER_PARTITION in partitions


def uses_service_partitions(qos: QoS) -> bool:
    """Return whether writers of requests have `SERVICE_PARTITIONS`.

    A writer with the history KEEP_ALL stops if a reader that it matches does not acknowledge messages.
    """
    return not qos.keep_all


def ignores_service_partitions(guid: bytes, partitions: tuple[str, ...]) -> bool:
    """Return whether an endpoint never matches `SERVICE_PARTITIONS`.

    Args:
        guid: The GUID of the endpoint.
        partitions: Its partitions; empty for the default partition.
    """
    return vendor(guid) in _WITHOUT_DEFAULT_PARTITION and not partitions
