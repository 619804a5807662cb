# Written by scripts/generate_messages.py from interfaces/webots_ros2_msgs/msg; do not edit.
import geometry_msgs.msg
import numpy as np
import std_msgs.msg
import vision_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["BoolStamped", "CameraRecognitionObject", "CameraRecognitionObjects", "FloatStamped", "PenInkProperties", "StringStamped", "UrdfRobot"]

class BoolStamped(Message):
    header: std_msgs.msg.Header
    data: bool
    def __init__(self, *, header: std_msgs.msg.Header = ..., data: bool = ...) -> None: ...

class CameraRecognitionObject(Message):
    id: int
    pose: geometry_msgs.msg.PoseStamped
    bbox: vision_msgs.msg.BoundingBox2D
    colors: list[std_msgs.msg.ColorRGBA]
    model: str
    def __init__(self, *, id: int = ..., pose: geometry_msgs.msg.PoseStamped = ..., bbox: vision_msgs.msg.BoundingBox2D = ..., colors: list[std_msgs.msg.ColorRGBA] = ..., model: str = ...) -> None: ...

class CameraRecognitionObjects(Message):
    header: std_msgs.msg.Header
    objects: list[CameraRecognitionObject]
    def __init__(self, *, header: std_msgs.msg.Header = ..., objects: list[CameraRecognitionObject] = ...) -> None: ...

class FloatStamped(Message):
    header: std_msgs.msg.Header
    data: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., data: float = ...) -> None: ...

class PenInkProperties(Message):
    color: int
    density: float
    def __init__(self, *, color: int = ..., density: float = ...) -> None: ...

class StringStamped(Message):
    header: std_msgs.msg.Header
    data: str
    def __init__(self, *, header: std_msgs.msg.Header = ..., data: str = ...) -> None: ...

class UrdfRobot(Message):
    name: str
    urdf_path: str
    robot_description: str
    relative_path_prefix: str
    translation: str
    rotation: str
    normal: bool
    box_collision: bool
    init_pos: str
    def __init__(self, *, name: str = ..., urdf_path: str = ..., robot_description: str = ..., relative_path_prefix: str = ..., translation: str = ..., rotation: str = ..., normal: bool = ..., box_collision: bool = ..., init_pos: str = ...) -> None: ...

