# Written by scripts/generate_messages.py from interfaces/rcl_interfaces/srv; do not edit.
"""Services of rcl_interfaces."""

from __future__ import annotations

from array import array
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from coframe.messages.definition import BasicType, NamespacedType, UnboundedSequence, UnboundedString
from coframe.messages.message import Message, Service, set_fields
from coframe.messages.generated.rcl_interfaces.msg import ListParametersResult, LoggerLevel, Parameter, ParameterDescriptor, ParameterValue, SetLoggerLevelsResult, SetParametersResult

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.messages._hints import NumberSequence


class DescribeParameters_Request(Message):
    """Message rcl_interfaces/srv/DescribeParameters_Request."""

    ROS_TYPE = "rcl_interfaces/srv/DescribeParameters_Request"
    SLOT_TYPES = (
        UnboundedSequence(UnboundedString()),
    )

    if TYPE_CHECKING:
        names: list[str]
        def __init__(self, *, names: list[str] = ...) -> None: ...
    else:
        __slots__ = ["_names"]

        def __init__(self, **fields: Any) -> None:
            self._names = []
            if fields:
                set_fields(self, fields)


class DescribeParameters_Response(Message):
    """Message rcl_interfaces/srv/DescribeParameters_Response."""

    ROS_TYPE = "rcl_interfaces/srv/DescribeParameters_Response"
    SLOT_TYPES = (
        UnboundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'ParameterDescriptor')),
    )

    if TYPE_CHECKING:
        descriptors: list[ParameterDescriptor]
        def __init__(self, *, descriptors: list[ParameterDescriptor] = ...) -> None: ...
    else:
        __slots__ = ["_descriptors"]

        def __init__(self, **fields: Any) -> None:
            self._descriptors = []
            if fields:
                set_fields(self, fields)


class GetLoggerLevels_Request(Message):
    """Message rcl_interfaces/srv/GetLoggerLevels_Request."""

    ROS_TYPE = "rcl_interfaces/srv/GetLoggerLevels_Request"
    SLOT_TYPES = (
        UnboundedSequence(UnboundedString()),
    )

    if TYPE_CHECKING:
        names: list[str]
        def __init__(self, *, names: list[str] = ...) -> None: ...
    else:
        __slots__ = ["_names"]

        def __init__(self, **fields: Any) -> None:
            self._names = []
            if fields:
                set_fields(self, fields)


class GetLoggerLevels_Response(Message):
    """Message rcl_interfaces/srv/GetLoggerLevels_Response."""

    ROS_TYPE = "rcl_interfaces/srv/GetLoggerLevels_Response"
    SLOT_TYPES = (
        UnboundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'LoggerLevel')),
    )

    if TYPE_CHECKING:
        levels: list[LoggerLevel]
        def __init__(self, *, levels: list[LoggerLevel] = ...) -> None: ...
    else:
        __slots__ = ["_levels"]

        def __init__(self, **fields: Any) -> None:
            self._levels = []
            if fields:
                set_fields(self, fields)


class GetParameterTypes_Request(Message):
    """Message rcl_interfaces/srv/GetParameterTypes_Request."""

    ROS_TYPE = "rcl_interfaces/srv/GetParameterTypes_Request"
    SLOT_TYPES = (
        UnboundedSequence(UnboundedString()),
    )

    if TYPE_CHECKING:
        names: list[str]
        def __init__(self, *, names: list[str] = ...) -> None: ...
    else:
        __slots__ = ["_names"]

        def __init__(self, **fields: Any) -> None:
            self._names = []
            if fields:
                set_fields(self, fields)


class GetParameterTypes_Response(Message):
    """Message rcl_interfaces/srv/GetParameterTypes_Response."""

    ROS_TYPE = "rcl_interfaces/srv/GetParameterTypes_Response"
    SLOT_TYPES = (
        UnboundedSequence(BasicType('uint8')),
    )

    if TYPE_CHECKING:
        types = NumberSequence[int]()
        def __init__(self, *, types: Iterable[int] = ...) -> None: ...
    else:
        __slots__ = ["_types"]

        def __init__(self, **fields: Any) -> None:
            self._types = array("B")
            if fields:
                set_fields(self, fields)


class GetParameters_Request(Message):
    """Message rcl_interfaces/srv/GetParameters_Request."""

    ROS_TYPE = "rcl_interfaces/srv/GetParameters_Request"
    SLOT_TYPES = (
        UnboundedSequence(UnboundedString()),
    )

    if TYPE_CHECKING:
        names: list[str]
        def __init__(self, *, names: list[str] = ...) -> None: ...
    else:
        __slots__ = ["_names"]

        def __init__(self, **fields: Any) -> None:
            self._names = []
            if fields:
                set_fields(self, fields)


class GetParameters_Response(Message):
    """Message rcl_interfaces/srv/GetParameters_Response."""

    ROS_TYPE = "rcl_interfaces/srv/GetParameters_Response"
    SLOT_TYPES = (
        UnboundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'ParameterValue')),
    )

    if TYPE_CHECKING:
        values: list[ParameterValue]
        def __init__(self, *, values: list[ParameterValue] = ...) -> None: ...
    else:
        __slots__ = ["_values"]

        def __init__(self, **fields: Any) -> None:
            self._values = []
            if fields:
                set_fields(self, fields)


class ListParameters_Request(Message):
    """Message rcl_interfaces/srv/ListParameters_Request."""

    ROS_TYPE = "rcl_interfaces/srv/ListParameters_Request"
    SLOT_TYPES = (
        UnboundedSequence(UnboundedString()),
        BasicType('uint64'),
    )
    DEPTH_RECURSIVE: Final = 0

    if TYPE_CHECKING:
        prefixes: list[str]
        depth: int
        def __init__(self, *, prefixes: list[str] = ..., depth: int = ...) -> None: ...
    else:
        __slots__ = ["_prefixes", "_depth"]

        def __init__(self, **fields: Any) -> None:
            self._prefixes = []
            self._depth = 0
            if fields:
                set_fields(self, fields)


class ListParameters_Response(Message):
    """Message rcl_interfaces/srv/ListParameters_Response."""

    ROS_TYPE = "rcl_interfaces/srv/ListParameters_Response"
    SLOT_TYPES = (
        NamespacedType(('rcl_interfaces', 'msg'), 'ListParametersResult'),
    )

    if TYPE_CHECKING:
        result: ListParametersResult
        def __init__(self, *, result: ListParametersResult = ...) -> None: ...
    else:
        __slots__ = ["_result"]

        def __init__(self, **fields: Any) -> None:
            self._result = fields.get("result") or ListParametersResult()
            if fields:
                set_fields(self, fields)


class SetLoggerLevels_Request(Message):
    """Message rcl_interfaces/srv/SetLoggerLevels_Request."""

    ROS_TYPE = "rcl_interfaces/srv/SetLoggerLevels_Request"
    SLOT_TYPES = (
        UnboundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'LoggerLevel')),
    )

    if TYPE_CHECKING:
        levels: list[LoggerLevel]
        def __init__(self, *, levels: list[LoggerLevel] = ...) -> None: ...
    else:
        __slots__ = ["_levels"]

        def __init__(self, **fields: Any) -> None:
            self._levels = []
            if fields:
                set_fields(self, fields)


class SetLoggerLevels_Response(Message):
    """Message rcl_interfaces/srv/SetLoggerLevels_Response."""

    ROS_TYPE = "rcl_interfaces/srv/SetLoggerLevels_Response"
    SLOT_TYPES = (
        UnboundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'SetLoggerLevelsResult')),
    )

    if TYPE_CHECKING:
        results: list[SetLoggerLevelsResult]
        def __init__(self, *, results: list[SetLoggerLevelsResult] = ...) -> None: ...
    else:
        __slots__ = ["_results"]

        def __init__(self, **fields: Any) -> None:
            self._results = []
            if fields:
                set_fields(self, fields)


class SetParameters_Request(Message):
    """Message rcl_interfaces/srv/SetParameters_Request."""

    ROS_TYPE = "rcl_interfaces/srv/SetParameters_Request"
    SLOT_TYPES = (
        UnboundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'Parameter')),
    )

    if TYPE_CHECKING:
        parameters: list[Parameter]
        def __init__(self, *, parameters: list[Parameter] = ...) -> None: ...
    else:
        __slots__ = ["_parameters"]

        def __init__(self, **fields: Any) -> None:
            self._parameters = []
            if fields:
                set_fields(self, fields)


class SetParameters_Response(Message):
    """Message rcl_interfaces/srv/SetParameters_Response."""

    ROS_TYPE = "rcl_interfaces/srv/SetParameters_Response"
    SLOT_TYPES = (
        UnboundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'SetParametersResult')),
    )

    if TYPE_CHECKING:
        results: list[SetParametersResult]
        def __init__(self, *, results: list[SetParametersResult] = ...) -> None: ...
    else:
        __slots__ = ["_results"]

        def __init__(self, **fields: Any) -> None:
            self._results = []
            if fields:
                set_fields(self, fields)


class SetParametersAtomically_Request(Message):
    """Message rcl_interfaces/srv/SetParametersAtomically_Request."""

    ROS_TYPE = "rcl_interfaces/srv/SetParametersAtomically_Request"
    SLOT_TYPES = (
        UnboundedSequence(NamespacedType(('rcl_interfaces', 'msg'), 'Parameter')),
    )

    if TYPE_CHECKING:
        parameters: list[Parameter]
        def __init__(self, *, parameters: list[Parameter] = ...) -> None: ...
    else:
        __slots__ = ["_parameters"]

        def __init__(self, **fields: Any) -> None:
            self._parameters = []
            if fields:
                set_fields(self, fields)


class SetParametersAtomically_Response(Message):
    """Message rcl_interfaces/srv/SetParametersAtomically_Response."""

    ROS_TYPE = "rcl_interfaces/srv/SetParametersAtomically_Response"
    SLOT_TYPES = (
        NamespacedType(('rcl_interfaces', 'msg'), 'SetParametersResult'),
    )

    if TYPE_CHECKING:
        result: SetParametersResult
        def __init__(self, *, result: SetParametersResult = ...) -> None: ...
    else:
        __slots__ = ["_result"]

        def __init__(self, **fields: Any) -> None:
            self._result = fields.get("result") or SetParametersResult()
            if fields:
                set_fields(self, fields)


class DescribeParameters(Service):
    """Service rcl_interfaces/srv/DescribeParameters."""

    ROS_TYPE = "rcl_interfaces/srv/DescribeParameters"
    Request: TypeAlias = DescribeParameters_Request
    Response: TypeAlias = DescribeParameters_Response


class GetLoggerLevels(Service):
    """Service rcl_interfaces/srv/GetLoggerLevels."""

    ROS_TYPE = "rcl_interfaces/srv/GetLoggerLevels"
    Request: TypeAlias = GetLoggerLevels_Request
    Response: TypeAlias = GetLoggerLevels_Response


class GetParameterTypes(Service):
    """Service rcl_interfaces/srv/GetParameterTypes."""

    ROS_TYPE = "rcl_interfaces/srv/GetParameterTypes"
    Request: TypeAlias = GetParameterTypes_Request
    Response: TypeAlias = GetParameterTypes_Response


class GetParameters(Service):
    """Service rcl_interfaces/srv/GetParameters."""

    ROS_TYPE = "rcl_interfaces/srv/GetParameters"
    Request: TypeAlias = GetParameters_Request
    Response: TypeAlias = GetParameters_Response


class ListParameters(Service):
    """Service rcl_interfaces/srv/ListParameters."""

    ROS_TYPE = "rcl_interfaces/srv/ListParameters"
    Request: TypeAlias = ListParameters_Request
    Response: TypeAlias = ListParameters_Response


class SetLoggerLevels(Service):
    """Service rcl_interfaces/srv/SetLoggerLevels."""

    ROS_TYPE = "rcl_interfaces/srv/SetLoggerLevels"
    Request: TypeAlias = SetLoggerLevels_Request
    Response: TypeAlias = SetLoggerLevels_Response


class SetParameters(Service):
    """Service rcl_interfaces/srv/SetParameters."""

    ROS_TYPE = "rcl_interfaces/srv/SetParameters"
    Request: TypeAlias = SetParameters_Request
    Response: TypeAlias = SetParameters_Response


class SetParametersAtomically(Service):
    """Service rcl_interfaces/srv/SetParametersAtomically."""

    ROS_TYPE = "rcl_interfaces/srv/SetParametersAtomically"
    Request: TypeAlias = SetParametersAtomically_Request
    Response: TypeAlias = SetParametersAtomically_Response
