# Written by scripts/generate_messages.py from interfaces/tf2_msgs/msg; do not edit.
"""Messages of tf2_msgs."""

from coframe.messages.generated.tf2_msgs.msg import (
    TF2Error,
    TFMessage,
)

__all__ = [
    "TF2Error",
    "TFMessage",
]
