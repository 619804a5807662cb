# SPDX-License-Identifier: Apache-2.0
"""Spins a node in a thread."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

from rclpy.executors import SingleThreadedExecutor

if TYPE_CHECKING:
    from rclpy.context import Context
    from rclpy.node import Node

__all__ = ["MessagePump"]

_PERIOD = 0.1  # seconds between checks for `stop`


class MessagePump:
    """Spins a node in a thread, so that a test receives messages while it waits.

    Args:
        node: The node.
        timeout: Seconds for which `stop` waits for the thread.
        context: The context of the node; that of the node by default.
    """

    def __init__(self, node: Node, timeout: float = 10, context: Context | None = None) -> None:
        self._node = node
        self._timeout = timeout
        self._executor = SingleThreadedExecutor(context=node.context if context is None else context)
        self._executor.add_node(node)
        self._is_stopping = False
        self._thread = threading.Thread(target=self._spin, daemon=True)

    def start(self) -> None:
        """Start the thread."""
        self._thread.start()

    def stop(self) -> None:
        """Stop the thread.

        Raises:
            RuntimeError: A callback is still running after the timeout.
        """
        self._is_stopping = True
        self._executor.wake()
        if self._thread.ident is not None:
            self._thread.join(self._timeout)
        if self._thread.is_alive():
            raise RuntimeError(f"Timed out after {self._timeout:g} s waiting for the callbacks of the node to end")
        self._executor.remove_node(self._node)

    def _spin(self) -> None:
        while not self._is_stopping and self._executor.context.ok():
            self._executor.spin_once(timeout_sec=_PERIOD)
