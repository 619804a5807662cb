# Written by scripts/generate_messages.py from interfaces/tf2_msgs/msg; do not edit.
"""Messages of tf2_msgs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from coframe.messages.definition import BasicType, NamespacedType, UnboundedSequence, UnboundedString
from coframe.messages.message import Message, set_fields
from coframe.messages.generated.geometry_msgs.msg import TransformStamped


class TF2Error(Message):
    """The tf2 error that a lookup ended with."""

    ROS_TYPE = "tf2_msgs/msg/TF2Error"
    SLOT_TYPES = (
        BasicType('uint8'),
        UnboundedString(),
    )
    NO_ERROR: Final = 0
    LOOKUP_ERROR: Final = 1
    CONNECTIVITY_ERROR: Final = 2
    EXTRAPOLATION_ERROR: Final = 3
    INVALID_ARGUMENT_ERROR: Final = 4
    TIMEOUT_ERROR: Final = 5
    TRANSFORM_ERROR: Final = 6

    if TYPE_CHECKING:
        error: int
        error_string: str
        def __init__(self, *, error: int = ..., error_string: str = ...) -> None: ...
    else:
        __slots__ = ["_error", "_error_string"]

        def __init__(self, **fields: Any) -> None:
            self._error = 0
            self._error_string = ""
            if fields:
                set_fields(self, fields)


class TFMessage(Message):
    """Transforms as published on /tf and /tf_static."""

    ROS_TYPE = "tf2_msgs/msg/TFMessage"
    SLOT_TYPES = (
        UnboundedSequence(NamespacedType(('geometry_msgs', 'msg'), 'TransformStamped')),
    )

    if TYPE_CHECKING:
        transforms: list[TransformStamped]
        def __init__(self, *, transforms: list[TransformStamped] = ...) -> None: ...
    else:
        __slots__ = ["_transforms"]

        def __init__(self, **fields: Any) -> None:
            self._transforms = []
            if fields:
                set_fields(self, fields)
