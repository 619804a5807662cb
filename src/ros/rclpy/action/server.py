# SPDX-License-Identifier: Apache-2.0
"""Action servers, which execute the goals of action clients."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

import inspect
import math
import threading
import time
import traceback
from collections import deque
from enum import Enum
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from action_msgs.msg import GoalInfo, GoalStatus
from action_msgs.srv import CancelGoal
from coframe._output.warn_once import WarnOnce
from rclpy import _absent
from rclpy._destroyable import Destroyable
from rclpy.action._goal_handle import GoalEvent, ServerGoalHandle, can_be_cancelled
from rclpy.action._names import (
    CANCEL_GOAL,
    FEEDBACK,
    FEEDBACK_QOS,
    GET_RESULT,
    SEND_GOAL,
    STATUS,
    resolve_action_name,
)
from rclpy.action._status import encode_statuses
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.constants import S_TO_NS
from rclpy.exceptions import RCLError
from rclpy.qos import QoSProfile, qos_profile_action_status_default, qos_profile_services_default
from rclpy.serialization import serialize_message
from rclpy.service import DeferredResponseService
from rclpy.type_support import check_is_valid_action_type

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine

    from coframe.wire.request_header import RequestHeader
    from rclpy.callback_groups import CallbackGroup
    from rclpy.clock import Clock
    from rclpy.node import Node
    from rclpy.service_introspection import ServiceIntrospectionState
    from unique_identifier_msgs.msg import UUID

__all__ = [
    "ActionServer",
    "CancelResponse",
    "GoalEvent",
    "GoalResponse",
    "ServerGoalHandle",
    "default_cancel_callback",
    "default_goal_callback",
    "default_handle_accepted_callback",
]

MAX_GOALS: Final = 1_000  # whose status is published
MAX_GOAL_BYTES: Final = 64 << 20  # of all these goals; a single one may be larger
MAX_RESULT_REQUESTS: Final = 1_000  # that wait for the result of one goal


class GoalResponse(Enum):
    """Response to a goal request."""

    REJECT = 1
    ACCEPT = 2


class CancelResponse(Enum):
    """Response to a cancel request."""

    REJECT = 1
    ACCEPT = 2


def default_handle_accepted_callback(goal_handle: ServerGoalHandle) -> None:
    """Execute an accepted goal immediately."""
    goal_handle.execute()


def default_goal_callback(goal_request: Any) -> GoalResponse:
    """Accept every goal."""
    del goal_request
    return GoalResponse.ACCEPT


def default_cancel_callback(cancel_request: ServerGoalHandle) -> CancelResponse:
    """Reject every cancel request."""
    del cancel_request
    return CancelResponse.REJECT


class ActionServer(Destroyable):
    """Server of an action.

    All callbacks may be coroutine functions. Execute callbacks are in a separate reentrant group, so they run in
    parallel to all other callbacks if the executor has several threads.

    Args:
        node: Node of the server.
        action_type: Class of the action.
        action_name: Name of the action, which is expanded and remapped.
        execute_callback: Function that executes a goal: it is called with a `ServerGoalHandle`, calls its `succeed()`,
            `abort()` or `canceled()`, and returns the result.
        callback_group: Group of the other callbacks. None: the default group of the node.
        goal_callback: Function that is called with a goal and returns a `GoalResponse`.
        handle_accepted_callback: Function that is called with the `ServerGoalHandle` of each accepted goal and executes
            the goal immediately or later.
        cancel_callback: Function that is called with the `ServerGoalHandle` of a cancel request and returns a
            `CancelResponse`.
        goal_service_qos_profile: QoS profile of the goal service.
        result_service_qos_profile: QoS profile of the result service.
        cancel_service_qos_profile: QoS profile of the cancel service.
        feedback_pub_qos_profile: QoS profile of the feedback publisher.
        status_pub_qos_profile: QoS profile of the status publisher.
        result_timeout: Time in seconds for which results are kept. Negative: no limit. The server stores at most 1000
            goals; beyond that, it forgets the goal that finished first, and rejects goals if none is finished.

    Raises:
        TypeError: The execute callback is not callable.
        ValueError: The name is not valid.
        AttributeError, RuntimeError: `action_type` is not an action class.
    """

    def __init__(
        self,
        node: Node,
        action_type: Any,
        action_name: str,
        execute_callback: Callable[[ServerGoalHandle], Any],
        *,
        callback_group: CallbackGroup | None = None,
        goal_callback: Callable[[Any], Any] | None = default_goal_callback,
        handle_accepted_callback: Callable[[ServerGoalHandle], Any] | None = default_handle_accepted_callback,
        cancel_callback: Callable[[ServerGoalHandle], Any] | None = default_cancel_callback,
        goal_service_qos_profile: QoSProfile = qos_profile_services_default,
        result_service_qos_profile: QoSProfile = qos_profile_services_default,
        cancel_service_qos_profile: QoSProfile = qos_profile_services_default,
        feedback_pub_qos_profile: QoSProfile = FEEDBACK_QOS,
        status_pub_qos_profile: QoSProfile = qos_profile_action_status_default,
        result_timeout: float = 900,
    ) -> None:
        check_is_valid_action_type(action_type)
        self.register_handle_accepted_callback(handle_accepted_callback)
        self.register_goal_callback(goal_callback)
        self.register_cancel_callback(cancel_callback)
        self.register_execute_callback(execute_callback)
        self._node = node
        self._action_type = action_type
        self.__result_timeout = result_timeout
        self._lock = threading.RLock()
        self.__is_destroyed = False
        self.__goals: dict[bytes, ServerGoalHandle] = {}
        self.__expiries: deque[tuple[float, bytes]] = deque()  # of the finished goals
        self.__warn_once = WarnOnce(node.get_logger().warning)
        self.__to_execute: deque[tuple[Callable[[ServerGoalHandle], Any], ServerGoalHandle]] = deque()

        name, parts = resolve_action_name(node, action_name, "action server"), action_type.Impl
        internal_group = ReentrantCallbackGroup()
        self.__execution = node.create_guard_condition(self.__execute_next, internal_group)
        # The goal service comes last, so that clients that discover it also find the other endpoints.
        self.__feedback_publisher = node.create_publisher(
            parts.FeedbackMessage, name + FEEDBACK, feedback_pub_qos_profile
        )
        self.__status_publisher = node.create_publisher(parts.GoalStatusMessage, name + STATUS, status_pub_qos_profile)
        self.__result_service, self.__cancel_service, self.__goal_service = self.__services = tuple(
            node._Coframe__create_service(DeferredResponseService, srv_type, name + suffix, callback, qos, group)
            for srv_type, suffix, callback, qos, group in (
                (
                    parts.GetResultService,
                    GET_RESULT,
                    self.__on_result_request,
                    result_service_qos_profile,
                    internal_group,
                ),
                (
                    parts.CancelGoalService,
                    CANCEL_GOAL,
                    self.__on_cancel_request,
                    cancel_service_qos_profile,
                    callback_group,
                ),
                (parts.SendGoalService, SEND_GOAL, self.__on_goal_request, goal_service_qos_profile, callback_group),
            )
        )

    @property
    def action_type(self) -> Any:
        """The class of the action."""
        return self._action_type

    def register_handle_accepted_callback(
        self, handle_accepted_callback: Callable[[ServerGoalHandle], Any] | None
    ) -> None:
        """Set the callback for accepted goals. None: goals are executed immediately."""
        self.__handle_accepted_callback = handle_accepted_callback or default_handle_accepted_callback

    def register_goal_callback(self, goal_callback: Callable[[Any], Any] | None) -> None:
        """Set the callback for goal requests. None for all goals are accepted."""
        self.__goal_callback = goal_callback or default_goal_callback

    def register_cancel_callback(self, cancel_callback: Callable[[ServerGoalHandle], Any] | None) -> None:
        """Set the callback for cancel requests. None for all cancel requests are rejected."""
        self.__cancel_callback = cancel_callback or default_cancel_callback

    def register_execute_callback(self, execute_callback: Callable[[ServerGoalHandle], Any]) -> None:
        """Set the callback that executes goals.

        Raises:
            TypeError: `execute_callback` is not callable.
        """
        if not callable(execute_callback):
            raise TypeError("Failed to register goal execution callback: not callable")
        self.__execute_callback = execute_callback

    def notify_execute(
        self, goal_handle: ServerGoalHandle, execute_callback: Callable[[ServerGoalHandle], Any] | None
    ) -> None:
        """Schedule the execute callback of a goal. Prefer `ServerGoalHandle.execute`."""
        self.__to_execute.append((execute_callback or self.__execute_callback, goal_handle))
        self.__execution.trigger()

    def configure_introspection(
        self, clock: Clock, service_event_qos_profile: QoSProfile, introspection_state: ServiceIntrospectionState
    ) -> None:
        """Publish events of the action's three services, or stop. See `Service.configure_introspection`."""
        for service in self.__services:
            service.configure_introspection(clock, service_event_qos_profile, introspection_state)

    def destroy(self) -> None:
        """Destroy the server and its goal handles. Repeated calls have no effect."""
        with self._lock:
            self.__is_destroyed = True
            for goal_handle in self.__goals.values():
                goal_handle.destroy()
            self.__goals.clear()
        for service in self.__services:
            self._node.destroy_service(service)
        self._node.destroy_publisher(self.__feedback_publisher)
        self._node.destroy_publisher(self.__status_publisher)
        self._node.destroy_guard_condition(self.__execution)

    # Goals

    async def __on_goal_request(self, request: Any, header: RequestHeader) -> None:
        goal_handle = None
        is_new = _key(request.goal_id) not in self.__goals
        size = len(serialize_message(request.goal))
        if is_new and self.__has_room(size) and await self.__is_accepted(request.goal):
            goal_handle = self.__add(request, size)
        response = self._action_type.Impl.SendGoalService.Response(accepted=goal_handle is not None)
        if goal_handle is not None:
            response.stamp = goal_handle._goal_info.stamp
        self.__goal_service.send_response(response, header)
        outcome = "rejected" if goal_handle is None else "accepted"
        self._node.get_logger().debug(f"New goal {outcome}: {request.goal_id.uuid}")
        if goal_handle is not None:
            await _call(self.__handle_accepted_callback, goal_handle)

    def __has_room(self, size: int) -> bool:
        """Return whether a goal of `size` bytes can be stored; forget the goals that finished first if necessary."""
        self.__forget_expired()
        with self._lock:
            while not (has_room := self.__is_below_limits(size)) and self.__expiries:
                self.__goals.pop(self.__expiries.popleft()[1], None)
        if not has_room:
            limits = f"{MAX_GOALS} or {MAX_GOAL_BYTES >> 20} MiB"
            self.__warn_once(f"Rejecting goals: the unfinished goals would exceed the maximum of {limits}.")
        return has_room

    def __is_below_limits(self, size: int) -> bool:
        stored = sum(goal._Coframe__size for goal in self.__goals.values())
        return not self.__goals or (len(self.__goals) < MAX_GOALS and stored + size <= MAX_GOAL_BYTES)

    async def __is_accepted(self, goal: Any) -> bool:
        response = await _call(self.__goal_callback, goal)
        if not isinstance(response, GoalResponse):
            self._node.get_logger().warning("Goal request callback did not return a GoalResponse type. Rejecting goal.")
        return response is GoalResponse.ACCEPT

    def __add(self, request: Any, size: int) -> ServerGoalHandle | None:
        """Add a goal of `size` bytes and return its handle.

        Return None if another thread added a goal with the same identifier first, or destroyed the server.
        """
        info = GoalInfo(goal_id=request.goal_id, stamp=self._node.get_clock().now().to_msg())
        goal_handle = ServerGoalHandle(self, info, request.goal)
        goal_handle._Coframe__size = size
        with self._lock:
            if self.__is_destroyed or self.__goals.setdefault(_key(request.goal_id), goal_handle) is not goal_handle:
                return None
            self._Coframe__publish_status()
        return goal_handle

    def __execute_next(self) -> Coroutine[Any, Any, None] | None:
        try:
            execute_callback, goal_handle = self.__to_execute.popleft()
        except IndexError:  # Another thread took the last goal.
            return None
        if self.__to_execute:
            self.__execution.trigger()
        return self.__execute(execute_callback, goal_handle)

    async def __execute(
        self, execute_callback: Callable[[ServerGoalHandle], Any], goal_handle: ServerGoalHandle
    ) -> None:
        result_type = self._action_type.Result
        try:
            result = await _call(execute_callback, goal_handle)
        except Exception as error:
            if not self._node.context.ok():
                raise  # The shutdown caused the error.
            self._node.get_logger().error(f"Error raised in execute callback: {error}")
            traceback.print_exc()
            result = result_type()
        if goal_handle.is_active:
            self._node.get_logger().warning(
                f"Goal state not set, assuming aborted. Goal ID: {goal_handle.goal_id.uuid}"
            )
            goal_handle.abort()
        if not isinstance(result, result_type):
            if goal_handle._Coframe__result_response is None:
                self._node.get_logger().error(
                    f"The execute callback returned {type(result).__name__} instead of {result_type.__name__}. "
                    "The client receives an empty result."
                )
            result = result_type()
        self._Coframe__set_result(goal_handle, result)

    # Cancel requests

    async def __on_cancel_request(self, request: Any, header: RequestHeader) -> None:
        response = CancelGoal.Response()
        response.return_code, goal_handles = self.__find_goals_to_cancel(request.goal_info)
        canceling = [goal_handle for goal_handle in goal_handles if await self.__cancel(goal_handle)]
        response.goals_canceling = [goal_handle._goal_info for goal_handle in canceling]
        if goal_handles and not canceling:
            response.return_code = CancelGoal.Response.ERROR_REJECTED
        self.__cancel_service.send_response(response, header)

    def __find_goals_to_cancel(self, goal_info: GoalInfo) -> tuple[int, list[ServerGoalHandle]]:
        """Return the goals that a cancel request selects, by the rules of `action_msgs/CancelGoal`.

        An identifier selects one goal, a stamp selects all goals accepted up to this time, both together select the
        union, and a request without either selects all goals.
        """
        key, latest_ns = _key(goal_info.goal_id), _nanoseconds(goal_info)
        with self._lock:
            goals = dict(self.__goals)
        if any(key) and latest_ns == 0:
            if key not in goals:
                return CancelGoal.Response.ERROR_UNKNOWN_GOAL_ID, []
            if not can_be_cancelled(goals[key]):
                return CancelGoal.Response.ERROR_GOAL_TERMINATED, []
            return CancelGoal.Response.ERROR_NONE, [goals[key]]
        return CancelGoal.Response.ERROR_NONE, [
            goal_handle
            for other_key, goal_handle in goals.items()
            if can_be_cancelled(goal_handle)
            and (latest_ns == 0 or other_key == key or _nanoseconds(goal_handle._goal_info) <= latest_ns)
        ]

    async def __cancel(self, goal_handle: ServerGoalHandle) -> bool:
        if await _call(self.__cancel_callback, goal_handle) is not CancelResponse.ACCEPT:
            return False
        try:
            goal_handle._update_state(GoalEvent.CANCEL_GOAL)
        except RCLError as error:  # The goal finished in the meantime.
            self._node.get_logger().debug(f"Failed to cancel goal: {error}")
            return False
        return True

    # Results

    def __on_result_request(self, request: Any, header: RequestHeader) -> None:
        self.__forget_expired()
        with self._lock:
            goal_handle = self.__goals.get(_key(request.goal_id))
            if goal_handle is not None and goal_handle._Coframe__result_response is None:
                if len(goal_handle._Coframe__result_requests) < MAX_RESULT_REQUESTS:
                    goal_handle._Coframe__result_requests.append(header)
                else:
                    self.__warn_once(f"Ignoring requests: {MAX_RESULT_REQUESTS} wait for the result of one goal.")
                return
        # The default status of a response is UNKNOWN, which is the response for an unknown goal.
        unknown = self._action_type.Impl.GetResultService.Response()
        response = unknown if goal_handle is None else goal_handle._Coframe__result_response
        self.__result_service.send_response(response, header)

    def _Coframe__set_result(self, goal_handle: ServerGoalHandle, result: Any) -> None:
        """Send the result to the waiting clients and keep it for later requests; only the first result applies."""
        response = self._action_type.Impl.GetResultService.Response(status=goal_handle.status, result=result)
        with self._lock:
            if goal_handle._Coframe__result_response is not None:
                return
            goal_handle._Coframe__result_response = response
            expiry = time.monotonic() + self.__result_timeout if self.__result_timeout >= 0 else math.inf
            self.__expiries.append((expiry, _key(goal_handle.goal_id)))
        for header in goal_handle._Coframe__result_requests:
            self.__result_service.send_response(response, header)

    def __forget_expired(self) -> None:
        with self._lock:
            while self.__expiries and self.__expiries[0][0] <= time.monotonic():
                self.__goals.pop(self.__expiries.popleft()[1], None)

    # Topics

    def _Coframe__publish_status(self) -> None:
        self.__status_publisher.publish(encode_statuses(goal._Coframe__status_entry for goal in self.__goals.values()))

    def _Coframe__publish_feedback(self, goal_handle: ServerGoalHandle, feedback: Any) -> None:
        if not isinstance(feedback, self._action_type.Feedback):
            raise TypeError(f"Expected {self._action_type.Feedback}, got {type(feedback)}")
        message = self._action_type.Impl.FeedbackMessage(goal_id=goal_handle.goal_id, feedback=feedback)
        with self._lock:
            if goal_handle.status != GoalStatus.STATUS_UNKNOWN:
                self.__feedback_publisher.publish(message)


async def _call(callback: Callable[..., Any], *args: Any) -> Any:
    result = callback(*args)
    return await result if inspect.iscoroutine(result) else result


def _nanoseconds(goal_info: GoalInfo) -> int:
    return goal_info.stamp.sec * S_TO_NS + goal_info.stamp.nanosec


def _key(goal_id: UUID) -> bytes:
    return bytes(goal_id.uuid)


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
