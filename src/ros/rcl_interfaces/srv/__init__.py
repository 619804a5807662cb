# Written by scripts/generate_messages.py from interfaces/rcl_interfaces/srv; do not edit.
"""Services of rcl_interfaces."""

from coframe.messages.events import event_attributes
from coframe.messages.generated.rcl_interfaces.srv import (
    DescribeParameters,
    DescribeParameters_Request,
    DescribeParameters_Response,
    GetLoggerLevels,
    GetLoggerLevels_Request,
    GetLoggerLevels_Response,
    GetParameters,
    GetParameters_Request,
    GetParameters_Response,
    GetParameterTypes,
    GetParameterTypes_Request,
    GetParameterTypes_Response,
    ListParameters,
    ListParameters_Request,
    ListParameters_Response,
    SetLoggerLevels,
    SetLoggerLevels_Request,
    SetLoggerLevels_Response,
    SetParameters,
    SetParameters_Request,
    SetParameters_Response,
    SetParametersAtomically,
    SetParametersAtomically_Request,
    SetParametersAtomically_Response,
)

__all__ = [
    "DescribeParameters",
    "DescribeParameters_Request",
    "DescribeParameters_Response",
    "GetLoggerLevels",
    "GetLoggerLevels_Request",
    "GetLoggerLevels_Response",
    "GetParameterTypes",
    "GetParameterTypes_Request",
    "GetParameterTypes_Response",
    "GetParameters",
    "GetParameters_Request",
    "GetParameters_Response",
    "ListParameters",
    "ListParameters_Request",
    "ListParameters_Response",
    "SetLoggerLevels",
    "SetLoggerLevels_Request",
    "SetLoggerLevels_Response",
    "SetParameters",
    "SetParametersAtomically",
    "SetParametersAtomically_Request",
    "SetParametersAtomically_Response",
    "SetParameters_Request",
    "SetParameters_Response",
]

__getattr__ = event_attributes("rcl_interfaces", "srv")
