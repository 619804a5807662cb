# SPDX-License-Identifier: Apache-2.0
"""Default context and command line."""

from __future__ import annotations

import sys
import threading
from functools import partial

from rclpy import _absent, _arguments
from rclpy.constants import S_TO_NS
from rclpy.context import Context

_lock = threading.Lock()
_default_context: Context | None = None


def get_default_context(*, shutting_down: bool = False) -> Context:
    """Return the default context, which is used if no context is given.

    Args:
        shutting_down: Reset the default context, so that the next call creates a new one.
    """
    global _default_context  # noqa: PLW0603 - There is one default context per process.
    with _lock:
        context = _default_context or Context()
        _default_context = None if shutting_down else context
        return context


def ok(*, context: Context | None = None) -> bool:
    """Return whether the context is initialized and not shut down."""
    return (context or get_default_context()).ok()


def shutdown(*, context: Context | None = None) -> None:
    """Shut down the context.

    Raises:
        RuntimeError: The context was never initialized, or was shut down before.
    """
    (context or get_default_context(shutting_down=True)).shutdown()


def try_shutdown(*, context: Context | None = None) -> None:
    """Shut down the context unless it is shut down already."""
    if context is None:
        context = get_default_context(shutting_down=True)
    context.try_shutdown()


def remove_ros_args(args: list[str] | None = None) -> list[str]:
    """Return the arguments without `--ros-args ... --`.

    Args:
        args: Command line. None: `sys.argv`.
    """
    return _arguments.remove(sys.argv if args is None else args)


def timeout_sec_to_nsec(timeout_sec: float | None) -> int:
    """Return a timeout in nanoseconds, or -1 for no limit.

    Args:
        timeout_sec: Timeout in seconds. None or negative: no limit.
    """
    return -1 if timeout_sec is None or timeout_sec < 0 else int(float(timeout_sec) * S_TO_NS)


def get_rmw_implementation_identifier() -> str:
    """Return the name of the RMW implementation whose conventions are used on the wire."""
    return "rmw_cyclonedds_cpp"


def get_available_rmw_implementations() -> set[str]:
    """Return the names of the available RMW implementations."""
    return {get_rmw_implementation_identifier()}


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
