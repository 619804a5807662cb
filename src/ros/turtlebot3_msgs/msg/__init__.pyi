# Written by scripts/generate_messages.py from interfaces/turtlebot3_msgs/msg; do not edit.
import numpy as np
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["SensorState", "Sound", "VersionInfo"]

class SensorState(Message):
    BUMPER_FORWARD: Final = 1
    BUMPER_BACKWARD: Final = 2
    CLIFF: Final = 1
    SONAR: Final = 1
    ILLUMINATION: Final = 1
    BUTTON0: Final = 1
    BUTTON1: Final = 2
    ERROR_LEFT_MOTOR: Final = 1
    ERROR_RIGHT_MOTOR: Final = 2
    TORQUE_ON: Final = 1
    TORQUE_OFF: Final = 2
    header: std_msgs.msg.Header
    bumper: int
    cliff: float
    sonar: float
    illumination: float
    led: int
    button: int
    torque: bool
    left_encoder: int
    right_encoder: int
    battery: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., bumper: int = ..., cliff: float = ..., sonar: float = ..., illumination: float = ..., led: int = ..., button: int = ..., torque: bool = ..., left_encoder: int = ..., right_encoder: int = ..., battery: float = ...) -> None: ...

class Sound(Message):
    OFF: Final = 0
    ON: Final = 1
    LOW_BATTERY: Final = 2
    ERROR: Final = 3
    BUTTON1: Final = 4
    BUTTON2: Final = 5
    value: int
    def __init__(self, *, value: int = ...) -> None: ...

class VersionInfo(Message):
    hardware: str
    firmware: str
    software: str
    def __init__(self, *, hardware: str = ..., firmware: str = ..., software: str = ...) -> None: ...

