# Written by scripts/generate_messages.py from interfaces/control_msgs/srv; do not edit.
import builtin_interfaces.msg
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["QueryCalibrationState", "QueryTrajectoryState"]

class QueryCalibrationState_Request(Message):
    def __init__(self) -> None: ...

class QueryCalibrationState_Response(Message):
    is_calibrated: bool
    def __init__(self, *, is_calibrated: bool = ...) -> None: ...

class QueryCalibrationState(Service):
    Request: TypeAlias = QueryCalibrationState_Request
    Response: TypeAlias = QueryCalibrationState_Response

class QueryTrajectoryState_Request(Message):
    time: builtin_interfaces.msg.Time
    def __init__(self, *, time: builtin_interfaces.msg.Time = ...) -> None: ...

class QueryTrajectoryState_Response(Message):
    success: bool
    message: str
    name: list[str]
    position: NumberSequence[float]
    velocity: NumberSequence[float]
    acceleration: NumberSequence[float]
    def __init__(self, *, success: bool = ..., message: str = ..., name: list[str] = ..., position: Iterable[float] = ..., velocity: Iterable[float] = ..., acceleration: Iterable[float] = ...) -> None: ...

class QueryTrajectoryState(Service):
    Request: TypeAlias = QueryTrajectoryState_Request
    Response: TypeAlias = QueryTrajectoryState_Response

