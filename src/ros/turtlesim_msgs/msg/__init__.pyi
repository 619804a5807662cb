# Written by scripts/generate_messages.py from interfaces/turtlesim_msgs/msg; do not edit.
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["Color", "Pose"]

class Color(Message):
    r: int
    g: int
    b: int
    def __init__(self, *, r: int = ..., g: int = ..., b: int = ...) -> None: ...

class Pose(Message):
    x: float
    y: float
    theta: float
    linear_velocity: float
    angular_velocity: float
    def __init__(self, *, x: float = ..., y: float = ..., theta: float = ..., linear_velocity: float = ..., angular_velocity: float = ...) -> None: ...

