# Written by scripts/generate_messages.py from interfaces/gazebo_msgs/srv; do not edit.
import builtin_interfaces.msg
import gazebo_msgs.msg
import geometry_msgs.msg
import numpy as np
import std_msgs.msg
import trajectory_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["ApplyBodyWrench", "ApplyJointEffort", "ApplyLinkWrench", "BodyRequest", "DeleteEntity", "DeleteLight", "DeleteModel", "GetEntityState", "GetJointProperties", "GetLightProperties", "GetLinkProperties", "GetLinkState", "GetModelList", "GetModelProperties", "GetModelState", "GetPhysicsProperties", "GetWorldProperties", "JointRequest", "LinkRequest", "SetEntityState", "SetJointProperties", "SetJointTrajectory", "SetLightProperties", "SetLinkProperties", "SetLinkState", "SetModelConfiguration", "SetModelState", "SetPhysicsProperties", "SpawnEntity", "SpawnModel"]

class ApplyBodyWrench_Request(Message):
    body_name: str
    reference_frame: str
    reference_point: geometry_msgs.msg.Point
    wrench: geometry_msgs.msg.Wrench
    start_time: builtin_interfaces.msg.Time
    duration: builtin_interfaces.msg.Duration
    def __init__(self, *, body_name: str = ..., reference_frame: str = ..., reference_point: geometry_msgs.msg.Point = ..., wrench: geometry_msgs.msg.Wrench = ..., start_time: builtin_interfaces.msg.Time = ..., duration: builtin_interfaces.msg.Duration = ...) -> None: ...

class ApplyBodyWrench_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class ApplyBodyWrench(Service):
    Request: TypeAlias = ApplyBodyWrench_Request
    Response: TypeAlias = ApplyBodyWrench_Response

class ApplyJointEffort_Request(Message):
    joint_name: str
    effort: float
    start_time: builtin_interfaces.msg.Time
    duration: builtin_interfaces.msg.Duration
    def __init__(self, *, joint_name: str = ..., effort: float = ..., start_time: builtin_interfaces.msg.Time = ..., duration: builtin_interfaces.msg.Duration = ...) -> None: ...

class ApplyJointEffort_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class ApplyJointEffort(Service):
    Request: TypeAlias = ApplyJointEffort_Request
    Response: TypeAlias = ApplyJointEffort_Response

class ApplyLinkWrench_Request(Message):
    link_name: str
    reference_frame: str
    reference_point: geometry_msgs.msg.Point
    wrench: geometry_msgs.msg.Wrench
    start_time: builtin_interfaces.msg.Time
    duration: builtin_interfaces.msg.Duration
    def __init__(self, *, link_name: str = ..., reference_frame: str = ..., reference_point: geometry_msgs.msg.Point = ..., wrench: geometry_msgs.msg.Wrench = ..., start_time: builtin_interfaces.msg.Time = ..., duration: builtin_interfaces.msg.Duration = ...) -> None: ...

class ApplyLinkWrench_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class ApplyLinkWrench(Service):
    Request: TypeAlias = ApplyLinkWrench_Request
    Response: TypeAlias = ApplyLinkWrench_Response

class BodyRequest_Request(Message):
    body_name: str
    def __init__(self, *, body_name: str = ...) -> None: ...

class BodyRequest_Response(Message):
    def __init__(self) -> None: ...

class BodyRequest(Service):
    Request: TypeAlias = BodyRequest_Request
    Response: TypeAlias = BodyRequest_Response

class DeleteEntity_Request(Message):
    name: str
    def __init__(self, *, name: str = ...) -> None: ...

class DeleteEntity_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class DeleteEntity(Service):
    Request: TypeAlias = DeleteEntity_Request
    Response: TypeAlias = DeleteEntity_Response

class DeleteLight_Request(Message):
    light_name: str
    def __init__(self, *, light_name: str = ...) -> None: ...

class DeleteLight_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class DeleteLight(Service):
    Request: TypeAlias = DeleteLight_Request
    Response: TypeAlias = DeleteLight_Response

class DeleteModel_Request(Message):
    model_name: str
    def __init__(self, *, model_name: str = ...) -> None: ...

class DeleteModel_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class DeleteModel(Service):
    Request: TypeAlias = DeleteModel_Request
    Response: TypeAlias = DeleteModel_Response

class GetEntityState_Request(Message):
    name: str
    reference_frame: str
    def __init__(self, *, name: str = ..., reference_frame: str = ...) -> None: ...

class GetEntityState_Response(Message):
    header: std_msgs.msg.Header
    state: gazebo_msgs.msg.EntityState
    success: bool
    def __init__(self, *, header: std_msgs.msg.Header = ..., state: gazebo_msgs.msg.EntityState = ..., success: bool = ...) -> None: ...

class GetEntityState(Service):
    Request: TypeAlias = GetEntityState_Request
    Response: TypeAlias = GetEntityState_Response

class GetJointProperties_Request(Message):
    joint_name: str
    def __init__(self, *, joint_name: str = ...) -> None: ...

class GetJointProperties_Response(Message):
    REVOLUTE: Final = 0
    CONTINUOUS: Final = 1
    PRISMATIC: Final = 2
    FIXED: Final = 3
    BALL: Final = 4
    UNIVERSAL: Final = 5
    type: int
    damping: NumberSequence[float]
    position: NumberSequence[float]
    rate: NumberSequence[float]
    success: bool
    status_message: str
    def __init__(self, *, type: int = ..., damping: Iterable[float] = ..., position: Iterable[float] = ..., rate: Iterable[float] = ..., success: bool = ..., status_message: str = ...) -> None: ...

class GetJointProperties(Service):
    Request: TypeAlias = GetJointProperties_Request
    Response: TypeAlias = GetJointProperties_Response

class GetLightProperties_Request(Message):
    light_name: str
    def __init__(self, *, light_name: str = ...) -> None: ...

class GetLightProperties_Response(Message):
    diffuse: std_msgs.msg.ColorRGBA
    attenuation_constant: float
    attenuation_linear: float
    attenuation_quadratic: float
    success: bool
    status_message: str
    def __init__(self, *, diffuse: std_msgs.msg.ColorRGBA = ..., attenuation_constant: float = ..., attenuation_linear: float = ..., attenuation_quadratic: float = ..., success: bool = ..., status_message: str = ...) -> None: ...

class GetLightProperties(Service):
    Request: TypeAlias = GetLightProperties_Request
    Response: TypeAlias = GetLightProperties_Response

class GetLinkProperties_Request(Message):
    link_name: str
    def __init__(self, *, link_name: str = ...) -> None: ...

class GetLinkProperties_Response(Message):
    com: geometry_msgs.msg.Pose
    gravity_mode: bool
    mass: float
    ixx: float
    ixy: float
    ixz: float
    iyy: float
    iyz: float
    izz: float
    success: bool
    status_message: str
    def __init__(self, *, com: geometry_msgs.msg.Pose = ..., gravity_mode: bool = ..., mass: float = ..., ixx: float = ..., ixy: float = ..., ixz: float = ..., iyy: float = ..., iyz: float = ..., izz: float = ..., success: bool = ..., status_message: str = ...) -> None: ...

class GetLinkProperties(Service):
    Request: TypeAlias = GetLinkProperties_Request
    Response: TypeAlias = GetLinkProperties_Response

class GetLinkState_Request(Message):
    link_name: str
    reference_frame: str
    def __init__(self, *, link_name: str = ..., reference_frame: str = ...) -> None: ...

class GetLinkState_Response(Message):
    link_state: gazebo_msgs.msg.LinkState
    success: bool
    status_message: str
    def __init__(self, *, link_state: gazebo_msgs.msg.LinkState = ..., success: bool = ..., status_message: str = ...) -> None: ...

class GetLinkState(Service):
    Request: TypeAlias = GetLinkState_Request
    Response: TypeAlias = GetLinkState_Response

class GetModelList_Request(Message):
    def __init__(self) -> None: ...

class GetModelList_Response(Message):
    header: std_msgs.msg.Header
    model_names: list[str]
    success: bool
    def __init__(self, *, header: std_msgs.msg.Header = ..., model_names: list[str] = ..., success: bool = ...) -> None: ...

class GetModelList(Service):
    Request: TypeAlias = GetModelList_Request
    Response: TypeAlias = GetModelList_Response

class GetModelProperties_Request(Message):
    model_name: str
    def __init__(self, *, model_name: str = ...) -> None: ...

class GetModelProperties_Response(Message):
    parent_model_name: str
    canonical_body_name: str
    body_names: list[str]
    geom_names: list[str]
    joint_names: list[str]
    child_model_names: list[str]
    is_static: bool
    success: bool
    status_message: str
    def __init__(self, *, parent_model_name: str = ..., canonical_body_name: str = ..., body_names: list[str] = ..., geom_names: list[str] = ..., joint_names: list[str] = ..., child_model_names: list[str] = ..., is_static: bool = ..., success: bool = ..., status_message: str = ...) -> None: ...

class GetModelProperties(Service):
    Request: TypeAlias = GetModelProperties_Request
    Response: TypeAlias = GetModelProperties_Response

class GetModelState_Request(Message):
    model_name: str
    relative_entity_name: str
    def __init__(self, *, model_name: str = ..., relative_entity_name: str = ...) -> None: ...

class GetModelState_Response(Message):
    header: std_msgs.msg.Header
    pose: geometry_msgs.msg.Pose
    twist: geometry_msgs.msg.Twist
    success: bool
    status_message: str
    def __init__(self, *, header: std_msgs.msg.Header = ..., pose: geometry_msgs.msg.Pose = ..., twist: geometry_msgs.msg.Twist = ..., success: bool = ..., status_message: str = ...) -> None: ...

class GetModelState(Service):
    Request: TypeAlias = GetModelState_Request
    Response: TypeAlias = GetModelState_Response

class GetPhysicsProperties_Request(Message):
    def __init__(self) -> None: ...

class GetPhysicsProperties_Response(Message):
    time_step: float
    pause: bool
    max_update_rate: float
    gravity: geometry_msgs.msg.Vector3
    ode_config: gazebo_msgs.msg.ODEPhysics
    success: bool
    status_message: str
    def __init__(self, *, time_step: float = ..., pause: bool = ..., max_update_rate: float = ..., gravity: geometry_msgs.msg.Vector3 = ..., ode_config: gazebo_msgs.msg.ODEPhysics = ..., success: bool = ..., status_message: str = ...) -> None: ...

class GetPhysicsProperties(Service):
    Request: TypeAlias = GetPhysicsProperties_Request
    Response: TypeAlias = GetPhysicsProperties_Response

class GetWorldProperties_Request(Message):
    def __init__(self) -> None: ...

class GetWorldProperties_Response(Message):
    sim_time: float
    model_names: list[str]
    rendering_enabled: bool
    success: bool
    status_message: str
    def __init__(self, *, sim_time: float = ..., model_names: list[str] = ..., rendering_enabled: bool = ..., success: bool = ..., status_message: str = ...) -> None: ...

class GetWorldProperties(Service):
    Request: TypeAlias = GetWorldProperties_Request
    Response: TypeAlias = GetWorldProperties_Response

class JointRequest_Request(Message):
    joint_name: str
    def __init__(self, *, joint_name: str = ...) -> None: ...

class JointRequest_Response(Message):
    def __init__(self) -> None: ...

class JointRequest(Service):
    Request: TypeAlias = JointRequest_Request
    Response: TypeAlias = JointRequest_Response

class LinkRequest_Request(Message):
    link_name: str
    def __init__(self, *, link_name: str = ...) -> None: ...

class LinkRequest_Response(Message):
    def __init__(self) -> None: ...

class LinkRequest(Service):
    Request: TypeAlias = LinkRequest_Request
    Response: TypeAlias = LinkRequest_Response

class SetEntityState_Request(Message):
    state: gazebo_msgs.msg.EntityState
    def __init__(self, *, state: gazebo_msgs.msg.EntityState = ...) -> None: ...

class SetEntityState_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class SetEntityState(Service):
    Request: TypeAlias = SetEntityState_Request
    Response: TypeAlias = SetEntityState_Response

class SetJointProperties_Request(Message):
    joint_name: str
    ode_joint_config: gazebo_msgs.msg.ODEJointProperties
    def __init__(self, *, joint_name: str = ..., ode_joint_config: gazebo_msgs.msg.ODEJointProperties = ...) -> None: ...

class SetJointProperties_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SetJointProperties(Service):
    Request: TypeAlias = SetJointProperties_Request
    Response: TypeAlias = SetJointProperties_Response

class SetJointTrajectory_Request(Message):
    model_name: str
    joint_trajectory: trajectory_msgs.msg.JointTrajectory
    model_pose: geometry_msgs.msg.Pose
    set_model_pose: bool
    disable_physics_updates: bool
    def __init__(self, *, model_name: str = ..., joint_trajectory: trajectory_msgs.msg.JointTrajectory = ..., model_pose: geometry_msgs.msg.Pose = ..., set_model_pose: bool = ..., disable_physics_updates: bool = ...) -> None: ...

class SetJointTrajectory_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SetJointTrajectory(Service):
    Request: TypeAlias = SetJointTrajectory_Request
    Response: TypeAlias = SetJointTrajectory_Response

class SetLightProperties_Request(Message):
    light_name: str
    diffuse: std_msgs.msg.ColorRGBA
    attenuation_constant: float
    attenuation_linear: float
    attenuation_quadratic: float
    def __init__(self, *, light_name: str = ..., diffuse: std_msgs.msg.ColorRGBA = ..., attenuation_constant: float = ..., attenuation_linear: float = ..., attenuation_quadratic: float = ...) -> None: ...

class SetLightProperties_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SetLightProperties(Service):
    Request: TypeAlias = SetLightProperties_Request
    Response: TypeAlias = SetLightProperties_Response

class SetLinkProperties_Request(Message):
    link_name: str
    com: geometry_msgs.msg.Pose
    gravity_mode: bool
    mass: float
    ixx: float
    ixy: float
    ixz: float
    iyy: float
    iyz: float
    izz: float
    def __init__(self, *, link_name: str = ..., com: geometry_msgs.msg.Pose = ..., gravity_mode: bool = ..., mass: float = ..., ixx: float = ..., ixy: float = ..., ixz: float = ..., iyy: float = ..., iyz: float = ..., izz: float = ...) -> None: ...

class SetLinkProperties_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SetLinkProperties(Service):
    Request: TypeAlias = SetLinkProperties_Request
    Response: TypeAlias = SetLinkProperties_Response

class SetLinkState_Request(Message):
    link_state: gazebo_msgs.msg.LinkState
    def __init__(self, *, link_state: gazebo_msgs.msg.LinkState = ...) -> None: ...

class SetLinkState_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SetLinkState(Service):
    Request: TypeAlias = SetLinkState_Request
    Response: TypeAlias = SetLinkState_Response

class SetModelConfiguration_Request(Message):
    model_name: str
    urdf_param_name: str
    joint_names: list[str]
    joint_positions: NumberSequence[float]
    def __init__(self, *, model_name: str = ..., urdf_param_name: str = ..., joint_names: list[str] = ..., joint_positions: Iterable[float] = ...) -> None: ...

class SetModelConfiguration_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SetModelConfiguration(Service):
    Request: TypeAlias = SetModelConfiguration_Request
    Response: TypeAlias = SetModelConfiguration_Response

class SetModelState_Request(Message):
    model_state: gazebo_msgs.msg.ModelState
    def __init__(self, *, model_state: gazebo_msgs.msg.ModelState = ...) -> None: ...

class SetModelState_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SetModelState(Service):
    Request: TypeAlias = SetModelState_Request
    Response: TypeAlias = SetModelState_Response

class SetPhysicsProperties_Request(Message):
    time_step: float
    max_update_rate: float
    gravity: geometry_msgs.msg.Vector3
    ode_config: gazebo_msgs.msg.ODEPhysics
    def __init__(self, *, time_step: float = ..., max_update_rate: float = ..., gravity: geometry_msgs.msg.Vector3 = ..., ode_config: gazebo_msgs.msg.ODEPhysics = ...) -> None: ...

class SetPhysicsProperties_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SetPhysicsProperties(Service):
    Request: TypeAlias = SetPhysicsProperties_Request
    Response: TypeAlias = SetPhysicsProperties_Response

class SpawnEntity_Request(Message):
    name: str
    xml: str
    robot_namespace: str
    initial_pose: geometry_msgs.msg.Pose
    reference_frame: str
    def __init__(self, *, name: str = ..., xml: str = ..., robot_namespace: str = ..., initial_pose: geometry_msgs.msg.Pose = ..., reference_frame: str = ...) -> None: ...

class SpawnEntity_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SpawnEntity(Service):
    Request: TypeAlias = SpawnEntity_Request
    Response: TypeAlias = SpawnEntity_Response

class SpawnModel_Request(Message):
    model_name: str
    model_xml: str
    robot_namespace: str
    initial_pose: geometry_msgs.msg.Pose
    reference_frame: str
    def __init__(self, *, model_name: str = ..., model_xml: str = ..., robot_namespace: str = ..., initial_pose: geometry_msgs.msg.Pose = ..., reference_frame: str = ...) -> None: ...

class SpawnModel_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SpawnModel(Service):
    Request: TypeAlias = SpawnModel_Request
    Response: TypeAlias = SpawnModel_Response

