# Written by scripts/generate_messages.py from interfaces/tf2_msgs/srv; do not edit.
"""Services of tf2_msgs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, TypeAlias

from coframe.messages.definition import UnboundedString
from coframe.messages.message import Message, Service, set_fields


class FrameGraph_Request(Message):
    """Message tf2_msgs/srv/FrameGraph_Request."""

    ROS_TYPE = "tf2_msgs/srv/FrameGraph_Request"
    SLOT_TYPES = ()

    if TYPE_CHECKING:
        def __init__(self) -> None: ...
    else:
        __slots__ = []

        def __init__(self, **fields: Any) -> None:
            if fields:
                set_fields(self, fields)


class FrameGraph_Response(Message):
    """Message tf2_msgs/srv/FrameGraph_Response."""

    ROS_TYPE = "tf2_msgs/srv/FrameGraph_Response"
    SLOT_TYPES = (
        UnboundedString(),
    )

    if TYPE_CHECKING:
        frame_yaml: str
        def __init__(self, *, frame_yaml: str = ...) -> None: ...
    else:
        __slots__ = ["_frame_yaml"]

        def __init__(self, **fields: Any) -> None:
            self._frame_yaml = ""
            if fields:
                set_fields(self, fields)


class FrameGraph(Service):
    """Service tf2_msgs/srv/FrameGraph."""

    ROS_TYPE = "tf2_msgs/srv/FrameGraph"
    Request: TypeAlias = FrameGraph_Request
    Response: TypeAlias = FrameGraph_Response
