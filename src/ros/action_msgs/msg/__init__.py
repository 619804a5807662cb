# Written by scripts/generate_messages.py from interfaces/action_msgs/msg; do not edit.
"""Messages of action_msgs."""

from coframe.messages.generated.action_msgs.msg import (
    GoalInfo,
    GoalStatus,
    GoalStatusArray,
)

__all__ = [
    "GoalInfo",
    "GoalStatus",
    "GoalStatusArray",
]
