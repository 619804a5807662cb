# SPDX-License-Identifier: Apache-2.0
"""The middleware through which a connection joins the ROS graph. Each middleware is a row of `middlewares`.

Other distributions add rows through the entry points `GROUP`, as coframe-fastdds does.

A call may name it (`coframe.connect(wire="zenoh")`), and so may the command line of a process (``--wire zenoh``).
Otherwise the environment decides; see `select`. Connections of one process may use different middlewares: each
middleware and domain has its own participant.
"""

from __future__ import annotations

import logging
import os
from importlib import import_module
from typing import TYPE_CHECKING, Final, NamedTuple, cast

from coframe._process.plugins import load_plugins, plugins
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
        title: Its name in messages.
        module: The module that contains it as ``MIDDLEWARE``. It is imported only when the middleware is considered.
        rmw_name: The common part of the names of its ROS 2 implementations, such as "zenoh" for rmw_zenoh_cpp; "" for
        all
            that no other row recognizes.
        rmw: The implementation of ROS 2 that communicates best with it.
        protocol: What it sends over the network: middlewares with the same protocol find each other.
        rmw_selects_it: Whether RMW_IMPLEMENTATION with such a name selects it for coframe as well.
    """

    wire: str
    title: str
    module: str
    rmw_name: str
    rmw: str
    protocol: str
    rmw_selects_it: bool

    def load(self) -> Middleware:
        """Return the middleware."""
        return cast("Middleware", import_module(self.module).MIDDLEWARE)


DEFAULT: Final = MiddlewareRow(
    "dds", "DDS", "coframe.wire.dds.middleware", "", "rmw_cyclonedds_cpp", "rtps", rmw_selects_it=False
)
ZENOH: Final = MiddlewareRow(
    "zenoh", "Zenoh", "coframe.wire.zenoh.middleware", "zenoh", "rmw_zenoh_cpp", "zenoh", rmw_selects_it=True
)
GROUP: Final = "coframe.middlewares"  # the entry points whose objects are rows

_command_line_choice: dict[str, str] = {}  # the wire that the command line has chosen for this process
_logged: set[str] = set()  # the middlewares whose automatic selection was logged


class Selection(NamedTuple):
    """The selected middleware, and why it was selected."""

    wire: str
    reason: str


def middlewares() -> tuple[MiddlewareRow, ...]:
    """Return the rows of all middlewares. If the environment does not decide, the first that is available is used."""
    return (DEFAULT, *(row for _, row in load_plugins(GROUP, _logger.warning)), ZENOH)


def wires() -> tuple[str, ...]:
    """Return the names of all middlewares."""
    return (DEFAULT.wire, *(plugin.name for plugin in plugins(GROUP)), ZENOH.wire)


def row_of(wire: str) -> MiddlewareRow:
    """Return the row of a middleware.

    Raises:
        WireError: There is no middleware of this name.
    """
    if wire == DEFAULT.wire:  # without a look at the entry points
        return DEFAULT
    for row in middlewares():
        if row.wire == wire:
            return row
    raise WireError(f"{wire!r} is not a middleware.", hint=f"Valid names: {alternatives()}.")


def row_of_rmw(implementation: str) -> MiddlewareRow:
    """Return the row of the middleware that a ROS 2 implementation uses: Zenoh for "rmw_zenoh_cpp"."""
    return next((row for row in middlewares() if row.rmw_name and row.rmw_name in implementation), DEFAULT)


def alternatives() -> str:
    """Return the names of all middlewares as a string: "dds or zenoh"."""
    *others, last = wires()
    return f"{', '.join(others)} or {last}"


def choose(wire: str) -> None:
    """Choose the middleware of this process, as ``--wire`` does. Processes that it starts use the same.

    Raises:
        WireError: There is no middleware of this name.
    """
    _command_line_choice["wire"] = row_of(wire).wire
    pass_to_children(VARIABLE, wire)


def select(environment: Mapping[str, str] = os.environ) -> Selection:
    """Return the middleware to use where a call does not name one.

    The first of these decides: ``--wire``; COFRAME_WIRE; RMW_IMPLEMENTATION=rmw_zenoh_cpp, or rmw_fastrtps_cpp where
    coframe-fastdds is installed; a variable that configures only one middleware (COFRAME_DDS_LIBRARY); the installed
    libraries, DDS first.

    Args:
        environment: The environment variables. ``--wire`` has priority only over the variables of this process.

    Raises:
        WireError: COFRAME_WIRE has an invalid value.
    """
    return _requested_middleware(environment) or _installed_middleware(environment)


def _requested_middleware(environment: Mapping[str, str]) -> Selection | None:
    """Return the middleware that the user has selected, or None if there is no selection."""
    if environment is os.environ and _command_line_choice:
        return Selection(_command_line_choice["wire"], "--wire is given")
    if wire := environment.get(VARIABLE, "").strip().lower():
        if wire not in wires():
            hint = f"Unset {VARIABLE} to use {DEFAULT.title}."
            raise WireError(f"{VARIABLE} is {wire!r}: it must be {alternatives()}.", hint=hint)
        return Selection(wire, f"{VARIABLE} is set")
    rows = middlewares()
    implementation = environment.get(RMW_VARIABLE, "").strip()
    for row in rows:
        if row.rmw_selects_it and row.rmw_name in implementation:
            return Selection(row.wire, f"{RMW_VARIABLE} is {implementation}")
    for row in rows:
        for name in row.load().variables:
            if environment.get(name, "").strip():
                return Selection(row.wire, f"{name} is set")
    return None


def _installed_middleware(environment: Mapping[str, str]) -> Selection:
    """Return the first middleware that is available, or the default if there is none."""
    first = next((row for row in middlewares() if row.load().is_available(environment)), DEFAULT)
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
    """Return the middleware of a call: the given one, or the selected one if none is given.

    Raises:
        WireError: There is no middleware of this name, or the selection is not valid.
    """
    if wire is not None:
        return row_of(wire).wire
    if requested := _requested_middleware(os.environ):
        return requested.wire
    found = _installed_middleware(os.environ)
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
