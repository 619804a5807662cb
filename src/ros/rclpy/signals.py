# SPDX-License-Identifier: Apache-2.0
"""Handlers of SIGINT and SIGTERM, which shut down all contexts and suppress the traceback of the exit."""

from __future__ import annotations

import signal
import sys
import threading
import weakref
from enum import IntFlag
from functools import partial
from typing import TYPE_CHECKING, Any

from coframe._process.signal_handlers import SignalHandlers
from rclpy import _absent
from rclpy.context import _shut_down_by_signal
from rclpy.exceptions import ROSInterruptException
from rclpy.executors import ExternalShutdownException
from rclpy.guard_condition import GuardCondition

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType, TracebackType

    from rclpy.context import Context


class SignalHandlerOptions(IntFlag):
    """Signals that shut down the contexts."""

    NO = 0
    SIGINT = 1
    SIGTERM = 2
    ALL = 3


_EXPECTED = (KeyboardInterrupt, ExternalShutdownException, ROSInterruptException)

_options = SignalHandlerOptions.NO
_handlers = SignalHandlers()
_was_signalled = False
_previous_hooks: tuple[Callable[..., Any], Callable[..., Any], Callable[..., Any]] | None = None


def install_signal_handlers(options: SignalHandlerOptions = SignalHandlerOptions.ALL) -> None:
    """Install handlers that shut down all contexts. The previous handlers are still called.

    Processes that are forked from this one have the previous handlers only: SIGTERM ends them.

    Python allows this only in the main thread. In other threads, this function does nothing.
    """
    global _options  # noqa: PLW0603 - Signal handlers belong to the process.
    if threading.current_thread() is not threading.main_thread() or get_current_signal_handlers_options():
        return
    _options = options
    for option, number in (
        (SignalHandlerOptions.SIGINT, signal.SIGINT),
        (SignalHandlerOptions.SIGTERM, signal.SIGTERM),
    ):
        if option in options and option:
            _handlers.install(number, _handle)
    if options:
        _install_hooks()


def uninstall_signal_handlers() -> None:
    """Restore the previous handlers. Tracebacks of exceptions caused by a signal remain suppressed."""
    global _options  # noqa: PLW0603
    if threading.current_thread() is not threading.main_thread():
        return
    _options = SignalHandlerOptions.NO
    _handlers.restore()
    if not _was_signalled:
        _uninstall_hooks()


def get_current_signal_handlers_options() -> SignalHandlerOptions:
    """Return the signals that shut down the contexts."""
    return _options if _handlers.active else SignalHandlerOptions.NO


class SignalHandlerGuardCondition(GuardCondition):
    """Guard condition that SIGINT and SIGTERM trigger while rclpy's signal handlers are installed.

    Args:
        context: Context whose executors wait for it. None: the default context.
    """

    def __init__(self, context: Context | None = None) -> None:
        super().__init__(callback=None, callback_group=None, context=context)
        _guard_conditions.add(self)

    def destroy(self) -> None:
        """Destroy the guard condition, which signals no longer trigger."""
        _guard_conditions.discard(self)
        super().destroy()


# Read in a signal handler. Guard conditions that are not referenced anymore are removed.
_guard_conditions: weakref.WeakSet[SignalHandlerGuardCondition] = weakref.WeakSet()


def _handle(number: int, frame: FrameType | None) -> None:
    global _was_signalled  # noqa: PLW0603
    _was_signalled = True
    _shut_down_by_signal()
    for guard_condition in tuple(_guard_conditions):
        guard_condition.trigger()
    previous = _handlers.previous(number)
    if previous is not None:
        previous(number, frame)


def _install_hooks() -> None:
    global _previous_hooks  # noqa: PLW0603
    if _previous_hooks is None:
        _previous_hooks = sys.excepthook, threading.excepthook, sys.unraisablehook
        sys.excepthook, threading.excepthook, sys.unraisablehook = _excepthook, _thread_excepthook, _unraisable_hook


def _uninstall_hooks() -> None:
    global _previous_hooks  # noqa: PLW0603
    if _previous_hooks is not None and sys.excepthook is _excepthook:
        sys.excepthook, threading.excepthook, unraisable_hook = _previous_hooks
        if sys.unraisablehook is _unraisable_hook:  # Test frameworks replace it for a while.
            sys.unraisablehook = unraisable_hook
        _previous_hooks = None


def _excepthook(kind: type[BaseException], value: BaseException, traceback: TracebackType | None) -> None:
    if not (_was_signalled and isinstance(value, _EXPECTED)) and _previous_hooks is not None:
        _previous_hooks[0](kind, value, traceback)


def _thread_excepthook(args: threading.ExceptHookArgs) -> None:
    if not (_was_signalled and isinstance(args.exc_value, _EXPECTED)) and _previous_hooks is not None:
        _previous_hooks[1](args)


# A signal can arrive in `__del__` or in the callback of a weak reference, which each import has. Python ignores
# exceptions there and reports them, but the signal has had its effect: the contexts are shut down.
def _unraisable_hook(args: sys.UnraisableHookArgs) -> None:
    if not (_was_signalled and isinstance(args.exc_value, _EXPECTED)) and _previous_hooks is not None:
        _previous_hooks[2](args)


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
