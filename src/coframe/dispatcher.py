"""A thread that carries out in Python what native code has noticed: waits that were answered, edges that changed."""

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
    from coframe.transform import Transform

# Begins a native wait or watch that puts the token into the mailbox.
StartWait = Callable[[_core.Mailbox, int], _core.Wait]
StartWatch = Callable[[_core.Mailbox, int], _core.Watch]
Cancel = Callable[[], object]

_WAKE_UP = 0  # a token that stands for nothing
_FOR_EVER = -1
_FEW = 100
_PATIENCE = 1.0  # seconds for callbacks that run at the exit

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

    Its thread lives while there are any. Callbacks run under no lock; what they raise is logged. Those of watches run
    one after another in the thread; waits that an insertion from Python answers are called by the inserting thread.
    """

    def __init__(self) -> None:
        self.start_anew()
        _all.add(self)

    def start_anew(self) -> None:
        """Forgets everything; also in a forked process, which has no thread, but locks that one may have held."""
        self._mailbox = _core.Mailbox()
        # Who holds one of these locks may need it again: finalizers and signal handlers run anywhere.
        self._lock = threading.RLock()  # guards what follows; nothing foreign is called under it
        self._tokens = itertools.count(_WAKE_UP + 1)
        self._entries: dict[int, _Wait | _Watch] = {}
        self._deadlines: list[tuple[int, int]] = []  # a heap of (monotonic ns, token)
        self._thread: threading.Thread | None = None
        self._turn = threading.RLock()  # held from an insertion until its tokens are taken
        weakref.finalize(self, self._mailbox.put, _WAKE_UP).atexit = False

    def end(self) -> None:
        """Forgets everything and ends the thread: the exit would stop it anywhere, maybe with a lock in its hands."""
        with self._lock:
            entries, self._entries = self._entries, {}
            thread = self._thread
            self._mailbox.put(_WAKE_UP)
        entries.clear()
        if thread is not None:
            thread.join(_PATIENCE)

    @property
    def is_idle(self) -> bool:
        """Whether nobody waits or watches."""
        return not self._entries

    def wait(
        self, start: StartWait, on_end: Callable[[Transform | None], object], timeout: int | None = None
    ) -> Cancel:
        """Calls `on_end` once: with the transform, at once if it is there, or with None after `timeout` nanoseconds.

        Returns:
            Ends the wait without a call.
        """
        token = next(self._tokens)
        native = start(self._mailbox, token)
        found = native.transform()
        if found is not None:
            _call(on_end, found)
        else:
            self._add(token, _Wait(native, on_end), timeout)
            self._end_if_answered(token)  # before the entry was there, the token meant nothing
        return lambda: self._forget(token)

    def watch(self, start: StartWatch, on_change: Callable[[list[str]], object]) -> Cancel:
        """Calls `on_change` with the child frames of the edges that have changed, again and again.

        Returns:
            Ends the watch.
        """
        token = next(self._tokens)
        self._add(token, _Watch(start(self._mailbox, token), on_change), None)
        self._mailbox.put(token)  # before the entry was there, the token meant nothing
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
        self._carry_out(tokens, watches=False)

    def _add(self, token: int, entry: _Wait | _Watch, timeout: int | None) -> None:
        with self._lock:
            self._entries[token] = entry
            if timeout is not None:
                self._forget_old_deadlines()
                heapq.heappush(self._deadlines, (time.monotonic_ns() + timeout, token))
            if self._thread is not None or _exiting.is_set():
                if timeout is not None and self._deadlines[0][1] == token:
                    self._mailbox.put(_WAKE_UP)  # to sleep no longer than that
                return
            arguments = (weakref.ref(self), self._mailbox)
            self._thread = threading.Thread(target=_run, args=arguments, name="coframe waits", daemon=True)
            try:
                self._thread.start()
            except RuntimeError:  # there are too many, or the interpreter ends
                self._thread = None
                self._forget(token)
                raise

    def _forget_old_deadlines(self) -> None:
        """Those of waits that have ended may be far ahead."""
        if len(self._deadlines) <= 2 * len(self._entries) + _FEW:
            return
        old, self._deadlines = self._deadlines, []
        for deadline in old:
            if deadline[1] in self._entries:
                heapq.heappush(self._deadlines, deadline)

    def _forget(self, token: int) -> _Wait | _Watch | None:
        with self._lock:
            entry = self._entries.pop(token, None)
            if not self._entries:
                self._mailbox.put(_WAKE_UP)
        if entry is not None:
            entry.native.cancel()
        return entry

    def _carry_out(self, tokens: list[int], *, watches: bool) -> None:
        """What the tokens stand for; those of watches are for the thread."""
        tokens.reverse()
        try:
            while tokens:
                token = tokens.pop()
                entry = self._entries.get(token)
                if isinstance(entry, _Wait):
                    self._end_if_answered(token)
                elif isinstance(entry, _Watch) and watches:
                    self._tell_changes(entry)
                elif isinstance(entry, _Watch):
                    self._mailbox.put(token)
        finally:
            for token in tokens:  # a callback wants to end this thread: the others are not to suffer
                self._mailbox.put(token)

    def _end_if_answered(self, token: int) -> None:
        entry = self._entries.get(token)
        found = entry.native.transform() if isinstance(entry, _Wait) else None
        if isinstance(entry, _Wait) and found is not None and self._forget(token) is not None:
            _call(entry.on_end, found)

    @staticmethod
    def _tell_changes(watch: _Watch) -> None:
        changed = watch.native.take()
        if changed:
            _call(watch.on_change, changed)

    def _end_overdue(self) -> None:
        now = time.monotonic_ns()
        while True:
            with self._lock:
                if not self._deadlines or self._deadlines[0][0] > now:
                    return
                _, token = heapq.heappop(self._deadlines)
            entry = self._forget(token)
            if isinstance(entry, _Wait):
                _call(entry.on_end, entry.native.transform())

    def turn(self) -> int | None:
        """One round of the thread: nanoseconds that it may sleep now (negative: for ever), None if it may end."""
        with self._turn:
            tokens = self._mailbox.take()
        self._carry_out(tokens, watches=True)
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
        try:
            nap = dispatcher.turn() if dispatcher is not None else None
        except BaseException:  # noqa: BLE001 - sys.exit() in a callback ends no thread that others need
            _log.exception("a callback of a buffer wanted to end the thread of all callbacks")
            nap = 0
        del dispatcher
        if nap is None:
            return
        mailbox.wait(nap)


def _call(callback: Callable[[Any], object], argument: Any) -> None:
    try:
        callback(argument)
    except Exception:  # noqa: BLE001 - of the user's; the next ones are to be called as well
        _log.exception("a callback of a buffer failed")


_all: weakref.WeakSet[Dispatcher] = weakref.WeakSet()
_exiting = threading.Event()  # a thread that is started then may never begin, and the one who starts it never go on


def _start_all_anew() -> None:
    for dispatcher in list(_all):
        dispatcher.start_anew()


def _end_all() -> None:
    _exiting.set()
    for dispatcher in list(_all):
        dispatcher.end()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_start_all_anew)
atexit.register(_end_all)
