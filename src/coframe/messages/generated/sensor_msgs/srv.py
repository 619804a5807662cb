# Written by scripts/generate_messages.py from interfaces/sensor_msgs/srv; do not edit.
"""Services of sensor_msgs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, TypeAlias

from coframe.messages.definition import BasicType, NamespacedType, UnboundedString
from coframe.messages.message import Message, Service, set_fields
from coframe.messages.generated.sensor_msgs.msg import CameraInfo


class SetCameraInfo_Request(Message):
    """Message sensor_msgs/srv/SetCameraInfo_Request."""

    ROS_TYPE = "sensor_msgs/srv/SetCameraInfo_Request"
    SLOT_TYPES = (
        NamespacedType(('sensor_msgs', 'msg'), 'CameraInfo'),
    )

    if TYPE_CHECKING:
        camera_info: CameraInfo
        def __init__(self, *, camera_info: CameraInfo = ...) -> None: ...
    else:
        __slots__ = ["_camera_info"]

        def __init__(self, **fields: Any) -> None:
            self._camera_info = fields.get("camera_info") or CameraInfo()
            if fields:
                set_fields(self, fields)


class SetCameraInfo_Response(Message):
    """Message sensor_msgs/srv/SetCameraInfo_Response."""

    ROS_TYPE = "sensor_msgs/srv/SetCameraInfo_Response"
    SLOT_TYPES = (
        BasicType('boolean'),
        UnboundedString(),
    )

    if TYPE_CHECKING:
        success: bool
        status_message: str
        def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...
    else:
        __slots__ = ["_success", "_status_message"]

        def __init__(self, **fields: Any) -> None:
            self._success = False
            self._status_message = ""
            if fields:
                set_fields(self, fields)


class SetCameraInfo(Service):
    """Service sensor_msgs/srv/SetCameraInfo."""

    ROS_TYPE = "sensor_msgs/srv/SetCameraInfo"
    Request: TypeAlias = SetCameraInfo_Request
    Response: TypeAlias = SetCameraInfo_Response
