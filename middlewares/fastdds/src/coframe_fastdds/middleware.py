# SPDX-License-Identifier: Apache-2.0
"""Fast DDS as a middleware of coframe: whether it is usable, and how a process joins a domain through it."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import TYPE_CHECKING

from coframe.errors import WireError
from coframe_fastdds import _config as config
from coframe_fastdds import _leftovers, _libraries

if TYPE_CHECKING:
    from collections.abc import Mapping

    from coframe import _core
    from coframe.wire._backend import Session


class FastDdsMiddleware:
    """Fast DDS. Implements `coframe.wire._backend.Middleware`."""

    variables = ()

    def is_available(self, environment: Mapping[str, str]) -> bool:
        """Return whether the native module is installed."""
        del environment
        return importlib.util.find_spec("coframe_fastdds._fastdds") is not None

    def check(self) -> None:
        """Check that the native module and the library can be loaded."""
        load()

    def describe(self) -> list[str]:
        """Return the libraries, which one is used and why, what configures it, and what killed processes have left.

        Raises:
            WireError: It cannot be loaded, or an environment variable has an invalid value.
        """
        load()
        native = importlib.import_module("coframe_fastdds._fastdds")
        settings = config.read()
        memory = "shared memory and UDP" if native.SHARES_MEMORY else "UDP"
        lines = [
            *_libraries.lines(Path(native.library()), native.VERSION),
            f"messages within this machine use {memory}",
        ]
        if native.SHARES_MEMORY and (left := _leftovers.line()):
            lines.append(left)
        if not native.HAS_SECURITY:
            lines.append("the library was compiled without security")
        if settings.server:
            lines.append(f"discovery through the server {settings.server}")
        if settings.profiles:
            lines.append(f"configured by the profiles in {settings.profiles}")
        if settings.properties:
            lines.append(f"security is enabled, with the enclave {settings.enclave}")
        return lines

    def network(self, environment: Mapping[str, str]) -> str:
        """Return the variables that configure Fast DDS."""
        return repr(config.read(environment))

    def join(self, domain: int, changed: _core.Event) -> Session:
        """Create a participant in a domain."""
        load()
        from coframe_fastdds._session import FastDdsSession  # noqa: PLC0415 - the selection must be cheap

        return FastDdsSession(domain, changed)


def load() -> None:
    """Load the native module and with it the library.

    Raises:
        WireError: The module or the library is missing, or does not fit this coframe.
    """
    try:
        importlib.import_module("coframe_fastdds._fastdds")
    except ImportError as error:
        raise WireError(
            f"Fast DDS cannot be used: {error}.",
            hint="Install coframe-fastdds again, with the library that this process finds, or use Cyclone DDS: "
            "COFRAME_WIRE=dds.",
        ) from error


MIDDLEWARE = FastDdsMiddleware()
