# Written by scripts/generate_messages.py from interfaces/moveit_msgs/action; do not edit.
import action_msgs.msg
import action_msgs.srv
import builtin_interfaces.msg
import moveit_msgs.msg
import numpy as np
import unique_identifier_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["ExecuteTrajectory", "MoveGroup", "MoveGroupSequence"]

class ExecuteTrajectory_Goal(Message):
    trajectory: moveit_msgs.msg.RobotTrajectory
    controller_names: list[str]
    def __init__(self, *, trajectory: moveit_msgs.msg.RobotTrajectory = ..., controller_names: list[str] = ...) -> None: ...

class ExecuteTrajectory_Result(Message):
    error_code: moveit_msgs.msg.MoveItErrorCodes
    def __init__(self, *, error_code: moveit_msgs.msg.MoveItErrorCodes = ...) -> None: ...

class ExecuteTrajectory_Feedback(Message):
    state: str
    def __init__(self, *, state: str = ...) -> None: ...

class ExecuteTrajectory_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: ExecuteTrajectory_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: ExecuteTrajectory_Goal = ...) -> None: ...

class ExecuteTrajectory_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class ExecuteTrajectory_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class ExecuteTrajectory_GetResult_Response(Message):
    status: int
    result: ExecuteTrajectory_Result
    def __init__(self, *, status: int = ..., result: ExecuteTrajectory_Result = ...) -> None: ...

class ExecuteTrajectory_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: ExecuteTrajectory_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: ExecuteTrajectory_Feedback = ...) -> None: ...

class ExecuteTrajectory_SendGoal(Service):
    Request: TypeAlias = ExecuteTrajectory_SendGoal_Request
    Response: TypeAlias = ExecuteTrajectory_SendGoal_Response

class ExecuteTrajectory_GetResult(Service):
    Request: TypeAlias = ExecuteTrajectory_GetResult_Request
    Response: TypeAlias = ExecuteTrajectory_GetResult_Response

class ExecuteTrajectory(Action):
    Goal: TypeAlias = ExecuteTrajectory_Goal
    Result: TypeAlias = ExecuteTrajectory_Result
    Feedback: TypeAlias = ExecuteTrajectory_Feedback
    class Impl:
        SendGoalService: TypeAlias = ExecuteTrajectory_SendGoal
        GetResultService: TypeAlias = ExecuteTrajectory_GetResult
        FeedbackMessage: TypeAlias = ExecuteTrajectory_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class MoveGroup_Goal(Message):
    request: moveit_msgs.msg.MotionPlanRequest
    planning_options: moveit_msgs.msg.PlanningOptions
    def __init__(self, *, request: moveit_msgs.msg.MotionPlanRequest = ..., planning_options: moveit_msgs.msg.PlanningOptions = ...) -> None: ...

class MoveGroup_Result(Message):
    error_code: moveit_msgs.msg.MoveItErrorCodes
    trajectory_start: moveit_msgs.msg.RobotState
    planned_trajectory: moveit_msgs.msg.RobotTrajectory
    executed_trajectory: moveit_msgs.msg.RobotTrajectory
    planning_time: float
    def __init__(self, *, error_code: moveit_msgs.msg.MoveItErrorCodes = ..., trajectory_start: moveit_msgs.msg.RobotState = ..., planned_trajectory: moveit_msgs.msg.RobotTrajectory = ..., executed_trajectory: moveit_msgs.msg.RobotTrajectory = ..., planning_time: float = ...) -> None: ...

class MoveGroup_Feedback(Message):
    state: str
    def __init__(self, *, state: str = ...) -> None: ...

class MoveGroup_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: MoveGroup_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: MoveGroup_Goal = ...) -> None: ...

class MoveGroup_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class MoveGroup_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class MoveGroup_GetResult_Response(Message):
    status: int
    result: MoveGroup_Result
    def __init__(self, *, status: int = ..., result: MoveGroup_Result = ...) -> None: ...

class MoveGroup_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: MoveGroup_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: MoveGroup_Feedback = ...) -> None: ...

class MoveGroup_SendGoal(Service):
    Request: TypeAlias = MoveGroup_SendGoal_Request
    Response: TypeAlias = MoveGroup_SendGoal_Response

class MoveGroup_GetResult(Service):
    Request: TypeAlias = MoveGroup_GetResult_Request
    Response: TypeAlias = MoveGroup_GetResult_Response

class MoveGroup(Action):
    Goal: TypeAlias = MoveGroup_Goal
    Result: TypeAlias = MoveGroup_Result
    Feedback: TypeAlias = MoveGroup_Feedback
    class Impl:
        SendGoalService: TypeAlias = MoveGroup_SendGoal
        GetResultService: TypeAlias = MoveGroup_GetResult
        FeedbackMessage: TypeAlias = MoveGroup_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class MoveGroupSequence_Goal(Message):
    request: moveit_msgs.msg.MotionSequenceRequest
    planning_options: moveit_msgs.msg.PlanningOptions
    def __init__(self, *, request: moveit_msgs.msg.MotionSequenceRequest = ..., planning_options: moveit_msgs.msg.PlanningOptions = ...) -> None: ...

class MoveGroupSequence_Result(Message):
    response: moveit_msgs.msg.MotionSequenceResponse
    def __init__(self, *, response: moveit_msgs.msg.MotionSequenceResponse = ...) -> None: ...

class MoveGroupSequence_Feedback(Message):
    state: str
    def __init__(self, *, state: str = ...) -> None: ...

class MoveGroupSequence_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: MoveGroupSequence_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: MoveGroupSequence_Goal = ...) -> None: ...

class MoveGroupSequence_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class MoveGroupSequence_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class MoveGroupSequence_GetResult_Response(Message):
    status: int
    result: MoveGroupSequence_Result
    def __init__(self, *, status: int = ..., result: MoveGroupSequence_Result = ...) -> None: ...

class MoveGroupSequence_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: MoveGroupSequence_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: MoveGroupSequence_Feedback = ...) -> None: ...

class MoveGroupSequence_SendGoal(Service):
    Request: TypeAlias = MoveGroupSequence_SendGoal_Request
    Response: TypeAlias = MoveGroupSequence_SendGoal_Response

class MoveGroupSequence_GetResult(Service):
    Request: TypeAlias = MoveGroupSequence_GetResult_Request
    Response: TypeAlias = MoveGroupSequence_GetResult_Response

class MoveGroupSequence(Action):
    Goal: TypeAlias = MoveGroupSequence_Goal
    Result: TypeAlias = MoveGroupSequence_Result
    Feedback: TypeAlias = MoveGroupSequence_Feedback
    class Impl:
        SendGoalService: TypeAlias = MoveGroupSequence_SendGoal
        GetResultService: TypeAlias = MoveGroupSequence_GetResult
        FeedbackMessage: TypeAlias = MoveGroupSequence_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

