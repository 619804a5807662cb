# SPDX-License-Identifier: Apache-2.0
"""The Zenoh middleware: checks that it is available, and joins a domain through it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.wire.zenoh import _library

if TYPE_CHECKING:
    from collections.abc import Mapping

    from coframe import _core
    from coframe.wire._backend import Session


class ZenohMiddleware:
    """Zenoh in the conventions of rmw_zenoh_cpp. Implements `coframe.wire._backend.Middleware`."""

    variables = ()

    def is_available(self, environment: Mapping[str, str]) -> bool:
        """Return whether eclipse-zenoh is installed."""
        del environment
        return _library.is_installed()

    def check(self) -> None:
        """Check that eclipse-zenoh is installed, without importing it."""
        _library.check()

    def describe(self) -> list[str]:
        """Return nothing: this middleware has its own examination."""
        return []

    def network(self, environment: Mapping[str, str]) -> str:
        """Return the variables that configure Zenoh."""
        names = sorted(name for name in environment if name.startswith("ZENOH_"))
        return repr([(name, environment[name]) for name in names])

    def join(self, domain: int, changed: _core.Event) -> Session:
        """Open a session in a domain."""
        _library.load()
        from coframe.wire import ros_security  # noqa: PLC0415 - the selection must be cheap
        from coframe.wire.zenoh._session import ZenohSession  # noqa: PLC0415

        ros_security.report_unsupported("Zenoh")

        return ZenohSession(domain, changed)


MIDDLEWARE = ZenohMiddleware()
