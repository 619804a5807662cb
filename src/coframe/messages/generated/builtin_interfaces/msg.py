# Written by scripts/generate_messages.py from interfaces/builtin_interfaces/msg; do not edit.
"""Messages of builtin_interfaces."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from coframe.messages.definition import BasicType
from coframe.messages.message import Message, set_fields


class Duration(Message):
    """A duration; nanosec is added to sec, even if sec is negative."""

    ROS_TYPE = "builtin_interfaces/msg/Duration"
    SLOT_TYPES = (
        BasicType('int32'),
        BasicType('uint32'),
    )

    if TYPE_CHECKING:
        sec: int
        nanosec: int
        def __init__(self, *, sec: int = ..., nanosec: int = ...) -> None: ...
    else:
        __slots__ = ["_sec", "_nanosec"]

        def __init__(self, **fields: Any) -> None:
            self._sec = 0
            self._nanosec = 0
            if fields:
                set_fields(self, fields)


class Time(Message):
    """A point in time, in seconds and nanoseconds."""

    ROS_TYPE = "builtin_interfaces/msg/Time"
    SLOT_TYPES = (
        BasicType('int32'),
        BasicType('uint32'),
    )

    if TYPE_CHECKING:
        sec: int
        nanosec: int
        def __init__(self, *, sec: int = ..., nanosec: int = ...) -> None: ...
    else:
        __slots__ = ["_sec", "_nanosec"]

        def __init__(self, **fields: Any) -> None:
            self._sec = 0
            self._nanosec = 0
            if fields:
                set_fields(self, fields)
