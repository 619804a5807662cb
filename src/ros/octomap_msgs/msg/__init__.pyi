# Written by scripts/generate_messages.py from interfaces/octomap_msgs/msg; do not edit.
import geometry_msgs.msg
import numpy as np
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["Octomap", "OctomapWithPose"]

class Octomap(Message):
    header: std_msgs.msg.Header
    binary: bool
    id: str
    resolution: float
    data: NumberSequence[int]
    def __init__(self, *, header: std_msgs.msg.Header = ..., binary: bool = ..., id: str = ..., resolution: float = ..., data: Iterable[int] = ...) -> None: ...

class OctomapWithPose(Message):
    header: std_msgs.msg.Header
    origin: geometry_msgs.msg.Pose
    octomap: Octomap
    def __init__(self, *, header: std_msgs.msg.Header = ..., origin: geometry_msgs.msg.Pose = ..., octomap: Octomap = ...) -> None: ...

