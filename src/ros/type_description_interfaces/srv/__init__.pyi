# Written by scripts/generate_messages.py from interfaces/type_description_interfaces/srv; do not edit.
import numpy as np
import type_description_interfaces.msg
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["GetTypeDescription"]

class GetTypeDescription_Request(Message):
    type_name: str
    type_hash: str
    include_type_sources: bool
    def __init__(self, *, type_name: str = ..., type_hash: str = ..., include_type_sources: bool = ...) -> None: ...

class GetTypeDescription_Response(Message):
    successful: bool
    failure_reason: str
    type_description: type_description_interfaces.msg.TypeDescription
    type_sources: list[type_description_interfaces.msg.TypeSource]
    extra_information: list[type_description_interfaces.msg.KeyValue]
    def __init__(self, *, successful: bool = ..., failure_reason: str = ..., type_description: type_description_interfaces.msg.TypeDescription = ..., type_sources: list[type_description_interfaces.msg.TypeSource] = ..., extra_information: list[type_description_interfaces.msg.KeyValue] = ...) -> None: ...

class GetTypeDescription(Service):
    Request: TypeAlias = GetTypeDescription_Request
    Response: TypeAlias = GetTypeDescription_Response

