# SPDX-License-Identifier: Apache-2.0
"""Test Zenoh: open a session with the configuration of this environment, and report its connections."""

from __future__ import annotations

import time
from dataclasses import dataclass
from importlib.metadata import version
from typing import TYPE_CHECKING, Final

from coframe.wire.zenoh import config, connecting

if TYPE_CHECKING:
    from collections.abc import Mapping

_ROUTER_TIMEOUT: Final = 2.0  # seconds; a router on another network answers within a few round trips
_VARIABLES: Final = (config.SESSION_FILE, config.OVERRIDE)


@dataclass(frozen=True)
class ZenohProbe:
    """The connections of a Zenoh session of this process.

    Attributes:
        version: The version of eclipse-zenoh.
        configured_by: The environment variables that configure it; empty if it has the defaults.
        connect: The endpoints that it connects to.
        routers: The identifiers of the routers that it has found.
        peers: The number of discovered peers.
    """

    version: str
    configured_by: list[str]
    connect: list[str]
    routers: list[str]
    peers: int


def probe_session(environment: Mapping[str, str]) -> ZenohProbe:
    """Open a session, and wait up to 2 s for a router.

    Raises:
        WireError: Zenoh is not installed, its configuration is not valid, or a client finds no router.
    """
    chosen = config.session_config(environment)
    session = connecting.open_with(chosen)
    try:
        end = time.monotonic() + _ROUTER_TIMEOUT
        while not session.info.routers_zid() and time.monotonic() < end:
            time.sleep(0.02)
        return ZenohProbe(
            version=version("eclipse-zenoh"),
            configured_by=[name for name in _VARIABLES if environment.get(name, "").strip()],
            connect=config.connect_endpoints(chosen),
            routers=[str(router) for router in session.info.routers_zid()],
            peers=len(session.info.peers_zid()),
        )
    finally:
        session.close()  # type: ignore[no-untyped-call]
