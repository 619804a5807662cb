# Written by scripts/generate_messages.py from interfaces/trajectory_msgs/msg; do not edit.
import builtin_interfaces.msg
import geometry_msgs.msg
import numpy as np
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["JointTrajectory", "JointTrajectoryPoint", "MultiDOFJointTrajectory", "MultiDOFJointTrajectoryPoint"]

class JointTrajectory(Message):
    header: std_msgs.msg.Header
    joint_names: list[str]
    points: list[JointTrajectoryPoint]
    def __init__(self, *, header: std_msgs.msg.Header = ..., joint_names: list[str] = ..., points: list[JointTrajectoryPoint] = ...) -> None: ...

class JointTrajectoryPoint(Message):
    positions: NumberSequence[float]
    velocities: NumberSequence[float]
    accelerations: NumberSequence[float]
    effort: NumberSequence[float]
    time_from_start: builtin_interfaces.msg.Duration
    def __init__(self, *, positions: Iterable[float] = ..., velocities: Iterable[float] = ..., accelerations: Iterable[float] = ..., effort: Iterable[float] = ..., time_from_start: builtin_interfaces.msg.Duration = ...) -> None: ...

class MultiDOFJointTrajectory(Message):
    header: std_msgs.msg.Header
    joint_names: list[str]
    points: list[MultiDOFJointTrajectoryPoint]
    def __init__(self, *, header: std_msgs.msg.Header = ..., joint_names: list[str] = ..., points: list[MultiDOFJointTrajectoryPoint] = ...) -> None: ...

class MultiDOFJointTrajectoryPoint(Message):
    transforms: list[geometry_msgs.msg.Transform]
    velocities: list[geometry_msgs.msg.Twist]
    accelerations: list[geometry_msgs.msg.Twist]
    time_from_start: builtin_interfaces.msg.Duration
    def __init__(self, *, transforms: list[geometry_msgs.msg.Transform] = ..., velocities: list[geometry_msgs.msg.Twist] = ..., accelerations: list[geometry_msgs.msg.Twist] = ..., time_from_start: builtin_interfaces.msg.Duration = ...) -> None: ...

