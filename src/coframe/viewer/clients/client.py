# SPDX-License-Identifier: Apache-2.0
"""One connected browser tab.

Updates are sent only when the client has drawn the last frame update and the connection has accepted it, so a client
that is slow or stuck skips updates. Requests are answered in order; the server stops reading from a client that does
not read the answers. Updates use direct calls without tasks and locks, which would cost more than most updates.
"""

from __future__ import annotations

import asyncio
import math
from collections import deque
from typing import TYPE_CHECKING, Protocol

from coframe.errors import ViewerError, WireError
from coframe.viewer._failures import report_failure
from coframe.viewer.clients._feeds import FRAMES, HELLO, TOPICS, make_feeds
from coframe.viewer.clients._requests import handle
from coframe.viewer.clients._state import ClientState
from coframe.viewer.clients._upload_requests import UploadedPart
from coframe.viewer.protocol.client_messages import FrameDrawn, Subscribe
from coframe.viewer.protocol.encoding import encode
from coframe.viewer.protocol.requests import BadRequestError, parse_request
from coframe.viewer.protocol.server_messages import DisplayStatus, ProblemReport, Pulse

if TYPE_CHECKING:
    from collections.abc import Hashable
    from typing import TypeAlias

    from coframe.viewer._state import ViewerState
    from coframe.viewer.clients._update import Feed
    from coframe.viewer.protocol.client_messages import ClientMessage
    from coframe.viewer.protocol.server_messages import ServerMessage

    _Request: TypeAlias = ClientMessage | UploadedPart | BadRequestError

__all__ = ["Client", "Socket"]

# The server reads no more requests from a client with this many unanswered ones until half of them are answered.
MAX_REQUESTS = 64
_NEVER_SENT = object()
# Seconds between two pulses.
PULSE_PERIOD = 1.0
# Seconds until a feed that failed unexpectedly is tried again, and how many such exceptions a page receives.
FAILED_PERIOD, MAX_REPORTED = 2.0, 20


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
        self._is_ready = True
        self._requests: deque[_Request] = deque()
        self._answer_task: asyncio.Task[None] | None = None
        self._pulse_due = 0.0
        self._reported: set[str] = set()  # The unexpected exceptions that the page knows.

    def receive(self, message: str | bytes) -> None:
        """Process a message: a confirmation immediately, everything else in order."""
        try:
            request: _Request = UploadedPart(message) if isinstance(message, bytes) else parse_request(message)
        except BadRequestError as error:
            request = error
        if isinstance(request, FrameDrawn):
            self._is_ready = True
            return
        self._requests.append(request)
        if len(self._requests) >= MAX_REQUESTS:
            self._socket.pause()
        if self._answer_task is None:
            self._answer_task = asyncio.get_running_loop().create_task(self._answer_all())

    def disconnected(self) -> None:
        """Clean up after the connection has ended."""
        if self._answer_task is not None:
            self._answer_task.cancel()
        self.state.close()

    def update(self, now: float) -> None:
        """Send what has changed if the client can receive it.

        Args:
            now: The time of the monotonic clock.
        """
        # All clients with the same rate are due at the same moments.
        rate = self.state.frame_rate
        self.due = (math.floor(now * rate) + 1) / rate
        try:
            self.state.publish_joints()
            self._viewer.panels.poll()
            if self._is_ready and self._socket.is_clear:
                self._viewer.refresh()
        except Exception as error:  # noqa: BLE001 - one failure must not stop the others
            self._report("the viewer could not be updated completely; it tries again", error)
        if self._is_ready and self._socket.is_clear:
            self._send_updates(now)

    def pulse(self, now: float) -> None:
        """Send a pulse once per second, even while the page draws: without one, it concludes that the server stopped.

        Args:
            now: The time of the monotonic clock.
        """
        if now >= self._pulse_due and self._socket.is_clear:
            self._pulse_due = now + PULSE_PERIOD
            viewer = self._viewer
            self._socket.send(encode(Pulse(type="pulse", silence=viewer.silence(), clock=viewer.source.clock)))

    def _send_updates(self, now: float) -> None:
        for feed in self._feeds:
            if now >= feed.due:
                try:
                    self._send_feed(feed, now)
                except Exception as error:  # noqa: BLE001 - one failure must not stop the others
                    feed.due = now + FAILED_PERIOD
                    self._report(f"{type(feed).__name__} failed; the other parts of the page continue", error)

    def _send_feed(self, feed: Feed, now: float) -> None:
        sent = self._sent
        for key, version, encode_update in feed.updates(now):
            if key is not None:
                if sent.get(key, _NEVER_SENT) == version:
                    continue
                if key == HELLO:
                    self._restart()
                sent[key] = version
            self._socket.send(encode_update())
            if key == FRAMES:
                self._is_ready = False

    def _report(self, what: str, error: Exception) -> None:
        """Log an unexpected exception, and tell the page about the first one of its kind."""
        report_failure(what, error)
        text = f"A part of the viewer failed: {type(error).__name__}: {error}"
        if text not in self._reported and len(self._reported) < MAX_REPORTED:
            self._reported.add(text)
            self._socket.send(encode(ProblemReport(type="problem", text=text, hint="See the server's log.")))

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
            self._answer_task = None
        except Exception as error:  # noqa: BLE001 - one failure must not stop the others
            report_failure("an answer could not be sent and the client was disconnected; the others continue", error)
            self._socket.abort()

    async def _answer(self, request: _Request) -> None:
        for answer in await self._answers(request):
            await self._socket.cleared()
            self._socket.send(encode(answer))

    async def _answers(self, request: _Request) -> list[ServerMessage]:
        """Return the answer; that to a request that fails is its error, including on the display that it concerns."""
        if isinstance(request, BadRequestError):
            return _failure_answers(str(request), request.hint, request.display)
        display = request.id if isinstance(request, Subscribe) else None
        try:
            answer = await handle(self.state, request)
        except (BadRequestError, ViewerError, WireError) as error:
            return _failure_answers(str(error), error.hint, display)
        except Exception as error:  # noqa: BLE001 - a request that fails unexpectedly must not stop the others
            report_failure(f"a request {type(request).__name__} failed; the viewer continues", error)
            return _failure_answers(f"A request failed: {type(error).__name__}: {error}", "", display)
        return [] if answer is None else [answer]


def _failure_answers(text: str, hint: str, display: int | None) -> list[ServerMessage]:
    """Return the answers to a request that failed."""
    answers: list[ServerMessage] = [ProblemReport(type="problem", text=text, hint=hint)]
    if display is not None:
        answers.append(DisplayStatus(type="display", id=display, state="error", text=f"{text} {hint}".strip()))
    return answers
