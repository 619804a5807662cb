"""The one timer of all tabs: each wake-up of a thread costs more than what a tab of a few frames is sent."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING

from coframe.viewer.clients.client import Client

if TYPE_CHECKING:
    import asyncio

    from coframe.viewer.server.websocket import WebSocket
    from coframe.viewer.state import Stage

__all__ = ["Ticker"]

_logger = logging.getLogger("coframe.viewer")


class Ticker:
    """Makes the tabs tick as long as there are any; used by the server's thread.

    Args:
        loop: The server's.
        stage: What all tabs see.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop, stage: Stage) -> None:
        self._loop = loop
        self._stage = stage
        self._clients: dict[WebSocket, Client] = {}
        self._timer: asyncio.TimerHandle | None = None

    def welcome(self, socket: WebSocket) -> Client:
        """A new tab, which is sent the first picture at once."""
        client = self._clients[socket] = Client(socket, self._stage)
        self._schedule()
        return client

    def _schedule(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
        due = min((client.due for client in self._clients.values()), default=None)
        self._timer = None if due is None else self._loop.call_at(due, self._tick)

    def _tick(self) -> None:
        now = self._loop.time()
        for socket, client in list(self._clients.items()):
            if socket.has_ended:
                del self._clients[socket]
            elif client.due <= now:
                self._tick_one(socket, client, now)
        self._schedule()

    def _tick_one(self, socket: WebSocket, client: Client, now: float) -> None:
        try:
            client.tick(now)
        except Exception:
            _logger.exception("a tab's connection failed; the others go on")
            del self._clients[socket]
            socket.abort()
