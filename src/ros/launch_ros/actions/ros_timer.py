# SPDX-License-Identifier: Apache-2.0
"""The action that visits entities after a time of the ROS clock."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

from launch.actions import TimerAction
from launch.frontend.expose import expose_action
from launch_ros.ros_adapters import get_ros_node

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from rclpy.node import Node

__all__ = ["ROSTimer", "RosTimer"]


@expose_action("ros_timer")
class RosTimer(TimerAction):
    """Visit entities after a time of the ROS clock, which may be simulated."""

    def _wait(self, context: LaunchContext, seconds: float) -> Any:
        return self.__wait(context, seconds)

    async def __wait(self, context: LaunchContext, seconds: float) -> None:
        node = get_ros_node(context)
        _use_time_of_nodes(context, node)
        reached = asyncio.Event()
        loop = asyncio.get_running_loop()
        timer = node.create_timer(seconds, lambda: loop.call_soon_threadsafe(reached.set))
        try:
            await reached.wait()
        finally:
            node.destroy_timer(timer)


def _use_time_of_nodes(context: LaunchContext, node: Node) -> None:
    """Let the node of the launch have the same parameter use_sim_time as the nodes that are launched."""
    from rclpy.parameter import Parameter  # noqa: PLC0415 - slow import

    for name, value in context.launch_configurations.get("global_params", []):
        if name == "use_sim_time":
            node.set_parameters([Parameter(name, value=bool(value))])


ROSTimer = RosTimer
