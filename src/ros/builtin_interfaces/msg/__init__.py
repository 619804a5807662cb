# Written by scripts/generate_messages.py from interfaces/builtin_interfaces/msg; do not edit.
"""Messages of builtin_interfaces."""

from coframe.messages.generated.builtin_interfaces.msg import (
    Duration,
    Time,
)

__all__ = [
    "Duration",
    "Time",
]
