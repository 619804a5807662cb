# Written by scripts/generate_messages.py from interfaces/service_msgs/msg; do not edit.
import builtin_interfaces.msg
import numpy as np
from collections.abc import Iterable
from typing import Final, TypeAlias

from coframe.messages._hints import NumberArray, NumberSequence
from coframe.messages.message import Action, Message, Service

__all__ = ["ServiceEventInfo"]

class ServiceEventInfo(Message):
    REQUEST_SENT: Final = 0
    REQUEST_RECEIVED: Final = 1
    RESPONSE_SENT: Final = 2
    RESPONSE_RECEIVED: Final = 3
    event_type: int
    stamp: builtin_interfaces.msg.Time
    client_gid: NumberArray[np.uint8]
    sequence_number: int
    def __init__(self, *, event_type: int = ..., stamp: builtin_interfaces.msg.Time = ..., client_gid: Iterable[int] = ..., sequence_number: int = ...) -> None: ...

