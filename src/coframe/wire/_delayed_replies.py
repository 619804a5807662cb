# SPDX-License-Identifier: Apache-2.0
"""Replies of a service that wait until their clients are discovered.

A client may discover a server, and send a request, before the server has discovered the client's subscription to
replies. A reply that is sent before that is lost. Such replies are sent by a thread, which exists only while replies
wait, so that a client that is never discovered delays no other client and no executor.
"""

from __future__ import annotations

import logging
import threading
import time
from collections import deque
from typing import TYPE_CHECKING, Final, NamedTuple

from coframe import _core
from coframe.errors import CoframeError

if TYPE_CHECKING:
    from collections.abc import Callable

MAX_DELAY: Final = 1.0  # seconds after which a reply is sent even if its client has not been discovered
MAX_WAITING_CLIENTS: Final = 1000  # of a service; replies to more clients are sent immediately
MAX_WAITING_REPLIES: Final = 100  # to one client; more are sent immediately

_MIN_PAUSE: Final = 0.001  # seconds between two checks, which double up to the longest
_MAX_PAUSE: Final = 0.02

_logger = logging.getLogger("coframe.wire")


class _Delayed(NamedTuple):
    """A reply that waits.

    Attributes:
        reaches: Returns whether a reply that is sent now reaches the client.
        send: Sends the reply.
        latest: When it is sent in any case, in seconds of the monotonic clock.
    """

    reaches: Callable[[], bool]
    send: Callable[[], None]
    latest: float


class DelayedReplies:
    """Sends the replies of a service as soon as their clients are discovered. All methods are thread-safe.

    Args:
        service: The name of the service, for warnings.
    """

    def __init__(self, service: str) -> None:
        self._service = service
        self._changed = threading.Condition()
        self._waiting_replies: dict[int, deque[_Delayed]] = {}  # by client, oldest first
        self._is_running = False

    def send(self, client: int, reaches: Callable[[], bool], send: Callable[[], None]) -> None:
        """Send a reply now, or as soon as its client is discovered, but after `MAX_DELAY` at the latest.

        Args:
            client: Identifies the client: the handle of its writer of requests.
            reaches: Returns whether a reply that is sent now reaches the client.
            send: Sends the reply. If it is called immediately, its exceptions are those of this method.
        """
        if (client not in self._waiting_replies and reaches()) or not self._store(client, reaches, send):
            send()

    def finish(self) -> None:
        """Wait until no reply waits, which takes at most `MAX_DELAY`."""
        with self._changed:
            self._changed.wait_for(lambda: not self._waiting_replies, MAX_DELAY + _MAX_PAUSE)

    def _store(self, client: int, reaches: Callable[[], bool], send: Callable[[], None]) -> bool:
        """Store a reply until its client is discovered. Return False if too many wait."""
        with self._changed:
            waiting = self._waiting_replies.get(client, deque())
            if len(waiting) >= MAX_WAITING_REPLIES or len(self._waiting_replies) >= MAX_WAITING_CLIENTS:
                return False
            waiting.append(_Delayed(reaches, send, time.monotonic() + MAX_DELAY))
            self._waiting_replies[client] = waiting
            self._changed.notify_all()
            if not self._is_running:
                self._is_running = True
                threading.Thread(target=self._run, name=f"coframe-replies{self._service}", daemon=True).start()
            return True

    def _run(self) -> None:
        pause = _MIN_PAUSE
        while True:
            with self._changed:
                self._changed.notify_all()
                if not self._waiting_replies:
                    self._is_running = False
                    return
                first = [(client, replies[0]) for client, replies in self._waiting_replies.items()]
            sent = [self._send_if_due(client, reply) for client, reply in first]
            if any(sent):
                pause = _MIN_PAUSE
                continue
            time.sleep(pause)
            pause = min(2 * pause, _MAX_PAUSE)

    def _send_if_due(self, client: int, reply: _Delayed) -> bool:
        """Send the oldest reply to a client if that is possible, and return whether it was sent."""
        try:
            if not (reply.reaches() or time.monotonic() >= reply.latest):
                return False
            reply.send()
        except (CoframeError, _core.EndpointError) as error:  # the service was closed, or a client does not keep up
            _logger.warning("A reply of %s was not sent: %s", self._service, error)
        with self._changed:
            replies = self._waiting_replies[client]
            replies.popleft()
            if not replies:
                del self._waiting_replies[client]
        return True
