# SPDX-License-Identifier: Apache-2.0
"""Serialization of messages to CDR as ROS 2 sends it: XCDR1 after a 4-byte encapsulation header.

ROS 1 messages can also be read.
"""

from __future__ import annotations

import functools
import struct
from typing import TYPE_CHECKING, Any, Final, TypeVar

from coframe.errors import DecodeError
from coframe.messages._decoding import decoding
from coframe.messages._encoding import encoding
from coframe.messages.encapsulation import BYTE_ORDERS, HEADER_SIZE, LITTLE_ENDIAN_HEADER
from coframe.messages.message import Message
from coframe.messages.native_codec import native_codec

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.messages._compiler import Plan

MAX_PADDING: Final = 3
"""The maximum number of padding bytes that DDS adds, because it sends multiples of 4 bytes."""

M = TypeVar("M", bound=Message)

_MAX_RECORDED = 256  # plans for classes of definitions in recordings that are kept, with the classes

_native_encodings: dict[type, Callable[[Any], bytes | None]] = {}
_native_decodings: dict[type, Callable[..., Any]] = {}
_encodings: dict[type, Plan] = {}
_decodings: dict[tuple[type, bytes], Plan] = {}


def serialize(message: Message) -> bytes:
    """Return the CDR bytes of a message, in little endian.

    Raises:
        TypeError: The argument is not a message, or a field contains a value of a wrong type.
        ValueError: A field contains a value that its type cannot hold: a number that is too large, a string that is
            too long or contains a NUL character.
    """
    cls = type(message)
    encode = _native_encodings.get(cls) or _new_native_encoding(cls)
    data = encode(message)
    return _serialize_in_python(message, cls) if data is None else data


def _serialize_in_python(message: Message, cls: type[Message]) -> bytes:
    """Serialize messages that the native encoder does not support, and report errors."""
    plan = _encodings.get(cls) or _new_encoding(cls)
    out = bytearray(LITTLE_ENDIAN_HEADER)
    try:
        plan.run(out, message)
    except (struct.error, AttributeError, TypeError, ValueError, OverflowError) as error:
        kind = TypeError if isinstance(error, (AttributeError, TypeError)) else ValueError
        raise kind(f"cannot serialize {cls.ROS_TYPE}, field {plan.locate_error(error)[0]}: {error}") from error
    return bytes(out)


def deserialize(data: bytes, cls: type[M]) -> M:
    """Return the message in CDR bytes.

    Args:
        data: CDR of either byte order. Bytes after the end of the message are ignored, as in ROS.
        cls: The class of the message.

    Raises:
        DecodeError: The bytes are not a message of this class.
        TypeError: ``cls`` is not a message class.
    """
    decode = _native_decodings.get(cls) or _new_native_decoding(cls)
    message = decode(data)
    return _deserialize_in_python(bytes(data), cls) if message is None else message


def deserialize_whole(data: bytes, cls: type[M]) -> M:
    """Return the message as `deserialize`, but accept at most `MAX_PADDING` bytes after its end.

    Raises:
        DecodeError: The bytes are not a message of this class, or are longer.
        TypeError: ``cls`` is not a message class.
    """
    decode = _native_decodings.get(cls) or _new_native_decoding(cls)
    message: M | None = decode(data, MAX_PADDING)
    return _deserialize_in_python(bytes(data), cls, MAX_PADDING) if message is None else message


def _deserialize_in_python(data: bytes, cls: type[M], max_rest: int | None = None) -> M:
    """Read messages that the native codec does not support, and report invalid bytes."""
    if len(data) < HEADER_SIZE:
        raise _header_error(_message_class(cls), data)
    plan = _decodings.get((cls, data[:2])) or _new_decoding(cls, data)
    try:
        message: M
        message, end = plan.run(data)
    except (struct.error, ValueError) as error:
        converted = _deserialize_if_other_form(data, cls)
        if converted is not None:
            return converted
        raise _decode_error(error, plan, data, cls) from None
    if max_rest is not None and len(data) - end > max_rest:
        raise DecodeError(
            f"{cls.ROS_TYPE}: the message ends at byte {end} of {len(data)}",
            hint="The bytes contain a message of another type, or of another version of this one.",
        )
    return message


def _deserialize_if_other_form(data: bytes, cls: type[M]) -> M | None:
    """Return the message if the bytes are one of the definition that another distribution has, or None otherwise."""
    from coframe.messages import other_forms  # noqa: PLC0415 - rarely needed

    if not other_forms.has_other_form(cls):
        return None
    return deserialize_other_form(data, cls)


def deserialize_other_form(data: bytes, cls: type[M]) -> M | None:
    """Decode a message with the definition of another distribution as `cls`, or return None if it does not fit.

    Args:
        data: The bytes.
        cls: A class for which `other_forms.has_other_form` is true.
    """
    from coframe.messages import other_forms  # noqa: PLC0415 - rarely needed

    other = other_forms.other_form(cls.ROS_TYPE)
    assert other is not None
    try:
        message: M = other_forms.convert(deserialize_whole(data, other), cls)
    except DecodeError:
        return None
    return message


def deserialize_ros1(data: bytes, cls: type[M]) -> M:
    """Return the message in ROS 1 bytes.

    Args:
        data: The bytes. Bytes after the end of the message are ignored.
        cls: The class of the message, without the sequence number of headers.

    Raises:
        DecodeError: The bytes are not a message of this class.
    """
    codec = native_codec(cls)
    message: M | None = None if codec is None else codec.decode_ros1(data)
    if message is not None:
        return message
    plan, data = _ros1_decoding(cls), bytes(data)
    try:
        return plan.run(data)[0]  # type: ignore[no-any-return]
    except (struct.error, ValueError) as error:
        raise _decode_error(error, plan, data, cls) from None


@functools.lru_cache(_MAX_RECORDED)
def _ros1_decoding(cls: type) -> Plan:
    return decoding(cls, "<", is_ros1=True)


def _new_native_encoding(cls: type) -> Callable[[Any], bytes | None]:
    codec = native_codec(_message_class(cls))
    encode: Callable[[Any], bytes | None] = codec.encode if codec else lambda _: None
    return encode if _is_recorded(cls) else _native_encodings.setdefault(cls, encode)


def _new_native_decoding(cls: type) -> Callable[..., Any]:
    codec = native_codec(_message_class(cls))
    decode: Callable[..., Any] = codec.decode if codec else lambda *_: None
    return decode if _is_recorded(cls) else _native_decodings.setdefault(cls, decode)


def _new_encoding(cls: type) -> Plan:
    if _is_recorded(cls):
        return _recorded_encoding(cls)
    return _encodings.setdefault(cls, encoding(_message_class(cls)))


def _new_decoding(cls: type, data: bytes) -> Plan:
    order = BYTE_ORDERS.get(data[:2])
    if order is None:
        raise _header_error(_message_class(cls), data)
    if _is_recorded(cls):
        return _recorded_decoding(cls, order)
    return _decodings.setdefault((cls, data[:2]), decoding(_message_class(cls), order))


_recorded_encoding = functools.lru_cache(_MAX_RECORDED)(encoding)
_recorded_decoding = functools.lru_cache(_MAX_RECORDED)(decoding)


def _is_recorded(cls: type) -> bool:
    return issubclass(cls, Message) and cls.__recorded__


def _message_class(cls: type) -> type[Message]:
    if not issubclass(cls, Message):
        raise TypeError(
            f"{cls.__module__}.{cls.__qualname__} is not a message class. "
            "For services and actions, use the classes of their parts, such as SetBool.Request."
        )
    return cls


def _header_error(cls: type[Message], data: bytes) -> DecodeError:
    return DecodeError(
        f"{cls.ROS_TYPE}: at byte 0 of {len(data)}: expected the CDR header 00 01 00 00 or 00 00 00 00, "
        f"found {data[:HEADER_SIZE].hex(' ') or 'nothing'}",
        hint="Only plain CDR (XCDR1) is supported, which ROS 2 uses.",
    )


def _decode_error(error: Exception, plan: Plan, data: bytes, cls: type[Message]) -> DecodeError:
    fields, variables = plan.locate_error(error)
    offset, expected = variables["pos"], str(error)
    if isinstance(error, struct.error):
        expected = f"more than the {max(len(data) - offset, 0)} remaining bytes"
    if isinstance(error, UnicodeDecodeError):
        expected = f"UTF-8, found {error.object[error.start : error.end].hex(' ')}"
    return DecodeError(
        f"{cls.ROS_TYPE}: at byte {offset} of {len(data)}, for {fields}: expected {expected}",
        hint="The bytes are truncated or damaged, or contain a message of another type.",
    )
