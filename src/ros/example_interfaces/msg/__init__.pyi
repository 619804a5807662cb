# Written by scripts/generate_messages.py from interfaces/example_interfaces/msg; do not edit.
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["Bool", "Byte", "ByteMultiArray", "Char", "Empty", "Float32", "Float32MultiArray", "Float64", "Float64MultiArray", "Int16", "Int16MultiArray", "Int32", "Int32MultiArray", "Int64", "Int64MultiArray", "Int8", "Int8MultiArray", "MultiArrayDimension", "MultiArrayLayout", "String", "UInt16", "UInt16MultiArray", "UInt32", "UInt32MultiArray", "UInt64", "UInt64MultiArray", "UInt8", "UInt8MultiArray", "WString"]

class Bool(Message):
    data: bool
    def __init__(self, *, data: bool = ...) -> None: ...

class Byte(Message):
    data: bytes
    def __init__(self, *, data: bytes = ...) -> None: ...

class ByteMultiArray(Message):
    layout: MultiArrayLayout
    data: list[bytes]
    def __init__(self, *, layout: MultiArrayLayout = ..., data: list[bytes] = ...) -> None: ...

class Char(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class Empty(Message):
    def __init__(self) -> None: ...

class Float32(Message):
    data: float
    def __init__(self, *, data: float = ...) -> None: ...

class Float32MultiArray(Message):
    layout: MultiArrayLayout
    data: NumberSequence[float]
    def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[float] = ...) -> None: ...

class Float64(Message):
    data: float
    def __init__(self, *, data: float = ...) -> None: ...

class Float64MultiArray(Message):
    layout: MultiArrayLayout
    data: NumberSequence[float]
    def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[float] = ...) -> None: ...

class Int16(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class Int16MultiArray(Message):
    layout: MultiArrayLayout
    data: NumberSequence[int]
    def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[int] = ...) -> None: ...

class Int32(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class Int32MultiArray(Message):
    layout: MultiArrayLayout
    data: NumberSequence[int]
    def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[int] = ...) -> None: ...

class Int64(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class Int64MultiArray(Message):
    layout: MultiArrayLayout
    data: NumberSequence[int]
    def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[int] = ...) -> None: ...

class Int8(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class Int8MultiArray(Message):
    layout: MultiArrayLayout
    data: NumberSequence[int]
    def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[int] = ...) -> None: ...

class MultiArrayDimension(Message):
    label: str
    size: int
    stride: int
    def __init__(self, *, label: str = ..., size: int = ..., stride: int = ...) -> None: ...

class MultiArrayLayout(Message):
    dim: list[MultiArrayDimension]
    data_offset: int
    def __init__(self, *, dim: list[MultiArrayDimension] = ..., data_offset: int = ...) -> None: ...

class String(Message):
    data: str
    def __init__(self, *, data: str = ...) -> None: ...

class UInt16(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class UInt16MultiArray(Message):
    layout: MultiArrayLayout
    data: NumberSequence[int]
    def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[int] = ...) -> None: ...

class UInt32(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class UInt32MultiArray(Message):
    layout: MultiArrayLayout
    data: NumberSequence[int]
    def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[int] = ...) -> None: ...

class UInt64(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class UInt64MultiArray(Message):
    layout: MultiArrayLayout
    data: NumberSequence[int]
    def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[int] = ...) -> None: ...

class UInt8(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class UInt8MultiArray(Message):
    layout: MultiArrayLayout
    data: NumberSequence[int]
    def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[int] = ...) -> None: ...

class WString(Message):
    data: str
    def __init__(self, *, data: str = ...) -> None: ...

