# Written by scripts/generate_messages.py from interfaces/rcl_interfaces/msg; do not edit.
"""Messages of rcl_interfaces."""

from coframe.messages.generated.rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ListParametersResult,
    Log,
    LoggerLevel,
    Parameter,
    ParameterDescriptor,
    ParameterEvent,
    ParameterEventDescriptors,
    ParameterType,
    ParameterValue,
    SetLoggerLevelsResult,
    SetParametersResult,
)

__all__ = [
    "FloatingPointRange",
    "IntegerRange",
    "ListParametersResult",
    "Log",
    "LoggerLevel",
    "Parameter",
    "ParameterDescriptor",
    "ParameterEvent",
    "ParameterEventDescriptors",
    "ParameterType",
    "ParameterValue",
    "SetLoggerLevelsResult",
    "SetParametersResult",
]
