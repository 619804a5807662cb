# Written by scripts/generate_messages.py from interfaces/diagnostic_msgs/srv; do not edit.
import diagnostic_msgs.msg
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["AddDiagnostics", "SelfTest"]

class AddDiagnostics_Request(Message):
    load_namespace: str
    def __init__(self, *, load_namespace: str = ...) -> None: ...

class AddDiagnostics_Response(Message):
    success: bool
    message: str
    def __init__(self, *, success: bool = ..., message: str = ...) -> None: ...

class AddDiagnostics(Service):
    Request: TypeAlias = AddDiagnostics_Request
    Response: TypeAlias = AddDiagnostics_Response

class SelfTest_Request(Message):
    def __init__(self) -> None: ...

class SelfTest_Response(Message):
    id: str
    passed: bytes
    status: list[diagnostic_msgs.msg.DiagnosticStatus]
    def __init__(self, *, id: str = ..., passed: bytes = ..., status: list[diagnostic_msgs.msg.DiagnosticStatus] = ...) -> None: ...

class SelfTest(Service):
    Request: TypeAlias = SelfTest_Request
    Response: TypeAlias = SelfTest_Response

