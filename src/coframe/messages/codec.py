"""Messages to CDR bytes and back, as ROS 2 sends them: XCDR1 behind a 4-byte encapsulation header."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, TypeVar

from coframe.errors import DecodeError
from coframe.messages.decoding import decoding
from coframe.messages.encapsulation import BYTE_ORDERS, HEADER_SIZE, LITTLE_ENDIAN_HEADER
from coframe.messages.encoding import encoding
from coframe.messages.message import Message

if TYPE_CHECKING:
    from coframe.messages.compiler import Plan

M = TypeVar("M", bound=Message)

_encodings: dict[type, Plan] = {}
_decodings: dict[tuple[type, bytes], Plan] = {}


def serialize(message: Message) -> bytes:
    """The bytes of a message, little endian.

    Raises:
        TypeError: it is not a message, or a field holds a value of a wrong type.
        ValueError: a field holds a value the type cannot carry: too large, too long, a NUL inside a text.
    """
    cls = type(message)
    plan = _encodings.get(cls) or _new_encoding(cls)
    out = bytearray(LITTLE_ENDIAN_HEADER)
    try:
        plan.run(out, message)
    except (struct.error, AttributeError, TypeError, ValueError, OverflowError) as error:
        kind = TypeError if isinstance(error, (AttributeError, TypeError)) else ValueError
        raise kind(f"cannot serialize {cls.ROS_TYPE}, field {plan.where(error)[0]}: {error}") from error
    return bytes(out)


def deserialize(data: bytes, cls: type[M]) -> M:
    """The message in the bytes, of either byte order; bytes after its end are ignored, as in ROS.

    Raises:
        DecodeError: the bytes are not a message of this class.
    """
    data = bytes(data)
    if len(data) < HEADER_SIZE:
        raise _header_error(_message_class(cls), data)
    plan = _decodings.get((cls, data[:2])) or _new_decoding(cls, data)
    try:
        message: M = plan.run(data)
    except (struct.error, ValueError) as error:
        raise _decode_error(error, plan, data, cls) from None
    return message


def _new_encoding(cls: type) -> Plan:
    _encodings[cls] = encoding(_message_class(cls))
    return _encodings[cls]


def _new_decoding(cls: type, data: bytes) -> Plan:
    order = BYTE_ORDERS.get(data[:2])
    if order is None:
        raise _header_error(_message_class(cls), data)
    _decodings[cls, data[:2]] = decoding(_message_class(cls), order)
    return _decodings[cls, data[:2]]


def _message_class(cls: type) -> type[Message]:
    if not issubclass(cls, Message):
        raise TypeError(
            f"{cls.__module__}.{cls.__qualname__} is not a message class; "
            "services and actions travel as their parts, for example SetBool.Request"
        )
    return cls


def _header_error(cls: type[Message], data: bytes) -> DecodeError:
    return DecodeError(
        f"{cls.ROS_TYPE}: at byte 0 of {len(data)}: expected the header of CDR, 00 01 00 00 or 00 00 00 00, "
        f"found {data[:HEADER_SIZE].hex(' ') or 'nothing'}",
        hint="Messages of ROS 2 travel as plain CDR (XCDR1); other encodings are not read.",
    )


def _decode_error(error: Exception, plan: Plan, data: bytes, cls: type[Message]) -> DecodeError:
    fields, variables = plan.where(error)
    offset, expected = variables["pos"], str(error)
    if isinstance(error, struct.error):
        expected = f"more than the {max(len(data) - offset, 0)} bytes that are left"
    if isinstance(error, UnicodeDecodeError):
        expected = f"UTF-8, found {error.object[error.start : error.end].hex(' ')}"
    return DecodeError(
        f"{cls.ROS_TYPE}: at byte {offset} of {len(data)}, for {fields}: expected {expected}",
        hint="The bytes are cut short, damaged, or of another type.",
    )
