# Written by scripts/generate_messages.py from interfaces/turtlesim_msgs/action; do not edit.
import action_msgs.msg
import action_msgs.srv
import builtin_interfaces.msg
import numpy as np
import unique_identifier_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["RotateAbsolute"]

class RotateAbsolute_Goal(Message):
    theta: float
    def __init__(self, *, theta: float = ...) -> None: ...

class RotateAbsolute_Result(Message):
    delta: float
    def __init__(self, *, delta: float = ...) -> None: ...

class RotateAbsolute_Feedback(Message):
    remaining: float
    def __init__(self, *, remaining: float = ...) -> None: ...

class RotateAbsolute_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: RotateAbsolute_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: RotateAbsolute_Goal = ...) -> None: ...

class RotateAbsolute_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class RotateAbsolute_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class RotateAbsolute_GetResult_Response(Message):
    status: int
    result: RotateAbsolute_Result
    def __init__(self, *, status: int = ..., result: RotateAbsolute_Result = ...) -> None: ...

class RotateAbsolute_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: RotateAbsolute_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: RotateAbsolute_Feedback = ...) -> None: ...

class RotateAbsolute_SendGoal(Service):
    Request: TypeAlias = RotateAbsolute_SendGoal_Request
    Response: TypeAlias = RotateAbsolute_SendGoal_Response

class RotateAbsolute_GetResult(Service):
    Request: TypeAlias = RotateAbsolute_GetResult_Request
    Response: TypeAlias = RotateAbsolute_GetResult_Response

class RotateAbsolute(Action):
    Goal: TypeAlias = RotateAbsolute_Goal
    Result: TypeAlias = RotateAbsolute_Result
    Feedback: TypeAlias = RotateAbsolute_Feedback
    class Impl:
        SendGoalService: TypeAlias = RotateAbsolute_SendGoal
        GetResultService: TypeAlias = RotateAbsolute_GetResult
        FeedbackMessage: TypeAlias = RotateAbsolute_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

