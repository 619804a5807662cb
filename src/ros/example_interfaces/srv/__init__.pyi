# Written by scripts/generate_messages.py from interfaces/example_interfaces/srv; do not edit.
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["AddTwoInts", "SetBool", "Trigger"]

class AddTwoInts_Request(Message):
    a: int
    b: int
    def __init__(self, *, a: int = ..., b: int = ...) -> None: ...

class AddTwoInts_Response(Message):
    sum: int
    def __init__(self, *, sum: int = ...) -> None: ...

class AddTwoInts(Service):
    Request: TypeAlias = AddTwoInts_Request
    Response: TypeAlias = AddTwoInts_Response

class SetBool_Request(Message):
    data: bool
    def __init__(self, *, data: bool = ...) -> None: ...

class SetBool_Response(Message):
    success: bool
    message: str
    def __init__(self, *, success: bool = ..., message: str = ...) -> None: ...

class SetBool(Service):
    Request: TypeAlias = SetBool_Request
    Response: TypeAlias = SetBool_Response

class Trigger_Request(Message):
    def __init__(self) -> None: ...

class Trigger_Response(Message):
    success: bool
    message: str
    def __init__(self, *, success: bool = ..., message: str = ...) -> None: ...

class Trigger(Service):
    Request: TypeAlias = Trigger_Request
    Response: TypeAlias = Trigger_Response

