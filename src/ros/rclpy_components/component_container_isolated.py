# SPDX-License-Identifier: Apache-2.0
"""A container in which each node has an executor and a dedicated thread."""

from __future__ import annotations

import contextlib
import threading
from typing import TYPE_CHECKING

from coframe.nodes.program import initialize_rclpy, program
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor, SingleThreadedExecutor
from rclpy_components.component_manager import ComponentManager

if TYPE_CHECKING:
    from rclpy.executors import Executor
    from rclpy.node import Node

__all__ = ["main"]

_END = 5.0  # seconds to wait for the callback of a node that is unloaded


class _Threads:
    """The executors and threads of nodes.

    Args:
        make_executor: Class of the executors.
    """

    def __init__(self, make_executor: type[SingleThreadedExecutor | MultiThreadedExecutor]) -> None:
        self._make_executor = make_executor
        self._running: dict[Node, tuple[Executor, threading.Thread]] = {}

    def start(self, node: Node) -> None:
        """Spin a node in a new thread."""
        executor = self._make_executor()
        executor.add_node(node)
        thread = threading.Thread(target=_spin, args=(executor,), name=node.get_name(), daemon=True)
        self._running[node] = executor, thread
        thread.start()

    def stop(self, node: Node) -> None:
        """End the thread of a node."""
        executor, thread = self._running.pop(node)
        executor.shutdown(timeout_sec=_END)
        thread.join(_END)


def _spin(executor: Executor) -> None:
    with contextlib.suppress(ExternalShutdownException):
        executor.spin()


def main(args: list[str] | None = None) -> None:
    """Run the container until shutdown."""
    program("component_container_isolated", args, _run)


def _run(words: list[str], arguments: list[str]) -> None:
    is_multi_threaded = "--use_multi_threaded_executor" in arguments
    threads = _Threads(MultiThreadedExecutor if is_multi_threaded else SingleThreadedExecutor)
    try:
        with initialize_rclpy(words, None):
            executor = SingleThreadedExecutor()
            executor.add_node(ComponentManager(add_node=threads.start, remove_node=threads.stop))
            executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == "__main__":
    main()
