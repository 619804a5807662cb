# SPDX-License-Identifier: Apache-2.0
"""Serialization of messages to CDR, the format on the wire."""

from __future__ import annotations

from typing import Any

from coframe.messages import codec


def serialize_message(message: Any) -> bytes:
    """Return a message serialized to CDR, including the four-byte encapsulation header."""
    return bytes(codec.serialize(message))


def deserialize_message(serialized_message: bytes, message_type: type[Any]) -> Any:
    """Return the message that the CDR bytes contain.

    Raises:
        DecodeError: The bytes are not a message of this type.
    """
    return codec.deserialize(serialized_message, message_type)
