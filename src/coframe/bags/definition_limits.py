# SPDX-License-Identifier: Apache-2.0
"""Limits on the definitions in recordings, before rosbags generates code for them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.messages.class_limits import check_limits
from coframe.messages.definition import (
    AbstractNestableType,
    AbstractType,
    Array,
    BasicType,
    NamespacedType,
    UnboundedSequence,
    UnboundedString,
)

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["check_definitions"]

_BASE, _NAME, _ARRAY = 1, 2, 3  # of rosbags' enumeration Nodetype


def check_definitions(types: Mapping[str, Any]) -> None:
    """Raise ValueError if a message of one of these types exceeds a limit.

    Args:
        types: Constants and fields by message type, as rosbags returns them.
    """

    def fields_of(ros_type: str) -> list[AbstractType]:
        return [_type(node) for _, node in types[ros_type][1]] if ros_type in types else []

    for name in types:
        check_limits(fields_of(name), fields_of)


def _type(node: Any) -> AbstractType:
    """Return the type of a field that rosbags describes as a tuple of its kind and details."""
    kind, details = node
    if kind == _NAME:
        *namespaces, name = str(details).split("/")
        return NamespacedType(tuple(namespaces), name)
    if kind == _BASE:
        name = str(details[0])
        return UnboundedString() if name in {"string", "wstring"} else BasicType(_NUMBERS.get(name, name))
    element, size = details
    value_type = _type(element)
    if not isinstance(value_type, AbstractNestableType):
        raise ValueError("an array of arrays, which ROS 2 does not have")  # noqa: TRY004 - the definition is invalid
    return Array(value_type, int(size)) if kind == _ARRAY else UnboundedSequence(value_type)


_NUMBERS = {"bool": "boolean", "byte": "octet", "char": "uint8", "float32": "float", "float64": "double"}
