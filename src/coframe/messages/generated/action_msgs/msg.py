# Written by scripts/generate_messages.py from interfaces/action_msgs/msg; do not edit.
"""Messages of action_msgs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from coframe.messages.definition import BasicType, NamespacedType, UnboundedSequence
from coframe.messages.message import Message, set_fields
from coframe.messages.generated.builtin_interfaces.msg import Time
from coframe.messages.generated.unique_identifier_msgs.msg import UUID


class GoalInfo(Message):
    """Message action_msgs/msg/GoalInfo."""

    ROS_TYPE = "action_msgs/msg/GoalInfo"
    SLOT_TYPES = (
        NamespacedType(('unique_identifier_msgs', 'msg'), 'UUID'),
        NamespacedType(('builtin_interfaces', 'msg'), 'Time'),
    )

    if TYPE_CHECKING:
        goal_id: UUID
        stamp: Time
        def __init__(self, *, goal_id: UUID = ..., stamp: Time = ...) -> None: ...
    else:
        __slots__ = ["_goal_id", "_stamp"]

        def __init__(self, **fields: Any) -> None:
            self._goal_id = fields.get("goal_id") or UUID()
            self._stamp = fields.get("stamp") or Time()
            if fields:
                set_fields(self, fields)


class GoalStatus(Message):
    """Message action_msgs/msg/GoalStatus."""

    ROS_TYPE = "action_msgs/msg/GoalStatus"
    SLOT_TYPES = (
        NamespacedType(('action_msgs', 'msg'), 'GoalInfo'),
        BasicType('int8'),
    )
    STATUS_UNKNOWN: Final = 0
    STATUS_ACCEPTED: Final = 1
    STATUS_EXECUTING: Final = 2
    STATUS_CANCELING: Final = 3
    STATUS_SUCCEEDED: Final = 4
    STATUS_CANCELED: Final = 5
    STATUS_ABORTED: Final = 6

    if TYPE_CHECKING:
        goal_info: GoalInfo
        status: int
        def __init__(self, *, goal_info: GoalInfo = ..., status: int = ...) -> None: ...
    else:
        __slots__ = ["_goal_info", "_status"]

        def __init__(self, **fields: Any) -> None:
            self._goal_info = fields.get("goal_info") or GoalInfo()
            self._status = 0
            if fields:
                set_fields(self, fields)


class GoalStatusArray(Message):
    """Message action_msgs/msg/GoalStatusArray."""

    ROS_TYPE = "action_msgs/msg/GoalStatusArray"
    SLOT_TYPES = (
        UnboundedSequence(NamespacedType(('action_msgs', 'msg'), 'GoalStatus')),
    )

    if TYPE_CHECKING:
        status_list: list[GoalStatus]
        def __init__(self, *, status_list: list[GoalStatus] = ...) -> None: ...
    else:
        __slots__ = ["_status_list"]

        def __init__(self, **fields: Any) -> None:
            self._status_list = []
            if fields:
                set_fields(self, fields)
