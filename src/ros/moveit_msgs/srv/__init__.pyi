# Written by scripts/generate_messages.py from interfaces/moveit_msgs/srv; do not edit.
import geometry_msgs.msg
import moveit_msgs.msg
import numpy as np
import sensor_msgs.msg
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["ApplyPlanningScene", "CheckIfRobotStateExistsInWarehouse", "DeleteRobotStateFromWarehouse", "GetCartesianPath", "GetGroupUrdf", "GetMotionPlan", "GetMotionSequence", "GetPlannerParams", "GetPlanningScene", "GetPositionFK", "GetPositionIK", "GetRobotStateFromWarehouse", "GetStateValidity", "GraspPlanning", "ListRobotStatesInWarehouse", "LoadGeometryFromFile", "LoadMap", "QueryPlannerInterfaces", "RenameRobotStateInWarehouse", "SaveGeometryToFile", "SaveMap", "SaveRobotStateToWarehouse", "ServoCommandType", "SetPlannerParams", "UpdatePointcloudOctomap"]

class ApplyPlanningScene_Request(Message):
    scene: moveit_msgs.msg.PlanningScene
    def __init__(self, *, scene: moveit_msgs.msg.PlanningScene = ...) -> None: ...

class ApplyPlanningScene_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class ApplyPlanningScene(Service):
    Request: TypeAlias = ApplyPlanningScene_Request
    Response: TypeAlias = ApplyPlanningScene_Response

class CheckIfRobotStateExistsInWarehouse_Request(Message):
    name: str
    robot: str
    def __init__(self, *, name: str = ..., robot: str = ...) -> None: ...

class CheckIfRobotStateExistsInWarehouse_Response(Message):
    exists: bool
    def __init__(self, *, exists: bool = ...) -> None: ...

class CheckIfRobotStateExistsInWarehouse(Service):
    Request: TypeAlias = CheckIfRobotStateExistsInWarehouse_Request
    Response: TypeAlias = CheckIfRobotStateExistsInWarehouse_Response

class DeleteRobotStateFromWarehouse_Request(Message):
    name: str
    robot: str
    def __init__(self, *, name: str = ..., robot: str = ...) -> None: ...

class DeleteRobotStateFromWarehouse_Response(Message):
    def __init__(self) -> None: ...

class DeleteRobotStateFromWarehouse(Service):
    Request: TypeAlias = DeleteRobotStateFromWarehouse_Request
    Response: TypeAlias = DeleteRobotStateFromWarehouse_Response

class GetCartesianPath_Request(Message):
    header: std_msgs.msg.Header
    start_state: moveit_msgs.msg.RobotState
    group_name: str
    link_name: str
    waypoints: list[geometry_msgs.msg.Pose]
    max_step: float
    jump_threshold: float
    prismatic_jump_threshold: float
    revolute_jump_threshold: float
    avoid_collisions: bool
    path_constraints: moveit_msgs.msg.Constraints
    max_velocity_scaling_factor: float
    max_acceleration_scaling_factor: float
    cartesian_speed_limited_link: str
    max_cartesian_speed: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., start_state: moveit_msgs.msg.RobotState = ..., group_name: str = ..., link_name: str = ..., waypoints: list[geometry_msgs.msg.Pose] = ..., max_step: float = ..., jump_threshold: float = ..., prismatic_jump_threshold: float = ..., revolute_jump_threshold: float = ..., avoid_collisions: bool = ..., path_constraints: moveit_msgs.msg.Constraints = ..., max_velocity_scaling_factor: float = ..., max_acceleration_scaling_factor: float = ..., cartesian_speed_limited_link: str = ..., max_cartesian_speed: float = ...) -> None: ...

class GetCartesianPath_Response(Message):
    start_state: moveit_msgs.msg.RobotState
    solution: moveit_msgs.msg.RobotTrajectory
    fraction: float
    error_code: moveit_msgs.msg.MoveItErrorCodes
    def __init__(self, *, start_state: moveit_msgs.msg.RobotState = ..., solution: moveit_msgs.msg.RobotTrajectory = ..., fraction: float = ..., error_code: moveit_msgs.msg.MoveItErrorCodes = ...) -> None: ...

class GetCartesianPath(Service):
    Request: TypeAlias = GetCartesianPath_Request
    Response: TypeAlias = GetCartesianPath_Response

class GetGroupUrdf_Request(Message):
    group_name: str
    def __init__(self, *, group_name: str = ...) -> None: ...

class GetGroupUrdf_Response(Message):
    error_code: moveit_msgs.msg.MoveItErrorCodes
    urdf_string: str
    def __init__(self, *, error_code: moveit_msgs.msg.MoveItErrorCodes = ..., urdf_string: str = ...) -> None: ...

class GetGroupUrdf(Service):
    Request: TypeAlias = GetGroupUrdf_Request
    Response: TypeAlias = GetGroupUrdf_Response

class GetMotionPlan_Request(Message):
    motion_plan_request: moveit_msgs.msg.MotionPlanRequest
    def __init__(self, *, motion_plan_request: moveit_msgs.msg.MotionPlanRequest = ...) -> None: ...

class GetMotionPlan_Response(Message):
    motion_plan_response: moveit_msgs.msg.MotionPlanResponse
    def __init__(self, *, motion_plan_response: moveit_msgs.msg.MotionPlanResponse = ...) -> None: ...

class GetMotionPlan(Service):
    Request: TypeAlias = GetMotionPlan_Request
    Response: TypeAlias = GetMotionPlan_Response

class GetMotionSequence_Request(Message):
    request: moveit_msgs.msg.MotionSequenceRequest
    def __init__(self, *, request: moveit_msgs.msg.MotionSequenceRequest = ...) -> None: ...

class GetMotionSequence_Response(Message):
    response: moveit_msgs.msg.MotionSequenceResponse
    def __init__(self, *, response: moveit_msgs.msg.MotionSequenceResponse = ...) -> None: ...

class GetMotionSequence(Service):
    Request: TypeAlias = GetMotionSequence_Request
    Response: TypeAlias = GetMotionSequence_Response

class GetPlannerParams_Request(Message):
    pipeline_id: str
    planner_config: str
    group: str
    def __init__(self, *, pipeline_id: str = ..., planner_config: str = ..., group: str = ...) -> None: ...

class GetPlannerParams_Response(Message):
    params: moveit_msgs.msg.PlannerParams
    def __init__(self, *, params: moveit_msgs.msg.PlannerParams = ...) -> None: ...

class GetPlannerParams(Service):
    Request: TypeAlias = GetPlannerParams_Request
    Response: TypeAlias = GetPlannerParams_Response

class GetPlanningScene_Request(Message):
    components: moveit_msgs.msg.PlanningSceneComponents
    def __init__(self, *, components: moveit_msgs.msg.PlanningSceneComponents = ...) -> None: ...

class GetPlanningScene_Response(Message):
    scene: moveit_msgs.msg.PlanningScene
    def __init__(self, *, scene: moveit_msgs.msg.PlanningScene = ...) -> None: ...

class GetPlanningScene(Service):
    Request: TypeAlias = GetPlanningScene_Request
    Response: TypeAlias = GetPlanningScene_Response

class GetPositionFK_Request(Message):
    header: std_msgs.msg.Header
    fk_link_names: list[str]
    robot_state: moveit_msgs.msg.RobotState
    def __init__(self, *, header: std_msgs.msg.Header = ..., fk_link_names: list[str] = ..., robot_state: moveit_msgs.msg.RobotState = ...) -> None: ...

class GetPositionFK_Response(Message):
    pose_stamped: list[geometry_msgs.msg.PoseStamped]
    fk_link_names: list[str]
    error_code: moveit_msgs.msg.MoveItErrorCodes
    def __init__(self, *, pose_stamped: list[geometry_msgs.msg.PoseStamped] = ..., fk_link_names: list[str] = ..., error_code: moveit_msgs.msg.MoveItErrorCodes = ...) -> None: ...

class GetPositionFK(Service):
    Request: TypeAlias = GetPositionFK_Request
    Response: TypeAlias = GetPositionFK_Response

class GetPositionIK_Request(Message):
    ik_request: moveit_msgs.msg.PositionIKRequest
    def __init__(self, *, ik_request: moveit_msgs.msg.PositionIKRequest = ...) -> None: ...

class GetPositionIK_Response(Message):
    solution: moveit_msgs.msg.RobotState
    error_code: moveit_msgs.msg.MoveItErrorCodes
    def __init__(self, *, solution: moveit_msgs.msg.RobotState = ..., error_code: moveit_msgs.msg.MoveItErrorCodes = ...) -> None: ...

class GetPositionIK(Service):
    Request: TypeAlias = GetPositionIK_Request
    Response: TypeAlias = GetPositionIK_Response

class GetRobotStateFromWarehouse_Request(Message):
    name: str
    robot: str
    def __init__(self, *, name: str = ..., robot: str = ...) -> None: ...

class GetRobotStateFromWarehouse_Response(Message):
    state: moveit_msgs.msg.RobotState
    def __init__(self, *, state: moveit_msgs.msg.RobotState = ...) -> None: ...

class GetRobotStateFromWarehouse(Service):
    Request: TypeAlias = GetRobotStateFromWarehouse_Request
    Response: TypeAlias = GetRobotStateFromWarehouse_Response

class GetStateValidity_Request(Message):
    robot_state: moveit_msgs.msg.RobotState
    group_name: str
    constraints: moveit_msgs.msg.Constraints
    def __init__(self, *, robot_state: moveit_msgs.msg.RobotState = ..., group_name: str = ..., constraints: moveit_msgs.msg.Constraints = ...) -> None: ...

class GetStateValidity_Response(Message):
    valid: bool
    contacts: list[moveit_msgs.msg.ContactInformation]
    cost_sources: list[moveit_msgs.msg.CostSource]
    constraint_result: list[moveit_msgs.msg.ConstraintEvalResult]
    def __init__(self, *, valid: bool = ..., contacts: list[moveit_msgs.msg.ContactInformation] = ..., cost_sources: list[moveit_msgs.msg.CostSource] = ..., constraint_result: list[moveit_msgs.msg.ConstraintEvalResult] = ...) -> None: ...

class GetStateValidity(Service):
    Request: TypeAlias = GetStateValidity_Request
    Response: TypeAlias = GetStateValidity_Response

class GraspPlanning_Request(Message):
    group_name: str
    target: moveit_msgs.msg.CollisionObject
    support_surfaces: list[str]
    candidate_grasps: list[moveit_msgs.msg.Grasp]
    movable_obstacles: list[moveit_msgs.msg.CollisionObject]
    def __init__(self, *, group_name: str = ..., target: moveit_msgs.msg.CollisionObject = ..., support_surfaces: list[str] = ..., candidate_grasps: list[moveit_msgs.msg.Grasp] = ..., movable_obstacles: list[moveit_msgs.msg.CollisionObject] = ...) -> None: ...

class GraspPlanning_Response(Message):
    grasps: list[moveit_msgs.msg.Grasp]
    error_code: moveit_msgs.msg.MoveItErrorCodes
    def __init__(self, *, grasps: list[moveit_msgs.msg.Grasp] = ..., error_code: moveit_msgs.msg.MoveItErrorCodes = ...) -> None: ...

class GraspPlanning(Service):
    Request: TypeAlias = GraspPlanning_Request
    Response: TypeAlias = GraspPlanning_Response

class ListRobotStatesInWarehouse_Request(Message):
    regex: str
    robot: str
    def __init__(self, *, regex: str = ..., robot: str = ...) -> None: ...

class ListRobotStatesInWarehouse_Response(Message):
    states: list[str]
    def __init__(self, *, states: list[str] = ...) -> None: ...

class ListRobotStatesInWarehouse(Service):
    Request: TypeAlias = ListRobotStatesInWarehouse_Request
    Response: TypeAlias = ListRobotStatesInWarehouse_Response

class LoadGeometryFromFile_Request(Message):
    file_path_and_name: str
    def __init__(self, *, file_path_and_name: str = ...) -> None: ...

class LoadGeometryFromFile_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class LoadGeometryFromFile(Service):
    Request: TypeAlias = LoadGeometryFromFile_Request
    Response: TypeAlias = LoadGeometryFromFile_Response

class LoadMap_Request(Message):
    filename: str
    def __init__(self, *, filename: str = ...) -> None: ...

class LoadMap_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class LoadMap(Service):
    Request: TypeAlias = LoadMap_Request
    Response: TypeAlias = LoadMap_Response

class QueryPlannerInterfaces_Request(Message):
    def __init__(self) -> None: ...

class QueryPlannerInterfaces_Response(Message):
    planner_interfaces: list[moveit_msgs.msg.PlannerInterfaceDescription]
    def __init__(self, *, planner_interfaces: list[moveit_msgs.msg.PlannerInterfaceDescription] = ...) -> None: ...

class QueryPlannerInterfaces(Service):
    Request: TypeAlias = QueryPlannerInterfaces_Request
    Response: TypeAlias = QueryPlannerInterfaces_Response

class RenameRobotStateInWarehouse_Request(Message):
    old_name: str
    new_name: str
    robot: str
    def __init__(self, *, old_name: str = ..., new_name: str = ..., robot: str = ...) -> None: ...

class RenameRobotStateInWarehouse_Response(Message):
    def __init__(self) -> None: ...

class RenameRobotStateInWarehouse(Service):
    Request: TypeAlias = RenameRobotStateInWarehouse_Request
    Response: TypeAlias = RenameRobotStateInWarehouse_Response

class SaveGeometryToFile_Request(Message):
    file_path_and_name: str
    def __init__(self, *, file_path_and_name: str = ...) -> None: ...

class SaveGeometryToFile_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class SaveGeometryToFile(Service):
    Request: TypeAlias = SaveGeometryToFile_Request
    Response: TypeAlias = SaveGeometryToFile_Response

class SaveMap_Request(Message):
    filename: str
    def __init__(self, *, filename: str = ...) -> None: ...

class SaveMap_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class SaveMap(Service):
    Request: TypeAlias = SaveMap_Request
    Response: TypeAlias = SaveMap_Response

class SaveRobotStateToWarehouse_Request(Message):
    name: str
    robot: str
    state: moveit_msgs.msg.RobotState
    def __init__(self, *, name: str = ..., robot: str = ..., state: moveit_msgs.msg.RobotState = ...) -> None: ...

class SaveRobotStateToWarehouse_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class SaveRobotStateToWarehouse(Service):
    Request: TypeAlias = SaveRobotStateToWarehouse_Request
    Response: TypeAlias = SaveRobotStateToWarehouse_Response

class ServoCommandType_Request(Message):
    JOINT_JOG: Final = 0
    TWIST: Final = 1
    POSE: Final = 2
    command_type: int
    def __init__(self, *, command_type: int = ...) -> None: ...

class ServoCommandType_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class ServoCommandType(Service):
    Request: TypeAlias = ServoCommandType_Request
    Response: TypeAlias = ServoCommandType_Response

class SetPlannerParams_Request(Message):
    pipeline_id: str
    planner_config: str
    group: str
    params: moveit_msgs.msg.PlannerParams
    replace: bool
    def __init__(self, *, pipeline_id: str = ..., planner_config: str = ..., group: str = ..., params: moveit_msgs.msg.PlannerParams = ..., replace: bool = ...) -> None: ...

class SetPlannerParams_Response(Message):
    def __init__(self) -> None: ...

class SetPlannerParams(Service):
    Request: TypeAlias = SetPlannerParams_Request
    Response: TypeAlias = SetPlannerParams_Response

class UpdatePointcloudOctomap_Request(Message):
    cloud: sensor_msgs.msg.PointCloud2
    def __init__(self, *, cloud: sensor_msgs.msg.PointCloud2 = ...) -> None: ...

class UpdatePointcloudOctomap_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class UpdatePointcloudOctomap(Service):
    Request: TypeAlias = UpdatePointcloudOctomap_Request
    Response: TypeAlias = UpdatePointcloudOctomap_Response

