# Written by scripts/generate_messages.py from interfaces/controller_manager_msgs/msg; do not edit.
import lifecycle_msgs.msg
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["ChainConnection", "ControllerState", "HardwareComponentState", "HardwareInterface"]

class ChainConnection(Message):
    name: str
    reference_interfaces: list[str]
    def __init__(self, *, name: str = ..., reference_interfaces: list[str] = ...) -> None: ...

class ControllerState(Message):
    name: str
    state: str
    type: str
    claimed_interfaces: list[str]
    required_command_interfaces: list[str]
    required_state_interfaces: list[str]
    is_chainable: bool
    is_chained: bool
    exported_state_interfaces: list[str]
    reference_interfaces: list[str]
    chain_connections: list[ChainConnection]
    def __init__(self, *, name: str = ..., state: str = ..., type: str = ..., claimed_interfaces: list[str] = ..., required_command_interfaces: list[str] = ..., required_state_interfaces: list[str] = ..., is_chainable: bool = ..., is_chained: bool = ..., exported_state_interfaces: list[str] = ..., reference_interfaces: list[str] = ..., chain_connections: list[ChainConnection] = ...) -> None: ...

class HardwareComponentState(Message):
    name: str
    type: str
    class_type: str
    plugin_name: str
    state: lifecycle_msgs.msg.State
    command_interfaces: list[HardwareInterface]
    state_interfaces: list[HardwareInterface]
    def __init__(self, *, name: str = ..., type: str = ..., class_type: str = ..., plugin_name: str = ..., state: lifecycle_msgs.msg.State = ..., command_interfaces: list[HardwareInterface] = ..., state_interfaces: list[HardwareInterface] = ...) -> None: ...

class HardwareInterface(Message):
    name: str
    is_available: bool
    is_claimed: bool
    def __init__(self, *, name: str = ..., is_available: bool = ..., is_claimed: bool = ...) -> None: ...

