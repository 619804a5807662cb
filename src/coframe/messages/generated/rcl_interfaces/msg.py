# Written by scripts/generate_messages.py from interfaces/rcl_interfaces/msg; do not edit.
"""Messages of rcl_interfaces."""

from __future__ import annotations

from array import array
from typing import TYPE_CHECKING, Any, Final

from coframe.distributions import follows
from coframe.messages.definition import BasicType, BoundedSequence, NamespacedType, UnboundedSequence, UnboundedString
from coframe.messages.message import Message, set_fields
from coframe.messages.generated.builtin_interfaces.msg import Time

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.messages._hints import NumberSequence


class FloatingPointRange(Message):
    """Message rcl_interfaces/msg/FloatingPointRange."""

    ROS_TYPE = "rcl_interfaces/msg/FloatingPointRange"
    SLOT_TYPES = (
        BasicType('double'),
        BasicType('double'),
        BasicType('double'),
    )

    if TYPE_CHECKING:
        from_value: float
        to_value: float
        step: float
        def __init__(self, *, from_value: float = ..., to_value: float = ..., step: float = ...) -> None: ...
    else:
        __slots__ = ["_from_value", "_to_value", "_step"]

        def __init__(self, **fields: Any) -> None:
            self._from_value = 0.0
            self._to_value = 0.0
            self._step = 0.0
            if fields:
                set_fields(self, fields)


class IntegerRange(Message):
    """Message rcl_interfaces/msg/IntegerRange."""

    ROS_TYPE = "rcl_interfaces/msg/IntegerRange"
    SLOT_TYPES = (
        BasicType('int64'),
        BasicType('int64'),
        BasicType('uint64'),
    )

    if TYPE_CHECKING:
        from_value: int
        to_value: int
        step: int
        def __init__(self, *, from_value: int = ..., to_value: int = ..., step: int = ...) -> None: ...
    else:
        __slots__ = ["_from_value", "_to_value", "_step"]

        def __init__(self, **fields: Any) -> None:
            self._from_value = 0
            self._to_value = 0
            self._step = 0
            if fields:
                set_fields(self, fields)


class ListParametersResult(Message):
    """Message rcl_interfaces/msg/ListParametersResult."""

    ROS_TYPE = "rcl_interfaces/msg/ListParametersResult"
    SLOT_TYPES = (
        UnboundedSequence(UnboundedString()),
        UnboundedSequence(UnboundedString()),
    )

    if TYPE_CHECKING:
        names: list[str]
        prefixes: list[str]
        def __init__(self, *, names: list[str] = ..., prefixes: list[str] = ...) -> None: ...
    else:
        __slots__ = ["_names", "_prefixes"]

        def __init__(self, **fields: Any) -> None:
            self._names = []
            self._prefixes = []
            if fields:
                set_fields(self, fields)


if TYPE_CHECKING or not follows("humble"):
    class Log(Message):
        """Message rcl_interfaces/msg/Log."""

        ROS_TYPE = "rcl_interfaces/msg/Log"
        SLOT_TYPES = (
            NamespacedType(('builtin_interfaces', 'msg'), 'Time'),
            BasicType('uint8'),
            UnboundedString(),
            UnboundedString(),
            UnboundedString(),
            UnboundedString(),
            BasicType('uint32'),
        )
        DEBUG: Final = 10
        INFO: Final = 20
        WARN: Final = 30
        ERROR: Final = 40
        FATAL: Final = 50

        if TYPE_CHECKING:
            stamp: Time
            level: int
            name: str
            msg: str
            file: str
            function: str
            line: int
            def __init__(self, *, stamp: Time = ..., level: int = ..., name: str = ..., msg: str = ..., file: str = ..., function: str = ..., line: int = ...) -> None: ...
        else:
            __slots__ = ["_stamp", "_level", "_name", "_msg", "_file", "_function", "_line"]

            def __init__(self, **fields: Any) -> None:
                self._stamp = fields.get("stamp") or Time()
                self._level = 0
                self._name = ""
                self._msg = ""
                self._file = ""
                self._function = ""
                self._line = 0
                if fields:
                    set_fields(self, fields)

else:
    class Log(Message):
        """Message rcl_interfaces/msg/Log."""

        ROS_TYPE = "rcl_interfaces/msg/Log"
        SLOT_TYPES = (
            NamespacedType(('builtin_interfaces', 'msg'), 'Time'),
            BasicType('uint8'),
            UnboundedString(),
            UnboundedString(),
            UnboundedString(),
            UnboundedString(),
            BasicType('uint32'),
        )
        DEBUG: Final = b'\n'
        INFO: Final = b'\x14'
        WARN: Final = b'\x1e'
        ERROR: Final = b'('
        FATAL: Final = b'2'

        if TYPE_CHECKING:
            stamp: Time
            level: int
            name: str
            msg: str
            file: str
            function: str
            line: int
            def __init__(self, *, stamp: Time = ..., level: int = ..., name: str = ..., msg: str = ..., file: str = ..., function: str = ..., line: int = ...) -> None: ...
        else:
            __slots__ = ["_stamp", "_level", "_name", "_msg", "_file", "_function", "_line"]

            def __init__(self, **fields: Any) -> None:
                self._stamp = fields.get("stamp") or Time()
                self._level = 0
                self._name = ""
                self._msg = ""
                self._file = ""
                self._function = ""
                self._line = 0
                if fields:
                    set_fields(self, fields)


class LoggerLevel(Message):
    """Message rcl_interfaces/msg/LoggerLevel."""

    ROS_TYPE = "rcl_interfaces/msg/LoggerLevel"
    SLOT_TYPES = (
        UnboundedString(),
        BasicType('uint32'),
    )
    LOG_LEVEL_UNKNOWN: Final = 0
    LOG_LEVEL_DEBUG: Final = 10
    LOG_LEVEL_INFO: Final = 20
    LOG_LEVEL_WARN: Final = 30
    LOG_LEVEL_ERROR: Final = 40
    LOG_LEVEL_FATAL: Final = 50

    if TYPE_CHECKING:
        name: str
        level: int
        def __init__(self, *, name: str = ..., level: int = ...) -> None: ...
    else:
        __slots__ = ["_name", "_level"]

        def __init__(self, **fields: Any) -> None:
            self._name = ""
            self._level = 0
            if fields:
                set_fields(self, fields)


class ParameterValue(Message):
    """The value of a parameter; type selects the member that contains it."""

    ROS_TYPE = "rcl_interfaces/msg/ParameterValue"
    SLOT_TYPES = (
        BasicType('uint8'),
        BasicType('boolean'),
        BasicType('int64'),
        BasicType('double'),
        UnboundedString(),
        UnboundedSequence(BasicType('octet')),
        UnboundedSequence(BasicType('boolean')),
        UnboundedSequence(BasicType('int64')),
        UnboundedSequence(BasicType('double')),
        UnboundedSequence(UnboundedString()),
    )

    if TYPE_CHECKING:
        type: int
        bool_value: bool
        integer_value: int
        double_value: float
        string_value: str
        byte_array_value: list[bytes]
        bool_array_value: list[bool]
        integer_array_value = NumberSequence[int]()
        double_array_value = NumberSequence[float]()
        string_array_value: list[str]
        def __init__(self, *, type: int = ..., bool_value: bool = ..., integer_value: int = ..., double_value: float = ..., string_value: str = ..., byte_array_value: list[bytes] = ..., bool_array_value: list[bool] = ..., integer_array_value: Iterable[int] = ..., double_array_value: Iterable[float] = ..., string_array_value: list[str] = ...) -> None: ...
    else:
        __slots__ = ["_type", "_bool_value", "_integer_value", "_double_value", "_string_value", "_byte_array_value", "_bool_array_value", "_integer_array_value", "_double_array_value", "_string_array_value"]

        def __init__(self, **fields: Any) -> None:
            self._type = 0
            self._bool_value = False
            self._integer_value = 0
            self._double_value = 0.0
            self._string_value = ""
            self._byte_array_value = []
            self._bool_array_value = []
            self._integer_array_value = array("q")
            self._double_array_value = array("d")
            self._string_array_value = []
            if fields:
                set_fields(self, fields)


class Parameter(Message):
    """Message rcl_interfaces/msg/Parameter."""

    ROS_TYPE = "rcl_interfaces/msg/Parameter"
    SLOT_TYPES = (
        UnboundedString(),
        NamespacedType(('rcl_interfaces', 'msg'), 'ParameterValue'),
    )

    if TYPE_CHECKING:
        name: str
        value: ParameterValue
        def __init__(self, *, name: str = ..., value: ParameterValue = ...) -> None: ...
    else:
        __slots__ = ["_name", "_value"]

        def __init__(self, **fields: Any) -> None:
            self._name = ""
            self._value = fields.get("value") or ParameterValue()
            if fields:
                set_fields(self, fields)


class ParameterDescriptor(Message):
    """Message rcl_interfaces/msg/ParameterDescriptor."""

    ROS_TYPE = "rcl_interfaces/msg/ParameterDescriptor"
    SLOT_TYPES = (
        UnboundedString(),
        BasicType('uint8'),
        UnboundedString(),
        UnboundedString(),
        BasicType('boolean'),
        BasicType('boolean'),
        BoundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'FloatingPointRange'), 1),
        BoundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'IntegerRange'), 1),
    )
    READ_ONLY__DEFAULT: Final = False
    DYNAMIC_TYPING__DEFAULT: Final = False

    if TYPE_CHECKING:
        name: str
        type: int
        description: str
        additional_constraints: str
        read_only: bool
        dynamic_typing: bool
        floating_point_range: list[FloatingPointRange]
        integer_range: list[IntegerRange]
        def __init__(self, *, name: str = ..., type: int = ..., description: str = ..., additional_constraints: str = ..., read_only: bool = ..., dynamic_typing: bool = ..., floating_point_range: list[FloatingPointRange] = ..., integer_range: list[IntegerRange] = ...) -> None: ...
    else:
        __slots__ = ["_name", "_type", "_description", "_additional_constraints", "_read_only", "_dynamic_typing", "_floating_point_range", "_integer_range"]

        def __init__(self, **fields: Any) -> None:
            self._name = ""
            self._type = 0
            self._description = ""
            self._additional_constraints = ""
            self._read_only = False
            self._dynamic_typing = False
            self._floating_point_range = []
            self._integer_range = []
            if fields:
                set_fields(self, fields)


class ParameterEvent(Message):
    """Message rcl_interfaces/msg/ParameterEvent."""

    ROS_TYPE = "rcl_interfaces/msg/ParameterEvent"
    SLOT_TYPES = (
        NamespacedType(('builtin_interfaces', 'msg'), 'Time'),
        UnboundedString(),
        UnboundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'Parameter')),
        UnboundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'Parameter')),
        UnboundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'Parameter')),
    )

    if TYPE_CHECKING:
        stamp: Time
        node: str
        new_parameters: list[Parameter]
        changed_parameters: list[Parameter]
        deleted_parameters: list[Parameter]
        def __init__(self, *, stamp: Time = ..., node: str = ..., new_parameters: list[Parameter] = ..., changed_parameters: list[Parameter] = ..., deleted_parameters: list[Parameter] = ...) -> None: ...
    else:
        __slots__ = ["_stamp", "_node", "_new_parameters", "_changed_parameters", "_deleted_parameters"]

        def __init__(self, **fields: Any) -> None:
            self._stamp = fields.get("stamp") or Time()
            self._node = ""
            self._new_parameters = []
            self._changed_parameters = []
            self._deleted_parameters = []
            if fields:
                set_fields(self, fields)


class ParameterEventDescriptors(Message):
    """Message rcl_interfaces/msg/ParameterEventDescriptors."""

    ROS_TYPE = "rcl_interfaces/msg/ParameterEventDescriptors"
    SLOT_TYPES = (
        UnboundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'ParameterDescriptor')),
        UnboundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'ParameterDescriptor')),
        UnboundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'ParameterDescriptor')),
    )

    if TYPE_CHECKING:
        new_parameters: list[ParameterDescriptor]
        changed_parameters: list[ParameterDescriptor]
        deleted_parameters: list[ParameterDescriptor]
        def __init__(self, *, new_parameters: list[ParameterDescriptor] = ..., changed_parameters: list[ParameterDescriptor] = ..., deleted_parameters: list[ParameterDescriptor] = ...) -> None: ...
    else:
        __slots__ = ["_new_parameters", "_changed_parameters", "_deleted_parameters"]

        def __init__(self, **fields: Any) -> None:
            self._new_parameters = []
            self._changed_parameters = []
            self._deleted_parameters = []
            if fields:
                set_fields(self, fields)


class ParameterType(Message):
    """Message rcl_interfaces/msg/ParameterType."""

    ROS_TYPE = "rcl_interfaces/msg/ParameterType"
    SLOT_TYPES = ()
    PARAMETER_NOT_SET: Final = 0
    PARAMETER_BOOL: Final = 1
    PARAMETER_INTEGER: Final = 2
    PARAMETER_DOUBLE: Final = 3
    PARAMETER_STRING: Final = 4
    PARAMETER_BYTE_ARRAY: Final = 5
    PARAMETER_BOOL_ARRAY: Final = 6
    PARAMETER_INTEGER_ARRAY: Final = 7
    PARAMETER_DOUBLE_ARRAY: Final = 8
    PARAMETER_STRING_ARRAY: Final = 9

    if TYPE_CHECKING:
        def __init__(self) -> None: ...
    else:
        __slots__ = []

        def __init__(self, **fields: Any) -> None:
            if fields:
                set_fields(self, fields)


class SetLoggerLevelsResult(Message):
    """Message rcl_interfaces/msg/SetLoggerLevelsResult."""

    ROS_TYPE = "rcl_interfaces/msg/SetLoggerLevelsResult"
    SLOT_TYPES = (
        BasicType('boolean'),
        UnboundedString(),
    )

    if TYPE_CHECKING:
        successful: bool
        reason: str
        def __init__(self, *, successful: bool = ..., reason: str = ...) -> None: ...
    else:
        __slots__ = ["_successful", "_reason"]

        def __init__(self, **fields: Any) -> None:
            self._successful = False
            self._reason = ""
            if fields:
                set_fields(self, fields)


class SetParametersResult(Message):
    """Message rcl_interfaces/msg/SetParametersResult."""

    ROS_TYPE = "rcl_interfaces/msg/SetParametersResult"
    SLOT_TYPES = (
        BasicType('boolean'),
        UnboundedString(),
    )

    if TYPE_CHECKING:
        successful: bool
        reason: str
        def __init__(self, *, successful: bool = ..., reason: str = ...) -> None: ...
    else:
        __slots__ = ["_successful", "_reason"]

        def __init__(self, **fields: Any) -> None:
            self._successful = False
            self._reason = ""
            if fields:
                set_fields(self, fields)
