# Written by scripts/generate_messages.py from interfaces/nav2_msgs/action; do not edit.
import action_msgs.msg
import action_msgs.srv
import builtin_interfaces.msg
import geometry_msgs.msg
import nav2_msgs.msg
import nav_msgs.msg
import numpy as np
import std_msgs.msg
import unique_identifier_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["AssistedTeleop", "BackUp", "ComputeAndTrackRoute", "ComputePathThroughPoses", "ComputePathToPose", "ComputeRoute", "DriveOnHeading", "DummyBehavior", "FollowPath", "FollowWaypoints", "NavigateThroughPoses", "NavigateToPose", "SmoothPath", "Spin", "Wait"]

class AssistedTeleop_Goal(Message):
    time_allowance: builtin_interfaces.msg.Duration
    def __init__(self, *, time_allowance: builtin_interfaces.msg.Duration = ...) -> None: ...

class AssistedTeleop_Result(Message):
    total_elapsed_time: builtin_interfaces.msg.Duration
    def __init__(self, *, total_elapsed_time: builtin_interfaces.msg.Duration = ...) -> None: ...

class AssistedTeleop_Feedback(Message):
    current_teleop_duration: builtin_interfaces.msg.Duration
    def __init__(self, *, current_teleop_duration: builtin_interfaces.msg.Duration = ...) -> None: ...

class AssistedTeleop_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: AssistedTeleop_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: AssistedTeleop_Goal = ...) -> None: ...

class AssistedTeleop_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class AssistedTeleop_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class AssistedTeleop_GetResult_Response(Message):
    status: int
    result: AssistedTeleop_Result
    def __init__(self, *, status: int = ..., result: AssistedTeleop_Result = ...) -> None: ...

class AssistedTeleop_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: AssistedTeleop_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: AssistedTeleop_Feedback = ...) -> None: ...

class AssistedTeleop_SendGoal(Service):
    Request: TypeAlias = AssistedTeleop_SendGoal_Request
    Response: TypeAlias = AssistedTeleop_SendGoal_Response

class AssistedTeleop_GetResult(Service):
    Request: TypeAlias = AssistedTeleop_GetResult_Request
    Response: TypeAlias = AssistedTeleop_GetResult_Response

class AssistedTeleop(Action):
    Goal: TypeAlias = AssistedTeleop_Goal
    Result: TypeAlias = AssistedTeleop_Result
    Feedback: TypeAlias = AssistedTeleop_Feedback
    class Impl:
        SendGoalService: TypeAlias = AssistedTeleop_SendGoal
        GetResultService: TypeAlias = AssistedTeleop_GetResult
        FeedbackMessage: TypeAlias = AssistedTeleop_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class BackUp_Goal(Message):
    target: geometry_msgs.msg.Point
    speed: float
    time_allowance: builtin_interfaces.msg.Duration
    def __init__(self, *, target: geometry_msgs.msg.Point = ..., speed: float = ..., time_allowance: builtin_interfaces.msg.Duration = ...) -> None: ...

class BackUp_Result(Message):
    total_elapsed_time: builtin_interfaces.msg.Duration
    def __init__(self, *, total_elapsed_time: builtin_interfaces.msg.Duration = ...) -> None: ...

class BackUp_Feedback(Message):
    distance_traveled: float
    def __init__(self, *, distance_traveled: float = ...) -> None: ...

class BackUp_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: BackUp_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: BackUp_Goal = ...) -> None: ...

class BackUp_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class BackUp_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class BackUp_GetResult_Response(Message):
    status: int
    result: BackUp_Result
    def __init__(self, *, status: int = ..., result: BackUp_Result = ...) -> None: ...

class BackUp_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: BackUp_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: BackUp_Feedback = ...) -> None: ...

class BackUp_SendGoal(Service):
    Request: TypeAlias = BackUp_SendGoal_Request
    Response: TypeAlias = BackUp_SendGoal_Response

class BackUp_GetResult(Service):
    Request: TypeAlias = BackUp_GetResult_Request
    Response: TypeAlias = BackUp_GetResult_Response

class BackUp(Action):
    Goal: TypeAlias = BackUp_Goal
    Result: TypeAlias = BackUp_Result
    Feedback: TypeAlias = BackUp_Feedback
    class Impl:
        SendGoalService: TypeAlias = BackUp_SendGoal
        GetResultService: TypeAlias = BackUp_GetResult
        FeedbackMessage: TypeAlias = BackUp_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class ComputeAndTrackRoute_Goal(Message):
    start_id: int
    start: geometry_msgs.msg.PoseStamped
    goal_id: int
    goal: geometry_msgs.msg.PoseStamped
    use_start: bool
    use_poses: bool
    def __init__(self, *, start_id: int = ..., start: geometry_msgs.msg.PoseStamped = ..., goal_id: int = ..., goal: geometry_msgs.msg.PoseStamped = ..., use_start: bool = ..., use_poses: bool = ...) -> None: ...

class ComputeAndTrackRoute_Result(Message):
    NONE: Final = 0
    UNKNOWN: Final = 400
    TF_ERROR: Final = 401
    NO_VALID_GRAPH: Final = 402
    INDETERMINANT_NODES_ON_GRAPH: Final = 403
    TIMEOUT: Final = 404
    NO_VALID_ROUTE: Final = 405
    OPERATION_FAILED: Final = 406
    INVALID_EDGE_SCORER_USE: Final = 407
    execution_duration: builtin_interfaces.msg.Duration
    def __init__(self, *, execution_duration: builtin_interfaces.msg.Duration = ...) -> None: ...

class ComputeAndTrackRoute_Feedback(Message):
    last_node_id: int
    next_node_id: int
    current_edge_id: int
    route: nav2_msgs.msg.Route
    path: nav_msgs.msg.Path
    operations_triggered: list[str]
    rerouted: bool
    def __init__(self, *, last_node_id: int = ..., next_node_id: int = ..., current_edge_id: int = ..., route: nav2_msgs.msg.Route = ..., path: nav_msgs.msg.Path = ..., operations_triggered: list[str] = ..., rerouted: bool = ...) -> None: ...

class ComputeAndTrackRoute_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: ComputeAndTrackRoute_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: ComputeAndTrackRoute_Goal = ...) -> None: ...

class ComputeAndTrackRoute_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class ComputeAndTrackRoute_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class ComputeAndTrackRoute_GetResult_Response(Message):
    status: int
    result: ComputeAndTrackRoute_Result
    def __init__(self, *, status: int = ..., result: ComputeAndTrackRoute_Result = ...) -> None: ...

class ComputeAndTrackRoute_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: ComputeAndTrackRoute_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: ComputeAndTrackRoute_Feedback = ...) -> None: ...

class ComputeAndTrackRoute_SendGoal(Service):
    Request: TypeAlias = ComputeAndTrackRoute_SendGoal_Request
    Response: TypeAlias = ComputeAndTrackRoute_SendGoal_Response

class ComputeAndTrackRoute_GetResult(Service):
    Request: TypeAlias = ComputeAndTrackRoute_GetResult_Request
    Response: TypeAlias = ComputeAndTrackRoute_GetResult_Response

class ComputeAndTrackRoute(Action):
    Goal: TypeAlias = ComputeAndTrackRoute_Goal
    Result: TypeAlias = ComputeAndTrackRoute_Result
    Feedback: TypeAlias = ComputeAndTrackRoute_Feedback
    class Impl:
        SendGoalService: TypeAlias = ComputeAndTrackRoute_SendGoal
        GetResultService: TypeAlias = ComputeAndTrackRoute_GetResult
        FeedbackMessage: TypeAlias = ComputeAndTrackRoute_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class ComputePathThroughPoses_Goal(Message):
    goals: list[geometry_msgs.msg.PoseStamped]
    start: geometry_msgs.msg.PoseStamped
    planner_id: str
    use_start: bool
    def __init__(self, *, goals: list[geometry_msgs.msg.PoseStamped] = ..., start: geometry_msgs.msg.PoseStamped = ..., planner_id: str = ..., use_start: bool = ...) -> None: ...

class ComputePathThroughPoses_Result(Message):
    path: nav_msgs.msg.Path
    planning_time: builtin_interfaces.msg.Duration
    def __init__(self, *, path: nav_msgs.msg.Path = ..., planning_time: builtin_interfaces.msg.Duration = ...) -> None: ...

class ComputePathThroughPoses_Feedback(Message):
    def __init__(self) -> None: ...

class ComputePathThroughPoses_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: ComputePathThroughPoses_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: ComputePathThroughPoses_Goal = ...) -> None: ...

class ComputePathThroughPoses_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class ComputePathThroughPoses_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class ComputePathThroughPoses_GetResult_Response(Message):
    status: int
    result: ComputePathThroughPoses_Result
    def __init__(self, *, status: int = ..., result: ComputePathThroughPoses_Result = ...) -> None: ...

class ComputePathThroughPoses_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: ComputePathThroughPoses_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: ComputePathThroughPoses_Feedback = ...) -> None: ...

class ComputePathThroughPoses_SendGoal(Service):
    Request: TypeAlias = ComputePathThroughPoses_SendGoal_Request
    Response: TypeAlias = ComputePathThroughPoses_SendGoal_Response

class ComputePathThroughPoses_GetResult(Service):
    Request: TypeAlias = ComputePathThroughPoses_GetResult_Request
    Response: TypeAlias = ComputePathThroughPoses_GetResult_Response

class ComputePathThroughPoses(Action):
    Goal: TypeAlias = ComputePathThroughPoses_Goal
    Result: TypeAlias = ComputePathThroughPoses_Result
    Feedback: TypeAlias = ComputePathThroughPoses_Feedback
    class Impl:
        SendGoalService: TypeAlias = ComputePathThroughPoses_SendGoal
        GetResultService: TypeAlias = ComputePathThroughPoses_GetResult
        FeedbackMessage: TypeAlias = ComputePathThroughPoses_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class ComputePathToPose_Goal(Message):
    goal: geometry_msgs.msg.PoseStamped
    start: geometry_msgs.msg.PoseStamped
    planner_id: str
    use_start: bool
    def __init__(self, *, goal: geometry_msgs.msg.PoseStamped = ..., start: geometry_msgs.msg.PoseStamped = ..., planner_id: str = ..., use_start: bool = ...) -> None: ...

class ComputePathToPose_Result(Message):
    path: nav_msgs.msg.Path
    planning_time: builtin_interfaces.msg.Duration
    def __init__(self, *, path: nav_msgs.msg.Path = ..., planning_time: builtin_interfaces.msg.Duration = ...) -> None: ...

class ComputePathToPose_Feedback(Message):
    def __init__(self) -> None: ...

class ComputePathToPose_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: ComputePathToPose_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: ComputePathToPose_Goal = ...) -> None: ...

class ComputePathToPose_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class ComputePathToPose_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class ComputePathToPose_GetResult_Response(Message):
    status: int
    result: ComputePathToPose_Result
    def __init__(self, *, status: int = ..., result: ComputePathToPose_Result = ...) -> None: ...

class ComputePathToPose_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: ComputePathToPose_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: ComputePathToPose_Feedback = ...) -> None: ...

class ComputePathToPose_SendGoal(Service):
    Request: TypeAlias = ComputePathToPose_SendGoal_Request
    Response: TypeAlias = ComputePathToPose_SendGoal_Response

class ComputePathToPose_GetResult(Service):
    Request: TypeAlias = ComputePathToPose_GetResult_Request
    Response: TypeAlias = ComputePathToPose_GetResult_Response

class ComputePathToPose(Action):
    Goal: TypeAlias = ComputePathToPose_Goal
    Result: TypeAlias = ComputePathToPose_Result
    Feedback: TypeAlias = ComputePathToPose_Feedback
    class Impl:
        SendGoalService: TypeAlias = ComputePathToPose_SendGoal
        GetResultService: TypeAlias = ComputePathToPose_GetResult
        FeedbackMessage: TypeAlias = ComputePathToPose_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class ComputeRoute_Goal(Message):
    start_id: int
    start: geometry_msgs.msg.PoseStamped
    goal_id: int
    goal: geometry_msgs.msg.PoseStamped
    use_start: bool
    use_poses: bool
    def __init__(self, *, start_id: int = ..., start: geometry_msgs.msg.PoseStamped = ..., goal_id: int = ..., goal: geometry_msgs.msg.PoseStamped = ..., use_start: bool = ..., use_poses: bool = ...) -> None: ...

class ComputeRoute_Result(Message):
    NONE: Final = 0
    UNKNOWN: Final = 400
    TF_ERROR: Final = 401
    NO_VALID_GRAPH: Final = 402
    INDETERMINANT_NODES_ON_GRAPH: Final = 403
    TIMEOUT: Final = 404
    NO_VALID_ROUTE: Final = 405
    INVALID_EDGE_SCORER_USE: Final = 407
    planning_time: builtin_interfaces.msg.Duration
    path: nav_msgs.msg.Path
    route: nav2_msgs.msg.Route
    def __init__(self, *, planning_time: builtin_interfaces.msg.Duration = ..., path: nav_msgs.msg.Path = ..., route: nav2_msgs.msg.Route = ...) -> None: ...

class ComputeRoute_Feedback(Message):
    def __init__(self) -> None: ...

class ComputeRoute_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: ComputeRoute_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: ComputeRoute_Goal = ...) -> None: ...

class ComputeRoute_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class ComputeRoute_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class ComputeRoute_GetResult_Response(Message):
    status: int
    result: ComputeRoute_Result
    def __init__(self, *, status: int = ..., result: ComputeRoute_Result = ...) -> None: ...

class ComputeRoute_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: ComputeRoute_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: ComputeRoute_Feedback = ...) -> None: ...

class ComputeRoute_SendGoal(Service):
    Request: TypeAlias = ComputeRoute_SendGoal_Request
    Response: TypeAlias = ComputeRoute_SendGoal_Response

class ComputeRoute_GetResult(Service):
    Request: TypeAlias = ComputeRoute_GetResult_Request
    Response: TypeAlias = ComputeRoute_GetResult_Response

class ComputeRoute(Action):
    Goal: TypeAlias = ComputeRoute_Goal
    Result: TypeAlias = ComputeRoute_Result
    Feedback: TypeAlias = ComputeRoute_Feedback
    class Impl:
        SendGoalService: TypeAlias = ComputeRoute_SendGoal
        GetResultService: TypeAlias = ComputeRoute_GetResult
        FeedbackMessage: TypeAlias = ComputeRoute_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class DriveOnHeading_Goal(Message):
    target: geometry_msgs.msg.Point
    speed: float
    time_allowance: builtin_interfaces.msg.Duration
    def __init__(self, *, target: geometry_msgs.msg.Point = ..., speed: float = ..., time_allowance: builtin_interfaces.msg.Duration = ...) -> None: ...

class DriveOnHeading_Result(Message):
    total_elapsed_time: builtin_interfaces.msg.Duration
    def __init__(self, *, total_elapsed_time: builtin_interfaces.msg.Duration = ...) -> None: ...

class DriveOnHeading_Feedback(Message):
    distance_traveled: float
    def __init__(self, *, distance_traveled: float = ...) -> None: ...

class DriveOnHeading_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: DriveOnHeading_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: DriveOnHeading_Goal = ...) -> None: ...

class DriveOnHeading_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class DriveOnHeading_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class DriveOnHeading_GetResult_Response(Message):
    status: int
    result: DriveOnHeading_Result
    def __init__(self, *, status: int = ..., result: DriveOnHeading_Result = ...) -> None: ...

class DriveOnHeading_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: DriveOnHeading_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: DriveOnHeading_Feedback = ...) -> None: ...

class DriveOnHeading_SendGoal(Service):
    Request: TypeAlias = DriveOnHeading_SendGoal_Request
    Response: TypeAlias = DriveOnHeading_SendGoal_Response

class DriveOnHeading_GetResult(Service):
    Request: TypeAlias = DriveOnHeading_GetResult_Request
    Response: TypeAlias = DriveOnHeading_GetResult_Response

class DriveOnHeading(Action):
    Goal: TypeAlias = DriveOnHeading_Goal
    Result: TypeAlias = DriveOnHeading_Result
    Feedback: TypeAlias = DriveOnHeading_Feedback
    class Impl:
        SendGoalService: TypeAlias = DriveOnHeading_SendGoal
        GetResultService: TypeAlias = DriveOnHeading_GetResult
        FeedbackMessage: TypeAlias = DriveOnHeading_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class DummyBehavior_Goal(Message):
    command: std_msgs.msg.String
    def __init__(self, *, command: std_msgs.msg.String = ...) -> None: ...

class DummyBehavior_Result(Message):
    total_elapsed_time: builtin_interfaces.msg.Duration
    def __init__(self, *, total_elapsed_time: builtin_interfaces.msg.Duration = ...) -> None: ...

class DummyBehavior_Feedback(Message):
    def __init__(self) -> None: ...

class DummyBehavior_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: DummyBehavior_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: DummyBehavior_Goal = ...) -> None: ...

class DummyBehavior_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class DummyBehavior_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class DummyBehavior_GetResult_Response(Message):
    status: int
    result: DummyBehavior_Result
    def __init__(self, *, status: int = ..., result: DummyBehavior_Result = ...) -> None: ...

class DummyBehavior_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: DummyBehavior_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: DummyBehavior_Feedback = ...) -> None: ...

class DummyBehavior_SendGoal(Service):
    Request: TypeAlias = DummyBehavior_SendGoal_Request
    Response: TypeAlias = DummyBehavior_SendGoal_Response

class DummyBehavior_GetResult(Service):
    Request: TypeAlias = DummyBehavior_GetResult_Request
    Response: TypeAlias = DummyBehavior_GetResult_Response

class DummyBehavior(Action):
    Goal: TypeAlias = DummyBehavior_Goal
    Result: TypeAlias = DummyBehavior_Result
    Feedback: TypeAlias = DummyBehavior_Feedback
    class Impl:
        SendGoalService: TypeAlias = DummyBehavior_SendGoal
        GetResultService: TypeAlias = DummyBehavior_GetResult
        FeedbackMessage: TypeAlias = DummyBehavior_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class FollowPath_Goal(Message):
    path: nav_msgs.msg.Path
    controller_id: str
    goal_checker_id: str
    def __init__(self, *, path: nav_msgs.msg.Path = ..., controller_id: str = ..., goal_checker_id: str = ...) -> None: ...

class FollowPath_Result(Message):
    result: std_msgs.msg.Empty
    def __init__(self, *, result: std_msgs.msg.Empty = ...) -> None: ...

class FollowPath_Feedback(Message):
    distance_to_goal: float
    speed: float
    def __init__(self, *, distance_to_goal: float = ..., speed: float = ...) -> None: ...

class FollowPath_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: FollowPath_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: FollowPath_Goal = ...) -> None: ...

class FollowPath_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class FollowPath_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class FollowPath_GetResult_Response(Message):
    status: int
    result: FollowPath_Result
    def __init__(self, *, status: int = ..., result: FollowPath_Result = ...) -> None: ...

class FollowPath_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: FollowPath_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: FollowPath_Feedback = ...) -> None: ...

class FollowPath_SendGoal(Service):
    Request: TypeAlias = FollowPath_SendGoal_Request
    Response: TypeAlias = FollowPath_SendGoal_Response

class FollowPath_GetResult(Service):
    Request: TypeAlias = FollowPath_GetResult_Request
    Response: TypeAlias = FollowPath_GetResult_Response

class FollowPath(Action):
    Goal: TypeAlias = FollowPath_Goal
    Result: TypeAlias = FollowPath_Result
    Feedback: TypeAlias = FollowPath_Feedback
    class Impl:
        SendGoalService: TypeAlias = FollowPath_SendGoal
        GetResultService: TypeAlias = FollowPath_GetResult
        FeedbackMessage: TypeAlias = FollowPath_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class FollowWaypoints_Goal(Message):
    poses: list[geometry_msgs.msg.PoseStamped]
    def __init__(self, *, poses: list[geometry_msgs.msg.PoseStamped] = ...) -> None: ...

class FollowWaypoints_Result(Message):
    missed_waypoints: NumberSequence[int]
    def __init__(self, *, missed_waypoints: Iterable[int] = ...) -> None: ...

class FollowWaypoints_Feedback(Message):
    current_waypoint: int
    def __init__(self, *, current_waypoint: int = ...) -> None: ...

class FollowWaypoints_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: FollowWaypoints_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: FollowWaypoints_Goal = ...) -> None: ...

class FollowWaypoints_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class FollowWaypoints_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class FollowWaypoints_GetResult_Response(Message):
    status: int
    result: FollowWaypoints_Result
    def __init__(self, *, status: int = ..., result: FollowWaypoints_Result = ...) -> None: ...

class FollowWaypoints_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: FollowWaypoints_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: FollowWaypoints_Feedback = ...) -> None: ...

class FollowWaypoints_SendGoal(Service):
    Request: TypeAlias = FollowWaypoints_SendGoal_Request
    Response: TypeAlias = FollowWaypoints_SendGoal_Response

class FollowWaypoints_GetResult(Service):
    Request: TypeAlias = FollowWaypoints_GetResult_Request
    Response: TypeAlias = FollowWaypoints_GetResult_Response

class FollowWaypoints(Action):
    Goal: TypeAlias = FollowWaypoints_Goal
    Result: TypeAlias = FollowWaypoints_Result
    Feedback: TypeAlias = FollowWaypoints_Feedback
    class Impl:
        SendGoalService: TypeAlias = FollowWaypoints_SendGoal
        GetResultService: TypeAlias = FollowWaypoints_GetResult
        FeedbackMessage: TypeAlias = FollowWaypoints_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class NavigateThroughPoses_Goal(Message):
    poses: list[geometry_msgs.msg.PoseStamped]
    behavior_tree: str
    def __init__(self, *, poses: list[geometry_msgs.msg.PoseStamped] = ..., behavior_tree: str = ...) -> None: ...

class NavigateThroughPoses_Result(Message):
    result: std_msgs.msg.Empty
    def __init__(self, *, result: std_msgs.msg.Empty = ...) -> None: ...

class NavigateThroughPoses_Feedback(Message):
    current_pose: geometry_msgs.msg.PoseStamped
    navigation_time: builtin_interfaces.msg.Duration
    estimated_time_remaining: builtin_interfaces.msg.Duration
    number_of_recoveries: int
    distance_remaining: float
    number_of_poses_remaining: int
    def __init__(self, *, current_pose: geometry_msgs.msg.PoseStamped = ..., navigation_time: builtin_interfaces.msg.Duration = ..., estimated_time_remaining: builtin_interfaces.msg.Duration = ..., number_of_recoveries: int = ..., distance_remaining: float = ..., number_of_poses_remaining: int = ...) -> None: ...

class NavigateThroughPoses_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: NavigateThroughPoses_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: NavigateThroughPoses_Goal = ...) -> None: ...

class NavigateThroughPoses_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class NavigateThroughPoses_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class NavigateThroughPoses_GetResult_Response(Message):
    status: int
    result: NavigateThroughPoses_Result
    def __init__(self, *, status: int = ..., result: NavigateThroughPoses_Result = ...) -> None: ...

class NavigateThroughPoses_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: NavigateThroughPoses_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: NavigateThroughPoses_Feedback = ...) -> None: ...

class NavigateThroughPoses_SendGoal(Service):
    Request: TypeAlias = NavigateThroughPoses_SendGoal_Request
    Response: TypeAlias = NavigateThroughPoses_SendGoal_Response

class NavigateThroughPoses_GetResult(Service):
    Request: TypeAlias = NavigateThroughPoses_GetResult_Request
    Response: TypeAlias = NavigateThroughPoses_GetResult_Response

class NavigateThroughPoses(Action):
    Goal: TypeAlias = NavigateThroughPoses_Goal
    Result: TypeAlias = NavigateThroughPoses_Result
    Feedback: TypeAlias = NavigateThroughPoses_Feedback
    class Impl:
        SendGoalService: TypeAlias = NavigateThroughPoses_SendGoal
        GetResultService: TypeAlias = NavigateThroughPoses_GetResult
        FeedbackMessage: TypeAlias = NavigateThroughPoses_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class NavigateToPose_Goal(Message):
    pose: geometry_msgs.msg.PoseStamped
    behavior_tree: str
    def __init__(self, *, pose: geometry_msgs.msg.PoseStamped = ..., behavior_tree: str = ...) -> None: ...

class NavigateToPose_Result(Message):
    result: std_msgs.msg.Empty
    def __init__(self, *, result: std_msgs.msg.Empty = ...) -> None: ...

class NavigateToPose_Feedback(Message):
    current_pose: geometry_msgs.msg.PoseStamped
    navigation_time: builtin_interfaces.msg.Duration
    estimated_time_remaining: builtin_interfaces.msg.Duration
    number_of_recoveries: int
    distance_remaining: float
    def __init__(self, *, current_pose: geometry_msgs.msg.PoseStamped = ..., navigation_time: builtin_interfaces.msg.Duration = ..., estimated_time_remaining: builtin_interfaces.msg.Duration = ..., number_of_recoveries: int = ..., distance_remaining: float = ...) -> None: ...

class NavigateToPose_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: NavigateToPose_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: NavigateToPose_Goal = ...) -> None: ...

class NavigateToPose_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class NavigateToPose_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class NavigateToPose_GetResult_Response(Message):
    status: int
    result: NavigateToPose_Result
    def __init__(self, *, status: int = ..., result: NavigateToPose_Result = ...) -> None: ...

class NavigateToPose_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: NavigateToPose_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: NavigateToPose_Feedback = ...) -> None: ...

class NavigateToPose_SendGoal(Service):
    Request: TypeAlias = NavigateToPose_SendGoal_Request
    Response: TypeAlias = NavigateToPose_SendGoal_Response

class NavigateToPose_GetResult(Service):
    Request: TypeAlias = NavigateToPose_GetResult_Request
    Response: TypeAlias = NavigateToPose_GetResult_Response

class NavigateToPose(Action):
    Goal: TypeAlias = NavigateToPose_Goal
    Result: TypeAlias = NavigateToPose_Result
    Feedback: TypeAlias = NavigateToPose_Feedback
    class Impl:
        SendGoalService: TypeAlias = NavigateToPose_SendGoal
        GetResultService: TypeAlias = NavigateToPose_GetResult
        FeedbackMessage: TypeAlias = NavigateToPose_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class SmoothPath_Goal(Message):
    path: nav_msgs.msg.Path
    smoother_id: str
    max_smoothing_duration: builtin_interfaces.msg.Duration
    check_for_collisions: bool
    def __init__(self, *, path: nav_msgs.msg.Path = ..., smoother_id: str = ..., max_smoothing_duration: builtin_interfaces.msg.Duration = ..., check_for_collisions: bool = ...) -> None: ...

class SmoothPath_Result(Message):
    path: nav_msgs.msg.Path
    smoothing_duration: builtin_interfaces.msg.Duration
    was_completed: bool
    def __init__(self, *, path: nav_msgs.msg.Path = ..., smoothing_duration: builtin_interfaces.msg.Duration = ..., was_completed: bool = ...) -> None: ...

class SmoothPath_Feedback(Message):
    def __init__(self) -> None: ...

class SmoothPath_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: SmoothPath_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: SmoothPath_Goal = ...) -> None: ...

class SmoothPath_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class SmoothPath_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class SmoothPath_GetResult_Response(Message):
    status: int
    result: SmoothPath_Result
    def __init__(self, *, status: int = ..., result: SmoothPath_Result = ...) -> None: ...

class SmoothPath_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: SmoothPath_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: SmoothPath_Feedback = ...) -> None: ...

class SmoothPath_SendGoal(Service):
    Request: TypeAlias = SmoothPath_SendGoal_Request
    Response: TypeAlias = SmoothPath_SendGoal_Response

class SmoothPath_GetResult(Service):
    Request: TypeAlias = SmoothPath_GetResult_Request
    Response: TypeAlias = SmoothPath_GetResult_Response

class SmoothPath(Action):
    Goal: TypeAlias = SmoothPath_Goal
    Result: TypeAlias = SmoothPath_Result
    Feedback: TypeAlias = SmoothPath_Feedback
    class Impl:
        SendGoalService: TypeAlias = SmoothPath_SendGoal
        GetResultService: TypeAlias = SmoothPath_GetResult
        FeedbackMessage: TypeAlias = SmoothPath_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class Spin_Goal(Message):
    target_yaw: float
    time_allowance: builtin_interfaces.msg.Duration
    def __init__(self, *, target_yaw: float = ..., time_allowance: builtin_interfaces.msg.Duration = ...) -> None: ...

class Spin_Result(Message):
    total_elapsed_time: builtin_interfaces.msg.Duration
    def __init__(self, *, total_elapsed_time: builtin_interfaces.msg.Duration = ...) -> None: ...

class Spin_Feedback(Message):
    angular_distance_traveled: float
    def __init__(self, *, angular_distance_traveled: float = ...) -> None: ...

class Spin_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: Spin_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: Spin_Goal = ...) -> None: ...

class Spin_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class Spin_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class Spin_GetResult_Response(Message):
    status: int
    result: Spin_Result
    def __init__(self, *, status: int = ..., result: Spin_Result = ...) -> None: ...

class Spin_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: Spin_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: Spin_Feedback = ...) -> None: ...

class Spin_SendGoal(Service):
    Request: TypeAlias = Spin_SendGoal_Request
    Response: TypeAlias = Spin_SendGoal_Response

class Spin_GetResult(Service):
    Request: TypeAlias = Spin_GetResult_Request
    Response: TypeAlias = Spin_GetResult_Response

class Spin(Action):
    Goal: TypeAlias = Spin_Goal
    Result: TypeAlias = Spin_Result
    Feedback: TypeAlias = Spin_Feedback
    class Impl:
        SendGoalService: TypeAlias = Spin_SendGoal
        GetResultService: TypeAlias = Spin_GetResult
        FeedbackMessage: TypeAlias = Spin_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

class Wait_Goal(Message):
    time: builtin_interfaces.msg.Duration
    def __init__(self, *, time: builtin_interfaces.msg.Duration = ...) -> None: ...

class Wait_Result(Message):
    total_elapsed_time: builtin_interfaces.msg.Duration
    def __init__(self, *, total_elapsed_time: builtin_interfaces.msg.Duration = ...) -> None: ...

class Wait_Feedback(Message):
    time_left: builtin_interfaces.msg.Duration
    def __init__(self, *, time_left: builtin_interfaces.msg.Duration = ...) -> None: ...

class Wait_SendGoal_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    goal: Wait_Goal
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., goal: Wait_Goal = ...) -> None: ...

class Wait_SendGoal_Response(Message):
    accepted: bool
    stamp: builtin_interfaces.msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: builtin_interfaces.msg.Time = ...) -> None: ...

class Wait_GetResult_Request(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ...) -> None: ...

class Wait_GetResult_Response(Message):
    status: int
    result: Wait_Result
    def __init__(self, *, status: int = ..., result: Wait_Result = ...) -> None: ...

class Wait_FeedbackMessage(Message):
    goal_id: unique_identifier_msgs.msg.UUID
    feedback: Wait_Feedback
    def __init__(self, *, goal_id: unique_identifier_msgs.msg.UUID = ..., feedback: Wait_Feedback = ...) -> None: ...

class Wait_SendGoal(Service):
    Request: TypeAlias = Wait_SendGoal_Request
    Response: TypeAlias = Wait_SendGoal_Response

class Wait_GetResult(Service):
    Request: TypeAlias = Wait_GetResult_Request
    Response: TypeAlias = Wait_GetResult_Response

class Wait(Action):
    Goal: TypeAlias = Wait_Goal
    Result: TypeAlias = Wait_Result
    Feedback: TypeAlias = Wait_Feedback
    class Impl:
        SendGoalService: TypeAlias = Wait_SendGoal
        GetResultService: TypeAlias = Wait_GetResult
        FeedbackMessage: TypeAlias = Wait_FeedbackMessage
        CancelGoalService: TypeAlias = action_msgs.srv.CancelGoal
        GoalStatusMessage: TypeAlias = action_msgs.msg.GoalStatusArray

