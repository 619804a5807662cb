# Written by scripts/generate_messages.py from interfaces/sensor_msgs/srv; do not edit.
"""Services of sensor_msgs."""

from coframe.messages.events import event_attributes
from coframe.messages.generated.sensor_msgs.srv import (
    SetCameraInfo,
    SetCameraInfo_Request,
    SetCameraInfo_Response,
)

__all__ = [
    "SetCameraInfo",
    "SetCameraInfo_Request",
    "SetCameraInfo_Response",
]

__getattr__ = event_attributes("sensor_msgs", "srv")
