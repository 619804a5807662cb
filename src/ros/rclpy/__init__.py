# SPDX-License-Identifier: Apache-2.0
"""The ROS 2 client library for Python (the API of Humble, Jazzy and Kilted) without a ROS installation.

    import rclpy

    rclpy.init()
    node = rclpy.create_node("my_node")
    rclpy.spin(node)

This package is used if no ROS installation is sourced. A ROS installation on the path takes precedence as a whole.
"""

from __future__ import annotations

from contextlib import contextmanager
from importlib import import_module
from typing import TYPE_CHECKING, Any

from coframe.workspace import ros_side

ros_side.check(__name__)

from rclpy import utilities
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.impl import implementation_singleton  # noqa: F401 - libraries use it as an attribute
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, qos_profile_rosout_default
from rclpy.signals import (
    SignalHandlerOptions,
    install_signal_handlers,
    uninstall_signal_handlers,
)
from rclpy.task import Future
from rclpy.utilities import (
    get_default_context,
    get_rmw_implementation_identifier,
    ok,
)

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import TracebackType

    from typing_extensions import Self

    from rclpy import (
        action,
        callback_groups,
        client,
        clock,
        clock_type,
        constants,
        context,
        duration,
        exceptions,
        executors,
        expand_topic_name,
        guard_condition,
        handle,
        logging,
        node,
        parameter,
        parameter_service,
        publisher,
        qos,
        qos_event,
        serialization,
        service,
        signals,
        subscription,
        task,
        time,
        time_source,
        timer,
        topic_endpoint_info,
        topic_or_service_is_hidden,
        type_hash,
        type_support,
        validate_full_topic_name,
        validate_namespace,
        validate_node_name,
        validate_parameter_name,
        validate_topic_name,
        wait_for_message,
    )
    from rclpy.executors import Executor
    from rclpy.node import Node
    from rclpy.subscription import MessageInfo

__all__ = [
    "Context",
    "Future",
    "InitContextManager",
    "MessageInfo",
    "Parameter",
    "SignalHandlerOptions",
    "SingleThreadedExecutor",
    "action",
    "callback_groups",
    "client",
    "clock",
    "clock_type",
    "constants",
    "context",
    "create_node",
    "duration",
    "exceptions",
    "executors",
    "expand_topic_name",
    "get_default_context",
    "get_global_executor",
    "get_rmw_implementation_identifier",
    "guard_condition",
    "handle",
    "init",
    "install_signal_handlers",
    "logging",
    "node",
    "ok",
    "parameter",
    "parameter_service",
    "publisher",
    "qos",
    "qos_event",
    "serialization",
    "service",
    "shutdown",
    "signals",
    "spin",
    "spin_once",
    "spin_until_future_complete",
    "subscription",
    "task",
    "time",
    "time_source",
    "timer",
    "topic_endpoint_info",
    "topic_or_service_is_hidden",
    "try_shutdown",
    "type_hash",
    "type_support",
    "uninstall_signal_handlers",
    "utilities",
    "validate_full_topic_name",
    "validate_namespace",
    "validate_node_name",
    "validate_parameter_name",
    "validate_topic_name",
    "wait_for_message",
]

_global_executor: Executor | None = None


def __getattr__(name: str) -> Any:
    """Import a module when a program uses it as an attribute, for example rclpy.time.Time."""
    if name == "MessageInfo":
        return import_module("rclpy.subscription").MessageInfo
    if name in __all__:
        return import_module(f"rclpy.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


class InitContextManager:
    """Context manager returned by `init()`. `with rclpy.init(): ...` shuts down at the end of the block.

    The arguments are those of `init`.
    """

    def __init__(
        self,
        args: list[str] | None = None,
        context: Context | None = None,
        domain_id: int | None = None,
        signal_handler_options: SignalHandlerOptions | None = None,
    ) -> None:
        if signal_handler_options is None:
            signal_handler_options = SignalHandlerOptions.ALL if context is None else SignalHandlerOptions.NO
        self.context = context or get_default_context()
        self.context.init(args, domain_id=domain_id)
        install_signal_handlers(signal_handler_options)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        exc_type: type[BaseException] | None,
        exc_value: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if self.context.ok():
            _shut_down(self.context, uninstall_handlers=None)


def init(
    *,
    args: list[str] | None = None,
    context: Context | None = None,
    domain_id: int | None = None,
    signal_handler_options: SignalHandlerOptions | None = None,
) -> InitContextManager:
    """Initialize ROS communication. Call this once before using other functions.

    Args:
        args: Command line with `--ros-args`. None: `sys.argv`.
        context: Context to initialize. None: the default context.
        domain_id: ROS domain. None: ROS_DOMAIN_ID or 0.
        signal_handler_options: Signals that shut down all contexts. None: SIGINT and SIGTERM for the default context,
            no signals for other contexts.

    Returns:
        A context manager that calls `shutdown()`. Its use is optional.

    Raises:
        RuntimeError: The context was initialized before.
        RCLInvalidROSArgsError: The arguments are malformed.
    """
    return InitContextManager(args, context, domain_id, signal_handler_options)


def shutdown(*, context: Context | None = None, uninstall_handlers: bool | None = None) -> None:
    """Shut down ROS communication. Calls that spin or sleep return.

    If a signal has shut down the context already, this does nothing.

    Args:
        context: Context to shut down. None: the default context.
        uninstall_handlers: Whether to restore the previous signal handlers. None: only for the default context.

    Raises:
        RuntimeError: The context was never initialized, or was shut down before.
    """
    _shut_down(context, uninstall_handlers=uninstall_handlers)


def try_shutdown(*, context: Context | None = None, uninstall_handlers: bool | None = None) -> None:
    """Shut down ROS communication unless it is shut down already. See `shutdown`."""
    chosen = get_default_context() if context is None else context
    # After a signal, the default context is replaced, so that init() works again.
    if chosen.ok() or chosen._Coframe__was_shut_down_by_signal:  # noqa: SLF001 - shared in rclpy
        _shut_down(context, uninstall_handlers=uninstall_handlers)


def _shut_down(context: Context | None, *, uninstall_handlers: bool | None) -> None:
    global _global_executor
    is_default = context is None or context is get_default_context()
    utilities.shutdown(context=None if is_default else context)
    if is_default:
        executor, _global_executor = _global_executor, None
        if executor is not None:
            executor.shutdown(timeout_sec=0)
    if uninstall_handlers or (uninstall_handlers is None and is_default):
        uninstall_signal_handlers()


def create_node(
    node_name: str,
    *,
    context: Context | None = None,
    cli_args: list[str] | None = None,
    namespace: str | None = None,
    use_global_arguments: bool = True,
    enable_rosout: bool = True,
    start_parameter_services: bool = True,
    parameter_overrides: list[Parameter[Any]] | None = None,
    allow_undeclared_parameters: bool = False,
    automatically_declare_parameters_from_overrides: bool = False,
    enable_logger_service: bool = False,
    rosout_qos_profile: QoSProfile | int = qos_profile_rosout_default,
) -> Node:
    """Create a node. The arguments are the same as for `rclpy.node.Node`."""
    from rclpy.node import Node  # noqa: PLC0415 - programs that only use messages or times need no nodes

    return Node(
        node_name,
        context=context,
        cli_args=cli_args,
        namespace=namespace,
        use_global_arguments=use_global_arguments,
        enable_rosout=enable_rosout,
        start_parameter_services=start_parameter_services,
        parameter_overrides=parameter_overrides,
        allow_undeclared_parameters=allow_undeclared_parameters,
        automatically_declare_parameters_from_overrides=automatically_declare_parameters_from_overrides,
        enable_logger_service=enable_logger_service,
        rosout_qos_profile=rosout_qos_profile,
    )


def get_global_executor() -> Executor:
    """Return the executor that `spin` and related functions use if no executor is given."""
    global _global_executor  # noqa: PLW0603
    if _global_executor is None or _global_executor.context is not get_default_context():
        _global_executor = SingleThreadedExecutor()
    return _global_executor


def spin(node: Node, executor: Executor | None = None) -> None:
    """Run the callbacks of a node until the context is shut down.

    Args:
        node: Node to spin.
        executor: Executor to use. None: the global executor.
    """
    with _add_temporarily(node, executor) as added:
        added.spin()


def spin_once(node: Node, *, executor: Executor | None = None, timeout_sec: float | None = None) -> None:
    """Wait for one callback of a node and run it.

    Args:
        node: Node to spin.
        executor: Executor to use. None: the global executor.
        timeout_sec: Maximum time to wait in seconds. None or negative: no limit.

    Raises:
        ExternalShutdownException: The context was shut down.
    """
    with _add_temporarily(node, executor) as added:
        added.spin_once(timeout_sec=timeout_sec)


def spin_until_future_complete(
    node: Node,
    future: Future[Any],
    executor: Executor | None = None,
    timeout_sec: float | None = None,
) -> None:
    """Run the callbacks of a node until a future is complete.

    Args:
        node: The node whose callbacks run.
        future: Future to wait for.
        executor: Executor that runs the callbacks. None: the global executor.
        timeout_sec: Maximum time to wait in seconds. None or negative: no limit.

    Raises:
        ExternalShutdownException: The context was shut down.
    """
    with _add_temporarily(node, executor) as added:
        added.spin_until_future_complete(future, timeout_sec)


@contextmanager
def _add_temporarily(node: Node, executor: Executor | None) -> Iterator[Executor]:
    """Add a node to an executor temporarily, and return it to its previous executor."""
    executor = executor or get_global_executor()
    previous = node.executor
    is_new = executor.add_node(node)
    try:
        yield executor
    finally:
        if is_new:
            executor.remove_node(node)
            if previous is not None and node.executor is None and previous.context.ok():
                previous.add_node(node)
