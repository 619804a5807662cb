# SPDX-License-Identifier: Apache-2.0
"""The middleware through which a connection joins the ROS graph. Each middleware is a row of `MIDDLEWARES`.

A call may name it (`coframe.connect(wire="zenoh")`), and so may the command line of a process (``--wire zenoh``).
Otherwise the environment decides; see `select`. Connections of one process may use different middlewares: each
middleware and domain has its own participant.
"""

from __future__ import annotations

import logging
import os
from importlib import import_module
from typing import TYPE_CHECKING, Final, NamedTuple, cast

from coframe._process.python_children import pass_to_children
from coframe.errors import WireError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from coframe import _core
    from coframe.wire._backend import Middleware, Session

VARIABLE: Final = "COFRAME_WIRE"
RMW_VARIABLE: Final = "RMW_IMPLEMENTATION"

_logger = logging.getLogger("coframe.wire")


class MiddlewareRow(NamedTuple):
    """A middleware that can be selected.

    Attributes:
        wire: Its name in COFRAME_WIRE, ``--wire`` and ``wire=``.
        title: Its name in texts.
        module: The module that contains it as ``MIDDLEWARE``. It is imported only when the middleware is considered.
        rmw_name: What the names of its implementations of ROS 2 contain, such as "zenoh" for rmw_zenoh_cpp; "" for all
            that no other row recognizes.
        rmw: The implementation of ROS 2 that communicates best with it.
        rmw_selects_it: Whether RMW_IMPLEMENTATION with this value selects it for coframe as well.
    """

    wire: str
    title: str
    module: str
    rmw_name: str
    rmw: str
    rmw_selects_it: bool

    def load(self) -> Middleware:
        """Return the middleware."""
        return cast("Middleware", import_module(self.module).MIDDLEWARE)


# If the environment does not decide, the first one that is available is used.
MIDDLEWARES: Final = (
    MiddlewareRow("dds", "DDS", "coframe.wire.dds.middleware", "", "rmw_cyclonedds_cpp", rmw_selects_it=False),
    MiddlewareRow("zenoh", "Zenoh", "coframe.wire.zenoh.middleware", "zenoh", "rmw_zenoh_cpp", rmw_selects_it=True),
)
DEFAULT: Final = MIDDLEWARES[0]
WIRES: Final = tuple(row.wire for row in MIDDLEWARES)

_chosen: dict[str, str] = {}  # the wire that the command line has chosen for this process
_logged: set[str] = set()  # the middlewares whose automatic selection was logged


class Selection(NamedTuple):
    """The selected middleware, and why it was selected."""

    wire: str
    reason: str


def row_of(wire: str) -> MiddlewareRow:
    """Return the row of a middleware.

    Raises:
        WireError: There is no middleware of this name.
    """
    for row in MIDDLEWARES:
        if row.wire == wire:
            return row
    raise WireError(f"{wire!r} is not a middleware.", hint=f"Valid names: {alternatives()}.")


def row_of_rmw(implementation: str) -> MiddlewareRow:
    """Return the row of the middleware that an implementation of ROS 2 uses: that of Zenoh for "rmw_zenoh_cpp"."""
    return next((row for row in MIDDLEWARES if row.rmw_name and row.rmw_name in implementation), DEFAULT)


def alternatives() -> str:
    """Return the names of all middlewares as a text: "dds or zenoh"."""
    return " or ".join(WIRES)


def choose(wire: str) -> None:
    """Choose the middleware of this process, as ``--wire`` does. Processes that it starts use the same.

    Raises:
        WireError: There is no middleware of this name.
    """
    _chosen["wire"] = row_of(wire).wire
    pass_to_children(VARIABLE, wire)


def select(environment: Mapping[str, str] = os.environ) -> Selection:
    """Return the middleware to use where a call does not name one.

    The first of these decides: ``--wire``; COFRAME_WIRE; RMW_IMPLEMENTATION=rmw_zenoh_cpp; a variable that configures
    only one middleware (COFRAME_DDS_LIBRARY); what is installed, DDS first.

    Args:
        environment: The environment variables. ``--wire`` has priority only over those of this process.

    Raises:
        WireError: COFRAME_WIRE has an invalid value.
    """
    return _requested(environment) or _installed(environment)


def _requested(environment: Mapping[str, str]) -> Selection | None:
    """Return the middleware that the user asks for; None if there is no such wish."""
    if environment is os.environ and _chosen:
        return Selection(_chosen["wire"], "--wire is given")
    if wire := environment.get(VARIABLE, "").strip().lower():
        if wire not in WIRES:
            hint = f"Unset {VARIABLE} to use {DEFAULT.title}."
            raise WireError(f"{VARIABLE} is {wire!r}: it must be {alternatives()}.", hint=hint)
        return Selection(wire, f"{VARIABLE} is set")
    implementation = environment.get(RMW_VARIABLE, "").strip()
    for row in MIDDLEWARES:
        if row.rmw_selects_it and implementation == row.rmw:
            return Selection(row.wire, f"{RMW_VARIABLE} is {implementation}")
    for row in MIDDLEWARES:
        for name in row.load().variables:
            if environment.get(name, "").strip():
                return Selection(row.wire, f"{name} is set")
    return None


def _installed(environment: Mapping[str, str]) -> Selection:
    """Return the first middleware that is available; the default if there is none."""
    first = next((row for row in MIDDLEWARES if row.load().is_available(environment)), DEFAULT)
    if first is DEFAULT:
        return Selection(first.wire, "it is the default")
    return Selection(first.wire, f"there is no {DEFAULT.title} library on this machine")


def check(wire: str | None = None) -> None:
    """Check that a middleware is installed, without loading it.

    Args:
        wire: The middleware. If None, it is the selected one.

    Raises:
        WireError: It is not installed, or the selection is not valid.
    """
    row_of(wire or select().wire).load().check()


def network(wire: str, environment: Mapping[str, str] = os.environ) -> str:
    """Return a string that identifies the network: the middleware with its configuration.

    Raises:
        WireError: An environment variable has an invalid value.
    """
    return f"{wire} {row_of(wire).load().network(environment)}"


def resolve(wire: str | None) -> str:
    """Return the middleware that a call asks for: the selected one if it names none.

    Raises:
        WireError: There is no middleware of this name, or the selection is not valid.
    """
    if wire is not None:
        return row_of(wire).wire
    if requested := _requested(os.environ):
        return requested.wire
    found = _installed(os.environ)
    if found.wire != DEFAULT.wire and found.wire not in _logged:
        _logged.add(found.wire)
        title, reason = row_of(found.wire).title, found.reason
        _logger.warning("%s is used: %s. %s=%s selects it without this message.", title, reason, VARIABLE, found.wire)
    return found.wire


def join(wire: str, domain: int, changed: _core.Event) -> Session:
    """Join a ROS domain through a middleware.

    Args:
        wire: The middleware.
        domain: The domain ID.
        changed: Set when the graph may have changed.

    Raises:
        WireError: The middleware is not installed, its configuration is not valid, or it cannot join the domain.
    """
    return row_of(wire).load().join(domain, changed)
