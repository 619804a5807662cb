# Written by scripts/generate_messages.py from interfaces/builtin_interfaces/msg; do not edit.
"""builtin_interfaces.msg"""

from coframe.messages.generated.builtin_interfaces.msg import (
    Duration,
    Time,
)

__all__ = [
    "Duration",
    "Time",
]
