# Written by scripts/generate_messages.py from interfaces/std_msgs/msg; do not edit.
"""Messages of std_msgs."""

from __future__ import annotations

from array import array
from typing import TYPE_CHECKING, Any, Final

from coframe.messages.definition import BasicType, NamespacedType, UnboundedSequence, UnboundedString
from coframe.messages.message import Message, set_fields
from coframe.messages.generated.builtin_interfaces.msg import Time

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.messages._hints import NumberSequence


class Bool(Message):
    """Message std_msgs/msg/Bool."""

    ROS_TYPE = "std_msgs/msg/Bool"
    SLOT_TYPES = (
        BasicType('boolean'),
    )

    if TYPE_CHECKING:
        data: bool
        def __init__(self, *, data: bool = ...) -> None: ...
    else:
        __slots__ = ["_data"]

        def __init__(self, **fields: Any) -> None:
            self._data = False
            if fields:
                set_fields(self, fields)


class Byte(Message):
    """Message std_msgs/msg/Byte."""

    ROS_TYPE = "std_msgs/msg/Byte"
    SLOT_TYPES = (
        BasicType('octet'),
    )

    if TYPE_CHECKING:
        data: bytes
        def __init__(self, *, data: bytes = ...) -> None: ...
    else:
        __slots__ = ["_data"]

        def __init__(self, **fields: Any) -> None:
            self._data = b"\x00"
            if fields:
                set_fields(self, fields)


class MultiArrayDimension(Message):
    """Message std_msgs/msg/MultiArrayDimension."""

    ROS_TYPE = "std_msgs/msg/MultiArrayDimension"
    SLOT_TYPES = (
        UnboundedString(),
        BasicType('uint32'),
        BasicType('uint32'),
    )

    if TYPE_CHECKING:
        label: str
        size: int
        stride: int
        def __init__(self, *, label: str = ..., size: int = ..., stride: int = ...) -> None: ...
    else:
        __slots__ = ["_label", "_size", "_stride"]

        def __init__(self, **fields: Any) -> None:
            self._label = ""
            self._size = 0
            self._stride = 0
            if fields:
                set_fields(self, fields)


class MultiArrayLayout(Message):
    """Message std_msgs/msg/MultiArrayLayout."""

    ROS_TYPE = "std_msgs/msg/MultiArrayLayout"
    SLOT_TYPES = (
        UnboundedSequence(NamespacedType(('std_msgs', 'msg'), 'MultiArrayDimension')),
        BasicType('uint32'),
    )

    if TYPE_CHECKING:
        dim: list[MultiArrayDimension]
        data_offset: int
        def __init__(self, *, dim: list[MultiArrayDimension] = ..., data_offset: int = ...) -> None: ...
    else:
        __slots__ = ["_dim", "_data_offset"]

        def __init__(self, **fields: Any) -> None:
            self._dim = []
            self._data_offset = 0
            if fields:
                set_fields(self, fields)


class ByteMultiArray(Message):
    """Message std_msgs/msg/ByteMultiArray."""

    ROS_TYPE = "std_msgs/msg/ByteMultiArray"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'MultiArrayLayout'),
        UnboundedSequence(BasicType('octet')),
    )

    if TYPE_CHECKING:
        layout: MultiArrayLayout
        data: list[bytes]
        def __init__(self, *, layout: MultiArrayLayout = ..., data: list[bytes] = ...) -> None: ...
    else:
        __slots__ = ["_layout", "_data"]

        def __init__(self, **fields: Any) -> None:
            self._layout = fields.get("layout") or MultiArrayLayout()
            self._data = []
            if fields:
                set_fields(self, fields)


class Char(Message):
    """Message std_msgs/msg/Char."""

    ROS_TYPE = "std_msgs/msg/Char"
    SLOT_TYPES = (
        BasicType('uint8'),
    )

    if TYPE_CHECKING:
        data: int
        def __init__(self, *, data: int = ...) -> None: ...
    else:
        __slots__ = ["_data"]

        def __init__(self, **fields: Any) -> None:
            self._data = 0
            if fields:
                set_fields(self, fields)


class ColorRGBA(Message):
    """Message std_msgs/msg/ColorRGBA."""

    ROS_TYPE = "std_msgs/msg/ColorRGBA"
    SLOT_TYPES = (
        BasicType('float'),
        BasicType('float'),
        BasicType('float'),
        BasicType('float'),
    )

    if TYPE_CHECKING:
        r: float
        g: float
        b: float
        a: float
        def __init__(self, *, r: float = ..., g: float = ..., b: float = ..., a: float = ...) -> None: ...
    else:
        __slots__ = ["_r", "_g", "_b", "_a"]

        def __init__(self, **fields: Any) -> None:
            self._r = 0.0
            self._g = 0.0
            self._b = 0.0
            self._a = 0.0
            if fields:
                set_fields(self, fields)


class Empty(Message):
    """Message std_msgs/msg/Empty."""

    ROS_TYPE = "std_msgs/msg/Empty"
    SLOT_TYPES = ()

    if TYPE_CHECKING:
        def __init__(self) -> None: ...
    else:
        __slots__ = []

        def __init__(self, **fields: Any) -> None:
            if fields:
                set_fields(self, fields)


class Float32(Message):
    """Message std_msgs/msg/Float32."""

    ROS_TYPE = "std_msgs/msg/Float32"
    SLOT_TYPES = (
        BasicType('float'),
    )

    if TYPE_CHECKING:
        data: float
        def __init__(self, *, data: float = ...) -> None: ...
    else:
        __slots__ = ["_data"]

        def __init__(self, **fields: Any) -> None:
            self._data = 0.0
            if fields:
                set_fields(self, fields)


class Float32MultiArray(Message):
    """Message std_msgs/msg/Float32MultiArray."""

    ROS_TYPE = "std_msgs/msg/Float32MultiArray"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'MultiArrayLayout'),
        UnboundedSequence(BasicType('float')),
    )

    if TYPE_CHECKING:
        layout: MultiArrayLayout
        data = NumberSequence[float]()
        def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[float] = ...) -> None: ...
    else:
        __slots__ = ["_layout", "_data"]

        def __init__(self, **fields: Any) -> None:
            self._layout = fields.get("layout") or MultiArrayLayout()
            self._data = array("f")
            if fields:
                set_fields(self, fields)


class Float64(Message):
    """Message std_msgs/msg/Float64."""

    ROS_TYPE = "std_msgs/msg/Float64"
    SLOT_TYPES = (
        BasicType('double'),
    )

    if TYPE_CHECKING:
        data: float
        def __init__(self, *, data: float = ...) -> None: ...
    else:
        __slots__ = ["_data"]

        def __init__(self, **fields: Any) -> None:
            self._data = 0.0
            if fields:
                set_fields(self, fields)


class Float64MultiArray(Message):
    """Message std_msgs/msg/Float64MultiArray."""

    ROS_TYPE = "std_msgs/msg/Float64MultiArray"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'MultiArrayLayout'),
        UnboundedSequence(BasicType('double')),
    )

    if TYPE_CHECKING:
        layout: MultiArrayLayout
        data = NumberSequence[float]()
        def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[float] = ...) -> None: ...
    else:
        __slots__ = ["_layout", "_data"]

        def __init__(self, **fields: Any) -> None:
            self._layout = fields.get("layout") or MultiArrayLayout()
            self._data = array("d")
            if fields:
                set_fields(self, fields)


class Header(Message):
    """Stamp and frame of the data in a message."""

    ROS_TYPE = "std_msgs/msg/Header"
    SLOT_TYPES = (
        NamespacedType(('builtin_interfaces', 'msg'), 'Time'),
        UnboundedString(),
    )

    if TYPE_CHECKING:
        stamp: Time
        frame_id: str
        def __init__(self, *, stamp: Time = ..., frame_id: str = ...) -> None: ...
    else:
        __slots__ = ["_stamp", "_frame_id"]

        def __init__(self, **fields: Any) -> None:
            self._stamp = fields.get("stamp") or Time()
            self._frame_id = ""
            if fields:
                set_fields(self, fields)


class Int16(Message):
    """Message std_msgs/msg/Int16."""

    ROS_TYPE = "std_msgs/msg/Int16"
    SLOT_TYPES = (
        BasicType('int16'),
    )

    if TYPE_CHECKING:
        data: int
        def __init__(self, *, data: int = ...) -> None: ...
    else:
        __slots__ = ["_data"]

        def __init__(self, **fields: Any) -> None:
            self._data = 0
            if fields:
                set_fields(self, fields)


class Int16MultiArray(Message):
    """Message std_msgs/msg/Int16MultiArray."""

    ROS_TYPE = "std_msgs/msg/Int16MultiArray"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'MultiArrayLayout'),
        UnboundedSequence(BasicType('int16')),
    )

    if TYPE_CHECKING:
        layout: MultiArrayLayout
        data = NumberSequence[int]()
        def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[int] = ...) -> None: ...
    else:
        __slots__ = ["_layout", "_data"]

        def __init__(self, **fields: Any) -> None:
            self._layout = fields.get("layout") or MultiArrayLayout()
            self._data = array("h")
            if fields:
                set_fields(self, fields)


class Int32(Message):
    """Message std_msgs/msg/Int32."""

    ROS_TYPE = "std_msgs/msg/Int32"
    SLOT_TYPES = (
        BasicType('int32'),
    )

    if TYPE_CHECKING:
        data: int
        def __init__(self, *, data: int = ...) -> None: ...
    else:
        __slots__ = ["_data"]

        def __init__(self, **fields: Any) -> None:
            self._data = 0
            if fields:
                set_fields(self, fields)


class Int32MultiArray(Message):
    """Message std_msgs/msg/Int32MultiArray."""

    ROS_TYPE = "std_msgs/msg/Int32MultiArray"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'MultiArrayLayout'),
        UnboundedSequence(BasicType('int32')),
    )

    if TYPE_CHECKING:
        layout: MultiArrayLayout
        data = NumberSequence[int]()
        def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[int] = ...) -> None: ...
    else:
        __slots__ = ["_layout", "_data"]

        def __init__(self, **fields: Any) -> None:
            self._layout = fields.get("layout") or MultiArrayLayout()
            self._data = array("i")
            if fields:
                set_fields(self, fields)


class Int64(Message):
    """Message std_msgs/msg/Int64."""

    ROS_TYPE = "std_msgs/msg/Int64"
    SLOT_TYPES = (
        BasicType('int64'),
    )

    if TYPE_CHECKING:
        data: int
        def __init__(self, *, data: int = ...) -> None: ...
    else:
        __slots__ = ["_data"]

        def __init__(self, **fields: Any) -> None:
            self._data = 0
            if fields:
                set_fields(self, fields)


class Int64MultiArray(Message):
    """Message std_msgs/msg/Int64MultiArray."""

    ROS_TYPE = "std_msgs/msg/Int64MultiArray"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'MultiArrayLayout'),
        UnboundedSequence(BasicType('int64')),
    )

    if TYPE_CHECKING:
        layout: MultiArrayLayout
        data = NumberSequence[int]()
        def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[int] = ...) -> None: ...
    else:
        __slots__ = ["_layout", "_data"]

        def __init__(self, **fields: Any) -> None:
            self._layout = fields.get("layout") or MultiArrayLayout()
            self._data = array("q")
            if fields:
                set_fields(self, fields)


class Int8(Message):
    """Message std_msgs/msg/Int8."""

    ROS_TYPE = "std_msgs/msg/Int8"
    SLOT_TYPES = (
        BasicType('int8'),
    )

    if TYPE_CHECKING:
        data: int
        def __init__(self, *, data: int = ...) -> None: ...
    else:
        __slots__ = ["_data"]

        def __init__(self, **fields: Any) -> None:
            self._data = 0
            if fields:
                set_fields(self, fields)


class Int8MultiArray(Message):
    """Message std_msgs/msg/Int8MultiArray."""

    ROS_TYPE = "std_msgs/msg/Int8MultiArray"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'MultiArrayLayout'),
        UnboundedSequence(BasicType('int8')),
    )

    if TYPE_CHECKING:
        layout: MultiArrayLayout
        data = NumberSequence[int]()
        def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[int] = ...) -> None: ...
    else:
        __slots__ = ["_layout", "_data"]

        def __init__(self, **fields: Any) -> None:
            self._layout = fields.get("layout") or MultiArrayLayout()
            self._data = array("b")
            if fields:
                set_fields(self, fields)


class String(Message):
    """Message std_msgs/msg/String."""

    ROS_TYPE = "std_msgs/msg/String"
    SLOT_TYPES = (
        UnboundedString(),
    )

    if TYPE_CHECKING:
        data: str
        def __init__(self, *, data: str = ...) -> None: ...
    else:
        __slots__ = ["_data"]

        def __init__(self, **fields: Any) -> None:
            self._data = ""
            if fields:
                set_fields(self, fields)


class UInt16(Message):
    """Message std_msgs/msg/UInt16."""

    ROS_TYPE = "std_msgs/msg/UInt16"
    SLOT_TYPES = (
        BasicType('uint16'),
    )

    if TYPE_CHECKING:
        data: int
        def __init__(self, *, data: int = ...) -> None: ...
    else:
        __slots__ = ["_data"]

        def __init__(self, **fields: Any) -> None:
            self._data = 0
            if fields:
                set_fields(self, fields)


class UInt16MultiArray(Message):
    """Message std_msgs/msg/UInt16MultiArray."""

    ROS_TYPE = "std_msgs/msg/UInt16MultiArray"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'MultiArrayLayout'),
        UnboundedSequence(BasicType('uint16')),
    )

    if TYPE_CHECKING:
        layout: MultiArrayLayout
        data = NumberSequence[int]()
        def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[int] = ...) -> None: ...
    else:
        __slots__ = ["_layout", "_data"]

        def __init__(self, **fields: Any) -> None:
            self._layout = fields.get("layout") or MultiArrayLayout()
            self._data = array("H")
            if fields:
                set_fields(self, fields)


class UInt32(Message):
    """Message std_msgs/msg/UInt32."""

    ROS_TYPE = "std_msgs/msg/UInt32"
    SLOT_TYPES = (
        BasicType('uint32'),
    )

    if TYPE_CHECKING:
        data: int
        def __init__(self, *, data: int = ...) -> None: ...
    else:
        __slots__ = ["_data"]

        def __init__(self, **fields: Any) -> None:
            self._data = 0
            if fields:
                set_fields(self, fields)


class UInt32MultiArray(Message):
    """Message std_msgs/msg/UInt32MultiArray."""

    ROS_TYPE = "std_msgs/msg/UInt32MultiArray"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'MultiArrayLayout'),
        UnboundedSequence(BasicType('uint32')),
    )

    if TYPE_CHECKING:
        layout: MultiArrayLayout
        data = NumberSequence[int]()
        def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[int] = ...) -> None: ...
    else:
        __slots__ = ["_layout", "_data"]

        def __init__(self, **fields: Any) -> None:
            self._layout = fields.get("layout") or MultiArrayLayout()
            self._data = array("I")
            if fields:
                set_fields(self, fields)


class UInt64(Message):
    """Message std_msgs/msg/UInt64."""

    ROS_TYPE = "std_msgs/msg/UInt64"
    SLOT_TYPES = (
        BasicType('uint64'),
    )

    if TYPE_CHECKING:
        data: int
        def __init__(self, *, data: int = ...) -> None: ...
    else:
        __slots__ = ["_data"]

        def __init__(self, **fields: Any) -> None:
            self._data = 0
            if fields:
                set_fields(self, fields)


class UInt64MultiArray(Message):
    """Message std_msgs/msg/UInt64MultiArray."""

    ROS_TYPE = "std_msgs/msg/UInt64MultiArray"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'MultiArrayLayout'),
        UnboundedSequence(BasicType('uint64')),
    )

    if TYPE_CHECKING:
        layout: MultiArrayLayout
        data = NumberSequence[int]()
        def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[int] = ...) -> None: ...
    else:
        __slots__ = ["_layout", "_data"]

        def __init__(self, **fields: Any) -> None:
            self._layout = fields.get("layout") or MultiArrayLayout()
            self._data = array("Q")
            if fields:
                set_fields(self, fields)


class UInt8(Message):
    """Message std_msgs/msg/UInt8."""

    ROS_TYPE = "std_msgs/msg/UInt8"
    SLOT_TYPES = (
        BasicType('uint8'),
    )

    if TYPE_CHECKING:
        data: int
        def __init__(self, *, data: int = ...) -> None: ...
    else:
        __slots__ = ["_data"]

        def __init__(self, **fields: Any) -> None:
            self._data = 0
            if fields:
                set_fields(self, fields)


class UInt8MultiArray(Message):
    """Message std_msgs/msg/UInt8MultiArray."""

    ROS_TYPE = "std_msgs/msg/UInt8MultiArray"
    SLOT_TYPES = (
        NamespacedType(('std_msgs', 'msg'), 'MultiArrayLayout'),
        UnboundedSequence(BasicType('uint8')),
    )

    if TYPE_CHECKING:
        layout: MultiArrayLayout
        data = NumberSequence[int]()
        def __init__(self, *, layout: MultiArrayLayout = ..., data: Iterable[int] = ...) -> None: ...
    else:
        __slots__ = ["_layout", "_data"]

        def __init__(self, **fields: Any) -> None:
            self._layout = fields.get("layout") or MultiArrayLayout()
            self._data = array("B")
            if fields:
                set_fields(self, fields)
