# Written by scripts/generate_messages.py from interfaces/gazebo_msgs/msg; do not edit.
import geometry_msgs.msg
import numpy as np
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["ContactState", "ContactsState", "EntityState", "LinkState", "LinkStates", "ModelState", "ModelStates", "ODEJointProperties", "ODEPhysics", "PerformanceMetrics", "SensorPerformanceMetric", "WheelSlip", "WorldState"]

class ContactState(Message):
    info: str
    collision1_name: str
    collision2_name: str
    wrenches: list[geometry_msgs.msg.Wrench]
    total_wrench: geometry_msgs.msg.Wrench
    contact_positions: list[geometry_msgs.msg.Vector3]
    contact_normals: list[geometry_msgs.msg.Vector3]
    depths: NumberSequence[float]
    def __init__(self, *, info: str = ..., collision1_name: str = ..., collision2_name: str = ..., wrenches: list[geometry_msgs.msg.Wrench] = ..., total_wrench: geometry_msgs.msg.Wrench = ..., contact_positions: list[geometry_msgs.msg.Vector3] = ..., contact_normals: list[geometry_msgs.msg.Vector3] = ..., depths: Iterable[float] = ...) -> None: ...

class ContactsState(Message):
    header: std_msgs.msg.Header
    states: list[ContactState]
    def __init__(self, *, header: std_msgs.msg.Header = ..., states: list[ContactState] = ...) -> None: ...

class EntityState(Message):
    name: str
    pose: geometry_msgs.msg.Pose
    twist: geometry_msgs.msg.Twist
    reference_frame: str
    def __init__(self, *, name: str = ..., pose: geometry_msgs.msg.Pose = ..., twist: geometry_msgs.msg.Twist = ..., reference_frame: str = ...) -> None: ...

class LinkState(Message):
    link_name: str
    pose: geometry_msgs.msg.Pose
    twist: geometry_msgs.msg.Twist
    reference_frame: str
    def __init__(self, *, link_name: str = ..., pose: geometry_msgs.msg.Pose = ..., twist: geometry_msgs.msg.Twist = ..., reference_frame: str = ...) -> None: ...

class LinkStates(Message):
    name: list[str]
    pose: list[geometry_msgs.msg.Pose]
    twist: list[geometry_msgs.msg.Twist]
    def __init__(self, *, name: list[str] = ..., pose: list[geometry_msgs.msg.Pose] = ..., twist: list[geometry_msgs.msg.Twist] = ...) -> None: ...

class ModelState(Message):
    model_name: str
    pose: geometry_msgs.msg.Pose
    twist: geometry_msgs.msg.Twist
    reference_frame: str
    def __init__(self, *, model_name: str = ..., pose: geometry_msgs.msg.Pose = ..., twist: geometry_msgs.msg.Twist = ..., reference_frame: str = ...) -> None: ...

class ModelStates(Message):
    name: list[str]
    pose: list[geometry_msgs.msg.Pose]
    twist: list[geometry_msgs.msg.Twist]
    def __init__(self, *, name: list[str] = ..., pose: list[geometry_msgs.msg.Pose] = ..., twist: list[geometry_msgs.msg.Twist] = ...) -> None: ...

class ODEJointProperties(Message):
    damping: NumberSequence[float]
    hi_stop: NumberSequence[float]
    lo_stop: NumberSequence[float]
    erp: NumberSequence[float]
    cfm: NumberSequence[float]
    stop_erp: NumberSequence[float]
    stop_cfm: NumberSequence[float]
    fudge_factor: NumberSequence[float]
    fmax: NumberSequence[float]
    vel: NumberSequence[float]
    def __init__(self, *, damping: Iterable[float] = ..., hi_stop: Iterable[float] = ..., lo_stop: Iterable[float] = ..., erp: Iterable[float] = ..., cfm: Iterable[float] = ..., stop_erp: Iterable[float] = ..., stop_cfm: Iterable[float] = ..., fudge_factor: Iterable[float] = ..., fmax: Iterable[float] = ..., vel: Iterable[float] = ...) -> None: ...

class ODEPhysics(Message):
    auto_disable_bodies: bool
    sor_pgs_precon_iters: int
    sor_pgs_iters: int
    sor_pgs_w: float
    sor_pgs_rms_error_tol: float
    contact_surface_layer: float
    contact_max_correcting_vel: float
    cfm: float
    erp: float
    max_contacts: int
    def __init__(self, *, auto_disable_bodies: bool = ..., sor_pgs_precon_iters: int = ..., sor_pgs_iters: int = ..., sor_pgs_w: float = ..., sor_pgs_rms_error_tol: float = ..., contact_surface_layer: float = ..., contact_max_correcting_vel: float = ..., cfm: float = ..., erp: float = ..., max_contacts: int = ...) -> None: ...

class PerformanceMetrics(Message):
    header: std_msgs.msg.Header
    real_time_factor: float
    sensors: list[SensorPerformanceMetric]
    def __init__(self, *, header: std_msgs.msg.Header = ..., real_time_factor: float = ..., sensors: list[SensorPerformanceMetric] = ...) -> None: ...

class SensorPerformanceMetric(Message):
    name: str
    sim_update_rate: float
    real_update_rate: float
    fps: float
    def __init__(self, *, name: str = ..., sim_update_rate: float = ..., real_update_rate: float = ..., fps: float = ...) -> None: ...

class WheelSlip(Message):
    name: list[str]
    lateral_slip: NumberSequence[float]
    longitudinal_slip: NumberSequence[float]
    def __init__(self, *, name: list[str] = ..., lateral_slip: Iterable[float] = ..., longitudinal_slip: Iterable[float] = ...) -> None: ...

class WorldState(Message):
    header: std_msgs.msg.Header
    name: list[str]
    pose: list[geometry_msgs.msg.Pose]
    twist: list[geometry_msgs.msg.Twist]
    wrench: list[geometry_msgs.msg.Wrench]
    def __init__(self, *, header: std_msgs.msg.Header = ..., name: list[str] = ..., pose: list[geometry_msgs.msg.Pose] = ..., twist: list[geometry_msgs.msg.Twist] = ..., wrench: list[geometry_msgs.msg.Wrench] = ...) -> None: ...

