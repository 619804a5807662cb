# SPDX-License-Identifier: Apache-2.0
"""Messages in the definition of another distribution, such as a `sensor_msgs/msg/Range` of Humble without `variance`.

They are read with the other definition and converted: fields with the same name are copied, others have their defaults.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any, Final

from coframe.distributions import DEFINITIONS, Distribution, current
from coframe.messages.type_hash import type_hash

if TYPE_CHECKING:
    from coframe.messages.message import Message

__all__ = ["convert", "difference", "has_other_form", "other_form"]

_SECOND: Final = 1_000_000_000
_TRANSITION_EVENT: Final = "lifecycle_msgs/msg/TransitionEvent"


def has_other_form(cls: Any) -> bool:
    """Return whether another distribution defines the fields of a message class differently."""
    if cls.__recorded__ or cls.ROS_TYPE not in DEFINITIONS:
        return False
    other = other_form(cls.ROS_TYPE)
    return other is not None and other.get_fields_and_field_types() != cls.get_fields_and_field_types()


@functools.cache
def other_form(ros_type: str) -> type[Message] | None:
    """Return a class for the definition that other distributions have of a type, or None if all have the same one."""
    from coframe.messages._class_factory import class_name, new_message_class  # noqa: PLC0415 - rarely needed
    from coframe.messages._parser import parse  # noqa: PLC0415
    from coframe.messages.definition import AbstractNestedType, NamespacedType  # noqa: PLC0415
    from coframe.messages.packages import shipped_other_form  # noqa: PLC0415
    from coframe.messages.registry import class_of  # noqa: PLC0415

    text = shipped_other_form(ros_type)
    if text is None or "/msg/" not in ros_type:
        return None
    (structure,) = parse(text, ros_type.partition("/")[0])
    inner = {}
    for field in structure.fields:
        type_: Any = field.type.value_type if isinstance(field.type, AbstractNestedType) else field.type
        if isinstance(type_, NamespacedType):
            inner[class_name(type_)] = class_of(type_)
    return new_message_class(ros_type, structure, inner, is_recorded=True)


def convert(message: Any, cls: type[Message]) -> Any:
    """Convert a message of the other form to a class of this distribution."""
    result: Any = cls()
    for name in cls.get_fields_and_field_types():
        if hasattr(message, name):
            # The slot, without the check of values that programs set: messages may contain any float.
            setattr(result, f"_{name}", getattr(message, name))
    if cls.ROS_TYPE == _TRANSITION_EVENT:
        if hasattr(message, "timestamp"):
            result.stamp.sec, result.stamp.nanosec = divmod(min(message.timestamp, _SECOND * 2**31 - 1), _SECOND)
        else:
            result.timestamp = max(message.stamp.sec * _SECOND + message.stamp.nanosec, 0)
    return result


def difference(ros_type: str, hash_: str) -> str:
    """Return which definition of a type has a hash: "the definition of ROS 2 Lyrical", or "another definition"."""
    other = other_form(ros_type) if ros_type in DEFINITIONS else None
    if other is None or type_hash(other) != hash_:
        return "another definition"
    since = DEFINITIONS[ros_type].since
    if current() >= since:
        return f"the definition of ROS 2 before {since.title}"
    later = "" if since is max(Distribution) else " or later"
    return f"the definition of ROS 2 {since.title}{later}"
