# Written by scripts/generate_messages.py from interfaces/visualization_msgs/srv; do not edit.
"""Services of visualization_msgs."""

from coframe.messages.events import event_attributes
from coframe.messages.generated.visualization_msgs.srv import (
    GetInteractiveMarkers,
    GetInteractiveMarkers_Request,
    GetInteractiveMarkers_Response,
)

__all__ = [
    "GetInteractiveMarkers",
    "GetInteractiveMarkers_Request",
    "GetInteractiveMarkers_Response",
]

__getattr__ = event_attributes("visualization_msgs", "srv")
