"""How far DDS reaches: ROS's environment variables as a configuration of Cyclone DDS."""

from __future__ import annotations

import os
import re
from html import escape
from typing import TYPE_CHECKING

from coframe.errors import WireError

if TYPE_CHECKING:
    from collections.abc import Mapping

MAX_DOMAIN_ID = 232
MAX_PARTICIPANT_INDEX = 99

_RANGES = ("OFF", "LOCALHOST", "SUBNET", "SYSTEM_DEFAULT")
_PEER = re.compile(r"[A-Za-z0-9_.:%\-]+")
_LOOPBACK = re.compile(r"localhost|127(\.\d+){3}|::1")


def domain_id(environment: Mapping[str, str] = os.environ) -> int:
    """The DDS domain: ROS_DOMAIN_ID, or 0.

    Raises:
        WireError: the variable does not hold a domain.
    """
    text = environment.get("ROS_DOMAIN_ID", "").strip()
    return check_domain_id(text or "0", "ROS_DOMAIN_ID is")


def check_domain_id(value: str | int, what: str = "domain") -> int:
    """`value` as the number of a domain.

    Raises:
        WireError: it is not a number from 0 to 232.
    """
    text = str(value)
    if not re.fullmatch(r"[0-9]{1,3}", text) or int(text) > MAX_DOMAIN_ID:
        raise WireError(
            f"{what} {text!r}: a domain is a number from 0 to {MAX_DOMAIN_ID}.",
            hint="Programs meet only in the same domain; 0 to 101 work on every platform.",
        )
    return int(text)


def discovery_range(environment: Mapping[str, str] = os.environ) -> str:
    """How far discovery reaches: "OFF", "LOCALHOST", "SUBNET" or "SYSTEM_DEFAULT".

    ROS_LOCALHOST_ONLY=1 comes first, then ROS_AUTOMATIC_DISCOVERY_RANGE, then ROS_LOCALHOST_ONLY=0, which in
    Humble asks for the network. With neither set: this machine only.

    Raises:
        WireError: a variable holds something else.
    """
    localhost_only = environment.get("ROS_LOCALHOST_ONLY", "").strip()
    if localhost_only not in ("", "0", "1"):
        raise WireError(
            f"ROS_LOCALHOST_ONLY is {localhost_only!r}: it must be 0 or 1.",
            hint="Use 1 to stay on this machine, or set ROS_AUTOMATIC_DISCOVERY_RANGE instead.",
        )
    wanted = environment.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "").strip().upper()
    if wanted not in ("", *_RANGES):
        raise WireError(
            f"ROS_AUTOMATIC_DISCOVERY_RANGE is {wanted!r}: it must be one of {', '.join(_RANGES)}.",
            hint="LOCALHOST stays on this machine, SUBNET opens the local network.",
        )
    if localhost_only == "1":
        return "LOCALHOST"
    return wanted or ("SUBNET" if localhost_only == "0" else "LOCALHOST")


def static_peers(environment: Mapping[str, str] = os.environ) -> list[str]:
    """The hosts of ROS_STATIC_PEERS, which are separated by semicolons.

    Raises:
        WireError: one of them is not a host.
    """
    peers = [peer.strip() for peer in environment.get("ROS_STATIC_PEERS", "").split(";")]
    for peer in peers:
        if peer and not _PEER.fullmatch(peer):
            raise WireError(
                f"ROS_STATIC_PEERS names {peer!r}: that is neither an address nor a host name.",
                hint="Separate the hosts by semicolons: ROS_STATIC_PEERS='192.168.1.7;robot.local'.",
            )
    return [peer for peer in peers if peer]


def cyclone_config(environment: Mapping[str, str] = os.environ) -> str:
    """The configuration for Cyclone DDS, with the user's own CYCLONEDDS_URI appended, which overrides it.

    Raises:
        WireError: a variable holds something else than ROS defines.
    """
    reach = discovery_range(environment)
    general = discovery = ""
    if reach == "OFF":
        general = "<AllowMulticast>false</AllowMulticast>"
        # The tag keeps participants of other processes out even if they know our port.
        discovery = f"<ParticipantIndex>none</ParticipantIndex><Tag>coframe_{os.getpid()}</Tag>"
    elif reach == "LOCALHOST":
        peers = static_peers(environment)
        general = _localhost(peers)
        discovery = _peers(["127.0.0.1", *peers])
    elif reach == "SUBNET" and (peers := static_peers(environment)):
        discovery = _peers(peers)
    xml = (
        f'<CycloneDDS><Domain id="any"><General>{general}</General>'
        f"<Discovery>{discovery}</Discovery></Domain></CycloneDDS>"
    )
    user = environment.get("CYCLONEDDS_URI", "").strip()
    return f"{xml},{user}" if user else xml


def _localhost(peers: list[str]) -> str:
    if all(_LOOPBACK.fullmatch(peer) for peer in peers):
        # Multicast on the loopback interface is how a Humble with ROS_LOCALHOST_ONLY announces itself.
        return (
            '<Interfaces><NetworkInterface address="127.0.0.1" multicast="true"/></Interfaces>'
            "<AllowMulticast>true</AllowMulticast>"
        )
    # A peer on another machine cannot be reached from the loopback interface.
    return "<AllowMulticast>false</AllowMulticast>"


def _peers(peers: list[str]) -> str:
    elements = "".join(f'<Peer address="{escape(peer)}"/>' for peer in peers)
    return (
        "<ParticipantIndex>auto</ParticipantIndex>"
        f"<MaxAutoParticipantIndex>{MAX_PARTICIPANT_INDEX}</MaxAutoParticipantIndex>"
        f"<Peers>{elements}</Peers>"
    )
