# SPDX-License-Identifier: Apache-2.0
"""Client for lookups in the buffer of another node."""

# The unused names are imported because programs import them from upstream's module.
import threading  # noqa: F401
import warnings
from time import monotonic, sleep  # noqa: F401
from typing import Any, Final

import builtin_interfaces  # noqa: F401
import tf2_py as tf2  # noqa: F401
import tf2_ros  # noqa: F401
from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration as DurationMessage
from builtin_interfaces.msg import Time as TimeMessage
from coframe.errors import WireError
from coframe.time import SECOND
from geometry_msgs.msg import TransformStamped
from rclpy.action import ActionClient
from rclpy.action.client import ClientGoalHandle
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.task import Future  # noqa: TC001 - programs import names of this module, too
from rclpy.time import Time
from tf2_msgs.action import LookupTransform
from tf2_py import TimeoutException, TransformException, _convert
from tf2_ros._lookup_action import QOS, raise_error
from tf2_ros._rclpy_side import refusal, wait_for
from tf2_ros.buffer_interface import BufferInterface

_NO_WAIT = Duration()
_PADDING = Duration(seconds=2.0)
_SUSPICION: Final = "Something is likely wrong with the server."

# Names that upstream's module defines for its annotations.
LookupTransformGoal = LookupTransform.Goal
LookupTransformResult = LookupTransform.Result


class BufferClient(BufferInterface):
    """Client that looks up transforms in a buffer server through the action `tf2_msgs/LookupTransform`.

    Lookups do not need a spinning node and also work in callbacks of a single-threaded executor, because they take
    their responses themselves. In coroutines, await the `..._async` methods, which do not block the executor.

    Attributes:
        node: Node of the client.
        action_client: Action client that sends the requests.
        check_frequency: Unused, kept for compatibility. The client does not poll.
        timeout_padding: Additional time that a lookup waits for the server after its timeout.
    """

    def __init__(
        self, node: Node, ns: str, check_frequency: float = 10.0, timeout_padding: Duration = _PADDING
    ) -> None:
        """Create the client.

        Args:
            node: Node of the client.
            ns: Name of the server's action, which is expanded and remapped.
            check_frequency: Ignored, accepted for compatibility.
            timeout_padding: Additional time that a lookup waits for the server after its timeout.
        """
        BufferInterface.__init__(self)
        self.node = node
        self.action_client = ActionClient(
            node,
            LookupTransform,
            action_name=ns,
            goal_service_qos_profile=QOS,
            result_service_qos_profile=QOS,
            cancel_service_qos_profile=QOS,
        )
        self.check_frequency = check_frequency
        self.timeout_padding = timeout_padding
        self.__group = ReentrantCallbackGroup()
        self.__clock = Clock(clock_type=ClockType.STEADY_TIME)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Time | TimeMessage, timeout: Duration = _NO_WAIT
    ) -> TransformStamped:
        """Return the transform that transforms data from `source_frame` into `target_frame`.

        Args:
            target_frame: Frame to transform data into.
            source_frame: Frame in which the data are expressed.
            time: Time of the transform. Zero requests the latest transform. Time messages are deprecated, as upstream.
            timeout: Maximum time that the server waits for the transform.

        Raises:
            TransformException: The transform is not available. The subclass and the message give the reason.
            TimeoutException: No server is available, or it does not respond.
        """
        return self.__process(_goal(target_frame, source_frame, time, timeout))

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = _NO_WAIT,
    ) -> TransformStamped:
        """Return the transform from `source_frame` at one time into `target_frame` at another time.

        Args:
            target_frame: Frame to transform data into.
            target_time: Time of the target frame.
            source_frame: Frame in which the data are expressed.
            source_time: Time of the data.
            fixed_frame: Frame that does not move between the two times.
            timeout: Maximum time that the server waits for the transform.

        Raises:
            TransformException: The transform is not available. The subclass and the message give the reason.
            TimeoutException: No server is available, or it does not respond.
        """
        return self.__process(_full_goal(target_frame, target_time, source_frame, source_time, fixed_frame, timeout))

    async def lookup_transform_async(
        self, target_frame: str, source_frame: str, time: Time | TimeMessage, timeout: Duration = _NO_WAIT
    ) -> TransformStamped:
        """Look up a transform in a coroutine like `lookup_transform`. The node must spin. Not in upstream."""
        return await self.__process_async(_goal(target_frame, source_frame, time, timeout))

    async def lookup_transform_full_async(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = _NO_WAIT,
    ) -> TransformStamped:
        """Look up a transform in a coroutine like `lookup_transform_full`. The node must spin. Not in upstream."""
        return await self.__process_async(
            _full_goal(target_frame, target_time, source_frame, source_time, fixed_frame, timeout)
        )

    def can_transform(
        self, target_frame: str, source_frame: str, time: Time | TimeMessage, timeout: Duration = _NO_WAIT
    ) -> bool:
        """Return whether `lookup_transform` would succeed."""
        try:
            self.lookup_transform(target_frame, source_frame, time, timeout)
        except TransformException:
            return False
        return True

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = _NO_WAIT,
    ) -> bool:
        """Return whether `lookup_transform_full` would succeed."""
        try:
            self.lookup_transform_full(target_frame, target_time, source_frame, source_time, fixed_frame, timeout)
        except TransformException:
            return False
        return True

    def destroy(self) -> None:
        """Destroy the action client. Repeated calls have no effect."""
        self.action_client.destroy()

    def __process(self, goal: LookupTransform.Goal) -> TransformStamped:
        deadline = self.__deadline(goal)
        goal_handle = self.__wait_for(self.action_client.send_goal_async(goal), deadline)
        return _transform_in(self.__wait_for(_check_accepted(goal_handle).get_result_async(), deadline))

    async def __process_async(self, goal: LookupTransform.Goal) -> TransformStamped:
        deadline = self.__deadline(goal)
        goal_handle = await self.__within(self.action_client.send_goal_async(goal), deadline)
        return _transform_in(await self.__within(_check_accepted(goal_handle).get_result_async(), deadline))

    def __deadline(self, goal: LookupTransform.Goal) -> float:
        if not self.action_client.server_is_ready():
            reason = refusal(self.action_client)
            raise TimeoutException(f"The BufferServer is not ready. {reason}".rstrip())
        wait = Duration.from_msg(goal.timeout).nanoseconds + self.timeout_padding.nanoseconds
        return monotonic() + wait / SECOND

    def __wait_for(self, future: "Future[Any]", deadline: float) -> Any:
        try:
            wait_for(self.action_client, future, deadline - monotonic())
            _time_out(future)
            return future.result()
        except WireError as error:
            raise TimeoutException(str(error)) from None

    async def __within(self, future: "Future[Any]", deadline: float) -> Any:
        remaining = max(deadline - monotonic(), 0.0)
        timer = self.node.create_timer(remaining, lambda: _time_out(future), self.__group, self.__clock)
        try:
            return await future
        except WireError as error:
            raise TimeoutException(str(error)) from None
        finally:
            self.node.destroy_timer(timer)


def _goal(target_frame: str, source_frame: str, time: Any, timeout: Duration) -> LookupTransform.Goal:
    return LookupTransform.Goal(
        target_frame=_convert.text(target_frame, 1),
        source_frame=_convert.text(source_frame, 2),
        source_time=_time_message(time),
        timeout=_duration_message(timeout),
    )


def _full_goal(
    target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str, timeout: Duration
) -> LookupTransform.Goal:
    return LookupTransform.Goal(
        target_frame=_convert.text(target_frame, 1),
        target_time=_time_message(target_time),
        source_frame=_convert.text(source_frame, 3),
        source_time=_time_message(source_time),
        fixed_frame=_convert.text(fixed_frame, 5),
        timeout=_duration_message(timeout),
        advanced=True,
    )


def _time_message(time: Any) -> TimeMessage:
    if isinstance(time, TimeMessage):
        warnings.warn(
            "Passing a builtin_interfaces.msg.Time argument is deprecated, and will be removed in the near future. "
            "Use rclpy.time.Time instead.",
            stacklevel=4,
        )
        return time
    if not isinstance(time, Time):
        raise TypeError("Must pass a rclpy.time.Time object.")
    return time.to_msg()


def _duration_message(timeout: Any) -> DurationMessage:
    if not isinstance(timeout, Duration):
        raise TypeError(f"timeout must be an rclpy Duration, not {type(timeout).__name__}. Use Duration(seconds=...).")
    return timeout.to_msg()


def _time_out(future: "Future[Any]") -> None:
    """Set a TimeoutException on a future that is not done."""
    if not future.done():
        text = "The LookupTransform goal sent to the BufferServer did not come back in the specified time."
        future.set_exception(TimeoutException(f"{text} {_SUSPICION}"))


def _check_accepted(goal_handle: ClientGoalHandle) -> ClientGoalHandle:
    if not goal_handle.accepted:
        text = "The LookupTransform goal sent to the BufferServer did not come back with accepted status."
        raise TimeoutException(f"{text} {_SUSPICION}")
    return goal_handle


def _transform_in(response: Any) -> TransformStamped:
    raise_error(response.result.error)
    if response.status == GoalStatus.STATUS_ABORTED:
        # The C++ server aborts a goal after its timeout without an error in the result.
        raise TimeoutException(
            "The BufferServer aborted the LookupTransform goal. The transform was not available within the timeout."
        )
    if response.status != GoalStatus.STATUS_SUCCEEDED:
        raise TransformException(f"The LookupTransform goal ended with status {response.status}, without a transform.")
    transform: TransformStamped = response.result.transform
    return transform
