"""Messages as bytes (CDR), as they go over the wire."""

from __future__ import annotations

from typing import Any

from coframe.messages import codec


def serialize_message(message: Any) -> bytes:
    """Returns the bytes of a message, with CDR's four-byte header."""
    return bytes(codec.serialize(message))


def deserialize_message(serialized_message: bytes, message_type: type[Any]) -> Any:
    """Returns the message of the bytes.

    Raises:
        DecodeError: They are no bytes of such a message.
    """
    return codec.deserialize(serialized_message, message_type)
