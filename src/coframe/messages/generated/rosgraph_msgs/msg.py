# Written by scripts/generate_messages.py from interfaces/rosgraph_msgs/msg; do not edit.
"""Messages of rosgraph_msgs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from coframe.messages.definition import NamespacedType
from coframe.messages.message import Message
from coframe.messages.generated.builtin_interfaces.msg import Time


class Clock(Message):
    """The time that nodes with use_sim_time take as now."""

    ROS_TYPE = "rosgraph_msgs/msg/Clock"
    SLOT_TYPES = (
        NamespacedType(('builtin_interfaces', 'msg'), 'Time'),
    )

    if TYPE_CHECKING:
        clock: Time
        def __init__(self, *, clock: Time = ...) -> None: ...
    else:
        __slots__ = ["_clock"]

        def __init__(self, **fields: Any) -> None:
            self._clock = fields.get("clock") or Time()
            if fields:
                super().__init__(**fields)
