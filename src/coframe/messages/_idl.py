# SPDX-License-Identifier: Apache-2.0
"""Parser for the part of IDL 4.2 that rosidl uses for messages, services and actions.

That part has modules, structures, constants, type definitions, arrays, sequences, strings, and the annotations
``@default`` and ``@verbatim``; other annotations, such as ``@key`` and ``@unit``, are read and ignored.
"""

from __future__ import annotations

import ast
import re
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.messages._idl_expressions import evaluate
from coframe.messages._idl_tokens import Tokens
from coframe.messages._literals import check_value
from coframe.messages._parser import (
    Constant,
    Field,
    MessageStructure,
    add_member,
    add_unique,
    bounded_size,
    check_message_name,
)
from coframe.messages.definition import (
    AbstractNestableType,
    AbstractNestedType,
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
from coframe.messages.limits import MAX_CONSTANTS, MAX_NESTING, MAX_TYPES

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.errors import InterfaceError
    from coframe.messages._idl_tokens import Token

__all__ = ["parse_idl", "parse_recorded_idl"]

_BASIC_TYPES = {
    "short": "int16",
    "long": "int32",
    "long long": "int64",
    "unsigned short": "uint16",
    "unsigned long": "uint32",
    "unsigned long long": "uint64",
    **{name: name for name in ("float", "double", "boolean", "octet")},
    **{f"{sign}int{bits}": f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)},
}
_UNSUPPORTED_BY_ROSIDL = {
    "enum",
    "union",
    "bitset",
    "bitmask",
    "interface",
    "valuetype",
    "native",
    "map",
    "fixed",
    "any",
}
_TYPES_WITHOUT_PYTHON = {"char": "uint8", "wchar": "uint16", "long double": "double"}
_FIELD = re.compile(r"[A-Za-z](?:_?[A-Za-z0-9])*")
_RECORDED_FIELD = re.compile(r"[A-Za-z]\w*", re.ASCII)
_DDS_MODULE = "dds_"  # rosidl's DDS names: std_msgs::msg::dds_::Header_, with fields such as stamp_

# The parts of a definition of each kind: the suffixes of its structures.
_SUFFIXES = {"msg": ("",), "srv": ("_Request", "_Response"), "action": ("_Goal", "_Result", "_Feedback")}
_CONSTANTS = "_Constants"


class _Annotations(NamedTuple):
    default: Any
    comment: str


def parse_idl(text: str, package: str, kind: str, name: str, *, file: str | None = None) -> list[MessageStructure]:
    """Parse the text of an ``.idl`` file.

    Args:
        text: The content of the file.
        package: The package of the file.
        kind: ``msg``, ``srv`` or ``action``.
        name: The name of the message, service or action.
        file: The name of the file, for error messages.

    Returns:
        The structures: 1 for a message, 2 for a service, 3 for an action.

    Raises:
        InterfaceError: The text is not valid, or does not define this message, service or action.
    """
    tokens = Tokens(text, file)
    parser = _IdlParser()
    parser.read(tokens)
    structures = parser.structures()
    parts = []
    for suffix in _SUFFIXES[kind]:
        scoped = (package, kind, f"{name}{suffix}")
        if scoped not in structures:
            found = ", ".join("::".join(other) for other in structures) or "no structure"
            raise tokens.error(f"expected the structure {'::'.join(scoped)}, found {found}")
        parts.append(structures[scoped])
    return parts


def parse_recorded_idl(texts: Iterable[tuple[int, str]]) -> dict[tuple[str, ...], MessageStructure]:
    """Parse IDL in a recording, which can have names that rosidl does not allow.

    Args:
        texts: The texts, each with the number of its first line, those that others use first.

    Returns:
        The structures by their names, such as ``("demo_msgs", "msg", "Pose")``, without the parts of DDS names.

    Raises:
        InterfaceError: A text is not valid, or there are too many structures or constants.
    """
    parser = _IdlParser(is_recorded=True)
    for line, text in texts:
        parser.read(Tokens(text, None, line))
    return parser.structures()


class _IdlParser:
    """The definitions of texts by their scoped names, such as ``("demo_msgs", "msg", "Pose")``."""

    _tokens: Tokens

    def __init__(self, *, is_recorded: bool = False) -> None:
        self._is_recorded = is_recorded
        self._structures: dict[tuple[str, ...], MessageStructure] = {}
        self._constants: dict[tuple[str, ...], Constant] = {}
        self._typedefs: dict[tuple[str, ...], AbstractType] = {}

    def read(self, tokens: Tokens) -> None:
        """Read a text."""
        self._tokens = tokens
        while tokens.peek().kind != "end":
            self._parse_definition(())

    def structures(self) -> dict[tuple[str, ...], MessageStructure]:
        """Return the structures, each with its constants."""
        for path, constant in self._constants.items():
            *module, name = path[:-1] or ("",)
            owner = (*module, name.removesuffix(_CONSTANTS))
            if name.endswith(_CONSTANTS) and owner in self._structures:
                self._structures[owner].constants.append(constant)
        self._constants.clear()
        return self._structures

    def _parse_definition(self, scope: tuple[str, ...]) -> None:
        annotations = self._parse_annotations()
        line = self._tokens.peek().line
        word = self._tokens.take("name").text
        try:
            if word == "module":
                self._parse_module(scope)
            elif word == "struct":
                self._parse_struct(scope, annotations)
            elif word == "const":
                self._parse_constant(scope)
            elif word == "typedef":
                self._parse_typedef(scope)
            else:
                known = (
                    "rosidl does not support it"
                    if word in _UNSUPPORTED_BY_ROSIDL
                    else "expected module, struct or const"
                )
                raise self._tokens.error(f"'{word}': {known}", line)
        except ValueError as error:
            raise self._add_line(error, line) from None
        self._tokens.expect(";")

    def _add_line(self, error: ValueError, line: int) -> InterfaceError:
        return self._tokens.error(str(error), line) if getattr(error, "line", None) is None else error  # type: ignore[return-value]

    def _parse_module(self, scope: tuple[str, ...]) -> None:
        if len(scope) == MAX_NESTING:
            raise self._tokens.error(f"modules are nested more than {MAX_NESTING} levels deep")
        inner = (*scope, self._tokens.take("name").text)
        self._tokens.expect("{")
        while not self._tokens.accept("}"):
            self._parse_definition(inner)

    def _parse_struct(self, scope: tuple[str, ...], annotations: _Annotations) -> None:
        name = self._tokens.take("name").text
        if not self._is_recorded:
            check_message_name(name.partition("_")[0])
        if len(self._structures) == MAX_TYPES:
            raise self._tokens.error(f"the definition has more than {MAX_TYPES} structures")
        self._tokens.expect("{")
        structure = MessageStructure([], [], annotations.comment)
        names: set[str] = set()
        while not self._tokens.accept("}"):
            line = self._tokens.peek().line
            try:
                for field in self._parse_members(scope):
                    add_unique(names, field.name)
                    add_member(structure, field)
            except ValueError as error:
                raise self._add_line(error, line) from None
        if [field.name for field in structure.fields] == ["structure_needs_at_least_one_member"]:
            structure.fields.clear()  # rosidl writes this member into structures without fields.
        self._structures.setdefault(self._remove_dds_parts((*scope, name)), structure)

    def _parse_members(self, scope: tuple[str, ...]) -> list[Field]:
        default = self._parse_annotations().default
        type_ = self._parse_type(scope)
        fields = []
        while True:
            name = self._tokens.take("name").text
            if _DDS_MODULE in scope:
                name = name.removesuffix("_")
            if not (_RECORDED_FIELD if self._is_recorded else _FIELD).fullmatch(name):
                raise ValueError(f"invalid field name {name!r}: use letters, digits and single underscores")
            full_type = self._parse_dimensions(type_, scope)
            fields.append(Field(name, full_type, None if default is None else _default_literal(default, full_type)))
            if not self._tokens.accept(","):
                self._tokens.expect(";")
                return fields

    def _parse_constant(self, scope: tuple[str, ...]) -> None:
        type_ = self._parse_nestable_type(scope)
        name = self._tokens.take("name").text
        self._tokens.expect("=")
        if len(self._constants) == MAX_CONSTANTS:
            raise self._tokens.error(f"the definition has more than {MAX_CONSTANTS} constants")
        self._constants.setdefault((*scope, name), Constant(name, type_, check_value(self._parse_value(scope), type_)))

    def _parse_typedef(self, scope: tuple[str, ...]) -> None:
        type_ = self._parse_type(scope)
        name = self._tokens.take("name").text
        self._typedefs.setdefault((*scope, name), self._parse_dimensions(type_, scope))

    def _parse_type(self, scope: tuple[str, ...]) -> AbstractType:
        if not self._tokens.accept("sequence"):
            return self._parse_single_type(scope)
        self._tokens.expect("<")
        inner = self._parse_nestable_type(scope)
        bound = self._parse_size(scope, in_brackets=True) if self._tokens.accept(",") else None
        self._tokens.expect(">")
        return UnboundedSequence(inner) if bound is None else BoundedSequence(inner, bound)

    def _parse_nestable_type(self, scope: tuple[str, ...]) -> AbstractNestableType:
        type_ = None if self._tokens.peek().text == "sequence" else self._parse_single_type(scope)
        if not isinstance(type_, AbstractNestableType):
            raise self._tokens.error(
                "ROS does not support sequences of sequences or arrays; put the inner one into a message"
            )
        return type_

    def _parse_single_type(self, scope: tuple[str, ...]) -> AbstractType:
        name = self._tokens.take("name").text
        if name in {"string", "wstring"}:
            return self._parse_string(name, scope)
        while name in {"unsigned", "long"} and self._tokens.peek().text in {"long", "short", "double"}:
            word = self._tokens.take().text
            name = f"{name} {word}"
            if word == "long" and name == "unsigned long" and self._tokens.accept("long"):
                name += " long"
        if name in _BASIC_TYPES:
            return BasicType(_BASIC_TYPES[name])
        if name == "char" and self._is_recorded:
            return BasicType("uint8")
        if name in _TYPES_WITHOUT_PYTHON:
            raise self._tokens.error(f"the type {name} is not supported; use {_TYPES_WITHOUT_PYTHON[name]}")
        if name in _UNSUPPORTED_BY_ROSIDL:
            raise self._tokens.error(f"the type {name} is not supported by rosidl")
        return self._named_type(name, scope)

    def _parse_string(self, name: str, scope: tuple[str, ...]) -> AbstractType:
        bound = None
        if self._tokens.accept("<"):
            bound = self._parse_size(scope, in_brackets=True)
            self._tokens.expect(">")
        if name == "string":
            return UnboundedString() if bound is None else BoundedString(bound)
        return UnboundedWString() if bound is None else BoundedWString(bound)

    def _named_type(self, name: str, scope: tuple[str, ...]) -> AbstractType:
        parts = tuple(name.removeprefix("::").split("::"))
        for known in _scopes(scope, parts):
            if known in self._typedefs:
                return self._typedefs[known]
        if len(parts) == 1:
            parts = (*scope, *parts)
        parts = self._remove_dds_parts(parts)
        if self._is_recorded and len(parts) == 2:
            parts = (parts[0], "msg", parts[1])
        if len(parts) != 3 or parts[1] not in _SUFFIXES:
            raise self._tokens.error(
                f"no type {name}; types of other files have names such as geometry_msgs::msg::Pose"
            )
        return NamespacedType(parts[:2], parts[2])

    def _parse_dimensions(self, type_: AbstractType, scope: tuple[str, ...]) -> AbstractType:
        if not self._tokens.accept("["):
            return type_
        size = self._parse_size(scope)
        self._tokens.expect("]")
        if not isinstance(type_, AbstractNestableType) or self._tokens.peek().text == "[":
            raise self._tokens.error(
                "ROS does not support arrays of sequences or arrays; put the inner one into a message"
            )
        return Array(type_, size)

    def _remove_dds_parts(self, path: tuple[str, ...]) -> tuple[str, ...]:
        """Return a scoped name without the parts that rosidl adds to DDS names."""
        if not self._is_recorded or len(path) < 2 or path[-2] != _DDS_MODULE:
            return path
        return (*path[:-2], path[-1].removesuffix("_"))

    def _parse_size(self, scope: tuple[str, ...], *, in_brackets: bool = False) -> int:
        return bounded_size(str(self._parse_value(scope, in_brackets=in_brackets)))

    def _parse_value(self, scope: tuple[str, ...], *, in_brackets: bool = False) -> Any:
        """Take an expression."""

        def constant(token: Token) -> Any:
            parts = tuple(token.text.removeprefix("::").split("::"))
            for known in _scopes(scope, parts):
                if known in self._constants:
                    return self._constants[known].value
            raise self._tokens.error(f"expected a value, found {token.text}", token.line)

        line = self._tokens.peek().line
        try:
            return evaluate(self._tokens, constant, in_brackets=in_brackets)
        except ValueError as error:
            raise self._add_line(error, line) from None

    def _parse_annotations(self) -> _Annotations:
        default, comment = None, ""
        while self._tokens.accept("@"):
            name = self._tokens.take("name").text
            values = self._parse_arguments()
            if name == "default":
                default = values.get("value")
            if name == "verbatim" and values.get("language") == "comment":
                comment = " ".join(str(values.get("text", "")).split())
        return _Annotations(default, comment)

    def _parse_arguments(self) -> dict[str, Any]:
        values: dict[str, Any] = {}
        if not self._tokens.accept("("):
            return values
        while not self._tokens.accept(")"):
            if self._tokens.peek().kind == "name" and self._tokens.peek().text not in {"TRUE", "FALSE"}:
                name = self._tokens.take().text
                values[name] = self._parse_value(()) if self._tokens.accept("=") else None
            else:
                values["value"] = self._parse_value(())
            self._tokens.accept(",")
        return values


def _scopes(scope: tuple[str, ...], parts: tuple[str, ...]) -> list[tuple[str, ...]]:
    """Return the full names that a name can have, from the innermost module to the outermost."""
    return [(*scope[:depth], *parts) for depth in range(len(scope), -1, -1)]


def _default_literal(value: Any, type_: AbstractType) -> Any:
    if not isinstance(type_, AbstractNestedType):
        return check_value(float(value) if _is_float(type_) and isinstance(value, int) else value, type_)
    try:
        return check_value(ast.literal_eval(value), type_)  # rosidl writes lists as strings: "(1, 2, 3)".
    except (SyntaxError, TypeError, MemoryError, RecursionError):
        raise ValueError(f'the default of a list must be a string such as "(1, 2)", not {value!r}') from None


def _is_float(type_: AbstractType) -> bool:
    return isinstance(type_, BasicType) and type_.typename in {"float", "double"}
