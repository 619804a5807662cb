# SPDX-License-Identifier: Apache-2.0
"""The thread that runs Python callbacks for native events: finished waits and changed edges."""

from __future__ import annotations

import atexit
import heapq
import itertools
import logging
import os
import threading
import time
import weakref
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from coframe import _core

if TYPE_CHECKING:
    from coframe.transform.transform import Transform

# Functions that start a native wait or watch, which later puts the token into the mailbox.
StartWait = Callable[[_core.Mailbox, int], _core.Wait]
StartWatch = Callable[[_core.Mailbox, int], _core.Watch]
Cancel = Callable[[], object]

_WAKE_UP = 0  # A token without an entry: it only wakes the thread.
_NO_LIMIT = -1
_SPARE_DEADLINES = 100
_EXIT_TIMEOUT = 1.0  # Seconds that callbacks in progress get at the exit of the interpreter.

_log = logging.getLogger("coframe")


@dataclass
class _Wait:
    native: _core.Wait
    on_end: Callable[[Transform | None], object]


@dataclass
class _Watch:
    native: _core.Watch
    on_change: Callable[[list[str]], object]
    is_user_watch: bool


class Dispatcher:
    """Runs the callbacks of the waits and watches of one buffer.

    The thread exists while there are waits or watches. Callbacks run without any lock held, and their exceptions are
    logged. Callbacks of watches run one after another in the thread. Callbacks of waits that are completed by an
    insertion from Python run in the inserting thread.
    """

    def __init__(self) -> None:
        self._tokens = itertools.count(_WAKE_UP + 1)  # Never restarts at 0, because cancel functions outlive `reset`.
        self.reset()
        _all.add(self)

    def reset(self) -> None:
        """Drop all waits and watches, including in a forked process, which has no thread but may have held locks."""
        self._mailbox = _core.Mailbox()
        # The locks are reentrant, because finalizers and signal handlers can run while a thread holds one.
        self._lock = threading.RLock()  # Guards the attributes below; no callback is called while it is held.
        self._entries: dict[int, _Wait | _Watch] = {}
        self._deadlines: list[tuple[int, int]] = []  # A heap of (monotonic time in nanoseconds, token).
        self._thread: threading.Thread | None = None
        self._run_lock = threading.RLock()  # Held from an insertion until its tokens are taken.
        weakref.finalize(self, self._mailbox.put, _WAKE_UP).atexit = False

    def end(self) -> None:
        """Drop all waits and watches and end the thread, which the interpreter's exit could stop with a lock held."""
        with self._lock:
            entries, self._entries = self._entries, {}
            thread = self._thread
            self._mailbox.put(_WAKE_UP)
        entries.clear()
        if thread is not None:
            thread.join(_EXIT_TIMEOUT)

    def user_watches(self) -> int:
        """Return the number of watches registered by the user of the buffer."""
        return sum(isinstance(entry, _Watch) and entry.is_user_watch for entry in self._entries.values())

    @property
    def is_idle(self) -> bool:
        """Whether there are no waits and no watches."""
        return not self._entries

    def wait(
        self, start: StartWait, on_end: Callable[[Transform | None], object], timeout: int | None = None
    ) -> Cancel:
        """Call `on_end` once: with the transform when it becomes available, or with None after the timeout.

        Args:
            start: Starts the native wait.
            on_end: Called with the result, immediately if the transform is already available.
            timeout: Nanoseconds; None waits without a limit.

        Returns:
            A function that cancels the wait.
        """
        token = next(self._tokens)
        native = start(self._mailbox, token)
        found = native.transform()
        if found is not None:
            _call_safely(on_end, found)
        else:
            self._add(token, _Wait(native, on_end), timeout)
            self._end_if_answered(token)  # The token may have been taken before its entry existed.
        return lambda: self._remove(token)

    def watch(
        self, start: StartWatch, on_change: Callable[[list[str]], object], *, is_user_watch: bool = False
    ) -> Cancel:
        """Call `on_change` with the child frames of the edges that have changed, after every change.

        Args:
            start: Starts the native watch.
            on_change: Called with the frames.
            is_user_watch: Whether it was registered by the user of the buffer; forked children then log that it is not
                called.

        Returns:
            A function that cancels the watch.
        """
        token = next(self._tokens)
        self._add(token, _Watch(start(self._mailbox, token), on_change, is_user_watch), None)
        self._mailbox.put(token)  # The token may have been taken before its entry existed.
        return lambda: self._remove(token)

    @contextmanager
    def inserting(self) -> Iterator[None]:
        """Return a context manager for insertions. On exit, it runs the callbacks of completed waits."""
        if self.is_idle:
            yield
            return
        with self._run_lock:
            yield
            tokens = self._mailbox.take()
        self._process(tokens, watches=False)

    def _add(self, token: int, entry: _Wait | _Watch, timeout: int | None) -> None:
        with self._lock:
            self._entries[token] = entry
            if timeout is not None:
                self._remove_old_deadlines()
                heapq.heappush(self._deadlines, (time.monotonic_ns() + timeout, token))
            if self._thread is not None or _exiting.is_set():
                if timeout is not None and self._deadlines[0][1] == token:
                    self._mailbox.put(_WAKE_UP)  # The thread has to wake up for this deadline.
                return
            arguments = (weakref.ref(self), self._mailbox)
            self._thread = threading.Thread(target=_run, args=arguments, name="coframe waits", daemon=True)
            try:
                self._thread.start()
            except RuntimeError:  # There are too many threads, or the interpreter is exiting.
                self._thread = None
                self._remove(token)
                raise

    def _remove_old_deadlines(self) -> None:
        """Remove the deadlines of finished waits when there are many. They may be far in the future."""
        if len(self._deadlines) <= 2 * len(self._entries) + _SPARE_DEADLINES:
            return
        old, self._deadlines = self._deadlines, []
        for deadline in old:
            if deadline[1] in self._entries:
                heapq.heappush(self._deadlines, deadline)

    def _remove(self, token: int) -> _Wait | _Watch | None:
        with self._lock:
            entry = self._entries.pop(token, None)
            if not self._entries:
                self._mailbox.put(_WAKE_UP)
        if entry is not None:
            entry.native.cancel()
        return entry

    def _process(self, tokens: list[int], *, watches: bool) -> None:
        """Run the callbacks of these tokens. Only the dispatcher thread sets `watches` and runs those of watches."""
        tokens.reverse()
        try:
            while tokens:
                token = tokens.pop()
                entry = self._entries.get(token)
                if isinstance(entry, _Wait):
                    self._end_if_answered(token)
                elif isinstance(entry, _Watch) and watches:
                    self._report_changes(entry)
                elif isinstance(entry, _Watch):
                    self._mailbox.put(token)
        finally:
            for token in tokens:  # A callback raised SystemExit or similar; the other tokens must not be lost.
                self._mailbox.put(token)

    def _end_if_answered(self, token: int) -> None:
        entry = self._entries.get(token)
        found = entry.native.transform() if isinstance(entry, _Wait) else None
        if isinstance(entry, _Wait) and found is not None and self._remove(token) is not None:
            _call_safely(entry.on_end, found)

    @staticmethod
    def _report_changes(watch: _Watch) -> None:
        changed = watch.native.take()
        if changed:
            _call_safely(watch.on_change, changed)

    def _end_expired_waits(self) -> None:
        now = time.monotonic_ns()
        while True:
            with self._lock:
                if not self._deadlines or self._deadlines[0][0] > now:
                    return
                _, token = heapq.heappop(self._deadlines)
            entry = self._remove(token)
            if isinstance(entry, _Wait):
                _call_safely(entry.on_end, entry.native.transform())

    def run_iteration(self) -> int | None:
        """Run one iteration of the thread.

        Returns:
            How long the thread may sleep, in nanoseconds (negative: without a limit), or None if the thread may end.
        """
        with self._run_lock:
            tokens = self._mailbox.take()
        self._process(tokens, watches=True)
        self._end_expired_waits()
        with self._lock:
            if not self._entries:
                self._thread = None
                self._deadlines.clear()
                return None
            if not self._deadlines:
                return _NO_LIMIT
            return max(self._deadlines[0][0] - time.monotonic_ns(), 0)


def _run(reference: weakref.ref[Dispatcher], mailbox: _core.Mailbox) -> None:
    """Run the thread of a dispatcher, without keeping the dispatcher alive while it sleeps."""
    while True:
        dispatcher = reference()
        try:
            pause = dispatcher.run_iteration() if dispatcher is not None else None
        except BaseException:  # noqa: BLE001 - sys.exit() in one callback must not end the thread of all callbacks
            _log.exception(
                "A buffer callback raised an exception that would end the callback thread; the exception is ignored"
            )
            pause = 0
        del dispatcher
        if pause is None:
            return
        mailbox.wait(pause)


def _call_safely(callback: Callable[[Any], object], argument: Any) -> None:
    try:
        callback(argument)
    except Exception:  # noqa: BLE001 - an exception in a callback of the user must not prevent the next callbacks
        _log.exception("A buffer callback failed")


_all: weakref.WeakSet[Dispatcher] = weakref.WeakSet()
_exiting = threading.Event()  # Threads started during the exit may never run, and block the thread that starts them.


def _reset_all() -> None:
    """Drop all waits and watches in a forked child."""
    dispatchers = list(_all)
    callbacks = sum(dispatcher.user_watches() for dispatcher in dispatchers)
    for dispatcher in dispatchers:
        dispatcher.reset()
    if callbacks:
        _log.warning(
            "Callbacks of Buffer.on_change that were registered before a fork are not called in the forked process "
            "%d, because their thread exists only in its parent. Call on_change() in this process to register them.",
            os.getpid(),
        )


def _end_all() -> None:
    _exiting.set()
    for dispatcher in list(_all):
        dispatcher.end()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_reset_all)
atexit.register(_end_all)
