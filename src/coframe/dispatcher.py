"""A thread that carries out in Python what native code has noticed: waits that were answered, edges that changed."""

from __future__ import annotations

import heapq
import itertools
import logging
import threading
import time
import weakref
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from coframe import _core

if TYPE_CHECKING:
    from coframe.transform import Transform

# Begins a native wait or watch that puts the token into the mailbox.
StartWait = Callable[[_core.Mailbox, int], _core.Wait]
StartWatch = Callable[[_core.Mailbox, int], _core.Watch]
Cancel = Callable[[], object]

_WAKE_UP = 0  # a token that stands for nothing
_FOR_EVER = -1

_log = logging.getLogger("coframe")


@dataclass
class _Wait:
    native: _core.Wait
    on_end: Callable[[Transform | None], object]


@dataclass
class _Watch:
    native: _core.Watch
    on_change: Callable[[list[str]], object]


class Dispatcher:
    """Calls back for the waits and watches of one buffer.

    Its thread lives while there are any. Callbacks run one after another and under no lock; what they raise is logged.
    """

    def __init__(self) -> None:
        self._mailbox = _core.Mailbox()
        self._lock = threading.Lock()  # guards what follows; nothing foreign runs under it
        self._tokens = itertools.count(_WAKE_UP + 1)
        self._entries: dict[int, _Wait | _Watch] = {}
        self._deadlines: list[tuple[int, int]] = []  # a heap of (monotonic ns, token)
        self._thread: threading.Thread | None = None
        self._turn = threading.Lock()  # held while tokens change hands
        weakref.finalize(self, self._mailbox.put, _WAKE_UP).atexit = False

    @property
    def is_idle(self) -> bool:
        """Whether nobody waits or watches."""
        return not self._entries

    def wait(
        self, start: StartWait, on_end: Callable[[Transform | None], object], timeout: int | None = None
    ) -> Cancel:
        """Calls `on_end` once: with the transform, or with None after `timeout` nanoseconds.

        Returns:
            Ends the wait without a call.
        """
        token = next(self._tokens)
        # Before the entry is there a token means nothing, and the wait may end as soon as it begins.
        with self._turn:
            native = start(self._mailbox, token)
            self._add(token, _Wait(native, on_end), timeout)
        return lambda: self._forget(token)

    def watch(self, start: StartWatch, on_change: Callable[[list[str]], object]) -> Cancel:
        """Calls `on_change` with the child frames of the edges that have changed, again and again.

        Returns:
            Ends the watch.
        """
        token = next(self._tokens)
        with self._turn:
            self._add(token, _Watch(start(self._mailbox, token), on_change), None)
        return lambda: self._forget(token)

    @contextmanager
    def inserting(self) -> Iterator[None]:
        """A scope for insertions: who waits for one of them is called at the end of it, by this thread."""
        if self.is_idle:
            yield
            return
        with self._turn:
            yield
            tokens = self._mailbox.take()
        for token in tokens:
            self._carry_out(token)

    def settle(self) -> None:
        """Carries out in this thread what was noticed and nobody has carried out yet."""
        with self._turn:
            tokens = self._mailbox.take()
        for token in tokens:
            self._carry_out(token)

    def _add(self, token: int, entry: _Wait | _Watch, timeout: int | None) -> None:
        with self._lock:
            self._entries[token] = entry
            if timeout is not None:
                heapq.heappush(self._deadlines, (time.monotonic_ns() + timeout, token))
            if self._thread is not None:
                self._mailbox.put(_WAKE_UP)  # the next deadline may be another
                return
            self._thread = threading.Thread(
                target=_run, args=(weakref.ref(self), self._mailbox), name="coframe waits", daemon=True
            )
            self._thread.start()

    def _forget(self, token: int) -> _Wait | _Watch | None:
        with self._lock:
            entry = self._entries.pop(token, None)
            if not self._entries:
                self._mailbox.put(_WAKE_UP)
        if entry is not None:
            entry.native.cancel()
        return entry

    def _carry_out(self, token: int) -> None:
        entry = self._entries.get(token)
        if isinstance(entry, _Watch):
            _call(entry.on_change, entry.native.take())
        elif isinstance(entry, _Wait) and self._forget(token) is not None:
            _call(entry.on_end, entry.native.answer())

    def _end_overdue(self) -> None:
        now = time.monotonic_ns()
        while True:
            with self._lock:
                if not self._deadlines or self._deadlines[0][0] > now:
                    return
                _, token = heapq.heappop(self._deadlines)
            entry = self._forget(token)
            if isinstance(entry, _Wait):
                _call(entry.on_end, entry.native.answer())

    def turn(self) -> int | None:
        """One round of the thread: nanoseconds that it may sleep now (negative: for ever), None if it may end."""
        self.settle()
        self._end_overdue()
        with self._lock:
            if not self._entries:
                self._thread = None
                self._deadlines.clear()
                return None
            if not self._deadlines:
                return _FOR_EVER
            return max(self._deadlines[0][0] - time.monotonic_ns(), 0)


def _run(reference: weakref.ref[Dispatcher], mailbox: _core.Mailbox) -> None:
    """The thread; asleep, it does not keep the dispatcher alive."""
    while True:
        dispatcher = reference()
        nap = dispatcher.turn() if dispatcher is not None else None
        del dispatcher
        if nap is None:
            return
        mailbox.wait(nap)


def _call(callback: Callable[[Any], object], argument: Any) -> None:
    try:
        callback(argument)
    except Exception:  # noqa: BLE001 - of the user's; the next ones are to be called as well
        _log.exception("a callback of a buffer failed")
