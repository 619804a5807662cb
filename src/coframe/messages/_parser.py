# SPDX-License-Identifier: Apache-2.0
"""Parser for interface definitions: the text of ``.msg``, ``.srv`` and ``.action`` files."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.errors import InterfaceError
from coframe.messages._literals import parse_literal
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
from coframe.messages.limits import MAX_CONSTANTS, MAX_FIELDS, MAX_LINE, MAX_VALUES

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

# Type names in .msg files that have another name in IDL. rosidl maps `char` to a number.
_IDL_NAMES = {"bool": "boolean", "byte": "octet", "char": "uint8", "float32": "float", "float64": "double"}
_INTEGERS = {f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)}
# Names of types that ROS 1, Python, C++ and IDL have.
_REPLACEMENTS = {
    "time": "builtin_interfaces/Time",
    "duration": "builtin_interfaces/Duration",
    "boolean": "bool",
    "octet": "byte",
    "double": "float64",
    "float": "float32 or float64",
    "int": "int32 or int64",
    "long": "int64",
    "short": "int16",
    "unsigned": "uint32",
    "str": "string",
}

_LINE = re.compile(
    r"(?P<type>[\w/]+(?:<=\d+)?)(?P<many>\[(?:<=)?\d*\])?\s+(?P<name>\w+)\s*(?P<equals>=)?\s*(?P<value>.*)", re.ASCII
)
_SEPARATOR = re.compile(r"---[ \t]*")
_PACKAGE = re.compile(r"[a-z](?:_?[a-z0-9])*")
_FIELD = re.compile(r"[a-z](?:_?[a-z0-9])*")
_CONSTANT = re.compile(r"[A-Z](?:_?[A-Z0-9])*")
_MESSAGE = re.compile(r"[A-Z][A-Za-z0-9]*")
# Names that message classes use themselves. The values of fields are stored with an underscore before their names.
_RESERVED = {
    *{"get_fields_and_field_types", "fields_and_field_types", "SLOT_TYPES", "ROS_TYPE"},
    *{"repr_html_", "Message__values", "Message__conversions"},
}


class Field(NamedTuple):
    """A field. Its default is None if the file has none."""

    name: str
    type: AbstractType
    default: Any


class Constant(NamedTuple):
    """A constant. The value of an octet is bytes of length 1, as in Python messages."""

    name: str
    type: AbstractNestableType
    value: Any


class MessageStructure(NamedTuple):
    """The fields and constants of one message in file order, and the comment at the beginning of the file."""

    fields: list[Field]
    constants: list[Constant]
    comment: str


class Rules(NamedTuple):
    """The names that a definition can use.

    Attributes:
        field: The names of fields.
        field_text: A description of valid field names.
        constant: The names of constants.
        constant_text: A description of valid constant names.
        named: Returns the message type with a name, of a package if the name has none. Raises ValueError if there
            cannot be such a type.
    """

    field: re.Pattern[str]
    field_text: str
    constant: re.Pattern[str]
    constant_text: str
    named: Callable[[str, str], NamespacedType]


def parse(text: str, package: str, parts: int = 1, *, file: str | None = None) -> list[MessageStructure]:
    """Parse the contents of a definition file.

    Args:
        text: The content of the file.
        package: The package of type names without a package.
        parts: The number of structures: 1 for a message, 2 for a service, 3 for an action.
        file: The name of the file, for error messages.

    Raises:
        InterfaceError: A line is not valid, or the number of parts is different.
    """
    pieces: list[list[tuple[int, str]]] = [[]]
    for number, line in enumerate(text.splitlines(), 1):
        if _SEPARATOR.fullmatch(line):
            pieces.append([])
        else:
            pieces[-1].append((number, line))
    if len(pieces) != parts:
        raise InterfaceError(f"expected {parts} parts separated by '---', found {len(pieces)}", file=file)
    return [parse_structure(piece, package, RULES, file=file) for piece in pieces]


def check_message_name(name: str) -> None:
    """Raise ValueError if a message, service or action cannot have this name."""
    if not _MESSAGE.fullmatch(name):
        raise ValueError(f"the name {name!r} must begin with a capital letter and contain only letters and digits")


def add_unique(names: set[str], name: str) -> None:
    """Add the name of a field or constant, and raise ValueError if the message has it already, or cannot have it."""
    if name in names:
        raise ValueError(f"the name {name!r} is used twice")
    if name in _RESERVED:
        raise ValueError(f"the name {name!r} is reserved for an attribute of message classes")
    names.add(name)


def parse_structure(
    lines: Iterable[tuple[int, str]], package: str, rules: Rules, *, file: str | None = None
) -> MessageStructure:
    """Parse the lines of one message.

    Args:
        lines: Each line with its number.
        package: The package of type names without a package.
        rules: The names that the definition can use.
        file: The name of the file, for error messages.

    Raises:
        InterfaceError: A line is not valid, or there are too many.
    """
    lines = list(lines)
    structure = MessageStructure([], [], _opening_comment(line for _, line in lines))
    names: set[str] = set()
    for number, line in lines:
        content = remove_comment(line)
        if not content:
            continue
        try:
            member = _parse_line(content, package, rules)
            add_unique(names, member.name)
            add_member(structure, member)
        except ValueError as error:
            raise InterfaceError(f"{truncate(str(error))}, in: {truncate(content)}", line=number, file=file) from None
    return structure


def add_member(structure: MessageStructure, member: Field | Constant) -> None:
    """Add a field or constant to a message, and raise ValueError if there are too many."""
    if isinstance(member, Field):
        structure.fields.append(member)
        if len(structure.fields) > MAX_FIELDS:
            raise ValueError(f"the definition has more than {MAX_FIELDS} fields")
    else:
        structure.constants.append(member)
        if len(structure.constants) > MAX_CONSTANTS:
            raise ValueError(f"the definition has more than {MAX_CONSTANTS} constants")


def _parse_line(content: str, package: str, rules: Rules) -> Field | Constant:
    if len(content) > MAX_LINE:
        raise ValueError(f"a line has {len(content)} characters; the maximum is {MAX_LINE}")
    match = _LINE.fullmatch(content)
    if match is None:
        raise ValueError("not a field such as 'float64 x' or a constant such as 'uint8 RED=1'")
    name = match["name"]
    value_type = _nestable_type(match["type"], package, rules)
    if match["equals"]:
        if match["many"] or isinstance(value_type, NamespacedType):
            raise ValueError("a constant must be a number, a boolean or a string")
        if not rules.constant.fullmatch(name):
            raise ValueError(f"the name of a constant has {rules.constant_text}, not {name!r}")
        return Constant(name, value_type, parse_literal(match["value"], value_type))
    if not rules.field.fullmatch(name):
        raise ValueError(f"the name of a field has {rules.field_text}, not {name!r}")
    field_type = _nested_type(value_type, match["many"]) if match["many"] else value_type
    return Field(name, field_type, parse_literal(match["value"], field_type) if match["value"] else None)


def truncate(text: str) -> str:
    """Truncate text for an error message."""
    longest = 200
    return text if len(text) <= longest else f"{text[:longest]}..."


def _opening_comment(lines: Iterable[str]) -> str:
    comments: list[str] = []
    for line in lines:
        if line.startswith("#"):
            comments.append(line.lstrip("# ").rstrip())
        elif line.strip() or comments:
            break
    return " ".join(comments)


def remove_comment(line: str) -> str:
    """Return the line up to a ``#`` that is not inside a quoted string."""
    return re.sub(r"""^((?:[^#"']|"(?:[^"\\]|\\.)*"|'(?:[^'\\]|\\.)*')*)#.*$""", r"\1", line).strip()


def bounded_size(digits: str) -> int:
    """Return the size of an array or the bound of a sequence or string."""
    size = int(digits) if len(digits) < len(str(MAX_VALUES)) + 1 else MAX_VALUES + 1
    if not 1 <= size <= MAX_VALUES:
        raise ValueError(f"a size must be from 1 to {MAX_VALUES}, not {truncate(digits)}")
    return size


def _nestable_type(name: str, package: str, rules: Rules) -> AbstractNestableType:
    name, _, bound = name.partition("<=")
    if name == "string":
        return BoundedString(bounded_size(bound)) if bound else UnboundedString()
    if name == "wstring":
        return BoundedWString(bounded_size(bound)) if bound else UnboundedWString()
    if bound:
        raise ValueError(f"only strings can have a bound, not {name}")
    if name in _IDL_NAMES or name in _INTEGERS:
        return BasicType(_IDL_NAMES.get(name, name))
    return rules.named(name, package)


def _named_type(name: str, package: str) -> NamespacedType:
    owner, _, message = name.rpartition("/")
    if not (_MESSAGE.fullmatch(message) and _PACKAGE.fullmatch(owner or package)):
        known = f"; use {_REPLACEMENTS[name]}" if name in _REPLACEMENTS else ""
        raise ValueError(f"no type {name!r}{known}")
    return NamespacedType((owner or package, "msg"), message)


def _nested_type(value_type: AbstractNestableType, brackets: str) -> AbstractType:
    size = brackets[1:-1]
    if not size:
        return UnboundedSequence(value_type)
    if size.startswith("<="):
        return BoundedSequence(value_type, bounded_size(size[2:]))
    return Array(value_type, bounded_size(size))


# Those of rosidl, for files.
RULES = Rules(
    _FIELD,
    "small letters, digits and single underscores",
    _CONSTANT,
    "capital letters, digits and single underscores",
    _named_type,
)
