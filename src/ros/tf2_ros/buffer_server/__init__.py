"""Answering look-ups for other nodes, so that they need no buffer and no listener of their own."""

# ruff: noqa: SLF001 - rclpy tells this server of a cancelled goal; users' callbacks have to look

from typing import Any

from rclpy.action import ActionServer, CancelResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.task import Future
from tf2_msgs.action import LookupTransform
from tf2_py import TransformException
from tf2_ros._lookup_action import QOS, error_message
from tf2_ros.buffer import Buffer

__all__ = ["BufferServer"]

# Clients ask for a result as soon as their goal is accepted.
_RESULT_TIMEOUT = 10.0


class BufferServer:
    """Serves the action `tf2_msgs/LookupTransform` out of a buffer; `BufferClient` and C++'s ask it.

    A goal waits for its transform as long as its timeout says, without a thread of its own. One that fails at once
    succeeds, with the error in its result; one whose time runs out is aborted, with the error that is left.
    """

    def __init__(self, buffer: Buffer, node: Node, ns: str) -> None:
        """Start serving, while an executor spins the node.

        Args:
            buffer: Where transforms are looked up.
            node: The node that serves.
            ns: The action's name; expanded and remapped.
        """
        self.buffer = buffer
        self.action_server = ActionServer(
            node,
            LookupTransform,
            ns,
            self._execute,
            callback_group=ReentrantCallbackGroup(),
            cancel_callback=lambda _: CancelResponse.ACCEPT,
            goal_service_qos_profile=QOS,
            result_service_qos_profile=QOS,
            cancel_service_qos_profile=QOS,
            result_timeout=_RESULT_TIMEOUT,
        )

    def destroy(self) -> None:
        """Stop serving; doing so twice does no harm. Goals that wait are not answered any more."""
        self.action_server.destroy()

    async def _execute(self, goal_handle: ServerGoalHandle) -> Any:
        goal, result = goal_handle.request, LookupTransform.Result()
        timeout = Duration.from_msg(goal.timeout)
        wait = self._wait_for(goal, timeout)
        goal_handle._cancel_request.add_done_callback(lambda _: wait.cancel())
        try:
            found = await wait
        except TransformException as error:
            result.error = error_message(error)
            end = goal_handle.abort if timeout.nanoseconds > 0 else goal_handle.succeed
        else:
            end = goal_handle.canceled if found is None else goal_handle.succeed
            result.transform = found or result.transform
        end()
        return result

    def _wait_for(self, goal: Any, timeout: Duration) -> Future[Any]:
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
