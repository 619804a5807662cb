# SPDX-License-Identifier: Apache-2.0
"""Options for composable nodes. A container sets them in a context, so node classes need no argument for them."""

from __future__ import annotations

import contextlib
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rclpy.node import Node
    from rclpy.parameter import Parameter

__all__ = ["ComposedOptions", "apply_options", "take_options"]


class ComposedOptions(NamedTuple):
    """The options of a node in a container.

    Attributes:
        cli_args: Arguments of the node, such as ``["--ros-args", "-r", "__node:=camera"]``.
        parameter_overrides: Parameters of the node.
        use_global_arguments: Whether the arguments of the container apply too.
    """

    cli_args: list[str]
    parameter_overrides: list[Parameter[Any]]
    use_global_arguments: bool = False


class _Pending:
    def __init__(self, cls: type, options: ComposedOptions) -> None:
        self.cls = cls
        self.options = options
        self.node: Node | None = None  # the node that has taken the options


_pending: ContextVar[_Pending | None] = ContextVar("_pending", default=None)


@contextlib.contextmanager
def apply_options(cls: type, options: ComposedOptions) -> Iterator[None]:
    """Apply options to the first node of a class that is created in this context.

    If the context raises an exception, the node is destroyed: its constructor has failed.
    """
    pending = _Pending(cls, options)
    token = _pending.set(pending)
    try:
        yield
    except BaseException:
        if hasattr(pending.node, "_Coframe__graph_node"):
            pending.node.destroy_node()  # type: ignore[union-attr]
        raise
    finally:
        _pending.reset(token)


def take_options(node: Node) -> ComposedOptions | None:
    """Return the options for a new node, once."""
    pending = _pending.get()
    if pending is None or pending.node is not None or type(node) is not pending.cls:
        return None
    pending.node = node
    return pending.options
