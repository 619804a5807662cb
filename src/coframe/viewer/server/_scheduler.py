# SPDX-License-Identifier: Apache-2.0
"""One timer for all clients, because waking the thread costs more than updating a client with few frames."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.viewer._failures import report_failure
from coframe.viewer.clients.client import Client

if TYPE_CHECKING:
    import asyncio

    from coframe.viewer._state import ViewerState
    from coframe.viewer.server._websocket import WebSocket

__all__ = ["ClientScheduler"]


class ClientScheduler:
    """Updates all clients when they are due; used by the server's thread.

    Args:
        loop: The server's event loop.
        state: The state that all clients share.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop, state: ViewerState) -> None:
        self._loop = loop
        self._state = state
        self._clients: dict[WebSocket, Client] = {}
        self._timer: asyncio.TimerHandle | None = None

    def add_client(self, socket: WebSocket) -> Client:
        """Return a new client, which is updated immediately."""
        client = self._clients[socket] = Client(socket, self._state)
        self._schedule()
        return client

    def _schedule(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
        due = min((client.due for client in self._clients.values()), default=None)
        self._timer = None if due is None else self._loop.call_at(due, self._update_all)

    def _update_all(self) -> None:
        now = self._loop.time()
        for socket, client in list(self._clients.items()):
            if socket.has_ended:
                del self._clients[socket]
            elif client.due <= now:
                self._update(socket, client, now)
        self._schedule()

    def _update(self, socket: WebSocket, client: Client, now: float) -> None:
        try:
            client.update(now)
            client.pulse(now)
        except Exception as error:  # noqa: BLE001 - one failure must not stop the others
            report_failure("a client failed and was disconnected; the others continue", error)
            del self._clients[socket]
            socket.abort()
