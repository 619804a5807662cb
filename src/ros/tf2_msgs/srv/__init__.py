# Written by scripts/generate_messages.py from interfaces/tf2_msgs/srv; do not edit.
"""Services of tf2_msgs."""

from coframe.messages.events import event_attributes
from coframe.messages.generated.tf2_msgs.srv import (
    FrameGraph,
    FrameGraph_Request,
    FrameGraph_Response,
)

__all__ = [
    "FrameGraph",
    "FrameGraph_Request",
    "FrameGraph_Response",
]

__getattr__ = event_attributes("tf2_msgs", "srv")
