# Written by scripts/generate_messages.py from interfaces/visualization_msgs/srv; do not edit.
"""Services of visualization_msgs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, TypeAlias

from coframe.messages.definition import BasicType, NamespacedType, UnboundedSequence
from coframe.messages.message import Message, Service, set_fields
from coframe.messages.generated.visualization_msgs.msg import InteractiveMarker


class GetInteractiveMarkers_Request(Message):
    """Message visualization_msgs/srv/GetInteractiveMarkers_Request."""

    ROS_TYPE = "visualization_msgs/srv/GetInteractiveMarkers_Request"
    SLOT_TYPES = ()

    if TYPE_CHECKING:
        def __init__(self) -> None: ...
    else:
        __slots__ = []

        def __init__(self, **fields: Any) -> None:
            if fields:
                set_fields(self, fields)


class GetInteractiveMarkers_Response(Message):
    """Message visualization_msgs/srv/GetInteractiveMarkers_Response."""

    ROS_TYPE = "visualization_msgs/srv/GetInteractiveMarkers_Response"
    SLOT_TYPES = (
        BasicType('uint64'),
        UnboundedSequence(NamespacedType(('visualization_msgs', 'msg'), 'InteractiveMarker')),
    )

    if TYPE_CHECKING:
        sequence_number: int
        markers: list[InteractiveMarker]
        def __init__(self, *, sequence_number: int = ..., markers: list[InteractiveMarker] = ...) -> None: ...
    else:
        __slots__ = ["_sequence_number", "_markers"]

        def __init__(self, **fields: Any) -> None:
            self._sequence_number = 0
            self._markers = []
            if fields:
                set_fields(self, fields)


class GetInteractiveMarkers(Service):
    """Service visualization_msgs/srv/GetInteractiveMarkers."""

    ROS_TYPE = "visualization_msgs/srv/GetInteractiveMarkers"
    Request: TypeAlias = GetInteractiveMarkers_Request
    Response: TypeAlias = GetInteractiveMarkers_Response
