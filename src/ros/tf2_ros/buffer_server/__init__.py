# SPDX-License-Identifier: Apache-2.0
"""Server for lookups of other nodes, which then need no buffer and no listener."""

from typing import Any

from rclpy.action import ActionServer, CancelResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.task import Future  # noqa: TC001 - a name of the module
from tf2_msgs.action import LookupTransform
from tf2_py import TransformException
from tf2_ros._lookup_action import QOS, error_message
from tf2_ros._rclpy_side import on_cancel
from tf2_ros.buffer import Buffer

__all__ = ["BufferServer"]

# Clients request the result as soon as their goal is accepted.
_RESULT_TIMEOUT = 10.0


class BufferServer:
    """Server of the action `tf2_msgs/LookupTransform` for the `BufferClient` of Python and C++.

    A goal waits for its transform up to its timeout without occupying a thread. A goal without timeout whose lookup
    fails finishes as succeeded, with the error in its result. A goal whose timeout expires is aborted, with the error
    in its result.
    """

    def __init__(self, buffer: Buffer, node: Node, ns: str) -> None:
        """Create the action server. It responds while an executor spins the node.

        Args:
            buffer: Buffer for the lookups.
            node: Node of the server.
            ns: Name of the action, which is expanded and remapped.
        """
        self.buffer = buffer
        self.action_server = ActionServer(
            node,
            LookupTransform,
            ns,
            self.__execute,
            callback_group=ReentrantCallbackGroup(),
            cancel_callback=lambda _: CancelResponse.ACCEPT,
            goal_service_qos_profile=QOS,
            result_service_qos_profile=QOS,
            cancel_service_qos_profile=QOS,
            result_timeout=_RESULT_TIMEOUT,
        )

    def destroy(self) -> None:
        """Destroy the action server without responding to waiting goals. Repeated calls have no effect."""
        self.action_server.destroy()

    async def __execute(self, goal_handle: ServerGoalHandle) -> Any:
        goal, result = goal_handle.request, LookupTransform.Result()
        timeout = Duration.from_msg(goal.timeout)
        wait = self.__wait_for(goal, timeout)
        on_cancel(goal_handle, wait.cancel)
        try:
            found = await wait
        except TransformException as error:
            result.error = error_message(error)
            finish = goal_handle.abort if timeout.nanoseconds > 0 else goal_handle.succeed
        else:
            finish = goal_handle.canceled if found is None else goal_handle.succeed
            result.transform = found or result.transform
        finish()
        return result

    def __wait_for(self, goal: Any, timeout: Duration) -> "Future[Any]":
        if not goal.advanced:
            return self.buffer.wait_for_transform_async(
                goal.target_frame, goal.source_frame, goal.source_time, timeout=timeout
            )
        return self.buffer.wait_for_transform_full_async(
            goal.target_frame,
            goal.target_time,
            goal.source_frame,
            goal.source_time,
            goal.fixed_frame,
            timeout=timeout,
        )
