# Written by scripts/generate_messages.py from interfaces/moveit_msgs/msg; do not edit.
import builtin_interfaces.msg
import geometry_msgs.msg
import numpy as np
import object_recognition_msgs.msg
import octomap_msgs.msg
import sensor_msgs.msg
import shape_msgs.msg
import std_msgs.msg
import trajectory_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["AllowedCollisionEntry", "AllowedCollisionMatrix", "AttachedCollisionObject", "BoundingVolume", "CartesianPoint", "CartesianTrajectory", "CartesianTrajectoryPoint", "CollisionObject", "ConstraintEvalResult", "Constraints", "ContactInformation", "CostSource", "DisplayRobotState", "DisplayTrajectory", "GenericTrajectory", "Grasp", "GripperTranslation", "JointConstraint", "JointLimits", "KinematicSolverInfo", "LinkPadding", "LinkScale", "MotionPlanDetailedResponse", "MotionPlanRequest", "MotionPlanResponse", "MotionSequenceItem", "MotionSequenceRequest", "MotionSequenceResponse", "MoveItErrorCodes", "ObjectColor", "OrientationConstraint", "OrientedBoundingBox", "PipelineState", "PlaceLocation", "PlannerInterfaceDescription", "PlannerParams", "PlanningOptions", "PlanningScene", "PlanningSceneComponents", "PlanningSceneWorld", "PositionConstraint", "PositionIKRequest", "RobotState", "RobotTrajectory", "ServoStatus", "TrajectoryConstraints", "VisibilityConstraint", "WorkspaceParameters"]

class AllowedCollisionEntry(Message):
    enabled: list[bool]
    def __init__(self, *, enabled: list[bool] = ...) -> None: ...

class AllowedCollisionMatrix(Message):
    entry_names: list[str]
    entry_values: list[AllowedCollisionEntry]
    default_entry_names: list[str]
    default_entry_values: list[bool]
    def __init__(self, *, entry_names: list[str] = ..., entry_values: list[AllowedCollisionEntry] = ..., default_entry_names: list[str] = ..., default_entry_values: list[bool] = ...) -> None: ...

class AttachedCollisionObject(Message):
    link_name: str
    object: CollisionObject
    touch_links: list[str]
    detach_posture: trajectory_msgs.msg.JointTrajectory
    weight: float
    def __init__(self, *, link_name: str = ..., object: CollisionObject = ..., touch_links: list[str] = ..., detach_posture: trajectory_msgs.msg.JointTrajectory = ..., weight: float = ...) -> None: ...

class BoundingVolume(Message):
    primitives: list[shape_msgs.msg.SolidPrimitive]
    primitive_poses: list[geometry_msgs.msg.Pose]
    meshes: list[shape_msgs.msg.Mesh]
    mesh_poses: list[geometry_msgs.msg.Pose]
    def __init__(self, *, primitives: list[shape_msgs.msg.SolidPrimitive] = ..., primitive_poses: list[geometry_msgs.msg.Pose] = ..., meshes: list[shape_msgs.msg.Mesh] = ..., mesh_poses: list[geometry_msgs.msg.Pose] = ...) -> None: ...

class CartesianPoint(Message):
    pose: geometry_msgs.msg.Pose
    velocity: geometry_msgs.msg.Twist
    acceleration: geometry_msgs.msg.Accel
    def __init__(self, *, pose: geometry_msgs.msg.Pose = ..., velocity: geometry_msgs.msg.Twist = ..., acceleration: geometry_msgs.msg.Accel = ...) -> None: ...

class CartesianTrajectory(Message):
    header: std_msgs.msg.Header
    tracked_frame: str
    points: list[CartesianTrajectoryPoint]
    def __init__(self, *, header: std_msgs.msg.Header = ..., tracked_frame: str = ..., points: list[CartesianTrajectoryPoint] = ...) -> None: ...

class CartesianTrajectoryPoint(Message):
    point: CartesianPoint
    time_from_start: builtin_interfaces.msg.Duration
    def __init__(self, *, point: CartesianPoint = ..., time_from_start: builtin_interfaces.msg.Duration = ...) -> None: ...

class CollisionObject(Message):
    ADD: Final = b'\x00'
    REMOVE: Final = b'\x01'
    APPEND: Final = b'\x02'
    MOVE: Final = b'\x03'
    header: std_msgs.msg.Header
    pose: geometry_msgs.msg.Pose
    id: str
    type: object_recognition_msgs.msg.ObjectType
    primitives: list[shape_msgs.msg.SolidPrimitive]
    primitive_poses: list[geometry_msgs.msg.Pose]
    meshes: list[shape_msgs.msg.Mesh]
    mesh_poses: list[geometry_msgs.msg.Pose]
    planes: list[shape_msgs.msg.Plane]
    plane_poses: list[geometry_msgs.msg.Pose]
    subframe_names: list[str]
    subframe_poses: list[geometry_msgs.msg.Pose]
    operation: bytes
    def __init__(self, *, header: std_msgs.msg.Header = ..., pose: geometry_msgs.msg.Pose = ..., id: str = ..., type: object_recognition_msgs.msg.ObjectType = ..., primitives: list[shape_msgs.msg.SolidPrimitive] = ..., primitive_poses: list[geometry_msgs.msg.Pose] = ..., meshes: list[shape_msgs.msg.Mesh] = ..., mesh_poses: list[geometry_msgs.msg.Pose] = ..., planes: list[shape_msgs.msg.Plane] = ..., plane_poses: list[geometry_msgs.msg.Pose] = ..., subframe_names: list[str] = ..., subframe_poses: list[geometry_msgs.msg.Pose] = ..., operation: bytes = ...) -> None: ...

class ConstraintEvalResult(Message):
    result: bool
    distance: float
    def __init__(self, *, result: bool = ..., distance: float = ...) -> None: ...

class Constraints(Message):
    name: str
    joint_constraints: list[JointConstraint]
    position_constraints: list[PositionConstraint]
    orientation_constraints: list[OrientationConstraint]
    visibility_constraints: list[VisibilityConstraint]
    def __init__(self, *, name: str = ..., joint_constraints: list[JointConstraint] = ..., position_constraints: list[PositionConstraint] = ..., orientation_constraints: list[OrientationConstraint] = ..., visibility_constraints: list[VisibilityConstraint] = ...) -> None: ...

class ContactInformation(Message):
    ROBOT_LINK: Final = 0
    WORLD_OBJECT: Final = 1
    ROBOT_ATTACHED: Final = 2
    header: std_msgs.msg.Header
    position: geometry_msgs.msg.Point
    normal: geometry_msgs.msg.Vector3
    depth: float
    contact_body_1: str
    body_type_1: int
    contact_body_2: str
    body_type_2: int
    def __init__(self, *, header: std_msgs.msg.Header = ..., position: geometry_msgs.msg.Point = ..., normal: geometry_msgs.msg.Vector3 = ..., depth: float = ..., contact_body_1: str = ..., body_type_1: int = ..., contact_body_2: str = ..., body_type_2: int = ...) -> None: ...

class CostSource(Message):
    cost_density: float
    aabb_min: geometry_msgs.msg.Vector3
    aabb_max: geometry_msgs.msg.Vector3
    def __init__(self, *, cost_density: float = ..., aabb_min: geometry_msgs.msg.Vector3 = ..., aabb_max: geometry_msgs.msg.Vector3 = ...) -> None: ...

class DisplayRobotState(Message):
    state: RobotState
    highlight_links: list[ObjectColor]
    hide: bool
    def __init__(self, *, state: RobotState = ..., highlight_links: list[ObjectColor] = ..., hide: bool = ...) -> None: ...

class DisplayTrajectory(Message):
    model_id: str
    trajectory: list[RobotTrajectory]
    trajectory_start: RobotState
    def __init__(self, *, model_id: str = ..., trajectory: list[RobotTrajectory] = ..., trajectory_start: RobotState = ...) -> None: ...

class GenericTrajectory(Message):
    header: std_msgs.msg.Header
    joint_trajectory: list[trajectory_msgs.msg.JointTrajectory]
    cartesian_trajectory: list[CartesianTrajectory]
    def __init__(self, *, header: std_msgs.msg.Header = ..., joint_trajectory: list[trajectory_msgs.msg.JointTrajectory] = ..., cartesian_trajectory: list[CartesianTrajectory] = ...) -> None: ...

class Grasp(Message):
    id: str
    pre_grasp_posture: trajectory_msgs.msg.JointTrajectory
    grasp_posture: trajectory_msgs.msg.JointTrajectory
    grasp_pose: geometry_msgs.msg.PoseStamped
    grasp_quality: float
    pre_grasp_approach: GripperTranslation
    post_grasp_retreat: GripperTranslation
    post_place_retreat: GripperTranslation
    max_contact_force: float
    allowed_touch_objects: list[str]
    def __init__(self, *, id: str = ..., pre_grasp_posture: trajectory_msgs.msg.JointTrajectory = ..., grasp_posture: trajectory_msgs.msg.JointTrajectory = ..., grasp_pose: geometry_msgs.msg.PoseStamped = ..., grasp_quality: float = ..., pre_grasp_approach: GripperTranslation = ..., post_grasp_retreat: GripperTranslation = ..., post_place_retreat: GripperTranslation = ..., max_contact_force: float = ..., allowed_touch_objects: list[str] = ...) -> None: ...

class GripperTranslation(Message):
    direction: geometry_msgs.msg.Vector3Stamped
    desired_distance: float
    min_distance: float
    def __init__(self, *, direction: geometry_msgs.msg.Vector3Stamped = ..., desired_distance: float = ..., min_distance: float = ...) -> None: ...

class JointConstraint(Message):
    joint_name: str
    position: float
    tolerance_above: float
    tolerance_below: float
    weight: float
    def __init__(self, *, joint_name: str = ..., position: float = ..., tolerance_above: float = ..., tolerance_below: float = ..., weight: float = ...) -> None: ...

class JointLimits(Message):
    joint_name: str
    has_position_limits: bool
    min_position: float
    max_position: float
    has_velocity_limits: bool
    max_velocity: float
    has_acceleration_limits: bool
    max_acceleration: float
    has_jerk_limits: bool
    max_jerk: float
    def __init__(self, *, joint_name: str = ..., has_position_limits: bool = ..., min_position: float = ..., max_position: float = ..., has_velocity_limits: bool = ..., max_velocity: float = ..., has_acceleration_limits: bool = ..., max_acceleration: float = ..., has_jerk_limits: bool = ..., max_jerk: float = ...) -> None: ...

class KinematicSolverInfo(Message):
    joint_names: list[str]
    limits: list[JointLimits]
    link_names: list[str]
    def __init__(self, *, joint_names: list[str] = ..., limits: list[JointLimits] = ..., link_names: list[str] = ...) -> None: ...

class LinkPadding(Message):
    link_name: str
    padding: float
    def __init__(self, *, link_name: str = ..., padding: float = ...) -> None: ...

class LinkScale(Message):
    link_name: str
    scale: float
    def __init__(self, *, link_name: str = ..., scale: float = ...) -> None: ...

class MotionPlanDetailedResponse(Message):
    trajectory_start: RobotState
    group_name: str
    trajectory: list[RobotTrajectory]
    description: list[str]
    processing_time: NumberSequence[float]
    error_code: MoveItErrorCodes
    def __init__(self, *, trajectory_start: RobotState = ..., group_name: str = ..., trajectory: list[RobotTrajectory] = ..., description: list[str] = ..., processing_time: Iterable[float] = ..., error_code: MoveItErrorCodes = ...) -> None: ...

class MotionPlanRequest(Message):
    workspace_parameters: WorkspaceParameters
    start_state: RobotState
    goal_constraints: list[Constraints]
    path_constraints: Constraints
    trajectory_constraints: TrajectoryConstraints
    reference_trajectories: list[GenericTrajectory]
    pipeline_id: str
    planner_id: str
    group_name: str
    num_planning_attempts: int
    allowed_planning_time: float
    max_velocity_scaling_factor: float
    max_acceleration_scaling_factor: float
    cartesian_speed_limited_link: str
    max_cartesian_speed: float
    def __init__(self, *, workspace_parameters: WorkspaceParameters = ..., start_state: RobotState = ..., goal_constraints: list[Constraints] = ..., path_constraints: Constraints = ..., trajectory_constraints: TrajectoryConstraints = ..., reference_trajectories: list[GenericTrajectory] = ..., pipeline_id: str = ..., planner_id: str = ..., group_name: str = ..., num_planning_attempts: int = ..., allowed_planning_time: float = ..., max_velocity_scaling_factor: float = ..., max_acceleration_scaling_factor: float = ..., cartesian_speed_limited_link: str = ..., max_cartesian_speed: float = ...) -> None: ...

class MotionPlanResponse(Message):
    trajectory_start: RobotState
    group_name: str
    trajectory: RobotTrajectory
    planning_time: float
    error_code: MoveItErrorCodes
    def __init__(self, *, trajectory_start: RobotState = ..., group_name: str = ..., trajectory: RobotTrajectory = ..., planning_time: float = ..., error_code: MoveItErrorCodes = ...) -> None: ...

class MotionSequenceItem(Message):
    req: MotionPlanRequest
    blend_radius: float
    def __init__(self, *, req: MotionPlanRequest = ..., blend_radius: float = ...) -> None: ...

class MotionSequenceRequest(Message):
    items: list[MotionSequenceItem]
    def __init__(self, *, items: list[MotionSequenceItem] = ...) -> None: ...

class MotionSequenceResponse(Message):
    error_code: MoveItErrorCodes
    sequence_start: RobotState
    planned_trajectories: list[RobotTrajectory]
    planning_time: float
    def __init__(self, *, error_code: MoveItErrorCodes = ..., sequence_start: RobotState = ..., planned_trajectories: list[RobotTrajectory] = ..., planning_time: float = ...) -> None: ...

class MoveItErrorCodes(Message):
    SUCCESS: Final = 1
    UNDEFINED: Final = 0
    FAILURE: Final = 99999
    PLANNING_FAILED: Final = -1
    INVALID_MOTION_PLAN: Final = -2
    MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE: Final = -3
    CONTROL_FAILED: Final = -4
    UNABLE_TO_AQUIRE_SENSOR_DATA: Final = -5
    TIMED_OUT: Final = -6
    PREEMPTED: Final = -7
    START_STATE_IN_COLLISION: Final = -10
    START_STATE_VIOLATES_PATH_CONSTRAINTS: Final = -11
    START_STATE_INVALID: Final = -26
    GOAL_IN_COLLISION: Final = -12
    GOAL_VIOLATES_PATH_CONSTRAINTS: Final = -13
    GOAL_CONSTRAINTS_VIOLATED: Final = -14
    GOAL_STATE_INVALID: Final = -27
    UNRECOGNIZED_GOAL_TYPE: Final = -28
    INVALID_GROUP_NAME: Final = -15
    INVALID_GOAL_CONSTRAINTS: Final = -16
    INVALID_ROBOT_STATE: Final = -17
    INVALID_LINK_NAME: Final = -18
    INVALID_OBJECT_NAME: Final = -19
    FRAME_TRANSFORM_FAILURE: Final = -21
    COLLISION_CHECKING_UNAVAILABLE: Final = -22
    ROBOT_STATE_STALE: Final = -23
    SENSOR_INFO_STALE: Final = -24
    COMMUNICATION_FAILURE: Final = -25
    CRASH: Final = -29
    ABORT: Final = -30
    NO_IK_SOLUTION: Final = -31
    val: int
    message: str
    source: str
    def __init__(self, *, val: int = ..., message: str = ..., source: str = ...) -> None: ...

class ObjectColor(Message):
    id: str
    color: std_msgs.msg.ColorRGBA
    def __init__(self, *, id: str = ..., color: std_msgs.msg.ColorRGBA = ...) -> None: ...

class OrientationConstraint(Message):
    XYZ_EULER_ANGLES: Final = 0
    ROTATION_VECTOR: Final = 1
    header: std_msgs.msg.Header
    orientation: geometry_msgs.msg.Quaternion
    link_name: str
    absolute_x_axis_tolerance: float
    absolute_y_axis_tolerance: float
    absolute_z_axis_tolerance: float
    parameterization: int
    weight: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., orientation: geometry_msgs.msg.Quaternion = ..., link_name: str = ..., absolute_x_axis_tolerance: float = ..., absolute_y_axis_tolerance: float = ..., absolute_z_axis_tolerance: float = ..., parameterization: int = ..., weight: float = ...) -> None: ...

class OrientedBoundingBox(Message):
    pose: geometry_msgs.msg.Pose
    extents: geometry_msgs.msg.Point32
    def __init__(self, *, pose: geometry_msgs.msg.Pose = ..., extents: geometry_msgs.msg.Point32 = ...) -> None: ...

class PipelineState(Message):
    request: MotionPlanRequest
    response: MotionPlanResponse
    pipeline_stage: str
    def __init__(self, *, request: MotionPlanRequest = ..., response: MotionPlanResponse = ..., pipeline_stage: str = ...) -> None: ...

class PlaceLocation(Message):
    id: str
    post_place_posture: trajectory_msgs.msg.JointTrajectory
    place_pose: geometry_msgs.msg.PoseStamped
    quality: float
    pre_place_approach: GripperTranslation
    post_place_retreat: GripperTranslation
    allowed_touch_objects: list[str]
    def __init__(self, *, id: str = ..., post_place_posture: trajectory_msgs.msg.JointTrajectory = ..., place_pose: geometry_msgs.msg.PoseStamped = ..., quality: float = ..., pre_place_approach: GripperTranslation = ..., post_place_retreat: GripperTranslation = ..., allowed_touch_objects: list[str] = ...) -> None: ...

class PlannerInterfaceDescription(Message):
    name: str
    pipeline_id: str
    planner_ids: list[str]
    def __init__(self, *, name: str = ..., pipeline_id: str = ..., planner_ids: list[str] = ...) -> None: ...

class PlannerParams(Message):
    keys: list[str]
    values: list[str]
    descriptions: list[str]
    def __init__(self, *, keys: list[str] = ..., values: list[str] = ..., descriptions: list[str] = ...) -> None: ...

class PlanningOptions(Message):
    planning_scene_diff: PlanningScene
    plan_only: bool
    look_around: bool
    look_around_attempts: int
    max_safe_execution_cost: float
    replan: bool
    replan_attempts: int
    replan_delay: float
    def __init__(self, *, planning_scene_diff: PlanningScene = ..., plan_only: bool = ..., look_around: bool = ..., look_around_attempts: int = ..., max_safe_execution_cost: float = ..., replan: bool = ..., replan_attempts: int = ..., replan_delay: float = ...) -> None: ...

class PlanningScene(Message):
    name: str
    robot_state: RobotState
    robot_model_name: str
    fixed_frame_transforms: list[geometry_msgs.msg.TransformStamped]
    allowed_collision_matrix: AllowedCollisionMatrix
    link_padding: list[LinkPadding]
    link_scale: list[LinkScale]
    object_colors: list[ObjectColor]
    world: PlanningSceneWorld
    is_diff: bool
    def __init__(self, *, name: str = ..., robot_state: RobotState = ..., robot_model_name: str = ..., fixed_frame_transforms: list[geometry_msgs.msg.TransformStamped] = ..., allowed_collision_matrix: AllowedCollisionMatrix = ..., link_padding: list[LinkPadding] = ..., link_scale: list[LinkScale] = ..., object_colors: list[ObjectColor] = ..., world: PlanningSceneWorld = ..., is_diff: bool = ...) -> None: ...

class PlanningSceneComponents(Message):
    SCENE_SETTINGS: Final = 1
    ROBOT_STATE: Final = 2
    ROBOT_STATE_ATTACHED_OBJECTS: Final = 4
    WORLD_OBJECT_NAMES: Final = 8
    WORLD_OBJECT_GEOMETRY: Final = 16
    OCTOMAP: Final = 32
    TRANSFORMS: Final = 64
    ALLOWED_COLLISION_MATRIX: Final = 128
    LINK_PADDING_AND_SCALING: Final = 256
    OBJECT_COLORS: Final = 512
    components: int
    def __init__(self, *, components: int = ...) -> None: ...

class PlanningSceneWorld(Message):
    collision_objects: list[CollisionObject]
    octomap: octomap_msgs.msg.OctomapWithPose
    def __init__(self, *, collision_objects: list[CollisionObject] = ..., octomap: octomap_msgs.msg.OctomapWithPose = ...) -> None: ...

class PositionConstraint(Message):
    header: std_msgs.msg.Header
    link_name: str
    target_point_offset: geometry_msgs.msg.Vector3
    constraint_region: BoundingVolume
    weight: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., link_name: str = ..., target_point_offset: geometry_msgs.msg.Vector3 = ..., constraint_region: BoundingVolume = ..., weight: float = ...) -> None: ...

class PositionIKRequest(Message):
    group_name: str
    robot_state: RobotState
    constraints: Constraints
    avoid_collisions: bool
    ik_link_name: str
    pose_stamped: geometry_msgs.msg.PoseStamped
    ik_link_names: list[str]
    pose_stamped_vector: list[geometry_msgs.msg.PoseStamped]
    timeout: builtin_interfaces.msg.Duration
    def __init__(self, *, group_name: str = ..., robot_state: RobotState = ..., constraints: Constraints = ..., avoid_collisions: bool = ..., ik_link_name: str = ..., pose_stamped: geometry_msgs.msg.PoseStamped = ..., ik_link_names: list[str] = ..., pose_stamped_vector: list[geometry_msgs.msg.PoseStamped] = ..., timeout: builtin_interfaces.msg.Duration = ...) -> None: ...

class RobotState(Message):
    joint_state: sensor_msgs.msg.JointState
    multi_dof_joint_state: sensor_msgs.msg.MultiDOFJointState
    attached_collision_objects: list[AttachedCollisionObject]
    is_diff: bool
    def __init__(self, *, joint_state: sensor_msgs.msg.JointState = ..., multi_dof_joint_state: sensor_msgs.msg.MultiDOFJointState = ..., attached_collision_objects: list[AttachedCollisionObject] = ..., is_diff: bool = ...) -> None: ...

class RobotTrajectory(Message):
    joint_trajectory: trajectory_msgs.msg.JointTrajectory
    multi_dof_joint_trajectory: trajectory_msgs.msg.MultiDOFJointTrajectory
    def __init__(self, *, joint_trajectory: trajectory_msgs.msg.JointTrajectory = ..., multi_dof_joint_trajectory: trajectory_msgs.msg.MultiDOFJointTrajectory = ...) -> None: ...

class ServoStatus(Message):
    INVALID: Final = -1
    NO_WARNING: Final = 0
    DECELERATE_FOR_APPROACHING_SINGULARITY: Final = 1
    HALT_FOR_SINGULARITY: Final = 2
    DECELERATE_FOR_COLLISION: Final = 3
    HALT_FOR_COLLISION: Final = 4
    JOINT_BOUND: Final = 5
    DECELERATE_FOR_LEAVING_SINGULARITY: Final = 6
    code: int
    message: str
    def __init__(self, *, code: int = ..., message: str = ...) -> None: ...

class TrajectoryConstraints(Message):
    constraints: list[Constraints]
    def __init__(self, *, constraints: list[Constraints] = ...) -> None: ...

class VisibilityConstraint(Message):
    SENSOR_Z: Final = 0
    SENSOR_Y: Final = 1
    SENSOR_X: Final = 2
    target_radius: float
    target_pose: geometry_msgs.msg.PoseStamped
    cone_sides: int
    sensor_pose: geometry_msgs.msg.PoseStamped
    max_view_angle: float
    max_range_angle: float
    sensor_view_direction: int
    weight: float
    def __init__(self, *, target_radius: float = ..., target_pose: geometry_msgs.msg.PoseStamped = ..., cone_sides: int = ..., sensor_pose: geometry_msgs.msg.PoseStamped = ..., max_view_angle: float = ..., max_range_angle: float = ..., sensor_view_direction: int = ..., weight: float = ...) -> None: ...

class WorkspaceParameters(Message):
    header: std_msgs.msg.Header
    min_corner: geometry_msgs.msg.Vector3
    max_corner: geometry_msgs.msg.Vector3
    def __init__(self, *, header: std_msgs.msg.Header = ..., min_corner: geometry_msgs.msg.Vector3 = ..., max_corner: geometry_msgs.msg.Vector3 = ...) -> None: ...

