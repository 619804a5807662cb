# SPDX-License-Identifier: Apache-2.0
"""DDS as a middleware of coframe: whether it is available, and how a process joins a domain through it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.wire.dds import library
from coframe.wire.dds.config import cyclone_config

if TYPE_CHECKING:
    from collections.abc import Mapping

    from coframe import _core
    from coframe.wire._backend import Session


class DdsMiddleware:
    """Cyclone DDS. Implements `coframe.wire._backend.Middleware`."""

    variables = (library.VARIABLE,)

    def is_available(self, environment: Mapping[str, str]) -> bool:
        """Return whether there is a file of the library."""
        return any(place.path is not None for place in library.places(environment))

    def check(self) -> None:
        """Check that there is a usable library, without loading it."""
        library.check()

    def describe(self) -> list[str]:
        """Return nothing: this middleware has its own examination."""
        return []

    def network(self, environment: Mapping[str, str]) -> str:
        """Return the configuration of Cyclone DDS."""
        return cyclone_config(environment)

    def join(self, domain: int, changed: _core.Event) -> Session:
        """Create a participant in a domain."""
        from coframe.wire import ros_security  # noqa: PLC0415 - the selection must be cheap
        from coframe.wire.dds.session import DdsSession  # noqa: PLC0415

        ros_security.report_unsupported("Cyclone DDS")

        return DdsSession(domain, changed)


MIDDLEWARE = DdsMiddleware()
