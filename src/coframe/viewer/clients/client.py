# SPDX-License-Identifier: Apache-2.0
"""One connected browser tab.

Updates are sent only when the client has drawn the last frame update and the connection has accepted it, so a client
that is slow or stuck skips updates. Requests are answered in order; the server stops reading from a client that does
not read the answers. Updates use direct calls without tasks and locks, which would cost more than most updates.
"""

from __future__ import annotations

import asyncio
import logging
import math
from collections import deque
from typing import TYPE_CHECKING, Protocol

from coframe.viewer.clients._feeds import FRAMES, HELLO, TOPICS, make_feeds
from coframe.viewer.clients._requests import handle
from coframe.viewer.clients._state import ClientState
from coframe.viewer.clients._upload_requests import UploadedPart
from coframe.viewer.protocol.client_messages import FrameDrawn
from coframe.viewer.protocol.encoding import encode
from coframe.viewer.protocol.requests import BadRequestError, parse_request
from coframe.viewer.protocol.server_messages import ProblemReport

if TYPE_CHECKING:
    from collections.abc import Hashable
    from typing import TypeAlias

    from coframe.viewer._state import ViewerState
    from coframe.viewer.protocol.client_messages import ClientMessage
    from coframe.viewer.protocol.server_messages import ServerMessage

    _Request: TypeAlias = ClientMessage | UploadedPart | BadRequestError

__all__ = ["Client", "Socket"]

_logger = logging.getLogger("coframe.viewer")

# The server reads no more requests from a client with this many unanswered ones until half of them are answered.
MAX_REQUESTS = 64
_NEVER_SENT = object()


class Socket(Protocol):
    """The interface that a client requires of its connection."""

    @property
    def is_clear(self) -> bool:
        """Whether the operating system has accepted nearly everything that was sent."""

    async def cleared(self) -> None:
        """Wait until the connection is clear or has ended."""

    def send(self, message: str | bytes | bytearray) -> None:
        """Send a message."""

    def pause(self) -> None:
        """Stop receiving."""

    def resume(self) -> None:
        """Receive again."""

    def abort(self) -> None:
        """Close the connection immediately."""


class Client:
    """A connected client.

    Args:
        socket: Its connection.
        viewer: The state that all clients share.

    Attributes:
        state: The contents of the page.
        due: When `update` should be called, on the monotonic clock.
    """

    def __init__(self, socket: Socket, viewer: ViewerState) -> None:
        self._socket = socket
        self._viewer = viewer
        self.state = ClientState(viewer)
        self.due = 0.0
        self._feeds = make_feeds(self.state)
        self._sent: dict[Hashable, object] = {}  # The last version of each key.
        self._ready = True
        self._requests: deque[_Request] = deque()
        self._answering: asyncio.Task[None] | None = None

    def receive(self, message: str | bytes) -> None:
        """Process a message: a confirmation immediately, everything else in order."""
        try:
            request: _Request = UploadedPart(message) if isinstance(message, bytes) else parse_request(message)
        except BadRequestError as error:
            request = error
        if isinstance(request, FrameDrawn):
            self._ready = True
            return
        self._requests.append(request)
        if len(self._requests) >= MAX_REQUESTS:
            self._socket.pause()
        if self._answering is None:
            self._answering = asyncio.get_running_loop().create_task(self._answer_all())

    def disconnected(self) -> None:
        """Clean up after the connection has ended."""
        if self._answering is not None:
            self._answering.cancel()
        self.state.close()

    def update(self, now: float) -> None:
        """Send what has changed if the client can receive it.

        Args:
            now: The time of the monotonic clock.
        """
        # All clients with the same rate are due at the same moments.
        rate = self.state.frame_rate
        self.due = (math.floor(now * rate) + 1) / rate
        self.state.publish_joints()
        self._viewer.panels.poll()
        if self._ready and self._socket.is_clear:
            self._viewer.refresh()
            self._send_updates(now)

    def _send_updates(self, now: float) -> None:
        sent = self._sent
        for feed in self._feeds:
            if now < feed.due:
                continue
            for key, version, encode_update in feed.updates(now):
                if key is not None:
                    if sent.get(key, _NEVER_SENT) == version:
                        continue
                    if key == HELLO:
                        self._restart()
                    sent[key] = version
                    if key == FRAMES:
                        self._ready = False
                self._socket.send(encode_update())

    def _restart(self) -> None:
        """Send everything again after another `hello`, except problems that were already reported."""
        self.state.restart()
        problems = {
            key: version for key, version in self._sent.items() if isinstance(key, tuple) and key[0] == "problem"
        }
        self._sent.clear()
        self._sent.update(problems)
        self._sent[TOPICS] = self._viewer.topics  # Already part of `hello`.
        for feed in self._feeds:
            feed.due = 0.0

    async def _answer_all(self) -> None:
        try:
            while self._requests:
                request = self._requests.popleft()
                if len(self._requests) < MAX_REQUESTS // 2:
                    self._socket.resume()
                await self._answer(request)
            self._answering = None
        except Exception:
            _logger.exception("a client's request failed and the client was disconnected; the others continue")
            self._socket.abort()

    async def _answer(self, request: _Request) -> None:
        answer: ServerMessage | None
        try:
            if isinstance(request, BadRequestError):
                raise request
            answer = await handle(self.state, request)
        except BadRequestError as error:
            answer = ProblemReport(type="problem", text=str(error), hint=error.hint)
        if answer is not None:
            await self._socket.cleared()
            self._socket.send(encode(answer))
