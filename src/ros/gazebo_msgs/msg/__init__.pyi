# Written by scripts/generate_messages.py from interfaces/gazebo_msgs/msg; do not edit.
import geometry_msgs.msg
import numpy as np
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["ContactState", "ContactsState", "EntityState", "LinkState", "LinkStates", "ModelState", "ModelStates", "PerformanceMetrics", "SensorPerformanceMetric"]

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

