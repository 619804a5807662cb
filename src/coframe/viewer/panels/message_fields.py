# SPDX-License-Identifier: Apache-2.0
"""The fields of a message as rows, with long arrays shortened as NumPy does, and the names of fields for completion."""

from __future__ import annotations

import array
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.messages import find
from coframe.plotting.values import field_names
from coframe.viewer.protocol.panel_messages import InspectedField

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

__all__ = ["field_paths", "message_rows", "value_rows"]

_MAX_ROWS = 400
_MAX_DEPTH = 12
_MAX_TEXT = 300
_MAX_ELEMENTS = 16  # elements of a sequence that have separate rows
_EDGE_ELEMENTS = 3  # elements at each end of a shortened array
_MAX_NAMES = 200


def message_rows(topic: str, message: Any) -> list[InspectedField]:
    """Return the fields of a message in the order of its definition, nested ones after the field that contains them.

    At most 400 rows are returned; a row says how many elements of a sequence are omitted.
    """
    rows: list[InspectedField] = []
    for row in _fields(message, topic, 0):
        if len(rows) == _MAX_ROWS:
            rows.append(_row("", 0, "…", "", f"only the first {_MAX_ROWS} values are shown"))
            break
        rows.append(row)
    return rows


def value_rows(message: Any) -> Iterator[InspectedField]:
    """Yield the fields that have a value of their own, including those of nested messages. A sequence is one value."""
    yield from _own_values(message, "", 0)


def field_paths(message: Any, path: str) -> list[str]:
    """Return the paths that begin with a path and end at the next field: ``pose.`` gives ``pose.position``, ...

    Args:
        message: A message of the type.
        path: The text typed so far; the last part may be incomplete.
    """
    *steps, begin = path.split(".")
    value = message
    for step in steps:
        name, _, index = step.partition("[")
        if name not in field_names(value):
            return []
        value = _element(value, name) if index else _read_field(value, name)
    prefix = "".join(f"{step}." for step in steps)
    wanted = begin.partition("[")[0].lower()
    names = [name for name in field_names(value)[:_MAX_NAMES] if name.lower().startswith(wanted)]
    return [prefix + name + ("[0]" if _is_sequence(_read_field(value, name)) else "") for name in names]


def _own_values(message: Any, path: str, depth: int) -> Iterator[InspectedField]:
    types = _types(message)
    for name in field_names(message):
        value, own = _read_field(message, name), f"{path}.{name}"
        if depth < _MAX_DEPTH and field_names(value):
            yield from _own_values(value, own, depth + 1)
        else:
            yield next(_value(value, own, depth, name, types.get(name, "")))  # The others are elements of a sequence.


def _fields(message: Any, path: str, depth: int) -> Iterator[InspectedField]:
    types = _types(message)
    for name in field_names(message):
        yield from _value(_read_field(message, name), f"{path}.{name}", depth, name, types.get(name, ""))


def _value(value: Any, path: str, depth: int, name: str, type_: str) -> Iterator[InspectedField]:
    type_ = type_ or type(value).__name__
    if isinstance(value, bool | int | float | np.number | np.bool_):
        yield _row(path, depth, name, type_, _number(value), is_number=True)
    elif isinstance(value, str):
        yield _row(path, depth, name, type_, _shorten(value))
    elif isinstance(value, bytes | bytearray | memoryview | array.array | np.ndarray):
        yield from _numbers(value, path, depth, name, type_)
    elif isinstance(value, list | tuple):
        yield _row(path, depth, name, type_, f"{len(value)} {'element' if len(value) == 1 else 'elements'}")
        yield from _elements(value, path, depth + 1, type_)
    elif depth < _MAX_DEPTH and field_names(value):
        yield _row(path, depth, name, type_, "")
        yield from _fields(value, path, depth + 1)
    else:
        yield _row(path, depth, name, type_, _shorten(str(value)))


def _numbers(value: Any, path: str, depth: int, name: str, type_: str) -> Iterator[InspectedField]:
    is_bytes = isinstance(value, bytes | bytearray | memoryview)
    numbers: Any = np.frombuffer(value, np.uint8) if is_bytes else np.asarray(value).reshape(-1)
    yield _row(path, depth, name, type_, _array_text(numbers))
    yield from _elements(numbers[: _MAX_ELEMENTS + 1], path, depth + 1, type_, len(numbers))


def _elements(
    values: Sequence[Any], path: str, depth: int, type_: str, count: int | None = None
) -> Iterator[InspectedField]:
    count = len(values) if count is None else count
    element = _element_type(type_)
    for i in range(min(len(values), _MAX_ELEMENTS)):
        yield from _value(values[i], f"{path}[{i}]", depth, f"[{i}]", element)
    if count > _MAX_ELEMENTS:
        yield _row("", depth, "…", "", f"{count - _MAX_ELEMENTS} more")


def _row(path: str, depth: int, name: str, type_: str, text: str, *, is_number: bool = False) -> InspectedField:
    return InspectedField(
        path=path, depth=depth, name=_shorten(name), type=_shorten(type_), text=text, is_number=is_number
    )


def _number(value: Any) -> str:
    if isinstance(value, bool | np.bool_):
        return "true" if value else "false"
    return str(int(value)) if isinstance(value, int | np.integer) else f"{float(value):.9g}"


def _array_text(numbers: np.ndarray[Any, Any]) -> str:
    if len(numbers) <= 2 * _EDGE_ELEMENTS + 1:
        return f"[{' '.join(map(_number, numbers))}]"
    first, last = (" ".join(map(_number, part)) for part in (numbers[:_EDGE_ELEMENTS], numbers[-_EDGE_ELEMENTS:]))
    return f"[{first} … {last}] ({len(numbers)})"


def _shorten(text: str) -> str:
    return text if len(text) <= _MAX_TEXT else f"{text[:_MAX_TEXT]} … ({len(text)} characters)"


def _types(message: Any) -> dict[str, str]:
    return dict(message.get_fields_and_field_types()) if hasattr(message, "get_fields_and_field_types") else {}


def _element_type(type_: str) -> str:
    """Return the type of the elements of ``sequence<T>``, ``sequence<T, N>`` or ``T[N]``, or "" if it is unknown."""
    if type_.startswith("sequence<"):
        return type_.removeprefix("sequence<").removesuffix(">").partition(",")[0].strip()
    return type_.partition("[")[0] if "[" in type_ else ""


def _read_field(value: Any, name: str) -> Any:
    return value[name] if isinstance(value, dict) else getattr(value, name, None)


def _element(value: Any, name: str) -> Any:
    """Return an element of a sequence, or a new message of its type if it is empty."""
    found = _read_field(value, name)
    if isinstance(found, list | tuple) and found:
        return found[0]
    package, _, short = _element_type(_types(value).get(name, "")).rpartition("/")
    try:
        return find(f"{package}/msg/{short}")()
    except LookupError:
        return None


def _is_sequence(value: Any) -> bool:
    return isinstance(value, list | tuple | bytes | array.array | np.ndarray)
