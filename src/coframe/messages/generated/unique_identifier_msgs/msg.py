# Written by scripts/generate_messages.py from interfaces/unique_identifier_msgs/msg; do not edit.
"""Messages of unique_identifier_msgs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import coframe.lazy_numpy as np
from coframe.messages.definition import Array, BasicType
from coframe.messages.message import Message, set_fields

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.messages._hints import NumberArray


class UUID(Message):
    """A universally unique id in 16 bytes."""

    ROS_TYPE = "unique_identifier_msgs/msg/UUID"
    SLOT_TYPES = (
        Array(BasicType('uint8'), 16),
    )

    if TYPE_CHECKING:
        uuid = NumberArray[np.uint8]()
        def __init__(self, *, uuid: Iterable[int] = ...) -> None: ...
    else:
        __slots__ = ["_uuid"]

        def __init__(self, **fields: Any) -> None:
            self._uuid = np.zeros(16, np.uint8)
            if fields:
                set_fields(self, fields)
