# Written by scripts/generate_messages.py from interfaces/ros_gz_interfaces/srv; do not edit.
import geometry_msgs.msg
import numpy as np
import ros_gz_interfaces.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["ControlWorld", "DeleteEntity", "SetEntityPose", "SpawnEntity"]

class ControlWorld_Request(Message):
    world_control: ros_gz_interfaces.msg.WorldControl
    def __init__(self, *, world_control: ros_gz_interfaces.msg.WorldControl = ...) -> None: ...

class ControlWorld_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class ControlWorld(Service):
    Request: TypeAlias = ControlWorld_Request
    Response: TypeAlias = ControlWorld_Response

class DeleteEntity_Request(Message):
    entity: ros_gz_interfaces.msg.Entity
    def __init__(self, *, entity: ros_gz_interfaces.msg.Entity = ...) -> None: ...

class DeleteEntity_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class DeleteEntity(Service):
    Request: TypeAlias = DeleteEntity_Request
    Response: TypeAlias = DeleteEntity_Response

class SetEntityPose_Request(Message):
    entity: ros_gz_interfaces.msg.Entity
    pose: geometry_msgs.msg.Pose
    def __init__(self, *, entity: ros_gz_interfaces.msg.Entity = ..., pose: geometry_msgs.msg.Pose = ...) -> None: ...

class SetEntityPose_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class SetEntityPose(Service):
    Request: TypeAlias = SetEntityPose_Request
    Response: TypeAlias = SetEntityPose_Response

class SpawnEntity_Request(Message):
    entity_factory: ros_gz_interfaces.msg.EntityFactory
    def __init__(self, *, entity_factory: ros_gz_interfaces.msg.EntityFactory = ...) -> None: ...

class SpawnEntity_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class SpawnEntity(Service):
    Request: TypeAlias = SpawnEntity_Request
    Response: TypeAlias = SpawnEntity_Response

