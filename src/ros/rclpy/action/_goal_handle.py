# SPDX-License-Identifier: Apache-2.0
"""Goal handles of action servers: the state machine and the result of a goal."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, Any, Final

from action_msgs.msg import GoalInfo, GoalStatus
from rclpy.action._status import encode_entry
from rclpy.exceptions import RCLError
from rclpy.task import Future

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.wire.request_header import RequestHeader
    from rclpy.action.server import ActionServer
    from unique_identifier_msgs.msg import UUID


class GoalEvent(Enum):
    """Event that changes the state of a goal."""

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
    """Handle of a goal that the action server accepted. The server creates it."""

    def __init__(self, action_server: ActionServer, goal_info: GoalInfo, goal_request: Any) -> None:
        self._action_server = action_server
        self._goal_info = goal_info
        self._goal_request = goal_request
        self._status: int = GoalStatus.STATUS_ACCEPTED
        self._Coframe__status_entry = encode_entry(goal_info, self._status)
        self._Coframe__size = 0  # bytes of the serialized request
        self.__is_execution_scheduled = False
        self._Coframe__cancel_request: Future[None] = Future()
        self._Coframe__result_response: Any = None
        self._Coframe__result_requests: list[RequestHeader] = []

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ServerGoalHandle) and self.goal_id == other.goal_id

    __hash__ = None  # type: ignore[assignment]

    @property
    def request(self) -> Any:
        """The goal that the client sent."""
        return self._goal_request

    @property
    def goal_id(self) -> UUID:
        """The identifier of the goal."""
        return self._goal_info.goal_id

    @property
    def is_active(self) -> bool:
        """Whether the goal is not finished yet."""
        return self._status in _ACTIVE

    @property
    def is_cancel_requested(self) -> bool:
        """Whether a client requested the cancellation and the cancel callback accepted it."""
        return self._status == GoalStatus.STATUS_CANCELING

    @property
    def status(self) -> int:
        """The status of the goal, a constant of `action_msgs/GoalStatus`. UNKNOWN if the goal was destroyed."""
        return self._status

    def execute(self, execute_callback: Callable[[ServerGoalHandle], Any] | None = None) -> None:
        """Schedule the execution of the goal in the executor that spins the server's node.

        Args:
            execute_callback: Function or coroutine function that is called with this handle and returns the result.
                None: the execute callback of the server.

        Raises:
            RCLError: The goal was executed before or is finished.
        """
        # A goal whose cancellation was accepted keeps its state. The callback finishes it.
        if not self.is_cancel_requested:
            self._update_state(GoalEvent.EXECUTE)
        self.__is_execution_scheduled = True
        self._action_server.notify_execute(self, execute_callback)

    def publish_feedback(self, feedback: Any) -> None:
        """Publish feedback on the goal.

        Args:
            feedback: Feedback to publish.

        Raises:
            TypeError: `feedback` is not feedback of the action's type.
        """
        self._action_server._Coframe__publish_feedback(self, feedback)

    def succeed(self, response: Any = None) -> None:
        """Finish the goal as succeeded.

        Args:
            response: Result of the goal. None: the return value of the execute callback.

        Raises:
            RCLError: The goal is not being executed.
            TypeError: `response` is not a result of the action's type.
        """
        self.__finish(GoalEvent.SUCCEED, response)

    def abort(self, response: Any = None) -> None:
        """Finish the goal as aborted. The argument and it raises the same errors as `succeed`."""
        self.__finish(GoalEvent.ABORT, response)

    def canceled(self, response: Any = None) -> None:
        """Finish the goal as cancelled, after an accepted cancel request. The argument is the same as for `succeed`.

        Raises:
            RCLError: No cancel request was accepted.
            TypeError: `response` is not a result of the action's type.
        """
        self.__finish(GoalEvent.CANCELED, response)

    def destroy(self) -> None:
        """Destroy the handle. Later changes of the goal are not published."""
        self._status = GoalStatus.STATUS_UNKNOWN

    def _update_state(self, event: GoalEvent) -> None:
        with self._action_server._lock:
            if self._status == GoalStatus.STATUS_UNKNOWN:
                return
            self._status = _status_after(self._status, event)
            self._Coframe__status_entry = encode_entry(self._goal_info, self._status)
            self._action_server._Coframe__publish_status()
        if event is GoalEvent.CANCEL_GOAL:
            self._Coframe__cancel_request.set_result(None)

    def __finish(self, event: GoalEvent, response: Any) -> None:
        result_type = self._action_server.action_type.Result
        if not (response is None or isinstance(response, result_type)):
            raise TypeError(f"Expected {result_type}, got {type(response)}")
        self._update_state(event)
        if response is not None or not self.__is_execution_scheduled:
            self._action_server._Coframe__set_result(self, response or result_type())


def _status_after(status: int, event: GoalEvent) -> int:
    try:
        return _TRANSITIONS[status, event]
    except KeyError:
        raise RCLError(
            "Failed to update goal state: goal_handle attempted invalid transition "
            f"from state {_STATUS_NAMES[status]} with event {event.name}"
        ) from None


def can_be_cancelled(goal_handle: ServerGoalHandle) -> bool:
    """Return whether a cancel request can change the state of the goal."""
    return (goal_handle.status, GoalEvent.CANCEL_GOAL) in _TRANSITIONS
