# Written by scripts/generate_messages.py from interfaces/rosgraph_msgs/msg; do not edit.
"""Messages of rosgraph_msgs."""

from coframe.messages.generated.rosgraph_msgs.msg import (
    Clock,
)

__all__ = [
    "Clock",
]
