# SPDX-License-Identifier: Apache-2.0
"""Open Zenoh sessions and check for a router."""

from __future__ import annotations

import itertools
import logging
import os
import time
from typing import TYPE_CHECKING, Final

from coframe.errors import WireError
from coframe.wire.zenoh import _library, config

if TYPE_CHECKING:
    import zenoh

_CHECK_PERIOD: Final = 1.0  # seconds between two router checks
_START: Final = "Start a router: coframe router, or ros2 run rmw_zenoh_cpp rmw_zenohd."

_logger = logging.getLogger("coframe.wire")


def open_session() -> zenoh.Session:
    """Open a session with the configuration from the environment, and warn if it finds no router.

    Raises:
        WireError: Zenoh is not installed, the configuration is not valid, or a client finds no router.
    """
    chosen = config.session_config()
    session = open_with(chosen)
    try:
        if not _has_router(session):
            _logger.warning("%s", missing_router(config.connect_endpoints(chosen)))
    except BaseException:
        session.close()  # type: ignore[no-untyped-call]
        raise
    return session


def open_with(chosen: zenoh.Config) -> zenoh.Session:
    """Open a session with a configuration.

    Raises:
        WireError: The configuration is not valid, or a client finds no router.
    """
    module = _library.load()
    endpoints = " or ".join(config.connect_endpoints(chosen)) or "no endpoint"
    try:
        session: zenoh.Session = module.open(chosen)
    except module.ZError as error:
        raise WireError(
            f"Opening a Zenoh session to {endpoints} failed: {config.reason_of(error)}.",
            hint=f"{_START} If {config.SESSION_FILE} or {config.OVERRIDE} is set, check it.",
        ) from error
    return session


def missing_router(endpoints: list[str]) -> str:
    """Return the warning that there is no router at the given endpoints."""
    routers = " or ".join(endpoints) or "any endpoint"
    if config.is_configured():
        return f"There is no Zenoh router at {routers}, so other processes are not found until it runs. {_START}"
    return (
        f"There is no Zenoh router at {routers}, so only processes of coframe on this machine are found, not the nodes "
        f"of ROS 2. {_START}"
    )


def _has_router(session: zenoh.Session) -> bool:
    """Check for a router as often as ZENOH_ROUTER_CHECK_ATTEMPTS specifies. Return True if the check is skipped."""
    attempts = config.router_check_attempts(os.environ)
    if attempts == 0:
        return True
    for attempt in itertools.count(1):
        if session.info.routers_zid():
            return True
        if attempt == attempts:
            break
        time.sleep(_CHECK_PERIOD)
    return False
