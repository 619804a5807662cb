"""The viewer's server: the page over HTTP and what it draws over a WebSocket, in a thread of its own."""

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
from urllib.parse import parse_qsl, unquote, urlsplit

from coframe.errors import ViewerError
from coframe.viewer.replay.page import Sights, replay_page
from coframe.viewer.robots.meshes import MESH_TYPES, MeshError
from coframe.viewer.server.http import STATIC, Visitors, file_response, page_file, response, sentence
from coframe.viewer.server.scheduler import Ticker
from coframe.viewer.server.websocket import WebSocket

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from typing_extensions import Self
    from websockets.http11 import Request, Response

    from coframe.viewer.state import Stage

__all__ = ["DEFAULT_PORT", "ViewerServer"]

_logger = logging.getLogger("coframe.viewer")

# A page that is opened again remembers its layout by the address: so the port stays the same where it can.
DEFAULT_PORT = 7676
_END_TIMEOUT = 5.0
# How often it is looked whether all tabs have said goodbye, in seconds.
_END_STEP = 0.01


class ViewerServer:
    """Serves a stage to browsers until it is closed.

    Args:
        stage: What is shown. From now on only the server's thread uses it.
        host: The address to listen on; others than this machine's own let everybody in who reaches it.
        port: The port; None takes the usual one, or any other where that is taken; 0 takes any.
        static: The folder of the page.

    Raises:
        ViewerError: The address cannot be listened on.
    """

    def __init__(
        self, stage: Stage, *, host: str = "127.0.0.1", port: int | None = None, static: Path = STATIC
    ) -> None:
        self._stage = stage
        self._host = host
        self._static = static
        self._visitors = Visitors(host, 0)
        self._sockets: set[WebSocket] = set()
        self.port = 0
        self._loop = asyncio.new_event_loop()
        self._ticker = Ticker(self._loop, stage)
        self._end = asyncio.Event()
        self._started = threading.Event()
        self._failure: OSError | None = None
        self._thread = threading.Thread(target=self._run, args=(port,), name="coframe-viewer", daemon=True)
        self._thread.start()
        self._started.wait()
        if self._failure is not None:
            self._thread.join()
            raise _cannot_listen(host, DEFAULT_PORT if port is None else port, self._failure) from self._failure

    @property
    def url(self) -> str:
        """The page's address."""
        host = {"0.0.0.0": "127.0.0.1", "::": "[::1]"}.get(self._host, self._host)  # noqa: S104 - to be shown
        return f"http://{f'[{host}]' if ':' in host and '[' not in host else host}:{self.port}/"

    def call(self, deed: Callable[..., object], *args: Any) -> None:
        """Has the server's thread do something soon; nothing happens once it has ended."""
        with contextlib.suppress(RuntimeError):  # the loop has ended already
            self._loop.call_soon_threadsafe(deed, *args)

    def close(self) -> None:
        """Ends all connections and the thread; doing so twice does no harm."""
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
            self._started.set()
            self._stage.close()
            self._loop.run_until_complete(self._loop.shutdown_asyncgens())
            self._loop.close()

    async def _serve(self, port: int | None) -> None:
        try:
            server = await self._listen(port)
        except OSError as error:
            self._failure = error
            return
        self.port = next(iter(server.sockets)).getsockname()[1]
        self._visitors = Visitors(self._host, self.port)
        self._started.set()
        try:
            await self._end.wait()
        finally:
            server.close()
            while self._sockets:
                for connection in list(self._sockets):
                    connection.close()
                await asyncio.sleep(_END_STEP)

    async def _listen(self, port: int | None) -> asyncio.Server:
        if port is not None:
            return await self._listen_on(port)
        try:
            return await self._listen_on(DEFAULT_PORT)
        except OSError:
            return await self._listen_on(0)

    async def _listen_on(self, port: int) -> asyncio.Server:
        return await self._loop.create_server(self._connect, self._host, port)

    def _connect(self) -> WebSocket:
        return WebSocket(self._answer, self._ticker.welcome, self._sockets)

    async def _answer(self, request: Request) -> Response | None:
        """An answer to a request; None lets a WebSocket be opened."""
        policy = self._visitors.policy
        if not self._visitors.host_is_ours(request.headers.get("Host")):
            return sentence(HTTPStatus.FORBIDDEN, "This server goes by another name.", policy)
        parts = urlsplit(request.path)
        path = unquote(parts.path)
        if path == "/ws":
            return self._answer_socket(request)
        if path.startswith("/mesh/"):
            return await self._in_thread(self._answer_mesh, path.removeprefix("/mesh/"))
        if path == "/rviz":
            return self._answer_rviz()
        if path == "/replay":
            return await self._answer_replay(parts.query)
        return self._answer_page(path, request.headers.get("If-None-Match"))

    async def _in_thread(self, deed: Callable[..., Response], *args: Any) -> Response:
        return await self._loop.run_in_executor(self._stage.executor, deed, *args)

    def _answer_mesh(self, path: str) -> Response:
        policy = self._visitors.policy
        try:
            file = self._stage.meshes.file(path)
            return response(HTTPStatus.OK, file.read_bytes(), MESH_TYPES[file.suffix.lower()], policy)
        except (MeshError, OSError) as error:
            return sentence(HTTPStatus.NOT_FOUND, str(error), policy)

    def _answer_socket(self, request: Request) -> Response | None:
        policy = self._visitors.policy
        if request.headers.get("Upgrade", "").lower() != "websocket":
            return sentence(HTTPStatus.UPGRADE_REQUIRED, "This is the address of a WebSocket.", policy)
        if not self._visitors.origin_is_ours(request.headers.get("Origin")):
            return sentence(HTTPStatus.FORBIDDEN, "Pages of other sites may not talk to this server.", policy)
        return None

    def _answer_rviz(self) -> Response:
        text, policy = self._stage.saved_rviz, self._visitors.policy
        if text is None:
            return sentence(HTTPStatus.NOT_FOUND, "Nothing has been saved yet: save it in the page.", policy)
        attachment = {"Content-Disposition": 'attachment; filename="coframe.rviz"'}
        return response(HTTPStatus.OK, text.encode(), "text/yaml; charset=utf-8", policy, attachment)

    async def _answer_replay(self, query: str) -> Response:
        stage, policy = self._stage, self._visitors.policy
        try:
            wanted = stage.replay_request(dict(parse_qsl(query)))
            template, robots = self._static / "replay.html", list(stage.descriptions.known.values())
            with stage.opened(display.topic for display in wanted.looks.displays) as messages:
                sights = Sights(stage.source.buffer, messages, robots, stage.meshes)
                page = await self._loop.run_in_executor(stage.executor, replay_page, template, sights, wanted)
        except ViewerError as error:
            return sentence(HTTPStatus.BAD_REQUEST, f"{error} {error.hint}".strip(), policy)
        attachment = {"Content-Disposition": 'attachment; filename="coframe-replay.html"'}
        return response(HTTPStatus.OK, page, "text/html; charset=utf-8", policy, attachment)

    def _answer_page(self, path: str, known: str | None) -> Response:
        file = page_file("index.html" if path == "/" else path, self._static)
        if file is not None:
            return file_response(file, self._visitors.policy, known)
        if path == "/":
            text = "This coframe has no viewer page: build it in viewer/ by `npm ci && npm run build`."
            return sentence(HTTPStatus.SERVICE_UNAVAILABLE, text, self._visitors.policy)
        return sentence(HTTPStatus.NOT_FOUND, "There is no such file.", self._visitors.policy)


def _cannot_listen(host: str, port: int, reason: OSError) -> ViewerError:
    # The library's own words hold the address once more.
    is_foreign = reason.errno == errno.EADDRNOTAVAIL or isinstance(reason, socket.gaierror)
    if is_foreign:
        return ViewerError(
            f"cannot listen on {host}: it is no address of this machine", hint="Choose another host, or 127.0.0.1."
        )
    words = os.strerror(reason.errno) if reason.errno else str(reason)
    return ViewerError(f"cannot listen on {host}:{port}: {words}", hint="Choose another port, or 0 for any free port.")
