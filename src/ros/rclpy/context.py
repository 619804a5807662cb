"""What a process shares between init and shutdown: arguments, the domain, and the end."""

from __future__ import annotations

import atexit
import os
import sys
import threading
import weakref
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from coframe._core import Event

from rclpy import _arguments
from rclpy import logging as ros_logging
from rclpy._wakeup import Wakeup

if TYPE_CHECKING:
    from types import TracebackType

    from coframe.wire import Participant
    from typing_extensions import Self

# Plain, so that a signal handler may walk through it at any moment.
_running: list[Context] = []


class Context:
    """The life between init and shutdown; also a context manager that does both."""

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._arguments = _arguments.Arguments()
        self._domain_id = 0
        self._is_initialized = False
        self._is_ok = False
        self._was_ended_by_signal = False
        self._shutdown_callbacks: list[Callable[[], Callable[[], object] | None]] = []
        self._events: set[Event] = set()
        self._wakeup = Wakeup()

    def init(
        self,
        args: list[str] | None = None,
        *,
        initialize_logging: bool = True,
        domain_id: int | None = None,
    ) -> None:
        """Starts the context.

        Args:
            args: Command line with `--ros-args`; None: `sys.argv`.
            initialize_logging: Whether `--log-level` and the like apply.
            domain_id: DDS domain; None: ROS_DOMAIN_ID or 0.

        Raises:
            RuntimeError: It was started before, or the domain is negative.
            RCLInvalidROSArgsError: The arguments are malformed.
        """
        with self._lock:
            if self._is_initialized:
                raise RuntimeError("Context.init() must only be called once")
            if domain_id is not None and domain_id < 0:
                raise RuntimeError(f"Domain id ({domain_id}) should not be lower than zero.")
            self._arguments = _arguments.parse(sys.argv if args is None else args)
            self._domain_id = _default_domain_id() if domain_id is None else domain_id
            if initialize_logging:
                ros_logging._configure(self._arguments.logging)
            self._is_initialized = self._is_ok = True
            _running.append(self)

    def ok(self) -> bool:
        """Whether it is started and not shut down."""
        return self._is_ok

    def get_domain_id(self) -> int:
        """Returns the DDS domain."""
        return self._domain_id

    def shutdown(self) -> None:
        """Ends the context: what spins or sleeps in it returns.

        Raises:
            RuntimeError: It was never started, or is shut down already (by anything but a signal).
        """
        if not self._is_initialized:
            raise RuntimeError("Context must be initialized before it can be shutdown")
        if not self._end() and not self._was_ended_by_signal:
            raise RuntimeError("failed to shutdown: shutdown was already called on the given context")

    def try_shutdown(self) -> None:
        """Ends the context unless that happened before."""
        self._end()

    def on_shutdown(self, callback: Callable[[], object]) -> None:
        """Calls `callback` at the shutdown; of a method, only while its object lives.

        Raises:
            TypeError: It is not callable.
        """
        if not callable(callback):
            raise TypeError(f"callback should be a callable, got {type(callback)}")
        if hasattr(callback, "__self__") and hasattr(callback, "__func__"):
            self._shutdown_callbacks.append(weakref.WeakMethod(callback))
        else:
            self._shutdown_callbacks.append(lambda: callback)

    def __enter__(self) -> Self:
        if not self._is_initialized:
            self.init()
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_value: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.try_shutdown()

    def _end(self, *, by_signal: bool = False) -> bool:
        """Shuts down; takes no lock that the interrupted code could hold. False when it was done before."""
        with self._lock:
            if not self._is_ok:
                return False
            self._is_ok = False
            self._was_ended_by_signal = by_signal
            _running.remove(self)
        self._wakeup.set()
        for event in tuple(self._events):
            event.set()
        callbacks, self._shutdown_callbacks = self._shutdown_callbacks, []
        for reference in callbacks:
            if (callback := reference()) is not None:
                callback()
        return True

    @contextmanager
    def _setting_at_shutdown(self, event: Event) -> Iterator[None]:
        """Within the block, a shutdown sets the event."""
        self._events.add(event)
        if not self._is_ok:
            event.set()
        try:
            yield
        finally:
            self._events.discard(event)

    def _join_graph(self) -> Participant:
        """Returns the DDS participant; the caller closes it."""
        from coframe.wire import Participant  # noqa: PLC0415 - time, clocks and futures work without DDS

        participant = Participant.get(self._domain_id)
        # Exit handlers run last in, first out: executors must have stopped before DDS ends.
        atexit.unregister(_end_at_exit)
        atexit.register(_end_at_exit)
        return participant


def _default_domain_id() -> int:
    text = os.environ.get("ROS_DOMAIN_ID", "").strip() or "0"
    if not text.isdecimal():
        raise RuntimeError(f"ROS_DOMAIN_ID is {text!r}, which is no domain: set it to a number from 0 to 232")
    return int(text)


def _end_by_signal() -> None:
    for context in tuple(_running):
        context._end(by_signal=True)


def _end_at_exit() -> None:
    contexts = tuple(_running)
    for context in contexts:
        context._end()
    for context in contexts:
        context._wakeup.wait_until_idle()


atexit.register(_end_at_exit)
