# SPDX-License-Identifier: Apache-2.0
"""A Zenoh router: a session in router mode that reports connections."""

from __future__ import annotations

import json
import os
import re
import socket
import threading
import time
from typing import TYPE_CHECKING, Final

from coframe.errors import WireError
from coframe.wire.zenoh import _library
from coframe.wire.zenoh import config as configuration

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from types import TracebackType

    from typing_extensions import Self

    import zenoh

# rmw_zenoh_cpp's router listens on all interfaces.
LOOPBACK: Final = "tcp/127.0.0.1:7447"
_ALL_INTERFACES: Final = ("0.0.0.0", "[::]")  # noqa: S104 - recognized, not listened on
_MAX_LINES: Final = 20
_WINDOW: Final = 10.0  # seconds
_SYSTEM_ERROR: Final = re.compile(r"([A-Z][^\[\]:()]*) \(os error \d+\)")


class Router:
    """A running router.

    Args:
        file: The configuration file, which replaces the defaults, or "" for the file in ZENOH_ROUTER_CONFIG_URI, or the
            defaults of ROS 2.
        listen: The endpoints to listen on. If empty, the endpoints in the configuration, or port 7447 of the loopback
        interface
            without a configuration.
        connect: The endpoints of other routers to connect to. If empty, the endpoints in the configuration.
        environment: The environment variables.

    Raises:
        WireError: Zenoh is not installed, the configuration is not valid, or an endpoint is in use.

    Attributes:
        endpoints: The endpoints that the router listens on.
    """

    def __init__(
        self,
        *,
        file: str = "",
        listen: Sequence[str] = (),
        connect: Sequence[str] = (),
        environment: Mapping[str, str] = os.environ,
    ) -> None:
        if not listen and not _chooses_endpoints(file, environment):
            listen = [LOOPBACK]
        config = configuration.router_config(
            environment, file=file, listen=list(listen) or None, connect=list(connect) or None
        )
        self.endpoints = configuration.endpoints(config, "listen")
        self._session = _open(config, self.endpoints)
        self._connections: _Connections | None = None

    def report_connections(self, report: Callable[[str], None]) -> None:
        """Report the connected processes, and from now on each one that connects or disconnects.

        Args:
            report: Called with a line of text, on a thread of Zenoh. If there are too many lines, some are omitted.
        """
        self._connections = _Connections(report)
        self._session.info.declare_link_events_listener(self._connections.note, history=True)

    def report_omitted(self) -> None:
        """Report how many lines were omitted, if that is due. Call this every second."""
        if self._connections:
            self._connections.end_window()

    def close(self) -> None:
        """Stop the router, which closes all connections."""
        self._session.close()  # type: ignore[no-untyped-call]

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()


def how_to_reach(endpoint: str) -> str:
    """Return a description of how nodes reach a router that listens on this endpoint."""
    if endpoint in {LOOPBACK, configuration.DEFAULT_ROUTER}:
        return "Nodes on this machine find it without settings."
    protocol, _, address = endpoint.partition("/")
    host, _, port = address.rpartition(":")
    if host in _ALL_INTERFACES:
        host = socket.gethostname()
    reachable = json.dumps([f"{protocol}/{host}:{port}"])
    certificates = ", with certificates," if protocol in {"tls", "quic"} else ""
    override = f"""mode="client";connect/endpoints={reachable}"""
    return f"To connect nodes{certificates} use: export ZENOH_CONFIG_OVERRIDE='{override}'"


class _Connections:
    """Reports at most `_MAX_LINES` connections per `_WINDOW`, and counts the others."""

    def __init__(self, report: Callable[[str], None]) -> None:
        self._report = report
        self._lock = threading.Lock()
        self._window = time.monotonic()
        self._lines = 0
        self._omitted = 0
        self._known: set[tuple[str, str]] = set()  # a link can be reported as present and as new

    def note(self, event: zenoh.LinkEvent) -> None:
        """Report that a link was added or removed."""
        link = event.link
        is_new = event.kind == _library.load().SampleKind.PUT
        identity = link.dst, str(link.zid)
        certificate = f", certificate of {link.auth_identifier}" if link.auth_identifier else ""
        self.end_window()
        with self._lock:
            if (identity in self._known) == is_new:
                return
            self._known ^= {identity}
            self._lines += 1
            if self._lines > _MAX_LINES:
                self._omitted += 1
                return
        self._report(f"{'Connected' if is_new else 'Disconnected'}: {link.dst}, session {link.zid}{certificate}")

    def end_window(self) -> None:
        """Begin a new window if the last one has ended, and report how many lines were omitted in it."""
        with self._lock:
            if time.monotonic() - self._window < _WINDOW:
                return
            self._window = time.monotonic()
            omitted, self._omitted, self._lines = self._omitted, 0, 0
        if omitted:
            self._report(f"{omitted} more connections and disconnections in {_WINDOW:g} s")


def _chooses_endpoints(file: str, environment: Mapping[str, str]) -> bool:
    """Return whether the user configures the endpoints to listen on, in a file or a variable."""
    if file or environment.get(configuration.ROUTER_FILE, "").strip():
        return True
    pairs = configuration.override_pairs(environment.get(configuration.OVERRIDE, ""))
    return any(path.partition("/")[0] == "listen" for path, _ in pairs)


def _open(config: zenoh.Config, endpoints: Sequence[str]) -> zenoh.Session:
    module = _library.load()
    try:
        session = module.open(config)
    except module.ZError as error:
        system_error = _SYSTEM_ERROR.search(str(error))
        reason = system_error[1] if system_error else configuration.reason_of(error)
        hint = "Check the endpoints and, for TLS, the files of the certificates in the configuration."
        if "in use" in reason:
            hint = "Another router is probably running. Choose another port, for example --listen tcp/127.0.0.1:7448."
        raise WireError(f"The router cannot listen on {', '.join(endpoints)}: {reason}.", hint=hint) from error
    # Zenoh's own log, which RUST_LOG configures, reports refused connections. If it were enabled before opening, it
    # would repeat the error above. A participant that leaves undeclares entities that access control had denied, which
    # is not an error.
    module.init_log_from_env_or("warn,zenoh::net::routing::hat=off")
    return session  # type: ignore[no-any-return]
