# SPDX-License-Identifier: Apache-2.0
"""The configuration of Cyclone DDS from the environment variables of ROS 2."""

from __future__ import annotations

import os
import re
import sys
from html import escape
from typing import TYPE_CHECKING

from coframe._files.regular_files import UnsuitableFileError, check_regular
from coframe.errors import WireError

if TYPE_CHECKING:
    from collections.abc import Mapping

MAX_PARTICIPANT_INDEX = 99
MAX_BYTES = 16 << 20  # of a configuration file
_FILE = "file://"

# Large messages are sent in fragments, and a reader requests up to 256 lost ones at a time. Fragments about as large as
# the datagrams of Cyclone DDS (14720 bytes) need a tenth of the requests: Fast DDS receives 40 MB in 1 s instead of 12
# s.
_SIZES = "<FragmentSize>14000B</FragmentSize>"

# A packet of the loopback interface has up to 64 kB, so that 1 MB needs 16 system calls instead of 72.
_LOOPBACK_SIZES = "<MaxMessageSize>65000B</MaxMessageSize><FragmentSize>64000B</FragmentSize>"

# A dedicated thread for data waits in recvmsg. Without it, one thread first waits for all sockets in epoll_wait, which
# is a second system call per message. Cyclone DDS stops such a thread with a packet to its own address, which is
# guaranteed to arrive only on the loopback interface: another interface can disappear.
_LOOPBACK_THREADS = "<MultipleReceiveThreads>true</MultipleReceiveThreads>"

# A reader that has requested a lost message requests it again after 3 s if the writer does not respond. On the
# loopback interface, responses take less than 1 ms, except those of Fast DDS about its endpoints, which take 100 ms
# (see _discovery_requests).
_LOOPBACK_REQUESTS = "<AutoReschedNackDelay>110ms</AutoReschedNackDelay>"

# Received datagrams are appended to a buffer. In a process that receives little, the default buffer of 1 MiB takes a
# quarter of an hour to fill, and memory grows during that time. Clouds of 1 MB take the same time
# (benchmarks.publishing).
_RECEIVE_BUFFERS = "<ReceiveBufferSize>256KiB</ReceiveBufferSize>"

# A lost message is sent again after a heartbeat from its writer and the response of its reader, both of which may also
# be lost. With Cyclone DDS's own intervals of 100 ms, messages are lost for good at 30 % packet loss, because a writer
# of transforms keeps only the last 100 messages. The writer sends heartbeats only while acknowledgements are
# outstanding, and doubles the interval up to the maximum: the longer the maximum, the faster many processes discover
# each other.
_RETRANSMISSION = (
    '<NackDelay>10ms</NackDelay><HeartbeatInterval min="5ms" minsched="10ms" max="2s">20ms</HeartbeatInterval>'
)

# Fast DDS identifies a closed endpoint or participant by its key hash. Without one, it would keep them until the lease
# of the participant expires (10 s), show nodes that have ended, and wait for acknowledgements from closed readers. Only
# discovery messages have keys, so that others remain as they are.
_KEY_HASH = "<GenerateKeyhash>true</GenerateKeyhash>"

# Hosts that could not reach each other for longer than the lease of 10 s find each other again by these announcements.
# One multicast datagram is sent per interval; with static peers it would be one for each possible port of each peer.
_ANNOUNCEMENTS = "<SPDPInterval>2s</SPDPInterval>"

# Humble with ROS_LOCALHOST_ONLY announces participants by multicast on the loopback interface.
_LOOPBACK_INTERFACE = (
    '<Interfaces><NetworkInterface address="127.0.0.1" multicast="true"/></Interfaces>'
    "<AllowMulticast>true</AllowMulticast>"
)

# Peers are configured where multicast is not delivered. Cyclone DDS would still use multicast for data with several
# receivers, and they would not notice what they miss.
_UNICAST_DATA = "<AllowMulticast>spdp</AllowMulticast>"

_RANGES = ("OFF", "LOCALHOST", "SUBNET", "SYSTEM_DEFAULT")
_default = {"range": "LOCALHOST"}
_PEER = re.compile(r"[A-Za-z0-9_.:%\-]+")
_LOOPBACK = re.compile(r"localhost|127(\.\d+){3}|::1")


def reach_subnet_by_default() -> None:
    """Let this process discover nodes on the local network by default, like ROS 2."""
    _default["range"] = "SUBNET"


def discovery_range(environment: Mapping[str, str] = os.environ) -> str:
    """Return the discovery range: "OFF", "LOCALHOST", "SUBNET" or "SYSTEM_DEFAULT".

    ROS_LOCALHOST_ONLY=1 has priority, then ROS_AUTOMATIC_DISCOVERY_RANGE, then ROS_LOCALHOST_ONLY=0, which enables the
    network in Humble. If neither is set, the range is "LOCALHOST"; see also `reach_subnet_by_default`.

    Raises:
        WireError: A variable has an invalid value.
    """
    localhost_only = environment.get("ROS_LOCALHOST_ONLY", "").strip()
    if localhost_only not in ("", "0", "1"):
        raise WireError(
            f"ROS_LOCALHOST_ONLY is {localhost_only!r}: it must be 0 or 1.",
            hint="Use 1 to communicate only on this machine, or set ROS_AUTOMATIC_DISCOVERY_RANGE instead.",
        )
    requested = environment.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "").strip().upper()
    if requested not in ("", *_RANGES):
        raise WireError(
            f"ROS_AUTOMATIC_DISCOVERY_RANGE is {requested!r}: it must be one of {', '.join(_RANGES)}.",
            hint="LOCALHOST restricts discovery to this machine, SUBNET includes the local network.",
        )
    if localhost_only == "1":
        return "LOCALHOST"
    return requested or ("SUBNET" if localhost_only == "0" else _default["range"])


def static_peers(environment: Mapping[str, str] = os.environ) -> list[str]:
    """Return the hosts in ROS_STATIC_PEERS, a list separated by semicolons.

    Raises:
        WireError: An entry is not an address or a host name.
    """
    peers = [peer.strip() for peer in environment.get("ROS_STATIC_PEERS", "").split(";")]
    for peer in peers:
        if peer and not _PEER.fullmatch(peer):
            raise WireError(
                f"ROS_STATIC_PEERS contains {peer!r}, which is not an address or a host name.",
                hint="Separate the hosts with semicolons: ROS_STATIC_PEERS='192.168.1.7;robot.local'.",
            )
    return [peer for peer in peers if peer]


def reaches_other_machines(environment: Mapping[str, str] = os.environ) -> bool:
    """Return whether the discovery range includes other machines.

    Raises:
        WireError: An environment variable has an invalid value.
    """
    allowed = discovery_range(environment)
    return allowed != "OFF" and (allowed != "LOCALHOST" or not _on_this_machine(static_peers(environment)))


def cyclone_config(environment: Mapping[str, str] = os.environ) -> str:
    """Return the configuration for Cyclone DDS. The user's CYCLONEDDS_URI is appended and overrides it.

    Raises:
        WireError: An environment variable has an invalid value, or names a file that is not regular.
    """
    allowed = discovery_range(environment)
    general, internal = _SIZES, _RETRANSMISSION + _KEY_HASH
    if allowed == "OFF":
        general += "<AllowMulticast>false</AllowMulticast>"
        # The tag excludes participants of other processes, even if they use the same port.
        discovery = f"<ParticipantIndex>none</ParticipantIndex><Tag>coframe_{os.getpid()}</Tag>"
    elif allowed == "LOCALHOST":
        peers = static_peers(environment)
        discovery = _peers(["127.0.0.1", *peers])
        if not _on_this_machine(peers):
            # A peer on another machine cannot be reached from the loopback interface.
            general += "<AllowMulticast>false</AllowMulticast>"
        else:
            if sys.platform == "linux":
                general, internal = _LOOPBACK_SIZES, internal + _LOOPBACK_THREADS
            general += _LOOPBACK_INTERFACE
            internal += _LOOPBACK_REQUESTS
    else:
        peers = static_peers(environment) if allowed == "SUBNET" else []
        discovery = _peers(peers) if peers else _ANNOUNCEMENTS
        general += _UNICAST_DATA if peers else ""
    xml = (
        f'<CycloneDDS><Domain id="any"><General>{general}</General>'
        f"<Discovery>{discovery}</Discovery><Internal>{internal}</Internal><Sizing>{_RECEIVE_BUFFERS}</Sizing>"
        "</Domain></CycloneDDS>"
    )
    user = environment.get("CYCLONEDDS_URI", "").strip()
    _check_files(user)
    return f"{xml},{user}" if user else xml


def _check_files(user: str) -> None:
    """Raise WireError if Cyclone DDS would wait for a file in CYCLONEDDS_URI, or read one that never ends."""
    for part in map(str.strip, user.split(",")):
        if part.startswith(_FILE) or (part and "<" not in user):
            try:
                check_regular(part.removeprefix(_FILE), MAX_BYTES)
            except UnsuitableFileError as error:
                raise WireError(f"CYCLONEDDS_URI: {error}.") from None
            except OSError:
                continue  # Cyclone DDS reports a missing file itself.


def _on_this_machine(peers: list[str]) -> bool:
    return all(_LOOPBACK.fullmatch(peer) for peer in peers)


def _peers(peers: list[str]) -> str:
    elements = "".join(f'<Peer address="{escape(peer)}"/>' for peer in peers)
    return (
        "<ParticipantIndex>auto</ParticipantIndex>"
        f"<MaxAutoParticipantIndex>{MAX_PARTICIPANT_INDEX}</MaxAutoParticipantIndex>"
        f"<Peers>{elements}</Peers>"
    )
