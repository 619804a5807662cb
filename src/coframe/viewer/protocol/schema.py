# SPDX-License-Identifier: Apache-2.0
"""Field types of the protocol, derived from the annotations in `messages`.

The same types check client messages (`FieldType.check`) and are written as TypeScript by
``scripts/generate_protocol.py``.
"""

from __future__ import annotations

import dataclasses
import math
import re
import types
import typing
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Protocol, Union, get_args, get_origin, get_type_hints

from coframe.errors import CoframeError
from coframe.viewer.protocol._limits import Clamp, Range

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = [
    "Array",
    "Field",
    "FieldType",
    "Flag",
    "InvalidFieldError",
    "Json",
    "Literals",
    "Map",
    "Nullable",
    "Number",
    "Record",
    "Text",
    "Tuple",
    "field_type",
    "record",
    "shorten",
]


_SURROGATE = re.compile("[\ud800-\udfff]")


class InvalidFieldError(CoframeError, ValueError):
    """A field whose value has the wrong type or is out of range.

    Attributes:
        path: The field, such as ``displays[3].topic``.
        expected: A description of valid values.
        value: The invalid value.
    """

    def __init__(self, path: str, expected: str, value: object) -> None:
        super().__init__(f"{path} must be {expected}, not {shorten(value)}")
        self.path = path
        self.expected = expected
        self.value = value


class FieldType(Protocol):
    """A type of values in JSON."""

    def check(self, value: object, path: str) -> Any:
        """Check a value and return it as the server uses it.

        Raises:
            InvalidFieldError: The value has another type or is out of range.
        """


@dataclass(frozen=True)
class Text:
    """A string."""

    def check(self, value: object, path: str) -> str:
        """Return the string."""
        if not isinstance(value, str) or _SURROGATE.search(value):  # A lone surrogate is not a character.
            raise InvalidFieldError(path, "text", value)
        return value


@dataclass(frozen=True)
class Flag:
    """A boolean."""

    def check(self, value: object, path: str) -> bool:
        """Return the boolean."""
        if not isinstance(value, bool):
            raise InvalidFieldError(path, "true or false", value)
        return value


@dataclass(frozen=True)
class Json:
    """An object with any content."""

    def check(self, value: object, path: str) -> dict[str, Any]:
        """Return the object."""
        if not isinstance(value, dict):
            raise InvalidFieldError(path, "an object", value)
        return value


@dataclass(frozen=True)
class Number:
    """A finite number, optionally an integer and within limits."""

    whole: bool = False
    limits: Range | Clamp | None = None

    def check(self, value: object, path: str) -> float:
        """Return the number."""
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise InvalidFieldError(path, self._expected_text(), value)
        limits = self.limits
        if isinstance(limits, Clamp) and value == value:  # noqa: PLR0124 - NaN differs from itself
            value = min(max(value, limits.smallest), limits.largest)
        # A huge int cannot be converted to a float, and the limits of an integer must be compared exactly.
        in_range = limits is None or limits.smallest <= value <= limits.largest
        if not in_range or not _is_finite(value) or (self.whole and value != int(value)):
            raise InvalidFieldError(path, self._expected_text(), value)
        return int(value) if self.whole else float(value)

    def _expected_text(self) -> str:
        kind = "a whole number" if self.whole else "a number"
        return f"{kind} from {self.limits.smallest:g} to {self.limits.largest:.10g}" if self.limits else kind


@dataclass(frozen=True)
class Literals:
    """One of several strings or integers."""

    values: tuple[str | int, ...]

    def check(self, value: object, path: str) -> str | int:
        """Return the value."""
        for known in self.values:
            if value == known and not isinstance(value, bool):
                return known
        raise InvalidFieldError(path, " or ".join(map(repr, self.values)), value)


@dataclass(frozen=True)
class Nullable:
    """A value or null."""

    inner: FieldType

    def check(self, value: object, path: str) -> Any:
        """Return the value, or None."""
        return None if value is None else self.inner.check(value, path)


@dataclass(frozen=True)
class Array:
    """An array of values of one type."""

    item: FieldType

    def check(self, value: object, path: str) -> list[Any]:
        """Return the checked items."""
        if not isinstance(value, list):
            raise InvalidFieldError(path, "an array", value)
        return [self.item.check(item, f"{path}[{index}]") for index, item in enumerate(value)]


@dataclass(frozen=True)
class Tuple:
    """An array of fixed length."""

    items: tuple[FieldType, ...]

    def check(self, value: object, path: str) -> tuple[Any, ...]:
        """Return the checked items."""
        if not isinstance(value, list) or len(value) != len(self.items):
            raise InvalidFieldError(path, f"an array of {len(self.items)} values", value)
        return tuple(
            item.check(one, f"{path}[{index}]") for index, (item, one) in enumerate(zip(self.items, value, strict=True))
        )


@dataclass(frozen=True)
class Map:
    """An object whose values have one type."""

    item: FieldType

    def check(self, value: object, path: str) -> dict[str, Any]:
        """Return the checked values."""
        if not isinstance(value, dict):
            raise InvalidFieldError(path, "an object", value)
        return {key: self.item.check(item, f"{path}.{key}") for key, item in value.items()}


@dataclass(frozen=True)
class Field:
    """A field of a record.

    Attributes:
        attribute: Its name in Python.
        name: Its name in JSON.
        type: The type of its values.
        required: Whether it must be present.
    """

    attribute: str
    name: str
    type: FieldType
    required: bool


class Record:
    """An object with known fields. Other fields are ignored.

    Args:
        python_type: The TypedDict or dataclass in `messages`.
    """

    def __init__(self, python_type: type) -> None:
        self.python_type = python_type
        self.name = python_type.__name__
        self.is_dataclass = dataclasses.is_dataclass(python_type)
        self._fields: tuple[Field, ...] | None = None

    @property
    def fields(self) -> tuple[Field, ...]:
        """The fields; resolved lazily, because a record may contain itself."""
        if self._fields is None:
            self._fields = _dataclass_fields(self.python_type) if self.is_dataclass else _dict_fields(self.python_type)
        return self._fields

    def check(self, value: object, path: str) -> Any:
        """Return a dict or an instance of the dataclass."""
        if not isinstance(value, dict):
            raise InvalidFieldError(path, "an object", value)
        return self.build(value, f"{path}." if path else "")

    def build(self, values: Mapping[str, Any], prefix: str = "") -> Any:
        """Return a dict or an instance of the dataclass from the fields of an object.

        Raises:
            InvalidFieldError: A field is missing or invalid.
        """
        checked = {}
        for field in self.fields:
            if field.name in values:
                checked[field.attribute] = field.type.check(values[field.name], prefix + field.name)
            elif field.required:
                field.type.check(None, prefix + field.name)
                raise InvalidFieldError(prefix + field.name, "present", None)
        return self.python_type(**checked) if self.is_dataclass else checked


_RECORDS: dict[type, Record] = {}


def record(python_type: type) -> Record:
    """Return the record of a TypedDict or dataclass."""
    known = _RECORDS.get(python_type)
    if known is None:
        known = _RECORDS[python_type] = Record(python_type)
    return known


def field_type(annotation: Any) -> FieldType:  # noqa: PLR0911 - one per kind of type
    """Return the type of the values of an annotation.

    Raises:
        TypeError: The protocol has no such type.
    """
    origin, arguments = get_origin(annotation), get_args(annotation)
    if origin is typing.Annotated:
        limits = next((extra for extra in arguments[1:] if isinstance(extra, Range | Clamp)), None)
        return Number(whole=arguments[0] is int, limits=limits)
    if origin is Literal:
        return Literals(arguments)
    if origin in {Union, types.UnionType} and len(arguments) == 2 and arguments[1] is type(None):
        return Nullable(field_type(arguments[0]))
    if origin is list:
        return Array(field_type(arguments[0]))
    if origin is tuple:
        return Tuple(tuple(field_type(argument) for argument in arguments))
    if origin is dict:
        return Json() if arguments[1] is Any else Map(field_type(arguments[1]))
    if annotation in _PLAIN_TYPES:
        return _PLAIN_TYPES[annotation]
    if typing.is_typeddict(annotation) or dataclasses.is_dataclass(annotation):
        return record(annotation)
    raise TypeError(f"the viewer's protocol has no type for {annotation!r}")


_PLAIN_TYPES: dict[Any, FieldType] = {str: Text(), bool: Flag(), int: Number(whole=True), float: Number()}


def shorten(value: object) -> str:
    """Return the repr of a value, truncated to 60 characters."""
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


def _dataclass_fields(python_type: Any) -> tuple[Field, ...]:
    hints = get_type_hints(python_type, include_extras=True)
    return tuple(
        Field(
            field.name,
            field.name.rstrip("_"),
            field_type(hints[field.name]),
            field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING,
        )
        for field in dataclasses.fields(python_type)
    )


def _dict_fields(python_type: Any) -> tuple[Field, ...]:
    hints = get_type_hints(python_type, include_extras=True)
    required = python_type.__required_keys__
    return tuple(Field(name, name, field_type(hint), name in required) for name, hint in hints.items())


def _is_finite(value: float) -> bool:
    try:
        return math.isfinite(value)
    except OverflowError:
        return False
