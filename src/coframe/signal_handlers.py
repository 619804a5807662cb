# SPDX-License-Identifier: Apache-2.0
"""Signal handlers of one process, which the processes that are forked from it do not inherit."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from types import FrameType
from typing import Any

__all__ = ["SignalHandlers", "clear_handled_interrupt"]

_Handler = Callable[[int, FrameType | None], object]


class SignalHandlers:
    """The signal handlers that one part of the program has installed; for the main thread only.

    They end what runs in this process: its nodes, its event loop, its command. A forked child has none of that, so
    there the signals have their previous handlers. Otherwise SIGTERM would not end the workers of a
    `multiprocessing.Pool`, and the Pool would wait for them for ever.
    """

    def __init__(self) -> None:
        self._installed: dict[int, tuple[_Handler, Any]] = {}

    def install(self, number: int, handler: _Handler) -> None:
        """Handle a signal, until `restore` is called."""
        self._installed[number] = handler, signal.signal(number, handler)
        if self not in _in_use:
            _in_use.append(self)

    @property
    def active(self) -> bool:
        """Whether handlers are installed: not after `restore`, and not in a forked child."""
        return bool(self._installed)

    def previous(self, number: int) -> _Handler | None:
        """Return the handler that a signal had before, or None if it was no function."""
        _, previous = self._installed.get(number, (None, None))
        return previous if callable(previous) else None

    def restore(self) -> None:
        """Restore the previous handlers, except where another part of the program has set its own since."""
        for number, (handler, previous) in self._installed.items():
            if signal.getsignal(number) is handler:
                # None: it was set by native code, and Python cannot restore it.
                signal.signal(number, signal.SIG_DFL if previous is None else previous)
        self._installed.clear()
        if self in _in_use:
            _in_use.remove(self)


def clear_handled_interrupt() -> None:
    """Let a process started with ``python -m`` exit with its own exit code after a Ctrl-C that it has handled.

    CPython notes a KeyboardInterrupt that leaves the code of ``exec(text)`` or ``eval(text)``, such as the code that
    `dataclasses` and `collections.namedtuple` generate during an import. At its exit it ends itself with SIGINT then,
    even if the exception was handled. The next ``exec(text)`` deletes the note (``run_eval_code_obj`` in pythonrun.c).
    """
    exec("")  # noqa: S102 - it runs nothing


_in_use: list[SignalHandlers] = []


def _restore_all() -> None:
    for handlers in reversed(_in_use.copy()):
        handlers.restore()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_restore_all)
