# SPDX-License-Identifier: Apache-2.0
"""Messages as compact YAML for display, in the order of their fields."""

from __future__ import annotations

import math
import re
from array import array
from itertools import islice
from typing import TYPE_CHECKING, Any

import coframe.lazy_numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["to_yaml"]

_PLAIN_STRING = re.compile(r"[A-Za-z_/][A-Za-z0-9_/.-]*")
# Plain words that YAML 1.1 reads as something other than text.
_RESERVED = {"true", "false", "yes", "no", "on", "off", "y", "n", "null"}


def to_yaml(message: Any, *, max_items: int | None = None) -> str:
    """Return a message as compact YAML with comments; ``str(message)`` is its repr, as in rclpy.

    No other package is needed. `rosidl_runtime_py.message_to_yaml` returns the output that ``ros2 topic echo`` prints,
    which has one line for each element of a sequence.

    Args:
        message: The message to print.
        max_items: Maximum number of elements of a sequence and characters of a string; a comment gives the number of
            omitted ones. None shows everything, and the result contains the whole message.

    Returns:
        The text, with a line break at the end. Sequences of numbers are on one line.

    Example:
        >>> from coframe.messages import find, to_yaml
        >>> point = find("geometry_msgs/msg/PointStamped")()
        >>> point.header.frame_id = "map"
        >>> print(to_yaml(point))
        header:
          stamp:
            sec: 0
            nanosec: 0
          frame_id: map
        point:
          x: 0.0
          y: 0.0
          z: 0.0
        <BLANKLINE>
    """
    return "\n".join(_lines(message, max_items)) + "\n"


def _lines(message: Any, most: int | None) -> Iterator[str]:
    fields = message.get_fields_and_field_types()
    if not fields:
        yield "{}"
    for name in fields:
        value = getattr(message, name)
        if hasattr(value, "get_fields_and_field_types"):
            yield from _indent_lines(f"{name}:", "  ", list(_lines(value, most)))
        elif isinstance(value, (list, tuple)) and value and hasattr(value[0], "get_fields_and_field_types"):
            yield f"{name}:{_omitted_text(len(value), most)}"
            for item in islice(value, most):
                first, *others = _lines(item, most)
                yield f"- {first}"
                yield from (f"  {line}" for line in others)
        else:
            yield f"{name}: {_value(value, most)}"


def _indent_lines(title: str, indent: str, lines: list[str]) -> Iterator[str]:
    if lines == ["{}"]:
        yield f"{title} {{}}"
        return
    yield title
    yield from (f"{indent}{line}" for line in lines)


def _value(value: Any, most: int | None) -> str:
    if isinstance(value, str):
        shown = value if most is None else value[:most]
        return _text(shown) + _omitted_text(len(value), most, "character")
    if isinstance(value, bytes) and len(value) == 1:  # ROS's type byte
        return str(value[0])
    if isinstance(value, (list, tuple, array, bytes, bytearray)) or np.is_array(value):
        return f"[{', '.join(_value(item, most) for item in islice(value, most))}]{_omitted_text(len(value), most)}"
    return _number(value)


def _omitted_text(size: int, most: int | None, noun: str = "item") -> str:
    if most is None or size <= most:
        return ""
    return f"  # and {size - most} more {noun}{'' if size - most == 1 else 's'}"


def _number(value: Any) -> str:
    if np.is_scalar(value):
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if not isinstance(value, float):
        return str(int(value))
    if math.isnan(value):
        return ".nan"
    if math.isinf(value):
        return ".inf" if value > 0 else "-.inf"
    text = repr(value)
    mantissa, exponent, power = text.partition("e")
    # YAML 1.1 reads 1e-05 as text, and 1.0e-05 as a number.
    return f"{mantissa}.0e{power}" if exponent and "." not in mantissa else text


def _text(value: str) -> str:
    if _PLAIN_STRING.fullmatch(value) and value.lower() not in _RESERVED:
        return value
    return '"' + "".join(map(_escape, value)) + '"'


def _escape(character: str) -> str:
    if character in {'"', "\\"}:
        return f"\\{character}"
    if character.isprintable():
        return character
    number = ord(character)
    return f"\\x{number:02x}" if number < 0x100 else f"\\u{number:04x}" if number < 0x10000 else f"\\U{number:08x}"
