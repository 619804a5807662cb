# Written by scripts/generate_messages.py from interfaces/gazebo_msgs/srv; do not edit.
import builtin_interfaces.msg
import gazebo_msgs.msg
import geometry_msgs.msg
import numpy as np
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["ApplyJointEffort", "ApplyLinkWrench", "DeleteEntity", "GetEntityState", "GetModelList", "JointRequest", "LinkRequest", "SetEntityState", "SpawnEntity"]

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

