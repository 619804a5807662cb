# Written by scripts/generate_messages.py from interfaces/control_msgs/msg; do not edit.
import builtin_interfaces.msg
import geometry_msgs.msg
import numpy as np
import sensor_msgs.msg
import std_msgs.msg
import trajectory_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["AdmittanceControllerState", "DynamicInterfaceGroupValues", "DynamicJointState", "GripperCommand", "InterfaceValue", "JointComponentTolerance", "JointControllerState", "JointJog", "JointTolerance", "JointTrajectoryControllerState", "MecanumDriveControllerState", "MultiDOFCommand", "MultiDOFStateStamped", "PidState", "SingleDOFState", "SingleDOFStateStamped", "SteeringControllerStatus"]

class AdmittanceControllerState(Message):
    mass: std_msgs.msg.Float64MultiArray
    damping: std_msgs.msg.Float64MultiArray
    stiffness: std_msgs.msg.Float64MultiArray
    rot_base_control: geometry_msgs.msg.Quaternion
    ref_trans_base_ft: geometry_msgs.msg.TransformStamped
    selected_axes: std_msgs.msg.Int8MultiArray
    ft_sensor_frame: std_msgs.msg.String
    admittance_position: geometry_msgs.msg.TransformStamped
    admittance_acceleration: geometry_msgs.msg.TwistStamped
    admittance_velocity: geometry_msgs.msg.TwistStamped
    wrench_base: geometry_msgs.msg.WrenchStamped
    joint_state: sensor_msgs.msg.JointState
    def __init__(self, *, mass: std_msgs.msg.Float64MultiArray = ..., damping: std_msgs.msg.Float64MultiArray = ..., stiffness: std_msgs.msg.Float64MultiArray = ..., rot_base_control: geometry_msgs.msg.Quaternion = ..., ref_trans_base_ft: geometry_msgs.msg.TransformStamped = ..., selected_axes: std_msgs.msg.Int8MultiArray = ..., ft_sensor_frame: std_msgs.msg.String = ..., admittance_position: geometry_msgs.msg.TransformStamped = ..., admittance_acceleration: geometry_msgs.msg.TwistStamped = ..., admittance_velocity: geometry_msgs.msg.TwistStamped = ..., wrench_base: geometry_msgs.msg.WrenchStamped = ..., joint_state: sensor_msgs.msg.JointState = ...) -> None: ...

class DynamicInterfaceGroupValues(Message):
    header: std_msgs.msg.Header
    interface_groups: list[str]
    interface_values: list[InterfaceValue]
    def __init__(self, *, header: std_msgs.msg.Header = ..., interface_groups: list[str] = ..., interface_values: list[InterfaceValue] = ...) -> None: ...

class DynamicJointState(Message):
    header: std_msgs.msg.Header
    joint_names: list[str]
    interface_values: list[InterfaceValue]
    def __init__(self, *, header: std_msgs.msg.Header = ..., joint_names: list[str] = ..., interface_values: list[InterfaceValue] = ...) -> None: ...

class GripperCommand(Message):
    position: float
    max_effort: float
    def __init__(self, *, position: float = ..., max_effort: float = ...) -> None: ...

class InterfaceValue(Message):
    interface_names: list[str]
    values: NumberSequence[float]
    def __init__(self, *, interface_names: list[str] = ..., values: Iterable[float] = ...) -> None: ...

class JointComponentTolerance(Message):
    X_AXIS: Final = 1
    Y_AXIS: Final = 2
    Z_AXIS: Final = 3
    TRANSLATION: Final = 4
    ROTATION: Final = 5
    joint_name: str
    component: int
    position: float
    velocity: float
    acceleration: float
    def __init__(self, *, joint_name: str = ..., component: int = ..., position: float = ..., velocity: float = ..., acceleration: float = ...) -> None: ...

class JointControllerState(Message):
    header: std_msgs.msg.Header
    set_point: float
    process_value: float
    process_value_dot: float
    error: float
    time_step: float
    command: float
    p: float
    i: float
    d: float
    i_clamp: float
    antiwindup: bool
    def __init__(self, *, header: std_msgs.msg.Header = ..., set_point: float = ..., process_value: float = ..., process_value_dot: float = ..., error: float = ..., time_step: float = ..., command: float = ..., p: float = ..., i: float = ..., d: float = ..., i_clamp: float = ..., antiwindup: bool = ...) -> None: ...

class JointJog(Message):
    header: std_msgs.msg.Header
    joint_names: list[str]
    displacements: NumberSequence[float]
    velocities: NumberSequence[float]
    duration: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., joint_names: list[str] = ..., displacements: Iterable[float] = ..., velocities: Iterable[float] = ..., duration: float = ...) -> None: ...

class JointTolerance(Message):
    name: str
    position: float
    velocity: float
    acceleration: float
    def __init__(self, *, name: str = ..., position: float = ..., velocity: float = ..., acceleration: float = ...) -> None: ...

class JointTrajectoryControllerState(Message):
    header: std_msgs.msg.Header
    joint_names: list[str]
    reference: trajectory_msgs.msg.JointTrajectoryPoint
    feedback: trajectory_msgs.msg.JointTrajectoryPoint
    error: trajectory_msgs.msg.JointTrajectoryPoint
    output: trajectory_msgs.msg.JointTrajectoryPoint
    desired: trajectory_msgs.msg.JointTrajectoryPoint
    actual: trajectory_msgs.msg.JointTrajectoryPoint
    multi_dof_joint_names: list[str]
    multi_dof_reference: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
    multi_dof_feedback: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
    multi_dof_error: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
    multi_dof_output: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
    multi_dof_desired: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
    multi_dof_actual: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
    def __init__(self, *, header: std_msgs.msg.Header = ..., joint_names: list[str] = ..., reference: trajectory_msgs.msg.JointTrajectoryPoint = ..., feedback: trajectory_msgs.msg.JointTrajectoryPoint = ..., error: trajectory_msgs.msg.JointTrajectoryPoint = ..., output: trajectory_msgs.msg.JointTrajectoryPoint = ..., desired: trajectory_msgs.msg.JointTrajectoryPoint = ..., actual: trajectory_msgs.msg.JointTrajectoryPoint = ..., multi_dof_joint_names: list[str] = ..., multi_dof_reference: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ..., multi_dof_feedback: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ..., multi_dof_error: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ..., multi_dof_output: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ..., multi_dof_desired: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ..., multi_dof_actual: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ...) -> None: ...

class MecanumDriveControllerState(Message):
    header: std_msgs.msg.Header
    front_left_wheel_velocity: float
    back_left_wheel_velocity: float
    back_right_wheel_velocity: float
    front_right_wheel_velocity: float
    reference_velocity: geometry_msgs.msg.Twist
    def __init__(self, *, header: std_msgs.msg.Header = ..., front_left_wheel_velocity: float = ..., back_left_wheel_velocity: float = ..., back_right_wheel_velocity: float = ..., front_right_wheel_velocity: float = ..., reference_velocity: geometry_msgs.msg.Twist = ...) -> None: ...

class MultiDOFCommand(Message):
    dof_names: list[str]
    values: NumberSequence[float]
    values_dot: NumberSequence[float]
    def __init__(self, *, dof_names: list[str] = ..., values: Iterable[float] = ..., values_dot: Iterable[float] = ...) -> None: ...

class MultiDOFStateStamped(Message):
    header: std_msgs.msg.Header
    dof_states: list[SingleDOFState]
    def __init__(self, *, header: std_msgs.msg.Header = ..., dof_states: list[SingleDOFState] = ...) -> None: ...

class PidState(Message):
    header: std_msgs.msg.Header
    timestep: builtin_interfaces.msg.Duration
    error: float
    error_dot: float
    p_error: float
    i_error: float
    d_error: float
    p_term: float
    i_term: float
    d_term: float
    i_max: float
    i_min: float
    output: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., timestep: builtin_interfaces.msg.Duration = ..., error: float = ..., error_dot: float = ..., p_error: float = ..., i_error: float = ..., d_error: float = ..., p_term: float = ..., i_term: float = ..., d_term: float = ..., i_max: float = ..., i_min: float = ..., output: float = ...) -> None: ...

class SingleDOFState(Message):
    name: str
    reference: float
    feedback: float
    feedback_dot: float
    error: float
    error_dot: float
    time_step: float
    output: float
    def __init__(self, *, name: str = ..., reference: float = ..., feedback: float = ..., feedback_dot: float = ..., error: float = ..., error_dot: float = ..., time_step: float = ..., output: float = ...) -> None: ...

class SingleDOFStateStamped(Message):
    header: std_msgs.msg.Header
    dof_state: SingleDOFState
    def __init__(self, *, header: std_msgs.msg.Header = ..., dof_state: SingleDOFState = ...) -> None: ...

class SteeringControllerStatus(Message):
    header: std_msgs.msg.Header
    traction_wheels_position: NumberSequence[float]
    traction_wheels_velocity: NumberSequence[float]
    steer_positions: NumberSequence[float]
    linear_velocity_command: NumberSequence[float]
    steering_angle_command: NumberSequence[float]
    def __init__(self, *, header: std_msgs.msg.Header = ..., traction_wheels_position: Iterable[float] = ..., traction_wheels_velocity: Iterable[float] = ..., steer_positions: Iterable[float] = ..., linear_velocity_command: Iterable[float] = ..., steering_angle_command: Iterable[float] = ...) -> None: ...

