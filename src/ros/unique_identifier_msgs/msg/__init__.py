# Written by scripts/generate_messages.py from interfaces/unique_identifier_msgs/msg; do not edit.
"""Messages of unique_identifier_msgs."""

from coframe.messages.generated.unique_identifier_msgs.msg import (
    UUID,
)

__all__ = [
    "UUID",
]
