# Written by scripts/generate_messages.py from interfaces/composition_interfaces/srv; do not edit.
import numpy as np
import rcl_interfaces.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["ListNodes", "LoadNode", "UnloadNode"]

class ListNodes_Request(Message):
    def __init__(self) -> None: ...

class ListNodes_Response(Message):
    full_node_names: list[str]
    unique_ids: NumberSequence[int]
    def __init__(self, *, full_node_names: list[str] = ..., unique_ids: Iterable[int] = ...) -> None: ...

class ListNodes(Service):
    Request: TypeAlias = ListNodes_Request
    Response: TypeAlias = ListNodes_Response

class LoadNode_Request(Message):
    package_name: str
    plugin_name: str
    node_name: str
    node_namespace: str
    log_level: int
    remap_rules: list[str]
    parameters: list[rcl_interfaces.msg.Parameter]
    extra_arguments: list[rcl_interfaces.msg.Parameter]
    def __init__(self, *, package_name: str = ..., plugin_name: str = ..., node_name: str = ..., node_namespace: str = ..., log_level: int = ..., remap_rules: list[str] = ..., parameters: list[rcl_interfaces.msg.Parameter] = ..., extra_arguments: list[rcl_interfaces.msg.Parameter] = ...) -> None: ...

class LoadNode_Response(Message):
    success: bool
    error_message: str
    full_node_name: str
    unique_id: int
    def __init__(self, *, success: bool = ..., error_message: str = ..., full_node_name: str = ..., unique_id: int = ...) -> None: ...

class LoadNode(Service):
    Request: TypeAlias = LoadNode_Request
    Response: TypeAlias = LoadNode_Response

class UnloadNode_Request(Message):
    unique_id: int
    def __init__(self, *, unique_id: int = ...) -> None: ...

class UnloadNode_Response(Message):
    success: bool
    error_message: str
    def __init__(self, *, success: bool = ..., error_message: str = ...) -> None: ...

class UnloadNode(Service):
    Request: TypeAlias = UnloadNode_Request
    Response: TypeAlias = UnloadNode_Response

