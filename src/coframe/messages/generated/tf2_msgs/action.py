# Written by scripts/generate_messages.py from interfaces/tf2_msgs/action; do not edit.
"""Actions of tf2_msgs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, TypeAlias

from coframe.messages.definition import BasicType, NamespacedType, UnboundedString
from coframe.messages.message import Action, Message, Service, set_fields
from coframe.messages.generated.action_msgs.msg import GoalStatusArray
from coframe.messages.generated.action_msgs.srv import CancelGoal
from coframe.messages.generated.builtin_interfaces.msg import Duration, Time
from coframe.messages.generated.geometry_msgs.msg import TransformStamped
from coframe.messages.generated.tf2_msgs.msg import TF2Error
from coframe.messages.generated.unique_identifier_msgs.msg import UUID


class LookupTransform_Goal(Message):
    """Message tf2_msgs/action/LookupTransform_Goal."""

    ROS_TYPE = "tf2_msgs/action/LookupTransform_Goal"
    SLOT_TYPES = (
        UnboundedString(),
        UnboundedString(),
        NamespacedType(('builtin_interfaces', 'msg'), 'Time'),
        NamespacedType(('builtin_interfaces', 'msg'), 'Duration'),
        NamespacedType(('builtin_interfaces', 'msg'), 'Time'),
        UnboundedString(),
        BasicType('boolean'),
    )

    if TYPE_CHECKING:
        target_frame: str
        source_frame: str
        source_time: Time
        timeout: Duration
        target_time: Time
        fixed_frame: str
        advanced: bool
        def __init__(self, *, target_frame: str = ..., source_frame: str = ..., source_time: Time = ..., timeout: Duration = ..., target_time: Time = ..., fixed_frame: str = ..., advanced: bool = ...) -> None: ...
    else:
        __slots__ = ["_target_frame", "_source_frame", "_source_time", "_timeout", "_target_time", "_fixed_frame", "_advanced"]

        def __init__(self, **fields: Any) -> None:
            self._target_frame = ""
            self._source_frame = ""
            self._source_time = fields.get("source_time") or Time()
            self._timeout = fields.get("timeout") or Duration()
            self._target_time = fields.get("target_time") or Time()
            self._fixed_frame = ""
            self._advanced = False
            if fields:
                set_fields(self, fields)


class LookupTransform_Result(Message):
    """Message tf2_msgs/action/LookupTransform_Result."""

    ROS_TYPE = "tf2_msgs/action/LookupTransform_Result"
    SLOT_TYPES = (
        NamespacedType(('geometry_msgs', 'msg'), 'TransformStamped'),
        NamespacedType(('tf2_msgs', 'msg'), 'TF2Error'),
    )

    if TYPE_CHECKING:
        transform: TransformStamped
        error: TF2Error
        def __init__(self, *, transform: TransformStamped = ..., error: TF2Error = ...) -> None: ...
    else:
        __slots__ = ["_transform", "_error"]

        def __init__(self, **fields: Any) -> None:
            self._transform = fields.get("transform") or TransformStamped()
            self._error = fields.get("error") or TF2Error()
            if fields:
                set_fields(self, fields)


class LookupTransform_Feedback(Message):
    """Message tf2_msgs/action/LookupTransform_Feedback."""

    ROS_TYPE = "tf2_msgs/action/LookupTransform_Feedback"
    SLOT_TYPES = ()

    if TYPE_CHECKING:
        def __init__(self) -> None: ...
    else:
        __slots__ = []

        def __init__(self, **fields: Any) -> None:
            if fields:
                set_fields(self, fields)


class LookupTransform_SendGoal_Request(Message):
    """Message tf2_msgs/action/LookupTransform_SendGoal_Request."""

    ROS_TYPE = "tf2_msgs/action/LookupTransform_SendGoal_Request"
    SLOT_TYPES = (
        NamespacedType(('unique_identifier_msgs', 'msg'), 'UUID'),
        NamespacedType(('tf2_msgs', 'action'), 'LookupTransform_Goal'),
    )

    if TYPE_CHECKING:
        goal_id: UUID
        goal: LookupTransform_Goal
        def __init__(self, *, goal_id: UUID = ..., goal: LookupTransform_Goal = ...) -> None: ...
    else:
        __slots__ = ["_goal_id", "_goal"]

        def __init__(self, **fields: Any) -> None:
            self._goal_id = fields.get("goal_id") or UUID()
            self._goal = fields.get("goal") or LookupTransform_Goal()
            if fields:
                set_fields(self, fields)


class LookupTransform_SendGoal_Response(Message):
    """Message tf2_msgs/action/LookupTransform_SendGoal_Response."""

    ROS_TYPE = "tf2_msgs/action/LookupTransform_SendGoal_Response"
    SLOT_TYPES = (
        BasicType('boolean'),
        NamespacedType(('builtin_interfaces', 'msg'), 'Time'),
    )

    if TYPE_CHECKING:
        accepted: bool
        stamp: Time
        def __init__(self, *, accepted: bool = ..., stamp: Time = ...) -> None: ...
    else:
        __slots__ = ["_accepted", "_stamp"]

        def __init__(self, **fields: Any) -> None:
            self._accepted = False
            self._stamp = fields.get("stamp") or Time()
            if fields:
                set_fields(self, fields)


class LookupTransform_GetResult_Request(Message):
    """Message tf2_msgs/action/LookupTransform_GetResult_Request."""

    ROS_TYPE = "tf2_msgs/action/LookupTransform_GetResult_Request"
    SLOT_TYPES = (
        NamespacedType(('unique_identifier_msgs', 'msg'), 'UUID'),
    )

    if TYPE_CHECKING:
        goal_id: UUID
        def __init__(self, *, goal_id: UUID = ...) -> None: ...
    else:
        __slots__ = ["_goal_id"]

        def __init__(self, **fields: Any) -> None:
            self._goal_id = fields.get("goal_id") or UUID()
            if fields:
                set_fields(self, fields)


class LookupTransform_GetResult_Response(Message):
    """Message tf2_msgs/action/LookupTransform_GetResult_Response."""

    ROS_TYPE = "tf2_msgs/action/LookupTransform_GetResult_Response"
    SLOT_TYPES = (
        BasicType('int8'),
        NamespacedType(('tf2_msgs', 'action'), 'LookupTransform_Result'),
    )

    if TYPE_CHECKING:
        status: int
        result: LookupTransform_Result
        def __init__(self, *, status: int = ..., result: LookupTransform_Result = ...) -> None: ...
    else:
        __slots__ = ["_status", "_result"]

        def __init__(self, **fields: Any) -> None:
            self._status = 0
            self._result = fields.get("result") or LookupTransform_Result()
            if fields:
                set_fields(self, fields)


class LookupTransform_FeedbackMessage(Message):
    """Message tf2_msgs/action/LookupTransform_FeedbackMessage."""

    ROS_TYPE = "tf2_msgs/action/LookupTransform_FeedbackMessage"
    SLOT_TYPES = (
        NamespacedType(('unique_identifier_msgs', 'msg'), 'UUID'),
        NamespacedType(('tf2_msgs', 'action'), 'LookupTransform_Feedback'),
    )

    if TYPE_CHECKING:
        goal_id: UUID
        feedback: LookupTransform_Feedback
        def __init__(self, *, goal_id: UUID = ..., feedback: LookupTransform_Feedback = ...) -> None: ...
    else:
        __slots__ = ["_goal_id", "_feedback"]

        def __init__(self, **fields: Any) -> None:
            self._goal_id = fields.get("goal_id") or UUID()
            self._feedback = fields.get("feedback") or LookupTransform_Feedback()
            if fields:
                set_fields(self, fields)


class LookupTransform_SendGoal(Service):
    """Service tf2_msgs/action/LookupTransform_SendGoal."""

    ROS_TYPE = "tf2_msgs/action/LookupTransform_SendGoal"
    Request: TypeAlias = LookupTransform_SendGoal_Request
    Response: TypeAlias = LookupTransform_SendGoal_Response


class LookupTransform_GetResult(Service):
    """Service tf2_msgs/action/LookupTransform_GetResult."""

    ROS_TYPE = "tf2_msgs/action/LookupTransform_GetResult"
    Request: TypeAlias = LookupTransform_GetResult_Request
    Response: TypeAlias = LookupTransform_GetResult_Response


class LookupTransform(Action):
    """Action tf2_msgs/action/LookupTransform."""

    ROS_TYPE = "tf2_msgs/action/LookupTransform"
    Goal: TypeAlias = LookupTransform_Goal
    Result: TypeAlias = LookupTransform_Result
    Feedback: TypeAlias = LookupTransform_Feedback

    class Impl:
        """The services and messages of the action protocol."""

        SendGoalService: TypeAlias = LookupTransform_SendGoal
        GetResultService: TypeAlias = LookupTransform_GetResult
        FeedbackMessage: TypeAlias = LookupTransform_FeedbackMessage
        CancelGoalService: TypeAlias = CancelGoal
        GoalStatusMessage: TypeAlias = GoalStatusArray
