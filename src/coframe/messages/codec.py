"""Messages to CDR bytes and back, as ROS 2 sends them: XCDR1 behind a 4-byte encapsulation header."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any, TypeVar

from coframe.errors import DecodeError
from coframe.messages.message import Message
from coframe.messages.plan import HEADER_SIZE, Decoder, Order, encoder

if TYPE_CHECKING:
    from collections.abc import Callable

M = TypeVar("M", bound=Message)

_LITTLE_ENDIAN_HEADER = b"\x00\x01\x00\x00"
_ORDERS: dict[bytes, Order] = {b"\x00\x00": ">", b"\x00\x01": "<"}

_encoders: dict[type, Callable[[bytearray, Any], None]] = {}
_decoders: dict[tuple[type, bytes], Decoder] = {}


def serialize(message: Message) -> bytes:
    """The bytes of a message, little endian.

    Raises:
        TypeError: it is not a message, or a field holds a value of a wrong type.
        ValueError: a field holds a value the type cannot carry: too large, too long, a NUL inside a text.
    """
    cls = type(message)
    out = bytearray(_LITTLE_ENDIAN_HEADER)
    try:
        encode = _encoders.get(cls) or _new_encoder(cls)
        encode(out, message)
    except (AttributeError, TypeError) as error:
        raise TypeError(f"cannot serialize {_name(cls)}: {error}") from error
    except (struct.error, ValueError, OverflowError) as error:
        raise ValueError(f"cannot serialize {_name(cls)}: {error}") from error
    return bytes(out)


def deserialize(data: bytes, cls: type[M]) -> M:
    """The message in the bytes, of either byte order; bytes after its end are ignored, as in ROS.

    Raises:
        DecodeError: the bytes are not a message of this class.
    """
    data = bytes(data)
    if len(data) < HEADER_SIZE:
        raise _header_error(cls, data)
    decoder = _decoders.get((cls, data[:2])) or _new_decoder(cls, data)
    try:
        message: M = decoder.run(data)
    except (struct.error, ValueError) as error:
        raise _decode_error(error, decoder, data, cls) from None
    return message


def _name(cls: type) -> str:
    return getattr(cls, "ROS_TYPE", None) or f"an object of type {cls.__name__}"


def _new_encoder(cls: type) -> Callable[[bytearray, Any], None]:
    if not issubclass(cls, Message):
        raise TypeError("it is not a message")
    _encoders[cls] = encoder(cls)
    return _encoders[cls]


def _new_decoder(cls: type[Message], data: bytes) -> Decoder:
    order = _ORDERS.get(data[:2])
    if order is None:
        raise _header_error(cls, data)
    _decoders[cls, data[:2]] = Decoder(cls, order)
    return _decoders[cls, data[:2]]


def _header_error(cls: type[Message], data: bytes) -> DecodeError:
    return DecodeError(
        f"{cls.ROS_TYPE}: at byte 0 of {len(data)}: expected the header of CDR, 00 01 00 00 or 00 00 00 00, "
        f"found {data[:HEADER_SIZE].hex(' ') or 'nothing'}",
        hint="Messages of ROS 2 travel as plain CDR (XCDR1); other encodings are not read.",
    )


def _decode_error(error: Exception, decoder: Decoder, data: bytes, cls: type[Message]) -> DecodeError:
    offset, fields = decoder.where(error)
    expected = str(error)
    if isinstance(error, struct.error):
        expected = f"more than the {max(len(data) - offset, 0)} bytes that are left"
    if isinstance(error, UnicodeDecodeError):
        expected = f"UTF-8, found {error.object[error.start : error.end].hex(' ')}"
    return DecodeError(
        f"{cls.ROS_TYPE}: at byte {offset} of {len(data)}, for {fields}: expected {expected}",
        hint="The bytes are cut short, damaged, or of another type.",
    )
