# SPDX-License-Identifier: Apache-2.0
"""Frame names in messages of any type: finds them by the definition of the type and replaces them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.bags.decoding import UnknownTypeError, humble_store, store_for
from coframe.bags.definitions import definition_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.bags.storage import Channel

__all__ = ["FrameNames"]

_FIELDS = {"frame_id", "child_frame_id"}
_BASE, _NAME, _ARRAY = 1, 2, 3  # kinds of fields, as rosbags numbers them; a sequence is 4

# The fields of a type that are frame names (None), and those that contain such fields.
_Plan = dict[str, "_Plan | None"]


class FrameNames:
    """Replaces the frame names in the messages of one type.

    Args:
        store: A type store of rosbags that contains the type.
        ros_type: The type.
    """

    def __init__(self, store: Any, ros_type: str) -> None:
        self._store = store
        self._type = ros_type
        self._plan = _plan(store, ros_type, ())

    @classmethod
    def of(cls, channel: Channel, ros_type: str) -> FrameNames | None:
        """Return the frame names for a channel's messages in CDR; None if the type is unknown."""
        is_described = channel.encoding == "cdr" and channel.definition
        if not is_described and definition_of(ros_type):
            return cls(humble_store(), ros_type)
        try:
            return cls(store_for(ros_type, channel.definition, channel.definition_format), ros_type)
        except UnknownTypeError:
            return None

    @property
    def exist(self) -> bool:
        """Whether messages of this type contain frame names."""
        return bool(self._plan)

    def rename(self, data: bytes, rename: Callable[[str], str]) -> tuple[bytes, int]:
        """Replace the frame names in a message.

        Args:
            data: The message in CDR.
            rename: Maps a name to its new name.

        Returns:
            The new message, and the number of names that changed.

        Raises:
            Exception: The bytes are damaged.
        """
        message = self._store.deserialize_cdr(data, self._type)
        changed = _rename(message, self._plan, rename)
        return (bytes(self._store.serialize_cdr(message, self._type)), changed) if changed else (data, 0)


def _plan(store: Any, ros_type: str, above: tuple[str, ...]) -> _Plan:
    plan: _Plan = {}
    if ros_type in above:
        return plan
    for name, (kind, detail) in store.get_msgdef(ros_type).fields:
        if name in _FIELDS and (kind, detail) == (_BASE, ("string", 0)):
            plan[name] = None
        if kind >= _ARRAY:
            kind, detail = detail[0]  # noqa: PLW2901 - the type of the elements
        if kind == _NAME and (inner := _plan(store, detail, (*above, ros_type))):
            plan[name] = inner
    return plan


def _rename(message: Any, plan: _Plan, rename: Callable[[str], str]) -> int:
    changed = 0
    for name, inner in plan.items():
        value = getattr(message, name)
        if inner is not None:
            changed += sum(_rename(part, inner, rename) for part in (value if isinstance(value, list) else [value]))
        elif (new := rename(value)) != value:
            setattr(message, name, new)
            changed += 1
    return changed
