# SPDX-License-Identifier: Apache-2.0
"""The configuration of Fast DDS from the environment variables of ROS 2."""

from __future__ import annotations

import os
import socket
from typing import TYPE_CHECKING, Final, NamedTuple

from coframe._files.regular_files import UnsuitableFileError, check_regular
from coframe.errors import WireError
from coframe.wire.dds.config import discovery_range, static_peers
from coframe_fastdds import _security as security

if TYPE_CHECKING:
    from collections.abc import Mapping

MAX_BYTES: Final = 16 << 20  # of a file with profiles
PROFILE_VARIABLES: Final = ("FASTDDS_DEFAULT_PROFILES_FILE", "FASTRTPS_DEFAULT_PROFILES_FILE")
_SERVER: Final = "ROS_DISCOVERY_SERVER"
_QOS_FROM_XML: Final = "RMW_FASTRTPS_USE_QOS_FROM_XML"
_MODE: Final = "RMW_FASTRTPS_PUBLICATION_MODE"
_MODES: Final = ("SYNCHRONOUS", "ASYNCHRONOUS", "AUTO")


class Config(NamedTuple):
    """The configuration of a participant.

    Attributes:
        range: "OFF", "LOCALHOST", "SUBNET" or "SYSTEM_DEFAULT".
        peers: The hosts in ROS_STATIC_PEERS.
        server: The discovery servers, which Fast DDS itself reads; "" if there are none.
        profiles: The XML file of the user; "" if there is none.
        qos_from_profiles: Whether endpoints use the profile with the name of their topic.
        asynchronous: Whether publishers send on a thread of Fast DDS.
        enclave: The name of the participant's enclave.
        properties: The properties that enable security.
    """

    range: str
    peers: tuple[str, ...]
    server: str
    profiles: str
    qos_from_profiles: bool
    asynchronous: bool
    enclave: str
    properties: tuple[tuple[str, str], ...]


def read(environment: Mapping[str, str] = os.environ) -> Config:
    """Return the configuration.

    Raises:
        WireError: An environment variable has an invalid value, or names a file that cannot be used.
    """
    enclave, properties = security.read(environment)
    return Config(
        discovery_range(environment),
        tuple(static_peers(environment)),
        environment.get(_SERVER, "").strip(),
        _profiles(environment),
        environment.get(_QOS_FROM_XML, "").strip() == "1",
        _publication_mode(environment) == "ASYNCHRONOUS",
        enclave,
        properties,
    )


def addresses(hosts: tuple[str, ...]) -> list[str]:
    """Return the IPv4 addresses of hosts.

    Raises:
        WireError: A host is unknown.
    """
    found: list[str] = []
    for host in hosts:
        try:
            found += {str(entry[4][0]) for entry in socket.getaddrinfo(host, None, socket.AF_INET)}
        except OSError as error:
            raise WireError(
                f"ROS_STATIC_PEERS contains {host!r}, whose address is unknown: {error}.",
                hint="Fast DDS needs an IPv4 address or a name that this machine can resolve.",
            ) from error
    return found


def _profiles(environment: Mapping[str, str]) -> str:
    """Return the XML file of the user. Fast DDS reads it itself."""
    for name in PROFILE_VARIABLES:
        if path := environment.get(name, "").strip():
            try:
                check_regular(path, MAX_BYTES)
            except UnsuitableFileError as error:
                raise WireError(f"{name}: {error}.") from None
            except OSError as error:
                raise WireError(
                    f"{name} is {path!r}, which cannot be read: {error.strerror}.", hint=f"Correct it, or unset {name}."
                ) from error
            return path
    return ""


def _publication_mode(environment: Mapping[str, str]) -> str:
    mode = environment.get(_MODE, "").strip().upper() or "SYNCHRONOUS"
    if mode not in _MODES:
        raise WireError(f"{_MODE} is {mode!r}: it must be one of {', '.join(_MODES)}.", hint=f"Unset {_MODE}.")
    return mode
