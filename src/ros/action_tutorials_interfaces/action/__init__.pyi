# Written by scripts/generate_messages.py from interfaces/action_tutorials_interfaces/action; do not edit.
import action_msgs.msg
import action_msgs.srv
import builtin_interfaces.msg
import numpy as np
import unique_identifier_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["Fibonacci"]

class Fibonacci_Goal(Message):
    order: int
    def __init__(self, *, order: int = ...) -> None: ...

class Fibonacci_Result(Message):
    sequence: NumberSequence[int]
    def __init__(self, *, sequence: Iterable[int] = ...) -> None: ...

class Fibonacci_Feedback(Message):
    partial_sequence: NumberSequence[int]
    def __init__(self, *, partial_sequence: Iterable[int] = ...) -> None: ...

class Fibonacci_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: Fibonacci_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: Fibonacci_Goal = ...) -> None: ...

class Fibonacci_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class Fibonacci_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class Fibonacci_GetResult_Response(Message):
    status: int
    result: Fibonacci_Result
    def __init__(self, *, status: int = ..., result: Fibonacci_Result = ...) -> None: ...

class Fibonacci_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: Fibonacci_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: Fibonacci_Feedback = ...) -> None: ...

class Fibonacci_SendGoal(Service):
    Request: TypeAlias = Fibonacci_SendGoal_Request
    Response: TypeAlias = Fibonacci_SendGoal_Response

class Fibonacci_GetResult(Service):
    Request: TypeAlias = Fibonacci_GetResult_Request
    Response: TypeAlias = Fibonacci_GetResult_Response

class Fibonacci(Action):
    Goal: TypeAlias = Fibonacci_Goal
    Result: TypeAlias = Fibonacci_Result
    Feedback: TypeAlias = Fibonacci_Feedback
    class Impl:
        SendGoalService: TypeAlias = Fibonacci_SendGoal
        GetResultService: TypeAlias = Fibonacci_GetResult
        FeedbackMessage: TypeAlias = Fibonacci_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

