# SPDX-License-Identifier: Apache-2.0
"""Contexts: the ROS arguments, the ROS domain and the shutdown state that nodes share."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

import atexit
import os
import sys
import threading
import weakref
from functools import partial
from typing import TYPE_CHECKING

from coframe._core import Event
from rclpy import _absent, _arguments
from rclpy import logging as ros_logging
from rclpy._absent import Handle
from rclpy._interruption import Interruption
from rclpy._wakeup import Wakeup
from rclpy.exceptions import RCLError, RCLInvalidROSArgsError, _with_hint

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import TracebackType

    from typing_extensions import Self

    from coframe.wire.participant import Participant
    from rclpy.node import Node

# A plain list, so that a signal handler can iterate over it at any time.
_running: list[Context] = []


class Context:
    """State between init and shutdown. As a context manager, it initializes and shuts down."""

    handle = Handle()

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._Coframe__arguments = _arguments.Arguments()
        self.__domain_id = 0
        self.__is_initialized = False
        self.__is_ok = False
        self._Coframe__was_shut_down_by_signal = False
        self.__tracked_nodes: list[weakref.ref[Node]] = []
        self.__shutdown_callbacks: list[Callable[[], Callable[[], object] | None]] = []
        self._Coframe__shutdown = Interruption()
        self._Coframe__wakeup = Wakeup()
        # Set when publishers must not publish anymore, for native code.
        self._Coframe__closed = Event()

    def init(
        self,
        args: list[str] | None = None,
        *,
        initialize_logging: bool = True,
        domain_id: int | None = None,
    ) -> None:
        """Initialize the context.

        Args:
            args: Command line with `--ros-args`. None: `sys.argv`.
            initialize_logging: Whether to apply logging options such as `--log-level`.
            domain_id: ROS domain. None: ROS_DOMAIN_ID or 0.

        Raises:
            RuntimeError: The context was initialized before, or the domain is negative.
            RCLInvalidROSArgsError: The arguments are malformed.
        """
        with self._lock:
            if self.__is_initialized:
                raise RuntimeError("Context.init() must only be called once")
            if domain_id is not None and domain_id < 0:
                raise RuntimeError(f"Domain id ({domain_id}) should not be lower than zero.")
            self._Coframe__arguments = _parse_arguments(sys.argv if args is None else args)
            self.__domain_id = _default_domain_id() if domain_id is None else domain_id
            if initialize_logging:
                ros_logging._configure(self._Coframe__arguments.logging)
            self.__is_initialized = self.__is_ok = True
            _running.append(self)

    def ok(self) -> bool:
        """Return whether the context is initialized and not shut down."""
        return self.__is_ok

    def get_domain_id(self) -> int:
        """Return the ROS domain of the context."""
        return self.__domain_id

    def shutdown(self) -> None:
        """Shut down the context. Calls that spin or sleep in it return.

        Raises:
            RuntimeError: The context was never initialized, or was shut down before (except by a signal).
        """
        if not self.__is_initialized:
            raise RuntimeError("Context must be initialized before it can be shutdown")
        if not self._Coframe__shut_down() and not self._Coframe__was_shut_down_by_signal:
            raise RuntimeError("failed to shutdown: shutdown was already called on the given context")

    def destroy(self) -> None:
        """Destroy the tracked nodes, and shut down the context unless it is shut down already."""
        with self._lock:
            references, self.__tracked_nodes = self.__tracked_nodes, []
        for reference in references:
            if (node := reference()) is not None:
                node.destroy_node()
        self.try_shutdown()

    def try_shutdown(self) -> None:
        """Shut down the context unless it is shut down already."""
        self._Coframe__shut_down()

    def on_shutdown(self, callback: Callable[[], object]) -> None:
        """Register a callback for the shutdown. Of a method, only a weak reference is kept.

        Raises:
            TypeError: `callback` is not callable.
        """
        if not callable(callback):
            raise TypeError("callback should be a callable, got {}", type(callback))
        if hasattr(callback, "__self__") and hasattr(callback, "__func__"):
            self.__shutdown_callbacks.append(weakref.WeakMethod(callback))
        else:
            self.__shutdown_callbacks.append(lambda: callback)

    def track_node(self, node: Node) -> None:
        """Destroy a node when the context is destroyed, unless the node is destroyed before."""
        with self._lock:
            self.__tracked_nodes.append(weakref.ref(node))

    def untrack_node(self, node: Node) -> None:
        """Leave a node that `track_node` added alone when the context is destroyed."""
        with self._lock:
            self.__tracked_nodes = [reference for reference in self.__tracked_nodes if reference() is not node]

    def __enter__(self) -> Self:
        if not self.__is_initialized:
            self.init()
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_value: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.try_shutdown()

    def _Coframe__shut_down(self, *, by_signal: bool = False) -> bool:
        """Shut down the context. Return False if it is shut down already.

        A signal handler may call this, so it acquires no lock that the interrupted code could hold.
        """
        with self._lock:
            if not self.__is_ok:
                return False
            self.__is_ok = False
            self._Coframe__was_shut_down_by_signal = by_signal
            # After a signal, a program may still publish final messages, for example to stop the robot.
            if not by_signal:
                self._Coframe__closed.set()
            _running.remove(self)
        self._Coframe__wakeup.set()
        self._Coframe__shutdown.set()
        callbacks, self.__shutdown_callbacks = self.__shutdown_callbacks, []
        for reference in callbacks:
            if (callback := reference()) is not None:
                callback()
        return True

    def _Coframe__get_participant(self) -> Participant:
        """Return the participant. The caller closes it."""
        # Times, clocks and futures need no middleware.
        from coframe.wire.participant import Participant  # noqa: PLC0415
        from coframe.wire.system_clock import stamp_fault  # noqa: PLC0415

        if (fault := stamp_fault()) is not None:
            raise fault
        participant = Participant.get(self.__domain_id)
        # Exit handlers run in reverse order of registration, and executors must stop before participants are closed.
        atexit.unregister(_shut_down_at_exit)
        atexit.register(_shut_down_at_exit)
        return participant


def _parse_arguments(args: list[str]) -> _arguments.Arguments:
    for argument in args:
        argument.encode()  # Arguments with surrogates are a UnicodeEncodeError, as in ROS 2.
    try:
        arguments = _arguments.parse(args)
    except RCLInvalidROSArgsError as error:
        # Upstream raises this class for the arguments of a process and RCLInvalidROSArgsError for those of a node.
        raise _with_hint(RCLError(f"failed to initialize rcl: {error}"), getattr(error, "hint", "")) from None
    if arguments.logging.config_file is not None:
        raise _with_hint(
            RCLError(
                "failed to initialize logging: spdlog logging backend doesn't currently support external configuration"
            ),
            "Use --log-level, for example `--log-level debug` or `--log-level my_node:=debug`.",
        )
    for rule in arguments.deprecated_remaps:
        ros_logging.get_logger("rcl").warning(
            f"Found remap rule '{rule}'. This syntax is deprecated. Use '--ros-args --remap {rule}' instead."
        )
    return arguments


def _default_domain_id() -> int:
    text = os.environ.get("ROS_DOMAIN_ID", "").strip() or "0"
    if not text.isdecimal() or len(text) > 9:
        raise RuntimeError(f"ROS_DOMAIN_ID is {text[:60]!r}, which is not a domain. Set it to a number from 0 to 232.")
    return int(text)


def _shut_down_by_signal() -> None:
    for context in tuple(_running):
        context._Coframe__shut_down(by_signal=True)


def _shut_down_at_exit() -> None:
    contexts = tuple(_running)
    for context in contexts:
        context._Coframe__shut_down()
    for context in contexts:
        context._Coframe__wakeup.wait_until_idle()


atexit.register(_shut_down_at_exit)

__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
