# Written by scripts/generate_messages.py from interfaces/lifecycle_msgs/srv; do not edit.
import lifecycle_msgs.msg
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["ChangeState", "GetAvailableStates", "GetAvailableTransitions", "GetState"]

class ChangeState_Request(Message):
    transition: lifecycle_msgs.msg.Transition
    def __init__(self, *, transition: lifecycle_msgs.msg.Transition = ...) -> None: ...

class ChangeState_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class ChangeState(Service):
    Request: TypeAlias = ChangeState_Request
    Response: TypeAlias = ChangeState_Response

class GetAvailableStates_Request(Message):
    def __init__(self) -> None: ...

class GetAvailableStates_Response(Message):
    available_states: list[lifecycle_msgs.msg.State]
    def __init__(self, *, available_states: list[lifecycle_msgs.msg.State] = ...) -> None: ...

class GetAvailableStates(Service):
    Request: TypeAlias = GetAvailableStates_Request
    Response: TypeAlias = GetAvailableStates_Response

class GetAvailableTransitions_Request(Message):
    def __init__(self) -> None: ...

class GetAvailableTransitions_Response(Message):
    available_transitions: list[lifecycle_msgs.msg.TransitionDescription]
    def __init__(self, *, available_transitions: list[lifecycle_msgs.msg.TransitionDescription] = ...) -> None: ...

class GetAvailableTransitions(Service):
    Request: TypeAlias = GetAvailableTransitions_Request
    Response: TypeAlias = GetAvailableTransitions_Response

class GetState_Request(Message):
    def __init__(self) -> None: ...

class GetState_Response(Message):
    current_state: lifecycle_msgs.msg.State
    def __init__(self, *, current_state: lifecycle_msgs.msg.State = ...) -> None: ...

class GetState(Service):
    Request: TypeAlias = GetState_Request
    Response: TypeAlias = GetState_Response

