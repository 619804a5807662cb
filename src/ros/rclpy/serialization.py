# SPDX-License-Identifier: Apache-2.0
"""Serialization of messages to CDR, the format on the wire."""

from __future__ import annotations

from functools import partial
from typing import Any

from coframe.errors import DecodeError
from coframe.messages import codec
from rclpy import _absent
from rclpy.exceptions import RMWError
from rclpy.type_support import check_for_type_support


def serialize_message(message: Any) -> bytes:
    """Return a message serialized to CDR, including the four-byte encapsulation header.

    Raises:
        AttributeError: `message` is not a message.
    """
    check_for_type_support(type(message))
    return bytes(codec.serialize(message))


def deserialize_message(serialized_message: bytes, message_type: type[Any]) -> Any:
    """Return the message that the CDR bytes contain.

    Raises:
        RMWError: The bytes are not a message of this type.
        AttributeError: `message_type` is not a message class.
    """
    check_for_type_support(message_type)
    try:
        return codec.deserialize(serialized_message, message_type)
    except DecodeError as error:
        raise RMWError(f"failed to deserialize ROS message: {error}") from error


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
