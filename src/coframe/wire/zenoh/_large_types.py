# SPDX-License-Identifier: Apache-2.0
"""The types that newer releases of rmw_zenoh_cpp send at an additional key: those with a byte sequence."""

from __future__ import annotations

from functools import cache
from typing import Any


@cache
def has_unbounded_bytes(ros_type: str) -> bool:
    """Return whether a message type contains an unbounded `uint8[]` at any depth. False if it is unknown."""
    from coframe.messages.registry import find  # noqa: PLC0415 - importing coframe.wire must be cheap

    try:
        return _contains(find(ros_type))
    except LookupError:
        return False


def _contains(message_type: Any) -> bool:
    from coframe.messages.definition import (  # noqa: PLC0415
        AbstractNestedType,
        BasicType,
        NamespacedType,
        UnboundedSequence,
    )

    for slot in message_type.SLOT_TYPES:
        value = slot.value_type if isinstance(slot, AbstractNestedType) else slot
        if isinstance(slot, UnboundedSequence) and isinstance(value, BasicType) and value.typename == "uint8":
            return True
        if isinstance(value, NamespacedType) and has_unbounded_bytes("/".join([*value.namespaces, value.name])):
            return True
    return False
