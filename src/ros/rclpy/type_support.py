# SPDX-License-Identifier: Apache-2.0
"""Checks of message, service and action types."""

from __future__ import annotations

from functools import partial
from typing import Any, Generic, TypeVar

from rclpy import _absent
from rclpy.exceptions import NoTypeSupportImportedException, _with_hint

__all__ = [
    "MsgType",
    "NoTypeSupportImportedException",
    "SrvType",
    "SrvTypeRequest",
    "SrvTypeResponse",
    "check_for_type_support",
    "check_is_valid_msg_type",
    "check_is_valid_srv_type",
    "message_class",
]


# The type variables of upstream's annotations.
MsgType = TypeVar("MsgType")
SrvType = TypeVar("SrvType")
SrvTypeRequest = TypeVar("SrvTypeRequest")
SrvTypeResponse = TypeVar("SrvTypeResponse")


class Msg:
    """A message, in annotations."""


MsgT = TypeVar("MsgT", bound=Msg)
SrvRequestT = TypeVar("SrvRequestT", bound=Msg)
SrvResponseT = TypeVar("SrvResponseT", bound=Msg)
GoalT = TypeVar("GoalT", bound=Msg)
ResultT = TypeVar("ResultT", bound=Msg)
FeedbackT = TypeVar("FeedbackT", bound=Msg)


class EventMessage(Msg, Generic[SrvRequestT, SrvResponseT]):
    """An event of a service, in annotations."""


class Srv(Generic[SrvRequestT, SrvResponseT]):
    """A service type, in annotations: ``type[Srv[Request, Response]]``."""


class SendGoalServiceRequest(Msg, Generic[GoalT]):
    """The request that sends a goal, in annotations."""


class SendGoalServiceResponse(Msg):
    """The response to a goal, in annotations."""


class SendGoalService(Srv[SendGoalServiceRequest[GoalT], SendGoalServiceResponse], Generic[GoalT]):
    """The service that sends goals, in annotations."""


class GetResultServiceRequest(Msg):
    """The request for a result, in annotations."""


class GetResultServiceResponse(Msg, Generic[ResultT]):
    """The response with a result, in annotations."""


class GetResultService(Srv[GetResultServiceRequest, GetResultServiceResponse[ResultT]], Generic[ResultT]):
    """The service that returns results, in annotations."""


class FeedbackMessage(Msg, Generic[FeedbackT]):
    """A message with feedback, in annotations."""


class Action(Generic[GoalT, ResultT, FeedbackT]):
    """An action type, in annotations: ``type[Action[Goal, Result, Feedback]]``."""


SrvT = TypeVar("SrvT", bound=type[Srv[Any, Any]])
ActionT = TypeVar("ActionT", bound=type[Action[Any, Any, Any]])


def check_for_type_support(msg_or_srv_type: Any) -> None:
    """Raise an error unless `msg_or_srv_type` is a message, service or action class of ROS 2.

    Raises:
        AttributeError: The type is not such a class.
    """
    if not hasattr(msg_or_srv_type, "ROS_TYPE"):
        raise _with_hint(
            AttributeError(
                f"type object '{type(msg_or_srv_type).__name__}' has no attribute '_TYPE_SUPPORT' This might be a ROS "
                "1 message type but it should be a ROS 2 message type. Make sure to source your ROS 2 workspace after "
                "your ROS 1 workspace."
            ),
            f"Expected a class such as std_msgs.msg.String, got {msg_or_srv_type!r}.",
        )


def check_is_valid_msg_type(msg_type: Any) -> None:
    """Raise an error unless `msg_type` is a message class.

    Raises:
        AttributeError: The type is not a class of an interface.
        RuntimeError: It is a service or action class.
    """
    check_for_type_support(msg_type)
    if not hasattr(msg_type, "SLOT_TYPES"):
        error = RuntimeError(f"The message type provided is not valid ({msg_type}), this might be a service or action")
        raise _with_hint(error, "Expected a message class such as std_msgs.msg.String.")


def message_class(msg_type: Any) -> type[Any]:
    """Return the message class, even if an instance of it was given, which upstream accepts.

    Raises:
        AttributeError, RuntimeError: See `check_is_valid_msg_type`.
    """
    check_is_valid_msg_type(msg_type)
    return msg_type if isinstance(msg_type, type) else type(msg_type)


def check_is_valid_srv_type(srv_type: Any) -> None:
    """Raise an error unless `srv_type` is a service class.

    Raises:
        AttributeError: The type is not a class of an interface.
        RuntimeError: It is a message or action class.
    """
    check_for_type_support(srv_type)
    if not hasattr(srv_type, "Request"):
        error = RuntimeError(f"The service type provided is not valid ({srv_type}), this might be a message or action")
        raise _with_hint(error, "Expected a service class such as std_srvs.srv.SetBool.")


def check_is_valid_action_type(action_type: Any) -> None:
    """Raise an error unless `action_type` is an action class.

    Raises:
        AttributeError: The type is not a class of an interface.
        RuntimeError: It is a message or service class.
    """
    check_for_type_support(action_type)
    if not hasattr(action_type, "Goal"):
        error = RuntimeError(
            f"The action type provided is not valid ({action_type}), this might be a message or service"
        )
        raise _with_hint(error, "Expected an action class such as tf2_msgs.action.LookupTransform.")


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
