# Written by scripts/generate_messages.py from interfaces/tf2_msgs/msg; do not edit.
"""tf2_msgs.msg"""

from coframe.messages.generated.tf2_msgs.msg import (
    TF2Error,
    TFMessage,
)

__all__ = [
    "TF2Error",
    "TFMessage",
]
