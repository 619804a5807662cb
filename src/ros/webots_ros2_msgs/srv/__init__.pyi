# Written by scripts/generate_messages.py from interfaces/webots_ros2_msgs/srv; do not edit.
import numpy as np
import webots_ros2_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["EmitterSendString", "GetBool", "SetString", "SpawnNodeFromString", "SpawnUrdfRobot"]

class EmitterSendString_Request(Message):
    value: str
    def __init__(self, *, value: str = ...) -> None: ...

class EmitterSendString_Response(Message):
    result: int
    def __init__(self, *, result: int = ...) -> None: ...

class EmitterSendString(Service):
    Request: TypeAlias = EmitterSendString_Request
    Response: TypeAlias = EmitterSendString_Response

class GetBool_Request(Message):
    ask: bool
    def __init__(self, *, ask: bool = ...) -> None: ...

class GetBool_Response(Message):
    value: bool
    def __init__(self, *, value: bool = ...) -> None: ...

class GetBool(Service):
    Request: TypeAlias = GetBool_Request
    Response: TypeAlias = GetBool_Response

class SetString_Request(Message):
    value: str
    def __init__(self, *, value: str = ...) -> None: ...

class SetString_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class SetString(Service):
    Request: TypeAlias = SetString_Request
    Response: TypeAlias = SetString_Response

class SpawnNodeFromString_Request(Message):
    data: str
    def __init__(self, *, data: str = ...) -> None: ...

class SpawnNodeFromString_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class SpawnNodeFromString(Service):
    Request: TypeAlias = SpawnNodeFromString_Request
    Response: TypeAlias = SpawnNodeFromString_Response

class SpawnUrdfRobot_Request(Message):
    robot: webots_ros2_msgs.msg.UrdfRobot
    def __init__(self, *, robot: webots_ros2_msgs.msg.UrdfRobot = ...) -> None: ...

class SpawnUrdfRobot_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class SpawnUrdfRobot(Service):
    Request: TypeAlias = SpawnUrdfRobot_Request
    Response: TypeAlias = SpawnUrdfRobot_Response

