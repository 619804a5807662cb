# Written by scripts/generate_messages.py from interfaces/std_srvs/srv; do not edit.
"""Services of std_srvs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, TypeAlias

from coframe.messages.definition import BasicType, UnboundedString
from coframe.messages.message import Message, Service, set_fields


class Empty_Request(Message):
    """Message std_srvs/srv/Empty_Request."""

    ROS_TYPE = "std_srvs/srv/Empty_Request"
    SLOT_TYPES = ()

    if TYPE_CHECKING:
        def __init__(self) -> None: ...
    else:
        __slots__ = []

        def __init__(self, **fields: Any) -> None:
            if fields:
                set_fields(self, fields)


class Empty_Response(Message):
    """Message std_srvs/srv/Empty_Response."""

    ROS_TYPE = "std_srvs/srv/Empty_Response"
    SLOT_TYPES = ()

    if TYPE_CHECKING:
        def __init__(self) -> None: ...
    else:
        __slots__ = []

        def __init__(self, **fields: Any) -> None:
            if fields:
                set_fields(self, fields)


class SetBool_Request(Message):
    """Message std_srvs/srv/SetBool_Request."""

    ROS_TYPE = "std_srvs/srv/SetBool_Request"
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


class SetBool_Response(Message):
    """Message std_srvs/srv/SetBool_Response."""

    ROS_TYPE = "std_srvs/srv/SetBool_Response"
    SLOT_TYPES = (
        BasicType('boolean'),
        UnboundedString(),
    )

    if TYPE_CHECKING:
        success: bool
        message: str
        def __init__(self, *, success: bool = ..., message: str = ...) -> None: ...
    else:
        __slots__ = ["_success", "_message"]

        def __init__(self, **fields: Any) -> None:
            self._success = False
            self._message = ""
            if fields:
                set_fields(self, fields)


class Trigger_Request(Message):
    """Message std_srvs/srv/Trigger_Request."""

    ROS_TYPE = "std_srvs/srv/Trigger_Request"
    SLOT_TYPES = ()

    if TYPE_CHECKING:
        def __init__(self) -> None: ...
    else:
        __slots__ = []

        def __init__(self, **fields: Any) -> None:
            if fields:
                set_fields(self, fields)


class Trigger_Response(Message):
    """Message std_srvs/srv/Trigger_Response."""

    ROS_TYPE = "std_srvs/srv/Trigger_Response"
    SLOT_TYPES = (
        BasicType('boolean'),
        UnboundedString(),
    )

    if TYPE_CHECKING:
        success: bool
        message: str
        def __init__(self, *, success: bool = ..., message: str = ...) -> None: ...
    else:
        __slots__ = ["_success", "_message"]

        def __init__(self, **fields: Any) -> None:
            self._success = False
            self._message = ""
            if fields:
                set_fields(self, fields)


class Empty(Service):
    """Service std_srvs/srv/Empty."""

    ROS_TYPE = "std_srvs/srv/Empty"
    Request: TypeAlias = Empty_Request
    Response: TypeAlias = Empty_Response


class SetBool(Service):
    """Service std_srvs/srv/SetBool."""

    ROS_TYPE = "std_srvs/srv/SetBool"
    Request: TypeAlias = SetBool_Request
    Response: TypeAlias = SetBool_Response


class Trigger(Service):
    """Service std_srvs/srv/Trigger."""

    ROS_TYPE = "std_srvs/srv/Trigger"
    Request: TypeAlias = Trigger_Request
    Response: TypeAlias = Trigger_Response
