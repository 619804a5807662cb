# SPDX-License-Identifier: Apache-2.0
"""Action clients, which send goals to action servers."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

import os
from collections import deque
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from action_msgs.msg import GoalStatus, GoalStatusArray
from action_msgs.srv import CancelGoal
from coframe._output.warn_once import WarnOnce
from coframe.errors import DecodeError
from coframe.messages import codec
from rclpy import _absent
from rclpy._destroyable import Destroyable
from rclpy.action._names import CANCEL_GOAL, FEEDBACK, FEEDBACK_QOS, GET_RESULT, SEND_GOAL, STATUS, resolve_action_name
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.client import take_responses_until, wait_until_ready
from rclpy.qos import QoSProfile, qos_profile_action_status_default, qos_profile_services_default
from rclpy.type_support import check_is_valid_action_type
from unique_identifier_msgs.msg import UUID

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.callback_groups import CallbackGroup
    from rclpy.clock import Clock
    from rclpy.node import Node
    from rclpy.service_introspection import ServiceIntrospectionState
    from rclpy.task import Future

# Feedback can arrive after the result, because they take different ways through the middleware.
_KEPT_CALLBACKS: Final = 100  # of goals that have ended
_ENDED: Final = {GoalStatus.STATUS_SUCCEEDED, GoalStatus.STATUS_CANCELED, GoalStatus.STATUS_ABORTED}


class ClientGoalHandle:
    """Handle of a goal that was sent. Obtain it from `ActionClient.send_goal_async`."""

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
        """The identifier of the goal."""
        return self._goal_id

    @property
    def stamp(self) -> Any:
        """The time at which the server accepted the goal, a `builtin_interfaces/Time`."""
        return self._goal_response.stamp

    @property
    def accepted(self) -> bool:
        """Whether the server accepted the goal."""
        return bool(self._goal_response.accepted)

    @property
    def status(self) -> int:
        """The last known status of the goal, a constant of `action_msgs/GoalStatus`."""
        if self._status not in _ENDED:
            self._status = self._action_client._Coframe__statuses().get(_key(self._goal_id), self._status)
        return self._status

    def cancel_goal(self) -> Any:
        """Request the cancellation of the goal, and return the `CancelGoal.Response` when it arrives."""
        return self._action_client._cancel_goal(self)

    def cancel_goal_async(self) -> Future[Any]:
        """Request the cancellation of the goal, and return a future of the `CancelGoal.Response`."""
        return self._action_client._cancel_goal_async(self)

    def get_result(self) -> Any:
        """Wait until the goal is finished and return a response with `status` and `result`."""
        return self._action_client._get_result(self)

    def get_result_async(self) -> Future[Any]:
        """Return a future of a response with `status` and `result`."""
        return self._action_client._get_result_async(self)


class ActionClient(Destroyable):
    """Client of an action.

    The blocking methods do not need a spinning node. They work in any callback, as long as another executor runs the
    server.

    Args:
        node: Node of the client.
        action_type: Class of the action.
        action_name: Name of the action, which is expanded and remapped.
        callback_group: Group of the feedback callbacks. None: the default group of the node.
        goal_service_qos_profile: QoS profile of the goal service.
        result_service_qos_profile: QoS profile of the result service.
        cancel_service_qos_profile: QoS profile of the cancel service.
        feedback_sub_qos_profile: QoS profile of the feedback subscription.
        status_sub_qos_profile: QoS profile of the status subscription.

    Raises:
        ValueError: The name is not valid.
        AttributeError, RuntimeError: `action_type` is not an action class.
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
        self.__ended: deque[bytes] = deque()  # the goals that have ended and whose feedback is still passed on
        self.__status_cdr: bytes | None = None
        self.__known_statuses: dict[bytes, int] = {}
        self.__warn_once = WarnOnce(node.get_logger().warning)

        name, parts = resolve_action_name(node, action_name, "action client"), action_type.Impl
        # Internal callbacks run no user code, so they do not need to wait for callbacks of the user's group.
        internal_group = ReentrantCallbackGroup()
        # The subscriptions come first, so that the server has discovered them when it receives the first goal.
        self.__feedback_subscription = node.create_subscription(
            parts.FeedbackMessage,
            name + FEEDBACK,
            self.__on_feedback,
            feedback_sub_qos_profile,
            callback_group=callback_group,
        )
        self.__status_subscription = node.create_subscription(
            parts.GoalStatusMessage,
            name + STATUS,
            self.__on_status,
            status_sub_qos_profile,
            callback_group=internal_group,
            raw=True,
        )
        self.__goal_client, self.__cancel_client, self.__result_client = self.__clients = tuple(
            node.create_client(srv_type, name + suffix, qos_profile=qos, callback_group=internal_group)
            for srv_type, suffix, qos in (
                (parts.SendGoalService, SEND_GOAL, goal_service_qos_profile),
                (parts.CancelGoalService, CANCEL_GOAL, cancel_service_qos_profile),
                (parts.GetResultService, GET_RESULT, result_service_qos_profile),
            )
        )

    def send_goal(self, goal: Any, **kwargs: Any) -> Any:
        """Send a goal and wait for its result.

        Args:
            goal: Goal to send.
            **kwargs: Keyword arguments of `send_goal_async`.

        Returns:
            A response with `status` and `result`, or None if the context was shut down.

        Raises:
            TypeError: `goal` is not a goal of the action's type.
        """
        goal_handle = self._Coframe__wait_for(self.send_goal_async(goal, **kwargs))
        return None if goal_handle is None else self._get_result(goal_handle)

    def send_goal_async(
        self, goal: Any, feedback_callback: Callable[[Any], Any] | None = None, goal_uuid: UUID | None = None
    ) -> Future[Any]:
        """Send a goal without waiting.

        Args:
            goal: Goal to send.
            feedback_callback: Function or coroutine function that is called with each feedback message of this goal,
                which has the attributes `goal_id` and `feedback`.
            goal_uuid: Identifier of the goal. None: a random identifier.

        Returns:
            A future of a `ClientGoalHandle`, whose attribute `accepted` is the response of the server. Its
            exceptions are the same as for `Client.call_async`.

        Raises:
            TypeError: `goal` is not a goal of the action's type.
        """
        if not isinstance(goal, self._action_type.Goal):
            raise TypeError(f"Expected {self._action_type.Goal}, got {type(goal)}")
        goal_id = UUID(uuid=list(os.urandom(16))) if goal_uuid is None else goal_uuid
        if feedback_callback is not None:
            self._feedback_callbacks[_key(goal_id)] = feedback_callback
        request = self._action_type.Impl.SendGoalService.Request(goal_id=goal_id, goal=goal)
        future = self.__goal_client._Coframe__send(request, partial(self.__on_goal_response, goal_id))
        future._Coframe__add_waiter(partial(self.__on_sent, goal_id, future))
        return future

    def server_is_ready(self) -> bool:
        """Return whether a server of the action is available."""
        return (
            all(client.service_is_ready() for client in self.__clients)
            and self.__feedback_subscription.get_publisher_count() > 0
            and self.__status_subscription.get_publisher_count() > 0
        )

    @property
    def _Coframe__refusal(self) -> str:
        """Why no goal can be sent although there is a server, or "" if there is no reason."""
        return next((reason for client in self.__clients if (reason := client._Coframe__refusal)), "")

    def wait_for_server(self, timeout_sec: float | None = None) -> bool:
        """Wait until a server of the action is available.

        Args:
            timeout_sec: Maximum time to wait in seconds. None: no limit.

        Returns:
            Whether a server is available. False if the context was shut down.
        """
        return wait_until_ready(self._node.context, self._node._Coframe__participant, self.server_is_ready, timeout_sec)

    def configure_introspection(
        self, clock: Clock, service_event_qos_profile: QoSProfile, introspection_state: ServiceIntrospectionState
    ) -> None:
        """Publish events of the action's three services, or stop. See `Client.configure_introspection`."""
        for client in self.__clients:
            client.configure_introspection(clock, service_event_qos_profile, introspection_state)

    def destroy(self) -> None:
        """Destroy the client. Repeated calls have no effect. Pending futures are never completed."""
        for client in self.__clients:
            self._node.destroy_client(client)
        self._node.destroy_subscription(self.__feedback_subscription)
        self._node.destroy_subscription(self.__status_subscription)
        self._feedback_callbacks.clear()

    def _cancel_goal(self, goal_handle: ClientGoalHandle) -> Any:
        return self._Coframe__wait_for(self._cancel_goal_async(goal_handle))

    def _cancel_goal_async(self, goal_handle: ClientGoalHandle) -> Future[Any]:
        _check_is_goal_handle(goal_handle)
        request = CancelGoal.Request()
        request.goal_info.goal_id = goal_handle.goal_id
        return self.__cancel_client.call_async(request)

    def _get_result(self, goal_handle: ClientGoalHandle) -> Any:
        return self._Coframe__wait_for(self._get_result_async(goal_handle))

    def _get_result_async(self, goal_handle: ClientGoalHandle) -> Future[Any]:
        _check_is_goal_handle(goal_handle)
        request = self._action_type.Impl.GetResultService.Request(goal_id=goal_handle.goal_id)
        return self.__result_client._Coframe__send(request, partial(self.__on_result, goal_handle))

    def _Coframe__wait_for(self, future: Future[Any], timeout_sec: float | None = None) -> Any:
        """Wait for a future of this client and return its result, or None after a timeout."""
        take_responses_until(self.__clients, future, timeout_sec)
        return future.result()

    def __on_sent(self, goal_id: UUID, future: Future[Any]) -> None:
        if future._exception is not None:
            self._feedback_callbacks.pop(_key(goal_id), None)

    def __on_goal_response(self, goal_id: UUID, response: Any) -> ClientGoalHandle:
        goal_handle = ClientGoalHandle(self, goal_id, response)
        if not goal_handle.accepted:
            self._feedback_callbacks.pop(_key(goal_id), None)
        return goal_handle

    def __on_result(self, goal_handle: ClientGoalHandle, response: Any) -> Any:
        if response.status in _ENDED:
            goal_handle._status = response.status
        self.__ended.append(_key(goal_handle.goal_id))
        if len(self.__ended) > _KEPT_CALLBACKS:
            self._feedback_callbacks.pop(self.__ended.popleft(), None)
        return response

    def __on_feedback(self, message: Any) -> Any:
        callback = self._feedback_callbacks.get(_key(message.goal_id))
        return None if callback is None else callback(message)

    def __on_status(self, cdr: bytes) -> None:
        self.__status_cdr = cdr

    def _Coframe__statuses(self) -> dict[bytes, int]:
        """Return the status of all goals by identifier.

        The last message is decoded only on demand, because messages are frequent and contain all goals.
        """
        cdr, self.__status_cdr = self.__status_cdr, None
        if cdr is None:
            return self.__known_statuses
        try:
            statuses = codec.deserialize(cdr, GoalStatusArray).status_list
        except DecodeError as error:
            text = f"Ignoring damaged messages with the status of goals of the action {self._action_name}: {error}"
            self.__warn_once(text, "status")
            return self.__known_statuses
        self.__known_statuses = {_key(goal.goal_info.goal_id): goal.status for goal in statuses}
        return self.__known_statuses


def _check_is_goal_handle(goal_handle: Any) -> None:
    if not isinstance(goal_handle, ClientGoalHandle):
        raise TypeError(f"Expected type ClientGoalHandle but received {type(goal_handle)}")


def _key(goal_id: UUID) -> bytes:
    return bytes(goal_id.uuid)


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
