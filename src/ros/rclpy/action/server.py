"""Action servers: they take goals, work on them, and tell how far they have got."""

# The modules of rclpy share what its users do not see.
# ruff: noqa: SLF001

from __future__ import annotations

import inspect
import threading
import time
import traceback
from collections import deque
from enum import Enum
from typing import TYPE_CHECKING, Any, Final

from action_msgs.msg import GoalInfo, GoalStatus
from action_msgs.srv import CancelGoal
from rclpy.action._names import (
    CANCEL_GOAL,
    FEEDBACK,
    FEEDBACK_QOS,
    GET_RESULT,
    SEND_GOAL,
    STATUS,
    resolve_action_name,
)
from rclpy.action._status import encode_entry, encode_statuses
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.constants import S_TO_NS
from rclpy.exceptions import RCLError
from rclpy.qos import QoSProfile, qos_profile_action_status_default, qos_profile_services_default
from rclpy.service import DeferredService
from rclpy.task import Future
from rclpy.type_support import check_is_valid_action_type

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine

    from rclpy._request_header import RequestHeader
    from rclpy.callback_groups import CallbackGroup
    from rclpy.node import Node
    from unique_identifier_msgs.msg import UUID


class GoalResponse(Enum):
    """What becomes of a goal that somebody sends."""

    REJECT = 1
    ACCEPT = 2


class CancelResponse(Enum):
    """What becomes of somebody's wish to cancel a goal."""

    REJECT = 1
    ACCEPT = 2


class GoalEvent(Enum):
    """What happens to a goal."""

    EXECUTE = 1
    CANCEL_GOAL = 2
    SUCCEED = 3
    ABORT = 4
    CANCELED = 5


_STATUS_NAMES: Final = {
    value: name.removeprefix("STATUS_") for name, value in vars(GoalStatus).items() if name.startswith("STATUS_")
}
_TRANSITIONS: Final = {
    (GoalStatus.STATUS_ACCEPTED, GoalEvent.EXECUTE): GoalStatus.STATUS_EXECUTING,
    (GoalStatus.STATUS_ACCEPTED, GoalEvent.CANCEL_GOAL): GoalStatus.STATUS_CANCELING,
    (GoalStatus.STATUS_EXECUTING, GoalEvent.CANCEL_GOAL): GoalStatus.STATUS_CANCELING,
    (GoalStatus.STATUS_EXECUTING, GoalEvent.SUCCEED): GoalStatus.STATUS_SUCCEEDED,
    (GoalStatus.STATUS_EXECUTING, GoalEvent.ABORT): GoalStatus.STATUS_ABORTED,
    (GoalStatus.STATUS_CANCELING, GoalEvent.SUCCEED): GoalStatus.STATUS_SUCCEEDED,
    (GoalStatus.STATUS_CANCELING, GoalEvent.ABORT): GoalStatus.STATUS_ABORTED,
    (GoalStatus.STATUS_CANCELING, GoalEvent.CANCELED): GoalStatus.STATUS_CANCELED,
}
_ACTIVE: Final = {status for status, _ in _TRANSITIONS}


class ServerGoalHandle:
    """A goal that an action server has accepted; made by the server."""

    def __init__(self, action_server: ActionServer, goal_info: GoalInfo, goal_request: Any) -> None:
        self._action_server = action_server
        self._goal_info = goal_info
        self._goal_request = goal_request
        self._status: int = GoalStatus.STATUS_ACCEPTED
        self._status_entry = encode_entry(goal_info, self._status)
        self._was_given_to_execute = False
        self._cancel_request: Future[None] = Future()
        self._result_response: Any = None
        self._result_requests: list[RequestHeader] = []

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ServerGoalHandle) and self.goal_id == other.goal_id

    __hash__ = None  # type: ignore[assignment]

    @property
    def request(self) -> Any:
        """The goal, as the client has sent it."""
        return self._goal_request

    @property
    def goal_id(self) -> UUID:
        """The goal's identifier."""
        return self._goal_info.goal_id

    @property
    def is_active(self) -> bool:
        """Whether it has not ended yet."""
        return self._status in _ACTIVE

    @property
    def is_cancel_requested(self) -> bool:
        """Whether somebody wants it cancelled, and the server's cancel callback has agreed."""
        return self._status == GoalStatus.STATUS_CANCELING

    @property
    def status(self) -> int:
        """How far it has got: one of the numbers of `action_msgs/GoalStatus`; UNKNOWN when it was destroyed."""
        return self._status

    def execute(self, execute_callback: Callable[[ServerGoalHandle], Any] | None = None) -> None:
        """Has the goal worked on, by an executor that spins the server's node.

        Args:
            execute_callback: Called with this handle, returns the result; may be a coroutine function. None: the
                server's execute callback.

        Raises:
            RCLError: It was executed before, or has ended.
        """
        # One that is to be cancelled already is for the callback to end.
        if not self.is_cancel_requested:
            self._update_state(GoalEvent.EXECUTE)
        self._was_given_to_execute = True
        self._action_server.notify_execute(self, execute_callback)

    def publish_feedback(self, feedback: Any) -> None:
        """Tells the client how far the work has got.

        Args:
            feedback: The feedback.

        Raises:
            TypeError: It is no feedback of the action's type.
        """
        self._action_server._publish_feedback(self, feedback)

    def succeed(self, response: Any = None) -> None:
        """Ends the goal as reached.

        Args:
            response: The result; None: what the execute callback returns.

        Raises:
            RCLError: It was not being executed.
            TypeError: The response is no result of the action's type.
        """
        self._end(GoalEvent.SUCCEED, response)

    def abort(self, response: Any = None) -> None:
        """Ends the goal as given up by the server; the argument and the errors are those of `succeed`."""
        self._end(GoalEvent.ABORT, response)

    def canceled(self, response: Any = None) -> None:
        """Ends the goal as cancelled, which must have been asked for; the argument is that of `succeed`.

        Raises:
            RCLError: Nobody has asked, or the server did not agree.
            TypeError: The response is no result of the action's type.
        """
        self._end(GoalEvent.CANCELED, response)

    def destroy(self) -> None:
        """Forgets the goal: what happens to it from now on tells nobody."""
        self._status = GoalStatus.STATUS_UNKNOWN

    def _update_state(self, event: GoalEvent) -> None:
        with self._action_server._lock:
            if self._status == GoalStatus.STATUS_UNKNOWN:
                return
            self._status = _status_after(self._status, event)
            self._status_entry = encode_entry(self._goal_info, self._status)
            self._action_server._publish_status()
        if event is GoalEvent.CANCEL_GOAL:
            self._cancel_request.set_result(None)

    def _end(self, event: GoalEvent, response: Any) -> None:
        result_type = self._action_server.action_type.Result
        if not (response is None or isinstance(response, result_type)):
            raise TypeError(f"Expected {result_type}, got {type(response)}")
        self._update_state(event)
        if response is not None or not self._was_given_to_execute:
            self._action_server._set_result(self, response or result_type())


def default_handle_accepted_callback(goal_handle: ServerGoalHandle) -> None:
    """Executes the goal."""
    goal_handle.execute()


def default_goal_callback(goal_request: Any) -> GoalResponse:
    """Accepts all goals."""
    del goal_request
    return GoalResponse.ACCEPT


def default_cancel_callback(cancel_request: ServerGoalHandle) -> CancelResponse:
    """Cancels no goal."""
    del cancel_request
    return CancelResponse.REJECT


class ActionServer:
    """Takes goals from action clients and has them worked on.

    All callbacks may be coroutine functions. Execute callbacks run beside everything else: where an executor has
    several threads, no callback group holds them up.

    Args:
        node: Its node.
        action_type: Class of the action.
        action_name: Its name; expanded and remapped.
        execute_callback: Works on a goal: called with a `ServerGoalHandle`, calls its `succeed()`, `abort()` or
            `canceled()`, and returns the result.
        callback_group: Of the other callbacks; None: the node's default group.
        goal_callback: Called with a goal, returns a `GoalResponse`.
        handle_accepted_callback: Called with the `ServerGoalHandle` of each accepted goal; executes it, now or later.
        cancel_callback: Called with the `ServerGoalHandle` that somebody wants cancelled, returns a `CancelResponse`.
        goal_service_qos_profile: Of the service that takes goals.
        result_service_qos_profile: Of the service that gives results.
        cancel_service_qos_profile: Of the service that cancels goals.
        feedback_pub_qos_profile: Of the publisher of feedback.
        status_pub_qos_profile: Of the publisher of the goals' status.
        result_timeout: Seconds for which results are kept; negative: for ever.

    Raises:
        TypeError: The execute callback is not callable.
        ValueError: The name breaks a rule.
        NoTypeSupportImportedException: `action_type` is no action class.
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
        self._result_timeout = result_timeout
        self._lock = threading.RLock()
        self._is_destroyed = False
        self._goals: dict[bytes, ServerGoalHandle] = {}
        self._expiries: deque[tuple[float, bytes]] = deque()
        self._to_execute: deque[tuple[Callable[[ServerGoalHandle], Any], ServerGoalHandle]] = deque()

        name, parts = resolve_action_name(node, action_name, "action server"), action_type.Impl
        own_group = ReentrantCallbackGroup()
        self._execution = node.create_guard_condition(self._execute_next, own_group)
        # The service that takes goals comes last: who sees it finds everything else.
        self._feedback_publisher = node.create_publisher(
            parts.FeedbackMessage, name + FEEDBACK, feedback_pub_qos_profile
        )
        self._status_publisher = node.create_publisher(parts.GoalStatusMessage, name + STATUS, status_pub_qos_profile)
        self._result_service, self._cancel_service, self._goal_service = self._services = tuple(
            node._create_service(DeferredService, srv_type, name + suffix, callback, qos, group)
            for srv_type, suffix, callback, qos, group in (
                (parts.GetResultService, GET_RESULT, self._on_result_request, result_service_qos_profile, own_group),
                (
                    parts.CancelGoalService,
                    CANCEL_GOAL,
                    self._on_cancel_request,
                    cancel_service_qos_profile,
                    callback_group,
                ),
                (parts.SendGoalService, SEND_GOAL, self._on_goal_request, goal_service_qos_profile, callback_group),
            )
        )

    @property
    def action_type(self) -> Any:
        """The class of the action."""
        return self._action_type

    def register_handle_accepted_callback(
        self, handle_accepted_callback: Callable[[ServerGoalHandle], Any] | None
    ) -> None:
        """Sets what is called with each accepted goal; None: it is executed."""
        self._handle_accepted_callback = handle_accepted_callback or default_handle_accepted_callback

    def register_goal_callback(self, goal_callback: Callable[[Any], Any] | None) -> None:
        """Sets who decides about goals; None: all are accepted."""
        self._goal_callback = goal_callback or default_goal_callback

    def register_cancel_callback(self, cancel_callback: Callable[[ServerGoalHandle], Any] | None) -> None:
        """Sets who decides about cancelling; None: no goal is cancelled."""
        self._cancel_callback = cancel_callback or default_cancel_callback

    def register_execute_callback(self, execute_callback: Callable[[ServerGoalHandle], Any]) -> None:
        """Sets who works on goals.

        Raises:
            TypeError: It is not callable.
        """
        if not callable(execute_callback):
            raise TypeError("Failed to register goal execution callback: not callable")
        self._execute_callback = execute_callback

    def notify_execute(
        self, goal_handle: ServerGoalHandle, execute_callback: Callable[[ServerGoalHandle], Any] | None
    ) -> None:
        """Has an executor call the execute callback; better use `ServerGoalHandle.execute`."""
        self._to_execute.append((execute_callback or self._execute_callback, goal_handle))
        self._execution.trigger()

    def destroy(self) -> None:
        """Ends it and forgets its goals; doing so twice is no error."""
        with self._lock:
            self._is_destroyed = True
            for goal_handle in self._goals.values():
                goal_handle.destroy()
            self._goals.clear()
        for service in self._services:
            self._node.destroy_service(service)
        self._node.destroy_publisher(self._feedback_publisher)
        self._node.destroy_publisher(self._status_publisher)
        self._node.destroy_guard_condition(self._execution)

    # Goals

    async def _on_goal_request(self, request: Any, header: RequestHeader) -> None:
        self._forget_expired()
        goal_handle = None
        if _key(request.goal_id) not in self._goals and await self._accepts(request.goal):
            goal_handle = self._add(request)
        response = self._action_type.Impl.SendGoalService.Response(accepted=goal_handle is not None)
        if goal_handle is not None:
            response.stamp = goal_handle._goal_info.stamp
        self._goal_service.send_response(response, header)
        outcome = "rejected" if goal_handle is None else "accepted"
        self._node.get_logger().debug(f"New goal {outcome}: {request.goal_id.uuid}")
        if goal_handle is not None:
            await _call(self._handle_accepted_callback, goal_handle)

    async def _accepts(self, goal: Any) -> bool:
        response = await _call(self._goal_callback, goal)
        if not isinstance(response, GoalResponse):
            self._node.get_logger().warning("Goal request callback did not return a GoalResponse type. Rejecting goal.")
        return response is GoalResponse.ACCEPT

    def _add(self, request: Any) -> ServerGoalHandle | None:
        """The new goal; None if another thread was faster with one of the same identifier, or with `destroy()`."""
        info = GoalInfo(goal_id=request.goal_id, stamp=self._node.get_clock().now().to_msg())
        goal_handle = ServerGoalHandle(self, info, request.goal)
        with self._lock:
            if self._is_destroyed or self._goals.setdefault(_key(request.goal_id), goal_handle) is not goal_handle:
                return None
            self._publish_status()
        return goal_handle

    def _execute_next(self) -> Coroutine[Any, Any, None] | None:
        try:
            execute_callback, goal_handle = self._to_execute.popleft()
        except IndexError:  # another thread was faster
            return None
        if self._to_execute:
            self._execution.trigger()
        return self._execute(execute_callback, goal_handle)

    async def _execute(
        self, execute_callback: Callable[[ServerGoalHandle], Any], goal_handle: ServerGoalHandle
    ) -> None:
        result_type = self._action_type.Result
        try:
            result = await _call(execute_callback, goal_handle)
        except Exception as error:
            if not self._node.context.ok():
                raise  # the shutdown's doing
            self._node.get_logger().error(f"Error raised in execute callback: {error}")
            traceback.print_exc()
            result = result_type()
        if goal_handle.is_active:
            self._node.get_logger().warning(
                f"Goal state not set, assuming aborted. Goal ID: {goal_handle.goal_id.uuid}"
            )
            goal_handle.abort()
        if not isinstance(result, result_type):
            if goal_handle._result_response is None:
                self._node.get_logger().error(
                    f"The execute callback returned {type(result).__name__}, not {result_type.__name__}: "
                    "the client gets an empty result"
                )
            result = result_type()
        self._set_result(goal_handle, result)

    # Cancelling

    async def _on_cancel_request(self, request: Any, header: RequestHeader) -> None:
        response = CancelGoal.Response()
        response.return_code, goal_handles = self._find_goals_to_cancel(request.goal_info)
        canceling = [goal_handle for goal_handle in goal_handles if await self._cancels(goal_handle)]
        response.goals_canceling = [goal_handle._goal_info for goal_handle in canceling]
        if goal_handles and not canceling:
            response.return_code = CancelGoal.Response.ERROR_REJECTED
        self._cancel_service.send_response(response, header)

    def _find_goals_to_cancel(self, goal_info: GoalInfo) -> tuple[int, list[ServerGoalHandle]]:
        """By ROS's rules: one goal; all up to a time of acceptance; both; or with neither an id nor a time, all."""
        key, latest_ns = _key(goal_info.goal_id), _nanoseconds(goal_info)
        with self._lock:
            goals = dict(self._goals)
        if any(key) and latest_ns == 0:
            if key not in goals:
                return CancelGoal.Response.ERROR_UNKNOWN_GOAL_ID, []
            if not _can_be_cancelled(goals[key]):
                return CancelGoal.Response.ERROR_GOAL_TERMINATED, []
            return CancelGoal.Response.ERROR_NONE, [goals[key]]
        return CancelGoal.Response.ERROR_NONE, [
            goal_handle
            for other_key, goal_handle in goals.items()
            if _can_be_cancelled(goal_handle)
            and (latest_ns == 0 or other_key == key or _nanoseconds(goal_handle._goal_info) <= latest_ns)
        ]

    async def _cancels(self, goal_handle: ServerGoalHandle) -> bool:
        if await _call(self._cancel_callback, goal_handle) is not CancelResponse.ACCEPT:
            return False
        try:
            goal_handle._update_state(GoalEvent.CANCEL_GOAL)
        except RCLError as error:  # it has ended meanwhile
            self._node.get_logger().debug(f"Failed to cancel goal: {error}")
            return False
        return True

    # Results

    def _on_result_request(self, request: Any, header: RequestHeader) -> None:
        self._forget_expired()
        with self._lock:
            goal_handle = self._goals.get(_key(request.goal_id))
            if goal_handle is not None and goal_handle._result_response is None:
                goal_handle._result_requests.append(header)
                return
        # Of an unknown goal, the response says so by its status.
        unknown = self._action_type.Impl.GetResultService.Response()
        response = unknown if goal_handle is None else goal_handle._result_response
        self._result_service.send_response(response, header)

    def _set_result(self, goal_handle: ServerGoalHandle, result: Any) -> None:
        """Sends the result to all who have asked, and keeps it for those who will; the first one counts."""
        response = self._action_type.Impl.GetResultService.Response(status=goal_handle.status, result=result)
        with self._lock:
            if goal_handle._result_response is not None:
                return
            goal_handle._result_response = response
            if self._result_timeout >= 0:
                self._expiries.append((time.monotonic() + self._result_timeout, _key(goal_handle.goal_id)))
        for header in goal_handle._result_requests:
            self._result_service.send_response(response, header)

    def _forget_expired(self) -> None:
        with self._lock:
            while self._expiries and self._expiries[0][0] <= time.monotonic():
                self._goals.pop(self._expiries.popleft()[1], None)

    # What everybody hears

    def _publish_status(self) -> None:
        self._status_publisher.publish(encode_statuses(goal._status_entry for goal in self._goals.values()))

    def _publish_feedback(self, goal_handle: ServerGoalHandle, feedback: Any) -> None:
        if not isinstance(feedback, self._action_type.Feedback):
            raise TypeError(f"Expected {self._action_type.Feedback}, got {type(feedback)}")
        message = self._action_type.Impl.FeedbackMessage(goal_id=goal_handle.goal_id, feedback=feedback)
        with self._lock:
            if goal_handle.status != GoalStatus.STATUS_UNKNOWN:
                self._feedback_publisher.publish(message)


async def _call(callback: Callable[..., Any], *args: Any) -> Any:
    result = callback(*args)
    return await result if inspect.iscoroutine(result) else result


def _status_after(status: int, event: GoalEvent) -> int:
    try:
        return _TRANSITIONS[status, event]
    except KeyError:
        raise RCLError(
            "Failed to update goal state: goal_handle attempted invalid transition "
            f"from state {_STATUS_NAMES[status]} with event {event.name}"
        ) from None


def _can_be_cancelled(goal_handle: ServerGoalHandle) -> bool:
    return (goal_handle.status, GoalEvent.CANCEL_GOAL) in _TRANSITIONS


def _nanoseconds(goal_info: GoalInfo) -> int:
    return goal_info.stamp.sec * S_TO_NS + goal_info.stamp.nanosec


def _key(goal_id: UUID) -> bytes:
    return bytes(goal_id.uuid)
