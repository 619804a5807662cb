"""Ctrl-C and SIGTERM: all contexts shut down, and a program that ends by them ends without a traceback."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Callable
from enum import IntFlag
from types import FrameType, TracebackType
from typing import Any

from rclpy.context import _end_by_signal
from rclpy.exceptions import ROSInterruptException
from rclpy.executors import ExternalShutdownException


class SignalHandlerOptions(IntFlag):
    """Which signals shut the contexts down."""

    NO = 0
    SIGINT = 1
    SIGTERM = 2
    ALL = 3


_EXPECTED = (KeyboardInterrupt, ExternalShutdownException, ROSInterruptException)

_options = SignalHandlerOptions.NO
_previous_handlers: dict[int, Any] = {}
_was_signalled = False
_previous_hooks: tuple[Callable[..., Any], Callable[..., Any]] | None = None


def install_signal_handlers(options: SignalHandlerOptions = SignalHandlerOptions.ALL) -> None:
    """Shuts all contexts down at the given signals; the handlers before go on being called.

    Python lets only the main thread do this; elsewhere nothing happens.
    """
    global _options  # noqa: PLW0603 - handlers are the process's
    if threading.current_thread() is not threading.main_thread() or _options:
        return
    _options = options
    for option, number in (
        (SignalHandlerOptions.SIGINT, signal.SIGINT),
        (SignalHandlerOptions.SIGTERM, signal.SIGTERM),
    ):
        if option in options and option:
            _previous_handlers[number] = signal.signal(number, _handle)
    if options:
        _install_hooks()


def uninstall_signal_handlers() -> None:
    """Takes the handlers back; the silence about exceptions that a signal has caused stays."""
    global _options  # noqa: PLW0603
    if threading.current_thread() is not threading.main_thread():
        return
    _options = SignalHandlerOptions.NO
    for number, handler in _previous_handlers.items():
        if signal.getsignal(number) is _handle:
            signal.signal(number, handler)
    _previous_handlers.clear()
    if not _was_signalled:
        _uninstall_hooks()


def get_current_signal_handlers_options() -> SignalHandlerOptions:
    """Returns which signals shut the contexts down."""
    return _options


def _handle(number: int, frame: FrameType | None) -> None:
    global _was_signalled  # noqa: PLW0603
    _was_signalled = True
    _end_by_signal()
    previous = _previous_handlers.get(number)
    if callable(previous):
        previous(number, frame)


def _install_hooks() -> None:
    global _previous_hooks  # noqa: PLW0603
    if _previous_hooks is None:
        _previous_hooks = sys.excepthook, threading.excepthook
        sys.excepthook, threading.excepthook = _excepthook, _thread_excepthook


def _uninstall_hooks() -> None:
    global _previous_hooks  # noqa: PLW0603
    if _previous_hooks is not None and sys.excepthook is _excepthook:
        sys.excepthook, threading.excepthook = _previous_hooks
        _previous_hooks = None


def _excepthook(kind: type[BaseException], value: BaseException, traceback: TracebackType | None) -> None:
    if not (_was_signalled and isinstance(value, _EXPECTED)) and _previous_hooks is not None:
        _previous_hooks[0](kind, value, traceback)


def _thread_excepthook(args: threading.ExceptHookArgs) -> None:
    if not (_was_signalled and isinstance(args.exc_value, _EXPECTED)) and _previous_hooks is not None:
        _previous_hooks[1](args)
