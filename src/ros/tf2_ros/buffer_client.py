"""Looking transforms up in the buffer of another node."""

# ruff: noqa: SLF001 - rclpy's action client lets this client wait with a timeout

# What is not used here is here because upstream leaks it.
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
from geometry_msgs.msg import TransformStamped
from rclpy.action import ActionClient
from rclpy.action.client import ClientGoalHandle
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import Clock, ClockType
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.task import Future
from rclpy.time import Time
from tf2_msgs.action import LookupTransform
from tf2_py import TimeoutException, TransformException, _convert
from tf2_ros._lookup_action import QOS, raise_error
from tf2_ros.buffer_interface import BufferInterface

_NO_WAIT = Duration()
_PADDING = Duration(seconds=2.0)
_SUSPICION: Final = "Something is likely wrong with the server."


class BufferClient(BufferInterface):
    """Looks transforms up in a buffer server, by the action `tf2_msgs/LookupTransform`.

    Look-ups work anywhere, also in a callback of a single-threaded executor, and nobody needs to spin the node: they
    receive their answers themselves. In coroutines, await the `..._async` ones, which leave the executor free.

    Attributes:
        node: The node that asks.
        action_client: What it asks by.
        check_frequency: Kept for upstream's sake; nothing is asked for periodically.
        timeout_padding: How much longer than its timeout a look-up waits for the server.
    """

    def __init__(
        self, node: Node, ns: str, check_frequency: float = 10.0, timeout_padding: Duration = _PADDING
    ) -> None:
        """Look for the server.

        Args:
            node: The node that asks.
            ns: Name of the server's action; expanded and remapped.
            check_frequency: Kept for upstream's sake.
            timeout_padding: How much longer than its timeout a look-up waits for the server.
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
        self._group = ReentrantCallbackGroup()
        self._clock = Clock(clock_type=ClockType.STEADY_TIME)

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Time | TimeMessage, timeout: Duration = _NO_WAIT
    ) -> TransformStamped:
        """The transform that takes data from `source_frame` to `target_frame`.

        Args:
            target_frame: Frame to express data in.
            source_frame: Frame the data are in.
            time: When; time zero asks for the latest. A message is deprecated, as upstream.
            timeout: How long the server waits for it.

        Raises:
            TransformException: It is not known; one of its children says why.
            TimeoutException: There is no server, or it does not answer.
        """
        return self._process(_goal(target_frame, source_frame, time, timeout))

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = _NO_WAIT,
    ) -> TransformStamped:
        """The transform from `source_frame` at one time to `target_frame` at another.

        Args:
            target_frame: Frame to express data in.
            target_time: When that frame is looked at.
            source_frame: Frame the data are in.
            source_time: When the data were taken.
            fixed_frame: Frame that stands still between the two times.
            timeout: How long the server waits for it.

        Raises:
            TransformException: It is not known; one of its children says why.
            TimeoutException: There is no server, or it does not answer.
        """
        return self._process(_full_goal(target_frame, target_time, source_frame, source_time, fixed_frame, timeout))

    async def lookup_transform_async(
        self, target_frame: str, source_frame: str, time: Time | TimeMessage, timeout: Duration = _NO_WAIT
    ) -> TransformStamped:
        """`lookup_transform` as a coroutine, for a node that is spun; not in upstream."""
        return await self._process_async(_goal(target_frame, source_frame, time, timeout))

    async def lookup_transform_full_async(
        self,
        target_frame: str,
        target_time: Time | TimeMessage,
        source_frame: str,
        source_time: Time | TimeMessage,
        fixed_frame: str,
        timeout: Duration = _NO_WAIT,
    ) -> TransformStamped:
        """`lookup_transform_full` as a coroutine, for a node that is spun; not in upstream."""
        return await self._process_async(
            _full_goal(target_frame, target_time, source_frame, source_time, fixed_frame, timeout)
        )

    def can_transform(
        self, target_frame: str, source_frame: str, time: Time | TimeMessage, timeout: Duration = _NO_WAIT
    ) -> bool:
        """Return whether `lookup_transform` would answer."""
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
        """Return whether `lookup_transform_full` would answer."""
        try:
            self.lookup_transform_full(target_frame, target_time, source_frame, source_time, fixed_frame, timeout)
        except TransformException:
            return False
        return True

    def destroy(self) -> None:
        """Stop asking; doing so twice does no harm."""
        self.action_client.destroy()

    def _process(self, goal: LookupTransform.Goal) -> TransformStamped:
        deadline = self._deadline(goal)
        goal_handle = self._wait_for(self.action_client.send_goal_async(goal), deadline)
        return _transform_in(self._wait_for(_accepted(goal_handle).get_result_async(), deadline))

    async def _process_async(self, goal: LookupTransform.Goal) -> TransformStamped:
        deadline = self._deadline(goal)
        goal_handle = await self._within(self.action_client.send_goal_async(goal), deadline)
        return _transform_in(await self._within(_accepted(goal_handle).get_result_async(), deadline))

    def _deadline(self, goal: LookupTransform.Goal) -> float:
        if not self.action_client.server_is_ready():
            raise TimeoutException("The BufferServer is not ready.")
        patience = Duration.from_msg(goal.timeout).nanoseconds + self.timeout_padding.nanoseconds
        return monotonic() + patience / 1e9

    def _wait_for(self, future: Future[Any], deadline: float) -> Any:
        self.action_client._wait_for(future, deadline - monotonic())
        _give_up(future)
        return future.result()

    async def _within(self, future: Future[Any], deadline: float) -> Any:
        patience = max(deadline - monotonic(), 0.0)
        timer = self.node.create_timer(patience, lambda: _give_up(future), self._group, self._clock)
        try:
            return await future
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
        raise TypeError(f"timeout must be an rclpy Duration, not {type(timeout).__name__}: Duration(seconds=...)")
    return timeout.to_msg()


def _give_up(future: Future[Any]) -> None:
    """End a future that is not over, by an exception."""
    if not future.done():
        text = "The LookupTransform goal sent to the BufferServer did not come back in the specified time."
        future.set_exception(TimeoutException(f"{text} {_SUSPICION}"))


def _accepted(goal_handle: ClientGoalHandle) -> ClientGoalHandle:
    if not goal_handle.accepted:
        text = "The LookupTransform goal sent to the BufferServer did not come back with accepted status."
        raise TimeoutException(f"{text} {_SUSPICION}")
    return goal_handle


def _transform_in(response: Any) -> TransformStamped:
    raise_error(response.result.error)
    if response.status == GoalStatus.STATUS_ABORTED:
        # All that C++'s server says about a goal whose time is over.
        raise TimeoutException("The BufferServer aborted the LookupTransform goal: the transform did not come in time.")
    if response.status != GoalStatus.STATUS_SUCCEEDED:
        raise TransformException(f"The LookupTransform goal ended with status {response.status}, without a transform.")
    transform: TransformStamped = response.result.transform
    return transform
