# Written by scripts/generate_messages.py from interfaces/actionlib_msgs/msg; do not edit.
import builtin_interfaces.msg
import numpy as np
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["GoalID", "GoalStatus", "GoalStatusArray"]

class GoalID(Message):
    stamp: builtin_interfaces.msg.Time
    id: str
    def __init__(self, *, stamp: builtin_interfaces.msg.Time = ..., id: str = ...) -> None: ...

class GoalStatus(Message):
    PENDING: Final = 0
    ACTIVE: Final = 1
    PREEMPTED: Final = 2
    SUCCEEDED: Final = 3
    ABORTED: Final = 4
    REJECTED: Final = 5
    PREEMPTING: Final = 6
    RECALLING: Final = 7
    RECALLED: Final = 8
    LOST: Final = 9
    goal_id: GoalID
    status: int
    text: str
    def __init__(self, *, goal_id: GoalID = ..., status: int = ..., text: str = ...) -> None: ...

class GoalStatusArray(Message):
    header: std_msgs.msg.Header
    status_list: list[GoalStatus]
    def __init__(self, *, header: std_msgs.msg.Header = ..., status_list: list[GoalStatus] = ...) -> None: ...

