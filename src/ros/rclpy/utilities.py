"""The default context and the command line."""

from __future__ import annotations

import sys
import threading

from rclpy import _arguments
from rclpy.context import Context

_lock = threading.Lock()
_default_context: Context | None = None


def get_default_context(*, shutting_down: bool = False) -> Context:
    """Returns the context that is used where none is given.

    Args:
        shutting_down: Forget it, so that the next call makes a new one.
    """
    global _default_context  # noqa: PLW0603 - one per process, as its users expect
    with _lock:
        context = _default_context or Context()
        _default_context = None if shutting_down else context
        return context


def ok(*, context: Context | None = None) -> bool:
    """Returns whether the context is started and not shut down."""
    return (context or get_default_context()).ok()


def shutdown(*, context: Context | None = None) -> None:
    """Shuts the context down.

    Raises:
        RuntimeError: It was never started, or is shut down already.
    """
    (context or get_default_context(shutting_down=True)).shutdown()


def try_shutdown(*, context: Context | None = None) -> None:
    """Shuts the context down unless that happened before."""
    if context is None:
        context = get_default_context(shutting_down=True)
    context.try_shutdown()


def remove_ros_args(args: list[str] | None = None) -> list[str]:
    """Returns the arguments without `--ros-args ... --`.

    Args:
        args: The command line; None: `sys.argv`.
    """
    return _arguments.remove(sys.argv if args is None else args)


def get_rmw_implementation_identifier() -> str:
    """Returns the name of the ROS middleware whose conventions are spoken on the wire."""
    return "rmw_cyclonedds_cpp"


def get_available_rmw_implementations() -> set[str]:
    """Returns the names of all middlewares there are to choose from."""
    return {get_rmw_implementation_identifier()}
