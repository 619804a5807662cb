# Written by scripts/generate_messages.py from interfaces/ackermann_msgs/msg; do not edit.
import numpy as np
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["AckermannDrive", "AckermannDriveStamped"]

class AckermannDrive(Message):
    steering_angle: float
    steering_angle_velocity: float
    speed: float
    acceleration: float
    jerk: float
    def __init__(self, *, steering_angle: float = ..., steering_angle_velocity: float = ..., speed: float = ..., acceleration: float = ..., jerk: float = ...) -> None: ...

class AckermannDriveStamped(Message):
    header: std_msgs.msg.Header
    drive: AckermannDrive
    def __init__(self, *, header: std_msgs.msg.Header = ..., drive: AckermannDrive = ...) -> None: ...

