# SPDX-License-Identifier: Apache-2.0
"""Parser for interface definitions: the text of ``.msg``, ``.srv`` and ``.action`` files."""

from __future__ import annotations

import ast
import re
from typing import Any, NamedTuple

from coframe.messages.definition import (
    AbstractNestableType,
    AbstractType,
    Array,
    BasicType,
    BoundedSequence,
    BoundedString,
    BoundedWString,
    NamespacedType,
    UnboundedSequence,
    UnboundedString,
    UnboundedWString,
)

# Type names in .msg files that have another name in IDL. rosidl maps `char` to a number.
_IDL_NAMES = {"bool": "boolean", "byte": "octet", "char": "uint8", "float32": "float", "float64": "double"}
_INTEGERS = {f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)}

_LINE = re.compile(
    r"(?P<type>[\w/]+(?:<=\d+)?)(?P<many>\[(?:<=)?\d*\])?\s+(?P<name>\w+)\s*(?P<equals>=)?\s*(?P<value>.*)"
)
_SEPARATOR = re.compile(r"^---[ \t]*$", re.MULTILINE)


class Field(NamedTuple):
    """A field; its default is None if the file has none."""

    name: str
    type: AbstractType
    default: Any


class Constant(NamedTuple):
    """A constant; the value of an octet is bytes of length 1, as in Python messages."""

    name: str
    type: AbstractNestableType
    value: Any


class Structure(NamedTuple):
    """The fields and constants of one message in file order, and the comment at the beginning of the file."""

    fields: list[Field]
    constants: list[Constant]
    comment: str


def parse(text: str, package: str, parts: int = 1) -> list[Structure]:
    """Parse the text of a definition file.

    Args:
        text: The content of the file.
        package: The package of type names without a package.
        parts: The number of structures: 1 for a message, 2 for a service, 3 for an action.

    Raises:
        ValueError: A line is not valid, or the number of parts is different.
    """
    pieces = _SEPARATOR.split(text)
    if len(pieces) != parts:
        raise ValueError(f"expected {parts} parts separated by '---', found {len(pieces)}")
    return [_parse_structure(piece, package) for piece in pieces]


def _parse_structure(text: str, package: str) -> Structure:
    structure = Structure([], [], _opening_comment(text))
    for line in text.splitlines():
        content = without_comment(line)
        if not content:
            continue
        match = _LINE.fullmatch(content)
        if match is None:
            raise ValueError(f"not a field or constant: {line!r}")
        value_type = _nestable(match["type"], package)
        if match["equals"]:
            structure.constants.append(Constant(match["name"], value_type, _literal(match["value"], value_type)))
            continue
        field_type = _nested(value_type, match["many"]) if match["many"] else value_type
        default = _literal(match["value"], value_type) if match["value"] else None
        structure.fields.append(Field(match["name"], field_type, default))
    return structure


def _opening_comment(text: str) -> str:
    lines: list[str] = []
    for line in text.strip().splitlines():
        if not line.startswith("#"):
            break
        lines.append(line.lstrip("# ").rstrip())
    return " ".join(lines)


def without_comment(line: str) -> str:
    """Return the line up to a ``#`` that is not inside a quoted string."""
    return re.sub(r"""^((?:[^#"']|"[^"]*"|'[^']*')*)#.*$""", r"\1", line).strip()


def _nestable(name: str, package: str) -> AbstractNestableType:
    name, _, bound = name.partition("<=")
    if name == "string":
        return BoundedString(int(bound)) if bound else UnboundedString()
    if name == "wstring":
        return BoundedWString(int(bound)) if bound else UnboundedWString()
    if bound:
        raise ValueError(f"only strings can have a bound, not {name}")
    if name in _IDL_NAMES or name in _INTEGERS:
        return BasicType(_IDL_NAMES.get(name, name))
    owner, _, message = name.rpartition("/")
    return NamespacedType((owner or package, "msg"), message)


def _nested(value_type: AbstractNestableType, brackets: str) -> AbstractType:
    size = brackets[1:-1]
    if not size:
        return UnboundedSequence(value_type)
    if size.startswith("<="):
        return BoundedSequence(value_type, int(size[2:]))
    return Array(value_type, int(size))


def _literal(text: str, type_: AbstractNestableType) -> Any:
    if text.startswith("["):
        return [_literal(item.strip(), type_) for item in text[1:-1].split(",") if item.strip()]
    if not isinstance(type_, BasicType):
        return ast.literal_eval(text) if text[:1] in {'"', "'"} else text
    if type_.typename == "boolean":
        return text.lower() in {"true", "1"}
    if type_.typename in {"float", "double"}:
        return float(text)
    number = int(text, 0)
    return bytes([number]) if type_.typename == "octet" else number
