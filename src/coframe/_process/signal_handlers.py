# SPDX-License-Identifier: Apache-2.0
"""Signal handlers that forked child processes do not inherit, and the exit code after Ctrl-C."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from types import FrameType
from typing import Any

__all__ = ["SIGINT_EXIT_CODE", "SignalHandlers", "clear_handled_interrupt"]

SIGINT_EXIT_CODE = 130  # 128 + SIGINT, as in shells

_Handler = Callable[[int, FrameType | None], object]


class SignalHandlers:
    """The signal handlers that one part of the program has installed. Use only in the main thread.

    They stop the nodes, the event loop or the command of this process. None of these exist in a forked child,
    so the child gets the previous handlers back. Otherwise SIGTERM would not end the workers of a
    `multiprocessing.Pool`, and the Pool would wait for them forever.
    """

    def __init__(self) -> None:
        self._replaced_handlers: dict[int, tuple[_Handler, Any]] = {}

    def install(self, number: int, handler: _Handler) -> None:
        """Handle a signal, until `restore` is called."""
        self._replaced_handlers[number] = handler, signal.signal(number, handler)
        if self not in _active_handlers:
            _active_handlers.append(self)

    @property
    def active(self) -> bool:
        """Whether the handlers are installed, or False after `restore` and in a forked child."""
        return bool(self._replaced_handlers)

    def previous(self, number: int) -> _Handler | None:
        """Return the previous handler of a signal, or None if it was not a function."""
        _, previous = self._replaced_handlers.get(number, (None, None))
        return previous if callable(previous) else None

    def restore(self) -> None:
        """Restore the previous handlers, except where another part of the program has installed its own since."""
        for number, (handler, previous) in self._replaced_handlers.items():
            if signal.getsignal(number) is handler:
                # None means that native code set it; Python cannot restore such a handler.
                signal.signal(number, signal.SIG_DFL if previous is None else previous)
        self._replaced_handlers.clear()
        if self in _active_handlers:
            _active_handlers.remove(self)


def clear_handled_interrupt() -> None:
    """Let a process started with ``python -m`` keep its own exit code after it has handled a Ctrl-C.

    CPython remembers a KeyboardInterrupt that leaves the code of ``exec(text)`` or ``eval(text)``, such as the code
    that `dataclasses` and `collections.namedtuple` generate during an import. On exit, it then ends itself with SIGINT,
    even if the exception was handled. The next ``exec(text)`` clears this state (``run_eval_code_obj`` in pythonrun.c).
    """
    exec("")  # noqa: S102 - it runs nothing


_active_handlers: list[SignalHandlers] = []


def _restore_all() -> None:
    for handlers in reversed(_active_handlers.copy()):
        handlers.restore()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_restore_all)
