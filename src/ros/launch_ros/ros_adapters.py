# SPDX-License-Identifier: Apache-2.0
"""The node that actions use to communicate with the nodes that they have started."""

from __future__ import annotations

import contextlib
import os
import threading
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from rclpy.node import Node

__all__ = ["ROSAdapter", "get_ros_adapter", "get_ros_node"]


class ROSAdapter:
    """A node that spins in its own thread.

    Args:
        argv: Arguments of the program.
    """

    def __init__(self, *, argv: list[str] | None = None) -> None:
        # Most launch files need no node, and rclpy is slow to import.
        import rclpy  # noqa: PLC0415
        from rclpy.context import Context  # noqa: PLC0415
        from rclpy.executors import SingleThreadedExecutor  # noqa: PLC0415

        self.__context = Context()
        rclpy.init(args=argv or [], context=self.__context)
        self.__node = rclpy.create_node(f"launch_ros_{os.getpid()}", context=self.__context)
        self.__executor = SingleThreadedExecutor(context=self.__context)
        self.__executor.add_node(self.__node)
        self.__thread = threading.Thread(target=self._run, name="launch_ros", daemon=True)
        self.__thread.start()

    def _run(self) -> None:
        from rclpy.executors import ExternalShutdownException  # noqa: PLC0415

        with contextlib.suppress(ExternalShutdownException):
            self.__executor.spin()

    @property
    def ros_node(self) -> Node:
        """The node."""
        return self.__node

    def shutdown(self) -> None:
        """Destroy the node and end its thread."""
        self.__executor.shutdown()
        self.__node.destroy_node()
        self.__context.try_shutdown()
        self.__thread.join(5.0)


def get_ros_adapter(context: LaunchContext) -> ROSAdapter:
    """Return the adapter of a launch. It is created at the first call, and ends when the launch shuts down."""
    from launch.event_handlers import OnShutdown  # noqa: PLC0415 - not needed without a node

    found = context.get_locals_as_dict().get("ros_adapter")
    if isinstance(found, ROSAdapter):
        return found
    adapter = ROSAdapter(argv=context.argv)
    context.extend_globals({"ros_adapter": adapter})
    context.register_event_handler(OnShutdown(on_shutdown=lambda _event, _context: adapter.shutdown()))
    return adapter


def get_ros_node(context: LaunchContext) -> Node:
    """Return the node of a launch. It is created at the first call."""
    return get_ros_adapter(context).ros_node
