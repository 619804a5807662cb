# Written by scripts/generate_messages.py from interfaces/turtlesim_msgs/srv; do not edit.
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["Kill", "SetPen", "Spawn", "TeleportAbsolute", "TeleportRelative"]

class Kill_Request(Message):
    name: str
    def __init__(self, *, name: str = ...) -> None: ...

class Kill_Response(Message):
    def __init__(self) -> None: ...

class Kill(Service):
    Request: TypeAlias = Kill_Request
    Response: TypeAlias = Kill_Response

class SetPen_Request(Message):
    r: int
    g: int
    b: int
    width: int
    off: int
    def __init__(self, *, r: int = ..., g: int = ..., b: int = ..., width: int = ..., off: int = ...) -> None: ...

class SetPen_Response(Message):
    def __init__(self) -> None: ...

class SetPen(Service):
    Request: TypeAlias = SetPen_Request
    Response: TypeAlias = SetPen_Response

class Spawn_Request(Message):
    x: float
    y: float
    theta: float
    name: str
    def __init__(self, *, x: float = ..., y: float = ..., theta: float = ..., name: str = ...) -> None: ...

class Spawn_Response(Message):
    name: str
    def __init__(self, *, name: str = ...) -> None: ...

class Spawn(Service):
    Request: TypeAlias = Spawn_Request
    Response: TypeAlias = Spawn_Response

class TeleportAbsolute_Request(Message):
    x: float
    y: float
    theta: float
    def __init__(self, *, x: float = ..., y: float = ..., theta: float = ...) -> None: ...

class TeleportAbsolute_Response(Message):
    def __init__(self) -> None: ...

class TeleportAbsolute(Service):
    Request: TypeAlias = TeleportAbsolute_Request
    Response: TypeAlias = TeleportAbsolute_Response

class TeleportRelative_Request(Message):
    linear: float
    angular: float
    def __init__(self, *, linear: float = ..., angular: float = ...) -> None: ...

class TeleportRelative_Response(Message):
    def __init__(self) -> None: ...

class TeleportRelative(Service):
    Request: TypeAlias = TeleportRelative_Request
    Response: TypeAlias = TeleportRelative_Response

