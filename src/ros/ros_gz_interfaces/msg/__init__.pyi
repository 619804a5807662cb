# Written by scripts/generate_messages.py from interfaces/ros_gz_interfaces/msg; do not edit.
import builtin_interfaces.msg
import geometry_msgs.msg
import numpy as np
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["Contact", "Contacts", "Entity", "EntityFactory", "JointWrench", "WorldControl", "WorldReset"]

class Contact(Message):
    collision1: Entity
    collision2: Entity
    positions: list[geometry_msgs.msg.Vector3]
    normals: list[geometry_msgs.msg.Vector3]
    depths: NumberSequence[float]
    wrenches: list[JointWrench]
    def __init__(self, *, collision1: Entity = ..., collision2: Entity = ..., positions: list[geometry_msgs.msg.Vector3] = ..., normals: list[geometry_msgs.msg.Vector3] = ..., depths: Iterable[float] = ..., wrenches: list[JointWrench] = ...) -> None: ...

class Contacts(Message):
    header: std_msgs.msg.Header
    contacts: list[Contact]
    def __init__(self, *, header: std_msgs.msg.Header = ..., contacts: list[Contact] = ...) -> None: ...

class Entity(Message):
    NONE: Final = 0
    LIGHT: Final = 1
    MODEL: Final = 2
    LINK: Final = 3
    VISUAL: Final = 4
    COLLISION: Final = 5
    SENSOR: Final = 6
    JOINT: Final = 7
    id: int
    name: str
    type: int
    def __init__(self, *, id: int = ..., name: str = ..., type: int = ...) -> None: ...

class EntityFactory(Message):
    name: str
    allow_renaming: bool
    sdf: str
    sdf_filename: str
    clone_name: str
    pose: geometry_msgs.msg.Pose
    relative_to: str
    def __init__(self, *, name: str = ..., allow_renaming: bool = ..., sdf: str = ..., sdf_filename: str = ..., clone_name: str = ..., pose: geometry_msgs.msg.Pose = ..., relative_to: str = ...) -> None: ...

class JointWrench(Message):
    header: std_msgs.msg.Header
    body_1_name: std_msgs.msg.String
    body_1_id: std_msgs.msg.UInt32
    body_2_name: std_msgs.msg.String
    body_2_id: std_msgs.msg.UInt32
    body_1_wrench: geometry_msgs.msg.Wrench
    body_2_wrench: geometry_msgs.msg.Wrench
    def __init__(self, *, header: std_msgs.msg.Header = ..., body_1_name: std_msgs.msg.String = ..., body_1_id: std_msgs.msg.UInt32 = ..., body_2_name: std_msgs.msg.String = ..., body_2_id: std_msgs.msg.UInt32 = ..., body_1_wrench: geometry_msgs.msg.Wrench = ..., body_2_wrench: geometry_msgs.msg.Wrench = ...) -> None: ...

class WorldControl(Message):
    pause: bool
    step: bool
    multi_step: int
    reset: WorldReset
    seed: int
    run_to_sim_time: builtin_interfaces.msg.Time
    def __init__(self, *, pause: bool = ..., step: bool = ..., multi_step: int = ..., reset: WorldReset = ..., seed: int = ..., run_to_sim_time: builtin_interfaces.msg.Time = ...) -> None: ...

class WorldReset(Message):
    all: bool
    time_only: bool
    model_only: bool
    def __init__(self, *, all: bool = ..., time_only: bool = ..., model_only: bool = ...) -> None: ...

