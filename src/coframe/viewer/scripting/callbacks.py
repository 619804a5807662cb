# SPDX-License-Identifier: Apache-2.0
"""The thread in which the callbacks of a program run, one after another."""

from __future__ import annotations

import logging
import threading
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable

__all__ = ["CallbackThread"]

_logger = logging.getLogger("coframe.viewer")

MAX_CALLBACKS = 1000


class CallbackThread:
    """Runs callbacks in the order of their events, so that a slow callback does not delay the pages.

    The thread starts with the first event. Events that wait are limited to `MAX_CALLBACKS`; more are dropped.
    """

    def __init__(self) -> None:
        self._condition = threading.Condition()
        self._waiting_callbacks: dict[Hashable, Callable[[], object]] = {}
        self._events = 0
        self._thread: threading.Thread | None = None
        self._closed = False
        self._has_warned = False

    def submit(self, callback: Callable[[], object], subject: Hashable = None) -> None:
        """Run a callback soon.

        Args:
            callback: The function to run, in the thread of the callbacks.
            subject: The subject of the event, which replaces a waiting event with the same subject. None keeps
                all events.
        """
        with self._condition:
            if self._closed:
                return
            self._events += 1
            key = ("event", self._events) if subject is None else ("subject", subject)
            if key not in self._waiting_callbacks and len(self._waiting_callbacks) >= MAX_CALLBACKS:
                self._warn()
                return
            self._waiting_callbacks[key] = callback
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, name="coframe-viewer-callbacks", daemon=True)
                self._thread.start()
            self._condition.notify()

    def close(self) -> None:
        """Drop the events that wait, and end the thread after the callback that runs now."""
        with self._condition:
            self._closed = True
            self._waiting_callbacks.clear()
            self._condition.notify()

    def _warn(self) -> None:
        if not self._has_warned:
            self._has_warned = True
            _logger.warning(
                "clicks and changes of widgets were dropped: %d callbacks wait. Let callbacks return sooner.",
                MAX_CALLBACKS,
            )

    def _run(self) -> None:
        while (callback := self._next_callback()) is not None:
            try:
                callback()
            except Exception:
                _logger.exception("a callback of the viewer failed; the viewer continues")

    def _next_callback(self) -> Callable[[], object] | None:
        """Wait for the oldest event and return its callback; None at the end."""
        with self._condition:
            self._condition.wait_for(lambda: self._waiting_callbacks or self._closed)
            if self._closed:
                return None
            return self._waiting_callbacks.pop(next(iter(self._waiting_callbacks)))
