# SPDX-License-Identifier: Apache-2.0
"""The configuration of Fast DDS from the environment variables of ROS 2."""

from __future__ import annotations

import os
import re
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
_MAX_PORT: Final = 65535
# An empty entry stands for a server with another number. Fast DDS assumes UDPv4, and its own port.
_SERVER_ENTRY = re.compile(
    r"(?:(?:UDP|TCP)v[46]:)?(?:\[(?P<bracketed>[0-9A-Za-z.:\-]+)\]|(?P<host>[0-9A-Za-z.\-]+))(?::(?P<port>\d+))?"
)


class Config(NamedTuple):
    """The configuration of a participant.

    Attributes:
        range: "OFF", "LOCALHOST", "SUBNET" or "SYSTEM_DEFAULT".
        peers: The hosts in ROS_STATIC_PEERS.
        server: The discovery servers, which Fast DDS itself reads, or "" if there are none.
        profiles: The XML file of the user, or "" if there is none.
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
        _servers(environment),
        _profiles(environment),
        _choice(environment, _QOS_FROM_XML, ("0", "1")) == "1",
        _choice(environment, _MODE, ("SYNCHRONOUS", "ASYNCHRONOUS", "AUTO")) == "ASYNCHRONOUS",
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
                f"ROS_STATIC_PEERS contains {host!r}, whose address is unknown: {_reason(error)}.",
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
                raise WireError(f"{name}: {error}.", hint=f"Correct it, or unset {name}.") from None
            except OSError as error:
                raise WireError(
                    f"{name} is {path!r}, which cannot be read: {error.strerror}.", hint=f"Correct it, or unset {name}."
                ) from error
            return path
    return ""


def _servers(environment: Mapping[str, str]) -> str:
    """Return the discovery servers: entries HOST:PORT, separated by semicolons. Fast DDS reads them itself."""
    servers = environment.get(_SERVER, "").strip()
    for entry in servers.split(";"):
        if not (entry := entry.strip()):
            continue
        found = _SERVER_ENTRY.fullmatch(entry)
        if found is None or int(found["port"] or 0) > _MAX_PORT:
            raise WireError(
                f"{_SERVER} contains {entry!r}, which is not the address of a discovery server.",
                hint=f"Use HOST:PORT, with a port up to {_MAX_PORT}, and semicolons between servers: "
                f"{_SERVER}='192.168.1.7:11811'.",
            )
        host = found["bracketed"] or found["host"]
        try:
            socket.getaddrinfo(host, None)
        except OSError as error:
            raise WireError(
                f"{_SERVER} contains {host!r}, whose address is unknown: {_reason(error)}.",
                hint=f"Correct it, or unset {_SERVER} to discover nodes without a server.",
            ) from error
    return servers


def _choice(environment: Mapping[str, str], name: str, values: tuple[str, ...]) -> str:
    """Return a variable that has one of some values; the first one if it is not set."""
    value = environment.get(name, "").strip().upper() or values[0]
    if value not in values:
        raise WireError(
            f"{name} is {environment[name]!r}: it must be {', '.join(values[:-1])} or {values[-1]}.",
            hint=f"Unset it for the default, {values[0]}.",
        )
    return value


def _reason(error: OSError) -> str:
    return error.strerror or str(error)
