# SPDX-License-Identifier: Apache-2.0
"""Messages from dictionaries."""

import array
import functools
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from rosidl_runtime_py.convert import get_message_slot_types
from rosidl_runtime_py.import_message import import_message_from_namespaced_type

__all__ = ["set_message_fields"]

StampSetter = Callable[[Any], None]

_HEADER = ("std_msgs", "msg", "Header")
_TIME = ("builtin_interfaces", "msg", "Time")


def set_message_fields(
    msg: Any, values: Mapping[str, Any], expand_header_auto: bool = False, expand_time_now: bool = False
) -> list[StampSetter]:
    """Set fields of a message from a dictionary, for example one that was read from YAML.

    Args:
        msg: The message. Fields that `values` does not have are not changed.
        values: Values by the names of fields; dictionaries for nested messages.
        expand_header_auto: Whether the value "auto" of a `std_msgs/Header` stands for the current time.
        expand_time_now: Whether the value "now" of a `builtin_interfaces/Time` stands for the current time.

    Returns:
        For each "auto" and "now" a function that sets the stamp of the message to a `builtin_interfaces/Time`.

    Raises:
        AttributeError: The message does not have a field.
        TypeError: A value does not have the type of its field.
    """
    setters: list[StampSetter] = []
    _set_fields(msg, values, setters, expand_header_auto, expand_time_now)
    return setters


def _set_fields(message: Any, values: Any, setters: list[StampSetter], auto: bool, now: bool) -> None:
    if not hasattr(values, "items"):
        raise TypeError(f"Value '{values}' is expected to be a dictionary but is a {type(values).__name__}")
    types = get_message_slot_types(message)
    for name, value in values.items():
        field = getattr(message, name)
        type_ = types[name]
        full_name = _full_name(type_)
        if auto and value == "auto" and full_name == _HEADER:
            setters.append(functools.partial(setattr, field, "stamp"))
            continue
        if now and value == "now" and full_name == _TIME:
            setters.append(functools.partial(setattr, message, name))
            continue
        if full_name is not None and not isinstance(value, type(field)):
            new = type(field)()
            _set_fields(new, value, setters, auto, now)
        else:
            new = _convert(field, value)
        elements = getattr(type_, "value_type", None)
        if hasattr(elements, "namespaced_name"):
            new = [_element(elements, element, setters, auto, now) for element in new]
        elif getattr(elements, "typename", None) == "octet":
            new = [_byte(element) for element in new]
        setattr(message, name, new)


def _element(type_: Any, value: Any, setters: list[StampSetter], auto: bool, now: bool) -> Any:
    """Return an element of a sequence of messages."""
    class_ = import_message_from_namespaced_type(type_)
    if isinstance(value, class_):
        return value
    message = class_()
    _set_fields(message, value, setters, auto, now)
    return message


def _convert(field: Any, value: Any) -> Any:
    """Return a value of a field that is not a message, with the type of its present value."""
    if isinstance(field, array.array):
        return array.array(field.typecode, value)
    if isinstance(field, np.ndarray):
        return np.array(value, dtype=field.dtype)
    if isinstance(value, type(field)):
        return value
    return _byte(value) if isinstance(field, bytes) else type(field)(value)


def _byte(value: Any) -> bytes:
    """Return an element of a byte array. YAML has only numbers for it; rosidl requires bytes of length 1."""
    if isinstance(value, bytes) and len(value) == 1:
        return value
    if not isinstance(value, int) or not 0 <= value <= 255:
        raise TypeError(f"a byte is a number from 0 to 255, not {value!r}")
    return bytes([value])


def _full_name(type_: Any) -> tuple[str, ...] | None:
    """Return the parts of the name of a message type, None for other types."""
    return tuple(type_.namespaced_name()) if hasattr(type_, "namespaced_name") else None
