# SPDX-License-Identifier: Apache-2.0
"""The viewer's server: the page over HTTP and its data over a WebSocket, in a separate thread."""

from __future__ import annotations

import asyncio
import contextlib
import errno
import logging
import os
import socket
import threading
from http import HTTPStatus
from typing import TYPE_CHECKING, Any
from urllib.parse import parse_qsl, unquote, urlencode, urlsplit

from coframe._files.os_errors import explain
from coframe._files.regular_files import read_regular
from coframe._output.formatting import error_text
from coframe.errors import PlotError, ViewerError
from coframe.viewer._page_files import STATIC
from coframe.viewer.replay.page import ReplayContent, replay_page
from coframe.viewer.robots.meshes import MAX_MESH_BYTES, MESH_TYPES, MeshError
from coframe.viewer.server._connections import Connections
from coframe.viewer.server._http import AccessPolicy, file_response, page_file, response, text_response
from coframe.viewer.server._scheduler import ClientScheduler
from coframe.viewer.server._websocket import WebSocket

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path
    from urllib.parse import SplitResult

    from typing_extensions import Self
    from websockets.http11 import Request, Response

    from coframe.viewer._state import ViewerState

__all__ = ["DEFAULT_PORT", "ViewerServer"]

_logger = logging.getLogger("coframe.viewer")

# Browsers store the layout of a page by its address, so the port is kept if possible.
DEFAULT_PORT = 7676
_TOKEN_PARAMETER = "token"  # noqa: S105 - its name in addresses
_END_TIMEOUT = 5.0
_REPEAT_AFTER = 60.0  # seconds between warnings about connections that cannot be accepted
# Seconds between checks whether all clients have disconnected.
_END_STEP = 0.01
# The headers that the server reads; requests that repeat one of them are ambiguous.
_SINGLE_HEADERS = ("Host", "Origin", "Upgrade", "If-None-Match")


class ViewerServer:
    """Serves the viewer to browsers until it is closed.

    Args:
        state: The state that all clients share. From now on, only the server's thread may use it.
        host: The address to listen on. If other machines can reach it, their requests need a token; see :attr:`url`.
        port: The port; None selects the default port, or any free port if that is in use; 0 selects any free port.
        static: The folder of the page.

    Raises:
        ViewerError: The server cannot listen on the address.
    """

    def __init__(
        self, state: ViewerState, *, host: str = "127.0.0.1", port: int | None = None, static: Path = STATIC
    ) -> None:
        self._state = state
        self._host = host
        self._static = static
        self._access = AccessPolicy(host, 0)
        self._connections = Connections()
        self.port = 0
        self._loop = asyncio.new_event_loop()
        self._loop.set_exception_handler(self._handle_error)
        self._warned_at = -_REPEAT_AFTER
        self._scheduler = ClientScheduler(self._loop, state)
        self._end = asyncio.Event()
        self._start_event = threading.Event()
        self._failure: Exception | None = None
        self._thread = threading.Thread(target=self._run, args=(port,), name="coframe-viewer", daemon=True)
        self._thread.start()
        self._start_event.wait()
        if self._failure is not None:
            self._thread.join()
            raise _cannot_listen(host, DEFAULT_PORT if port is None else port, self._failure) from self._failure

    @property
    def url(self) -> str:
        """The page's address, with the token that other machines need, unless only this machine can connect."""
        host = {"0.0.0.0": "127.0.0.1", "::": "[::1]"}.get(self._host, self._host)  # noqa: S104 - for display
        return f"http://{f'[{host}]' if ':' in host and '[' not in host else host}:{self.port}/{self._query}"

    @property
    def remote_url(self) -> str:
        """The page's address for other machines; empty if only this machine can connect."""
        if not self._access.token:
            return ""
        is_any = self._host in {"0.0.0.0", "::"}  # noqa: S104 - for display
        return f"http://{socket.gethostname()}:{self.port}/{self._query}" if is_any else self.url

    @property
    def _query(self) -> str:
        return f"?{_TOKEN_PARAMETER}={self._access.token}" if self._access.token else ""

    def call(self, callback: Callable[..., object], *args: Any) -> None:
        """Call a function in the server's thread soon. Do nothing if the server is closed."""
        with contextlib.suppress(RuntimeError):  # The loop is closed.
            self._loop.call_soon_threadsafe(callback, *args)

    def close(self) -> None:
        """Close all connections and end the thread; may be called more than once."""
        self.call(self._end.set)
        if self._thread is not threading.current_thread():
            self._thread.join(_END_TIMEOUT)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _run(self, port: int | None) -> None:
        try:
            self._loop.run_until_complete(self._serve(port))
        finally:
            self._start_event.set()
            self._state.close()
            self._loop.run_until_complete(self._loop.shutdown_asyncgens())
            self._loop.close()

    async def _serve(self, port: int | None) -> None:
        try:
            server = await self._listen(port)
        except (OSError, OverflowError, UnicodeError) as error:  # ports above 65535, invalid host names
            self._failure = error
            return
        self.port = next(iter(server.sockets)).getsockname()[1]
        self._access = AccessPolicy(self._host, self.port)
        self._start_event.set()
        try:
            await self._end.wait()
        finally:
            server.close()
            while self._connections:
                self._connections.close()
                await asyncio.sleep(_END_STEP)

    def _handle_error(self, loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        """Warn once a minute while connections cannot be accepted; asyncio would log thousands of tracebacks."""
        error = context.get("exception")
        if not (isinstance(error, OSError) and "accept" in context["message"]):
            loop.default_exception_handler(context)
        elif loop.time() - self._warned_at >= _REPEAT_AFTER:
            self._warned_at = loop.time()
            reason = error.strerror
            _logger.warning("the viewer cannot accept connections: %s. Close tabs, or enter: ulimit -n 1024", reason)

    async def _listen(self, port: int | None) -> asyncio.Server:
        if port is not None:
            return await self._listen_on(port)
        try:
            return await self._listen_on(DEFAULT_PORT)
        except OSError:
            return await self._listen_on(0)

    async def _listen_on(self, port: int) -> asyncio.Server:
        return await self._loop.create_server(self._connect, self._host, port, backlog=self._connections.backlog)

    def _connect(self) -> WebSocket:
        return WebSocket(self._answer, self._scheduler.add_client, self._connections)

    async def _answer(self, request: Request) -> Response | None:
        """Return the response to a request; None opens a WebSocket."""
        if (refusal := self._error_response(request)) is not None:
            return refusal
        parts = urlsplit(request.path)
        reply = self._token_reply(request, parts) if self._access.token else None
        return reply or await self._content(request, parts)

    async def _content(self, request: Request, parts: SplitResult) -> Response | None:
        path = unquote(parts.path)
        if path == "/ws":
            return self._answer_socket(request)
        if path.startswith("/mesh/"):
            return await self._in_thread(self._answer_mesh, path.removeprefix("/mesh/"))
        if path == "/rviz":
            return self._answer_rviz()
        if path in {"/replay", "/curves.csv"}:
            return await (self._answer_replay if path == "/replay" else self._answer_curves)(parts.query)
        return self._answer_page(path, request.headers.get("If-None-Match"), request.headers.get_all("Accept-Encoding"))

    def _error_response(self, request: Request) -> Response | None:
        """Return the response to a request that is not allowed or not valid, or None for others."""
        policy = self._access.content_security
        for name in _SINGLE_HEADERS:
            if len(request.headers.get_all(name)) > 1:
                return text_response(HTTPStatus.BAD_REQUEST, f"The request has more than one {name} header.", policy)
        if not self._access.allows_host(request.headers.get("Host")):
            return text_response(HTTPStatus.FORBIDDEN, "The Host header does not name this server.", policy)
        # Older versions of websockets accept only GET, and do not tell the method.
        if getattr(request, "method", "GET") != "GET":
            text, allowed = b"This server answers only GET.\n", {"Allow": "GET"}
            return response(HTTPStatus.METHOD_NOT_ALLOWED, text, "text/plain; charset=utf-8", policy, allowed)
        try:
            urlsplit(request.path)
        except ValueError:  # such as an address that begins with a bracket
            return text_response(HTTPStatus.BAD_REQUEST, "The address of the request is not valid.", policy)
        return None

    def _token_reply(self, request: Request, parts: SplitResult) -> Response | None:
        """Return the response to a request without the token or with the token in its address, or None for others."""
        query = parse_qsl(parts.query, keep_blank_values=True)
        if any(key == _TOKEN_PARAMETER and self._access.is_token(value) for key, value in query):
            if parts.path == "/ws":  # programs other than browsers
                return None
            rest = urlencode([(key, value) for key, value in query if key != _TOKEN_PARAMETER])
            # A path that begins with two slashes, or a slash and a backslash, would lead to another server.
            return self._access.redirection("/" + parts.path.lstrip("/\\") + (f"?{rest}" if rest else ""))
        if self._access.has_cookie(request.headers.get_all("Cookie")):
            return None
        text = "This viewer needs the token in its address. Open the complete address that coframe printed."
        return text_response(HTTPStatus.FORBIDDEN, text, self._access.content_security)

    async def _in_thread(self, make_response: Callable[..., Response], *args: Any) -> Response:
        return await self._loop.run_in_executor(self._state.executor, make_response, *args)

    def _answer_mesh(self, path: str) -> Response:
        policy = self._access.content_security
        try:
            file = self._state.meshes.file(path)
            return response(HTTPStatus.OK, read_regular(file, MAX_MESH_BYTES), MESH_TYPES[file.suffix.lower()], policy)
        except (MeshError, OSError) as error:
            return text_response(HTTPStatus.NOT_FOUND, explain(error), policy)

    def _answer_socket(self, request: Request) -> Response | None:
        policy = self._access.content_security
        if request.headers.get("Upgrade", "").lower() != "websocket":
            return text_response(HTTPStatus.UPGRADE_REQUIRED, "This address accepts only WebSockets.", policy)
        if not self._access.allows_origin(request.headers.get("Origin")):
            return text_response(HTTPStatus.FORBIDDEN, "Pages of other sites must not connect to this server.", policy)
        return None

    def _answer_rviz(self) -> Response:
        text, policy = self._state.saved_rviz, self._access.content_security
        if text is None:
            return text_response(
                HTTPStatus.NOT_FOUND, "No configuration has been saved yet. Save it in the page first.", policy
            )
        attachment = {"Content-Disposition": 'attachment; filename="coframe.rviz"'}
        return response(HTTPStatus.OK, text.encode(), "text/yaml; charset=utf-8", policy, attachment)

    async def _answer_replay(self, query: str) -> Response:
        state, policy = self._state, self._access.content_security
        try:
            replay = state.replay_request(dict(parse_qsl(query)))
            robots = list(state.descriptions.known.values())
            nodes = state.nodes.all()
            topics = [topic for display in replay.settings.displays for topic in display.topics]
            with state.opened(topics) as messages:
                content = ReplayContent(state.source.buffer, messages, robots, state.meshes, nodes)
                page = await self._loop.run_in_executor(state.executor, replay_page, self._static, content, replay)
        except ViewerError as error:
            return text_response(HTTPStatus.BAD_REQUEST, error_text(error), policy)
        attachment = {"Content-Disposition": 'attachment; filename="coframe-replay.html"'}
        return response(HTTPStatus.OK, page, "text/html; charset=utf-8", policy, attachment)

    async def _answer_curves(self, query: str) -> Response:
        policy = self._access.content_security
        expressions = [value for key, value in parse_qsl(query) if key == "curve"]
        try:
            table = self._state.panels.curves.table(expressions)
            text = await self._loop.run_in_executor(self._state.executor, table.as_csv)
        except PlotError as error:
            return text_response(HTTPStatus.BAD_REQUEST, error_text(error), policy)
        attachment = {"Content-Disposition": 'attachment; filename="coframe-curves.csv"'}
        return response(HTTPStatus.OK, text.encode(), "text/csv; charset=utf-8", policy, attachment)

    def _answer_page(self, path: str, known_tag: str | None, encodings: list[str]) -> Response:
        file = page_file("index.html" if path == "/" else path, self._static)
        if file is not None:
            return file_response(file, self._access.content_security, known_tag, ",".join(encodings))
        if path == "/":
            text = "The viewer's page is missing. Build it in viewer/ with `npm ci && npm run build`."
            return text_response(HTTPStatus.SERVICE_UNAVAILABLE, text, self._access.content_security)
        return text_response(HTTPStatus.NOT_FOUND, "File not found.", self._access.content_security)


def _cannot_listen(host: str, port: int, reason: Exception) -> ViewerError:
    # The exception's own message would repeat the address.
    code = getattr(reason, "errno", None)
    if code == errno.EADDRNOTAVAIL or isinstance(reason, socket.gaierror | UnicodeError):
        return ViewerError(
            f"cannot listen on {host}: this machine does not have that address",
            hint="Choose another host, or 127.0.0.1.",
        )
    text = os.strerror(code) if code else str(reason)
    return ViewerError(f"cannot listen on {host}:{port}: {text}", hint="Choose another port, or 0 for any free port.")
