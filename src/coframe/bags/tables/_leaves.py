# SPDX-License-Identifier: Apache-2.0
"""The values in messages of a type that become columns, such as x, y and z of a position."""

from __future__ import annotations

from dataclasses import dataclass, replace
from operator import attrgetter
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

import numpy as np

from coframe.bags.tables.columns import Key
from coframe.errors import CoframeError
from coframe.messages.definition import (
    AbstractGenericString,
    AbstractNestedType,
    Array,
    BasicType,
    NamespacedType,
)
from coframe.messages.registry import class_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from coframe.bags.tables.columns import Step
    from coframe.messages.definition import AbstractType

__all__ = [
    "DTYPES",
    "MAX_LEAVES",
    "Getter",
    "Kind",
    "Leaf",
    "MissingElementError",
    "at_path",
    "class_fields",
    "class_leaves",
    "is_named",
    "name_lists",
    "named_leaves",
    "names_beside",
    "reader",
    "value_fields",
    "value_leaves",
]

Kind: TypeAlias = Literal["number", "boolean", "time", "text", "array", "numbers", "bytes", "list"]
Path: TypeAlias = "tuple[str, ...]"
Names: TypeAlias = "Mapping[tuple[str, ...], list[str]]"

MAX_LEAVES = 10_000  # of one column
_TIME_FIELDS = ({"sec", "nanosec"}, {"sec", "nsec"}, {"secs", "nsecs"}, {"seconds", "nanos"})
_NAME_FIELDS = ("name", "names", "joint_names")  # sequences of strings that name the elements next to them
_BYTE_TYPES = {"uint8", "octet", "char"}
_INTEGER_TYPES = [f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)]
DTYPES: dict[str, np.dtype[Any]] = {name: np.dtype(name) for name in _INTEGER_TYPES} | {
    "float": np.dtype("float32"),
    "double": np.dtype("float64"),
    "octet": np.dtype("uint8"),
    "char": np.dtype("uint8"),
    "boolean": np.dtype("bool"),
}
_OBJECT_DTYPE = np.dtype(object)


class MissingElementError(CoframeError, LookupError):
    """A message has no element with an index or a name."""


@dataclass(frozen=True)
class Leaf:
    """A value that has no fields.

    Attributes:
        steps: Its path below the column; () if the column itself is this value.
        kind: ``time`` is int64 nanoseconds; ``array`` has a fixed number of numbers, ``numbers`` any number, and
            ``list`` contains strings or messages.
        dtype: The type of the numbers; object for other kinds.
        size: The number of elements of an ``array``.
        type_: The type of a ``list`` in the definition of the message.
        axis: Which number of a quaternion it is: ``x``, ``y``, ``z`` or ``w``, or "" for all other values.
    """

    steps: Path
    kind: Kind
    dtype: np.dtype[Any] = _OBJECT_DTYPE
    size: int = 0
    type_: AbstractType | None = None
    axis: str = ""

    @property
    def suffix(self) -> str:
        """What follows the name of the column in the name of this value."""
        return "".join(step if step.startswith("[") else f".{step}" for step in self.steps)


class Getter(NamedTuple):
    """Where a value is in a message.

    Attributes:
        path: The fields that lead to it.
        names: The field with the names of the elements of a sequence; () if the value is not an element.
        element: The name of the element.
    """

    path: Path
    names: Path = ()
    element: str = ""


Found: TypeAlias = "Iterator[tuple[Leaf, Getter]]"


def class_leaves(type_: Any, steps: Path, path: Path, names: Names) -> Found:
    """Yield the values in a message class or in a field of a type.

    Args:
        type_: The class or type.
        steps: The path of the value in the table.
        path: The path of the value in the message.
        names: The names of elements by the field that contains them.
    """
    if isinstance(type_, BasicType):
        dtype = DTYPES[type_.typename]
        yield Leaf(steps, "boolean" if dtype.kind == "b" else "number", dtype), Getter(path)
    elif isinstance(type_, AbstractGenericString):
        yield Leaf(steps, "text"), Getter(path)
    elif isinstance(type_, AbstractNestedType):
        yield _sequence(type_, steps), Getter(path)
    else:
        yield from _message_leaves(type_, steps, path, names)


def _message_leaves(type_: Any, steps: Path, path: Path, names: Names) -> Found:
    fields = class_fields(type_)
    if set(fields) in _TIME_FIELDS:
        yield Leaf(_in_nanoseconds(steps), "time", np.dtype("int64")), Getter(path)
        return
    beside = names_beside(fields)
    for name, inner in fields.items():
        here, place = (*steps, name), (*path, name)
        if beside and is_named(inner):
            yield from named_leaves(inner, here, place, (*path, beside), names)  # type: ignore[arg-type]  # it is a sequence
        else:
            for leaf, getter in class_leaves(inner, here, place, names):
                axis = name if set(fields) == set("xyzw") and leaf.kind == "number" else leaf.axis
                yield replace(leaf, axis=axis), getter


def named_leaves(type_: AbstractNestedType, steps: Path, path: Path, beside: Path, names: Names) -> Found:
    """Yield a value for each named element of a sequence of numbers."""
    dtype = DTYPES[type_.value_type.typename]  # type: ignore[attr-defined]  # is_named() holds
    kind: Kind = "boolean" if dtype.kind == "b" else "number"
    for name in names.get(beside, ()):
        last = (*steps[:-1], f"{steps[-1]}[{name}]") if steps else (f"[{name}]",)
        yield Leaf(last, kind, dtype), Getter(path, beside, name)


def name_lists(type_: Any, path: Path = ()) -> Iterator[Path]:
    """Yield the fields of a message class that name the elements of sequences next to them."""
    if isinstance(type_, (BasicType, AbstractGenericString, AbstractNestedType)):
        return
    fields = class_fields(type_)
    beside = names_beside(fields)
    if beside and any(map(is_named, fields.values())):
        yield (*path, beside)
    for name, inner in fields.items():
        yield from name_lists(inner, (*path, name))


def names_beside(fields: Mapping[str, Any]) -> str:
    """Return the field that names the elements of the sequences next to it, or "" if there is none."""
    for name in _NAME_FIELDS:
        type_ = fields.get(name)
        if isinstance(type_, AbstractNestedType) and isinstance(type_.value_type, AbstractGenericString):
            return name
    return ""


def is_named(type_: AbstractType) -> bool:
    """Return whether the elements of a type can have names: whether it is a sequence of numbers."""
    is_sequence = isinstance(type_, AbstractNestedType) and not isinstance(type_, Array)
    return is_sequence and isinstance(type_.value_type, BasicType)  # type: ignore[attr-defined]


def class_fields(type_: Any) -> dict[str, AbstractType]:
    """Return the fields of a message class, or of the message in a field."""
    cls = class_of(type_) if isinstance(type_, NamespacedType) else type_
    return {slot[1:]: inner for slot, inner in zip(cls.__slots__, cls.SLOT_TYPES, strict=True)}


def _sequence(type_: AbstractNestedType, steps: Path) -> Leaf:
    if not isinstance(type_.value_type, BasicType):
        return Leaf(steps, "list", type_=type_)
    name = type_.value_type.typename
    if isinstance(type_, Array):
        return Leaf(steps, "array", DTYPES[name], type_.size)
    return Leaf(steps, "bytes") if name in _BYTE_TYPES else Leaf(steps, "numbers", DTYPES[name])


def value_leaves(value: Any, steps: Path = ()) -> Found:
    """Yield the values in a message of JSON or protobuf. The first message determines the columns."""
    names = value_fields(value)
    if set(names) in _TIME_FIELDS:
        yield Leaf(_in_nanoseconds(steps), "time", np.dtype("int64")), Getter(steps)
    elif names:
        for name in names:
            for leaf, getter in value_leaves(at_path(value, (name,)), (*steps, name)):
                axis = name if set(names) == set("xyzw") and leaf.kind == "number" else leaf.axis
                yield replace(leaf, axis=axis), getter
    elif isinstance(value, bool):
        yield Leaf(steps, "boolean", np.dtype(bool)), Getter(steps)
    elif isinstance(value, int | float):
        yield Leaf(steps, "number", np.dtype("float64")), Getter(steps)
    else:
        yield Leaf(steps, "bytes" if isinstance(value, bytes) else "text"), Getter(steps)


def value_fields(value: Any) -> list[str]:
    """Return the names of the fields of a message of JSON or protobuf; none for other values."""
    if isinstance(value, dict):
        return list(map(str, value))
    descriptor = getattr(value, "DESCRIPTOR", None)
    return [] if descriptor is None else [field.name for field in descriptor.fields]


def at_path(value: Any, path: tuple[Step, ...]) -> Any:
    """Return the value at the end of a path.

    Raises:
        MissingElementError: An index or a name does not exist in this message.
    """
    owner = value
    for number, step in enumerate(path):
        if isinstance(step, Key):
            value = _element(value, _names_in(owner), step)
        elif isinstance(step, int):
            try:
                value = value[step]
            except (IndexError, KeyError, TypeError):
                raise MissingElementError(step) from None
        else:
            owner = value
            try:
                value = value[step] if isinstance(value, dict) else getattr(value, step)
            except (KeyError, AttributeError):
                raise MissingElementError(path[: number + 1]) from None
    return value


def _element(values: Any, names: Any, name: str) -> Any:
    try:
        return values[names.index(name)]
    except (ValueError, IndexError):
        raise MissingElementError(name) from None


def _names_in(message: Any) -> Any:
    name = names_beside(class_fields(type(message))) if hasattr(type(message), "SLOT_TYPES") else ""
    return getattr(message, name) if name else []


def _in_nanoseconds(steps: Path) -> Path:
    return (*steps[:-1], f"{steps[-1]}_ns") if steps else ()


def reader(getters: list[Getter], *, is_ros: bool) -> Callable[[Any], tuple[Any, ...]]:
    """Return the function that reads several values of a message; None is an element that does not exist.

    Args:
        getters: Where the values are.
        is_ros: Whether the messages are instances of one class, whose fields always exist.
    """
    if is_ros and len(getters) > 1 and all(getter.path and not getter.names for getter in getters):
        by_attributes: Callable[[Any], tuple[Any, ...]] = attrgetter(*(".".join(getter.path) for getter in getters))
        return by_attributes
    return lambda message: tuple(_value_or_none(getter, message) for getter in getters)


def _value_or_none(getter: Getter, message: Any) -> Any:
    try:
        value = at_path(message, getter.path)
        return _element(value, at_path(message, getter.names), getter.element) if getter.names else value
    except MissingElementError:
        return None
