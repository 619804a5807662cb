# SPDX-License-Identifier: Apache-2.0
"""The open connections of the server: at most as many as its file descriptors allow."""

from __future__ import annotations

import logging
import sys
import time
from typing import TYPE_CHECKING

if sys.platform != "win32":
    import resource

if TYPE_CHECKING:
    from coframe.viewer.server._websocket import WebSocket

__all__ = ["MAX_CONNECTIONS", "Connections"]

_logger = logging.getLogger("coframe.viewer")

MAX_CONNECTIONS = 512  # a tab has one for its data and, briefly, a few for its files
# File descriptors that are left for everything else: the middleware, the files of the page and of modules, a recording.
_RESERVED = 32
_BACKLOG = 100  # listen backlog, unless file descriptors are scarce
# asyncio accepts up to a whole backlog in each cycle of its loop, and closes a refused connection 3 cycles later.
_MAX_BACKLOGS = 4
_REPEAT_AFTER = 60.0  # seconds between warnings


class Connections:
    """The open connections.

    Attributes:
        backlog: The number of connections that may wait until they are accepted.
    """

    def __init__(self) -> None:
        spare = _descriptors() - _RESERVED
        self.backlog = max(1, min(_BACKLOG, spare // (2 * _MAX_BACKLOGS)))
        self._limit = max(1, min(MAX_CONNECTIONS, spare - _MAX_BACKLOGS * self.backlog))
        self._open_connections: set[WebSocket] = set()
        self._warned_at = -_REPEAT_AFTER

    def add(self, connection: WebSocket) -> bool:
        """Add a connection, and return whether that was possible. Warn at most once a minute if it was not."""
        if len(self._open_connections) < self._limit:
            self._open_connections.add(connection)
            return True
        if time.monotonic() - self._warned_at >= _REPEAT_AFTER:
            self._warned_at = time.monotonic()
            hint = "Close tabs" if self._limit == MAX_CONNECTIONS else "Close tabs, or enter: ulimit -n 1024"
            _logger.warning("the viewer has the maximum of %d connections and rejected one. %s", self._limit, hint)
        return False

    def discard(self, connection: WebSocket) -> None:
        """Remove a connection that has ended."""
        self._open_connections.discard(connection)

    def __len__(self) -> int:
        return len(self._open_connections)

    def close(self) -> None:
        """Close all connections. They are removed when they have ended."""
        for connection in list(self._open_connections):
            connection.close()


def _descriptors() -> int:
    """Return the file descriptor limit of this process."""
    if sys.platform == "win32":
        return sys.maxsize
    limit, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
    return sys.maxsize if limit == resource.RLIM_INFINITY else limit
