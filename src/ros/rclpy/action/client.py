"""Action clients: goals for others, and what becomes of them."""

# The modules of rclpy share what its users do not see.
# ruff: noqa: SLF001

from __future__ import annotations

import uuid
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from action_msgs.msg import GoalStatus, GoalStatusArray
from action_msgs.srv import CancelGoal
from coframe.messages import codec
from rclpy.action._names import CANCEL_GOAL, FEEDBACK, FEEDBACK_QOS, GET_RESULT, SEND_GOAL, STATUS, resolve_action_name
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.client import take_responses_until, wait_until_ready
from rclpy.qos import QoSProfile, qos_profile_action_status_default, qos_profile_services_default
from rclpy.type_support import check_is_valid_action_type
from unique_identifier_msgs.msg import UUID

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.callback_groups import CallbackGroup
    from rclpy.node import Node
    from rclpy.task import Future

_ENDED: Final = {GoalStatus.STATUS_SUCCEEDED, GoalStatus.STATUS_CANCELED, GoalStatus.STATUS_ABORTED}


class ClientGoalHandle:
    """A goal that was sent, and the server's answer to it; made by `ActionClient.send_goal_async`."""

    def __init__(self, action_client: ActionClient, goal_id: UUID, goal_response: Any) -> None:
        self._action_client = action_client
        self._goal_id = goal_id
        self._goal_response = goal_response
        self._status: int = GoalStatus.STATUS_UNKNOWN

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ClientGoalHandle) and self._goal_id == other.goal_id

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"ClientGoalHandle <id={self.goal_id.uuid}, accepted={self.accepted}, status={self.status}>"

    @property
    def goal_id(self) -> UUID:
        """The goal's identifier."""
        return self._goal_id

    @property
    def stamp(self) -> Any:
        """When the server accepted the goal, a `builtin_interfaces/Time`."""
        return self._goal_response.stamp

    @property
    def accepted(self) -> bool:
        """Whether the server has accepted the goal."""
        return bool(self._goal_response.accepted)

    @property
    def status(self) -> int:
        """How far the goal has got, as far as it is known here: one of the numbers of `action_msgs/GoalStatus`."""
        if self._status not in _ENDED:
            self._status = self._action_client._statuses().get(_key(self._goal_id), self._status)
        return self._status

    def cancel_goal(self) -> Any:
        """Asks the server to cancel the goal, and waits for the answer, a `CancelGoal.Response`."""
        return self._action_client._cancel_goal(self)

    def cancel_goal_async(self) -> Future[Any]:
        """Asks the server to cancel the goal; returns the future of a `CancelGoal.Response`."""
        return self._action_client._cancel_goal_async(self)

    def get_result(self) -> Any:
        """Waits for the end of the goal; returns a response with `status` and `result`."""
        return self._action_client._get_result(self)

    def get_result_async(self) -> Future[Any]:
        """Returns the future of a response with `status` and `result`."""
        return self._action_client._get_result_async(self)


class ActionClient:
    """Sends goals to an action server.

    Waiting methods work in any callback, as long as another executor runs the server; nobody needs to spin the node
    meanwhile.

    Args:
        node: Its node.
        action_type: Class of the action.
        action_name: Its name; expanded and remapped.
        callback_group: Of the feedback callbacks; None: the node's default group.
        goal_service_qos_profile: Of the service that takes goals.
        result_service_qos_profile: Of the service that gives results.
        cancel_service_qos_profile: Of the service that cancels goals.
        feedback_sub_qos_profile: Of the subscription to feedback.
        status_sub_qos_profile: Of the subscription to the goals' status.

    Raises:
        ValueError: The name breaks a rule.
        NoTypeSupportImportedException: `action_type` is no action class.
    """

    def __init__(
        self,
        node: Node,
        action_type: Any,
        action_name: str,
        *,
        callback_group: CallbackGroup | None = None,
        goal_service_qos_profile: QoSProfile = qos_profile_services_default,
        result_service_qos_profile: QoSProfile = qos_profile_services_default,
        cancel_service_qos_profile: QoSProfile = qos_profile_services_default,
        feedback_sub_qos_profile: QoSProfile = FEEDBACK_QOS,
        status_sub_qos_profile: QoSProfile = qos_profile_action_status_default,
    ) -> None:
        check_is_valid_action_type(action_type)
        self._node = node
        self._action_type = action_type
        self._action_name = action_name
        self._feedback_callbacks: dict[bytes, Callable[[Any], Any]] = {}
        self._ended: list[bytes] = []
        self._status_cdr: bytes | None = None
        self._known_statuses: dict[bytes, int] = {}

        name, parts = resolve_action_name(node, action_name, "action client"), action_type.Impl
        # What comes in for the client itself runs no code of users: it need not wait for the group's other callbacks.
        own_group = ReentrantCallbackGroup()
        # The server must know the subscriptions when it gets the first goal.
        self._feedback_subscription = node.create_subscription(
            parts.FeedbackMessage,
            name + FEEDBACK,
            self._on_feedback,
            feedback_sub_qos_profile,
            callback_group=callback_group,
        )
        self._status_subscription = node.create_subscription(
            parts.GoalStatusMessage,
            name + STATUS,
            self._on_status,
            status_sub_qos_profile,
            callback_group=own_group,
            raw=True,
        )
        self._goal_client, self._cancel_client, self._result_client = self._clients = tuple(
            node.create_client(srv_type, name + suffix, qos_profile=qos, callback_group=own_group)
            for srv_type, suffix, qos in (
                (parts.SendGoalService, SEND_GOAL, goal_service_qos_profile),
                (parts.CancelGoalService, CANCEL_GOAL, cancel_service_qos_profile),
                (parts.GetResultService, GET_RESULT, result_service_qos_profile),
            )
        )

    def send_goal(self, goal: Any, **kwargs: Any) -> Any:
        """Sends a goal and waits for its result.

        Args:
            goal: The goal.
            **kwargs: Those of `send_goal_async`.

        Returns:
            A response with `status` and `result`; None when the context was shut down meanwhile.

        Raises:
            TypeError: It is no goal of the action's type.
        """
        goal_handle = self._wait_for(self.send_goal_async(goal, **kwargs))
        return None if goal_handle is None else self._get_result(goal_handle)

    def send_goal_async(
        self, goal: Any, feedback_callback: Callable[[Any], Any] | None = None, goal_uuid: UUID | None = None
    ) -> Future[Any]:
        """Sends a goal.

        Args:
            goal: The goal.
            feedback_callback: Called with each message of feedback on this goal, which has a `goal_id` and the
                `feedback`; may be a coroutine function.
            goal_uuid: The goal's identifier; None: a random one.

        Returns:
            The future of a `ClientGoalHandle`, which says whether the goal was accepted.

        Raises:
            TypeError: It is no goal of the action's type.
        """
        if not isinstance(goal, self._action_type.Goal):
            raise TypeError(f"Expected {self._action_type.Goal}, got {type(goal)}")
        goal_id = UUID(uuid=list(uuid.uuid4().bytes)) if goal_uuid is None else goal_uuid
        if feedback_callback is not None:
            self._feedback_callbacks[_key(goal_id)] = feedback_callback
        request = self._action_type.Impl.SendGoalService.Request(goal_id=goal_id, goal=goal)
        return self._goal_client._send(request, partial(self._on_goal_response, goal_id))

    def server_is_ready(self) -> bool:
        """Whether somebody serves the action."""
        return (
            all(client.service_is_ready() for client in self._clients)
            and self._feedback_subscription.get_publisher_count() > 0
            and self._status_subscription.get_publisher_count() > 0
        )

    def wait_for_server(self, timeout_sec: float | None = None) -> bool:
        """Waits until somebody serves the action.

        Args:
            timeout_sec: Longest wait in seconds; None: as long as it takes.

        Returns:
            Whether somebody does; False also when the context was shut down.
        """
        return wait_until_ready(self._node.context, self._node._wire, self.server_is_ready, timeout_sec)

    def destroy(self) -> None:
        """Ends it; doing so twice is no error. Futures of goals and results will not be over any more."""
        for client in self._clients:
            self._node.destroy_client(client)
        self._node.destroy_subscription(self._feedback_subscription)
        self._node.destroy_subscription(self._status_subscription)
        self._feedback_callbacks.clear()

    def _cancel_goal(self, goal_handle: ClientGoalHandle) -> Any:
        return self._wait_for(self._cancel_goal_async(goal_handle))

    def _cancel_goal_async(self, goal_handle: ClientGoalHandle) -> Future[Any]:
        _check_is_goal_handle(goal_handle)
        request = CancelGoal.Request()
        request.goal_info.goal_id = goal_handle.goal_id
        return self._cancel_client.call_async(request)

    def _get_result(self, goal_handle: ClientGoalHandle) -> Any:
        return self._wait_for(self._get_result_async(goal_handle))

    def _get_result_async(self, goal_handle: ClientGoalHandle) -> Future[Any]:
        _check_is_goal_handle(goal_handle)
        request = self._action_type.Impl.GetResultService.Request(goal_id=goal_handle.goal_id)
        return self._result_client._send(request, partial(self._on_result, goal_handle))

    def _wait_for(self, future: Future[Any], timeout_sec: float | None = None) -> Any:
        """The result of one of the client's futures; None if there is none in time."""
        take_responses_until(self._clients, future, timeout_sec)
        return future.result()

    def _on_goal_response(self, goal_id: UUID, response: Any) -> ClientGoalHandle:
        goal_handle = ClientGoalHandle(self, goal_id, response)
        if not goal_handle.accepted:
            self._feedback_callbacks.pop(_key(goal_id), None)
        return goal_handle

    def _on_result(self, goal_handle: ClientGoalHandle, response: Any) -> Any:
        if response.status in _ENDED:
            goal_handle._status = response.status
        self._ended.append(_key(goal_handle.goal_id))
        self._forget_ended()
        return response

    def _on_feedback(self, message: Any) -> Any:
        callback = self._feedback_callbacks.get(_key(message.goal_id))
        self._forget_ended()
        return None if callback is None else callback(message)

    def _forget_ended(self) -> None:
        """Drops the feedback callbacks of goals with a result, once no feedback waits to be taken."""
        if self._feedback_subscription._remaining_ns() is None:
            ended, self._ended = self._ended, []
            for key in ended:
                self._feedback_callbacks.pop(key, None)

    def _on_status(self, cdr: bytes) -> None:
        self._status_cdr = cdr

    def _statuses(self) -> dict[bytes, int]:
        """The goals' status by their identifiers; decoded when somebody asks, as it comes often and tells of all."""
        cdr, self._status_cdr = self._status_cdr, None
        if cdr is not None:
            statuses = codec.deserialize(cdr, GoalStatusArray).status_list
            self._known_statuses = {_key(goal.goal_info.goal_id): goal.status for goal in statuses}
        return self._known_statuses


def _check_is_goal_handle(goal_handle: Any) -> None:
    if not isinstance(goal_handle, ClientGoalHandle):
        raise TypeError(f"Expected type ClientGoalHandle but received {type(goal_handle)}")


def _key(goal_id: UUID) -> bytes:
    return bytes(goal_id.uuid)
