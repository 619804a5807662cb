# Written by scripts/generate_messages.py from interfaces/std_srvs/srv; do not edit.
"""Services of std_srvs."""

from coframe.messages.events import event_attributes
from coframe.messages.generated.std_srvs.srv import (
    Empty,
    Empty_Request,
    Empty_Response,
    SetBool,
    SetBool_Request,
    SetBool_Response,
    Trigger,
    Trigger_Request,
    Trigger_Response,
)

__all__ = [
    "Empty",
    "Empty_Request",
    "Empty_Response",
    "SetBool",
    "SetBool_Request",
    "SetBool_Response",
    "Trigger",
    "Trigger_Request",
    "Trigger_Response",
]

__getattr__ = event_attributes("std_srvs", "srv")
