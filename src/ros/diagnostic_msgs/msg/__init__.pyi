# Written by scripts/generate_messages.py from interfaces/diagnostic_msgs/msg; do not edit.
import numpy as np
import std_msgs.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["DiagnosticArray", "DiagnosticStatus", "KeyValue"]

class DiagnosticArray(Message):
    header: std_msgs.msg.Header
    status: list[DiagnosticStatus]
    def __init__(self, *, header: std_msgs.msg.Header = ..., status: list[DiagnosticStatus] = ...) -> None: ...

class DiagnosticStatus(Message):
    OK: Final = b'\x00'
    WARN: Final = b'\x01'
    ERROR: Final = b'\x02'
    STALE: Final = b'\x03'
    level: bytes
    name: str
    message: str
    hardware_id: str
    values: list[KeyValue]
    def __init__(self, *, level: bytes = ..., name: str = ..., message: str = ..., hardware_id: str = ..., values: list[KeyValue] = ...) -> None: ...

class KeyValue(Message):
    key: str
    value: str
    def __init__(self, *, key: str = ..., value: str = ...) -> None: ...

