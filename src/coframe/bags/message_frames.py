# SPDX-License-Identifier: Apache-2.0
"""Find and replace frame names in messages of any type, using the fields of its class."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.bags._recorded_types import UnknownTypeError
from coframe.messages import deserialize, serialize
from coframe.messages.definition import AbstractNestedType, NamespacedType, UnboundedString
from coframe.messages.registry import class_of
from coframe.messages.schema_classes import known_class

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.bags._recorded_types import RecordedTypes
    from coframe.bags.storage import Channel

__all__ = ["FrameNames"]

# Besides those of headers and transforms: foxglove_msgs, tf2_msgs/LookupTransform, gazebo_msgs.
_FIELDS = {"child_frame_id", "fixed_frame", "frame_id", "parent_frame_id", "reference_frame", "source_frame"}
_FIELDS |= {"target_frame"}
_HEADER = "std_msgs/msg/Header"

# The fields of a type that are frame names (None), and those that contain such fields.
_Plan = dict[str, "_Plan | None"]


class FrameNames:
    """Replaces the frame names in the messages of one type.

    Args:
        cls: The class of the messages.
    """

    def __init__(self, cls: Any) -> None:
        self._class = cls
        self._plan = _plan(cls, {})

    @classmethod
    def of(cls, channel: Channel, ros_type: str, types: RecordedTypes) -> FrameNames | None:
        """Return a FrameNames for a channel's messages in CDR, or None if the type is unknown."""
        is_described = channel.encoding == "cdr" and channel.definition
        if not is_described and (known := known_class(ros_type)) is not None:
            return cls(known)
        try:
            return cls(types.message_class(channel))
        except UnknownTypeError:
            return None

    @property
    def exist(self) -> bool:
        """Whether messages of this type contain frame names."""
        return bool(self._plan)

    @property
    def only_in_header(self) -> bool:
        """Whether the only frame name is in a header at the beginning of the messages."""
        first = self._class.SLOT_TYPES[0] if self._class.SLOT_TYPES else None
        is_header = isinstance(first, NamespacedType) and "/".join(first.namespaced_name()) == _HEADER
        return is_header and self._plan == {self._class.__slots__[0][1:]: {"frame_id": None}}

    def rename(self, data: bytes, rename: Callable[[str], str]) -> tuple[bytes, int]:
        """Replace the frame names in a message.

        Args:
            data: The message in CDR.
            rename: Maps a name to its new name.

        Returns:
            The new message, and the number of names that changed.

        Raises:
            DecodeError: The bytes are damaged.
        """
        message = deserialize(data, self._class)
        change_count = _rename(message, self._plan, rename)
        return (serialize(message), change_count) if change_count else (data, 0)


def _plan(cls: Any, known: dict[Any, _Plan]) -> _Plan:
    """Return the plan of a class; `known` caches the plans of nested classes, so that each is visited once."""
    if cls not in known:
        plan: _Plan = {}
        for slot, type_ in zip(cls.__slots__, cls.SLOT_TYPES, strict=True):
            name = slot[1:]
            if name in _FIELDS and isinstance(type_, UnboundedString):
                plan[name] = None
            inner = type_.value_type if isinstance(type_, AbstractNestedType) else type_
            if isinstance(inner, NamespacedType) and (inner_plan := _plan(class_of(inner), known)):
                plan[name] = inner_plan
        known[cls] = plan
    return known[cls]


def _rename(message: Any, plan: _Plan, rename: Callable[[str], str]) -> int:
    change_count = 0
    for name, inner in plan.items():
        value = getattr(message, name)
        if inner is not None:
            change_count += sum(
                _rename(part, inner, rename) for part in (value if isinstance(value, list) else [value])
            )
        elif (new := rename(value)) != value:
            setattr(message, name, new)
            change_count += 1
    return change_count
