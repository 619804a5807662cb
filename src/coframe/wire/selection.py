# SPDX-License-Identifier: Apache-2.0
"""The middleware through which this process joins the ROS graph: DDS or Zenoh."""

from __future__ import annotations

import logging
import os
from typing import TYPE_CHECKING, Final, Literal, NamedTuple

from coframe.errors import WireError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from coframe import _core
    from coframe.wire.backend import Session

Wire = Literal["dds", "zenoh"]

VARIABLE: Final = "COFRAME_WIRE"
RMW_VARIABLE: Final = "RMW_IMPLEMENTATION"
ZENOH_RMW: Final = "rmw_zenoh_cpp"

_logger = logging.getLogger("coframe.wire")
_logged: list[Wire] = []  # the wires whose automatic choice is in the log


class Selection(NamedTuple):
    """The selected middleware, and why it was selected."""

    wire: Wire
    reason: str


def select(environment: Mapping[str, str] = os.environ) -> Selection:
    """Return the middleware to use.

    COFRAME_WIRE has priority. Otherwise it is Zenoh with RMW_IMPLEMENTATION=rmw_zenoh_cpp, and on a machine that has
    eclipse-zenoh but no DDS library.

    Raises:
        WireError: COFRAME_WIRE is neither "dds" nor "zenoh".
    """
    wire = environment.get(VARIABLE, "").strip().lower()
    if wire == "dds":
        return Selection("dds", f"{VARIABLE} is set")
    if wire == "zenoh":
        return Selection("zenoh", f"{VARIABLE} is set")
    if wire:
        raise WireError(f"{VARIABLE} is {wire!r}: it must be dds or zenoh.", hint=f"Unset {VARIABLE} to use DDS.")
    if environment.get(RMW_VARIABLE, "").strip() == ZENOH_RMW:
        return Selection("zenoh", f"{RMW_VARIABLE} is {ZENOH_RMW}")
    from coframe.wire.dds import library  # noqa: PLC0415 - an import only if the environment does not decide
    from coframe.wire.zenoh.library import is_installed  # noqa: PLC0415

    if environment.get(library.VARIABLE, "").strip():
        return Selection("dds", f"{library.VARIABLE} is set")
    if any(place.path is not None for place in library.places(environment)) or not is_installed():
        return Selection("dds", "it is the default")
    return Selection("zenoh", "there is no DDS library on this machine")


def check() -> None:
    """Check that the selected middleware is installed, without loading it.

    Raises:
        WireError: It is not installed, or COFRAME_WIRE is not valid.
    """
    if select().wire == "zenoh":
        from coframe.wire.zenoh import library as zenoh_library  # noqa: PLC0415

        zenoh_library.check()
    else:
        from coframe.wire.dds import library  # noqa: PLC0415

        library.check()


def network(environment: Mapping[str, str] = os.environ) -> str:
    """Return a text that is equal for processes that join the same network: the middleware with its configuration.

    Raises:
        WireError: An environment variable has an invalid value.
    """
    selected = select(environment)
    if selected.wire == "dds":
        from coframe.wire.dds.config import cyclone_config  # noqa: PLC0415 - loads only what is used

        return cyclone_config(environment)
    names = sorted(name for name in environment if name.startswith("ZENOH_"))
    return "zenoh " + repr([(name, environment[name]) for name in names])


def join(domain: int, changed: _core.Event) -> Session:
    """Join a ROS domain through the selected middleware.

    Args:
        domain: The domain ID.
        changed: Set whenever the graph may have changed.

    Raises:
        WireError: The middleware is not installed, its configuration is not valid, or it cannot join the domain.
    """
    selected = select()
    if selected.wire == "dds":
        from coframe.wire.dds.session import DdsSession  # noqa: PLC0415 - loads only what is used

        return DdsSession(domain, changed)
    if VARIABLE not in os.environ and RMW_VARIABLE not in os.environ and selected.wire not in _logged:
        _logged.append(selected.wire)
        _logger.warning("Zenoh is used: %s. %s=zenoh selects it without this message.", selected.reason, VARIABLE)
    from coframe.wire.zenoh import library as zenoh_library  # noqa: PLC0415

    zenoh_library.load()
    from coframe.wire.zenoh.session import ZenohSession  # noqa: PLC0415

    return ZenohSession(domain, changed)
