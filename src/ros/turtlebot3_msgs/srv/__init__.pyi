# Written by scripts/generate_messages.py from interfaces/turtlebot3_msgs/srv; do not edit.
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["Dqn", "Goal", "Sound"]

class Dqn_Request(Message):
    action: int
    init: bool
    def __init__(self, *, action: int = ..., init: bool = ...) -> None: ...

class Dqn_Response(Message):
    state: NumberSequence[float]
    reward: float
    done: bool
    def __init__(self, *, state: Iterable[float] = ..., reward: float = ..., done: bool = ...) -> None: ...

class Dqn(Service):
    Request: TypeAlias = Dqn_Request
    Response: TypeAlias = Dqn_Response

class Goal_Request(Message):
    def __init__(self) -> None: ...

class Goal_Response(Message):
    pose_x: float
    pose_y: float
    success: bool
    def __init__(self, *, pose_x: float = ..., pose_y: float = ..., success: bool = ...) -> None: ...

class Goal(Service):
    Request: TypeAlias = Goal_Request
    Response: TypeAlias = Goal_Response

class Sound_Request(Message):
    value: int
    def __init__(self, *, value: int = ...) -> None: ...

class Sound_Response(Message):
    success: bool
    message: str
    def __init__(self, *, success: bool = ..., message: str = ...) -> None: ...

class Sound(Service):
    Request: TypeAlias = Sound_Request
    Response: TypeAlias = Sound_Response

