# Written by scripts/generate_messages.py from interfaces/action_msgs/srv; do not edit.
"""Services of action_msgs."""

from coframe.messages.events import event_attributes
from coframe.messages.generated.action_msgs.srv import (
    CancelGoal,
    CancelGoal_Request,
    CancelGoal_Response,
)

__all__ = [
    "CancelGoal",
    "CancelGoal_Request",
    "CancelGoal_Response",
]

__getattr__ = event_attributes("action_msgs", "srv")
