# Written by scripts/generate_messages.py from interfaces/action_msgs/srv; do not edit.
"""Services of action_msgs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, TypeAlias

from coframe.messages.definition import BasicType, NamespacedType, UnboundedSequence
from coframe.messages.message import Message, Service, set_fields
from coframe.messages.generated.action_msgs.msg import GoalInfo


class CancelGoal_Request(Message):
    """A zero goal id or a zero stamp widens the request: see the design of ROS 2's actions."""

    ROS_TYPE = "action_msgs/srv/CancelGoal_Request"
    SLOT_TYPES = (
        NamespacedType(('action_msgs', 'msg'), 'GoalInfo'),
    )

    if TYPE_CHECKING:
        goal_info: GoalInfo
        def __init__(self, *, goal_info: GoalInfo = ...) -> None: ...
    else:
        __slots__ = ["_goal_info"]

        def __init__(self, **fields: Any) -> None:
            self._goal_info = fields.get("goal_info") or GoalInfo()
            if fields:
                set_fields(self, fields)


class CancelGoal_Response(Message):
    """Message action_msgs/srv/CancelGoal_Response."""

    ROS_TYPE = "action_msgs/srv/CancelGoal_Response"
    SLOT_TYPES = (
        BasicType('int8'),
        UnboundedSequence(NamespacedType(('action_msgs', 'msg'), 'GoalInfo')),
    )
    ERROR_NONE: Final = 0
    ERROR_REJECTED: Final = 1
    ERROR_UNKNOWN_GOAL_ID: Final = 2
    ERROR_GOAL_TERMINATED: Final = 3

    if TYPE_CHECKING:
        return_code: int
        goals_canceling: list[GoalInfo]
        def __init__(self, *, return_code: int = ..., goals_canceling: list[GoalInfo] = ...) -> None: ...
    else:
        __slots__ = ["_return_code", "_goals_canceling"]

        def __init__(self, **fields: Any) -> None:
            self._return_code = 0
            self._goals_canceling = []
            if fields:
                set_fields(self, fields)


class CancelGoal(Service):
    """Service action_msgs/srv/CancelGoal."""

    ROS_TYPE = "action_msgs/srv/CancelGoal"
    Request: TypeAlias = CancelGoal_Request
    Response: TypeAlias = CancelGoal_Response
