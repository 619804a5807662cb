# SPDX-License-Identifier: Apache-2.0
"""Types of message fields, with the names of ``rosidl_parser.definition``."""

from __future__ import annotations

from typing import Any


class AbstractType:
    """Base class of all types; types are equal if their classes and properties are equal."""

    __slots__: tuple[str, ...] = ()

    def _properties(self) -> tuple[Any, ...]:
        return tuple(getattr(self, slot) for slot in self.__slots__)

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and self._properties() == other._properties()

    def __hash__(self) -> int:
        return hash((type(self), self._properties()))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(map(repr, self._properties()))})"


class AbstractNestableType(AbstractType):
    """A type that arrays and sequences can hold."""

    __slots__ = ()


class BasicType(AbstractNestableType):
    """A number, boolean or octet with its IDL name: ``double``, ``uint8``, ``boolean``, ..."""

    __slots__ = ("typename",)

    def __init__(self, typename: str) -> None:
        self.typename = typename


class NamespacedType(AbstractNestableType):
    """Another message: ``NamespacedType(("std_msgs", "msg"), "Header")``."""

    __slots__ = ("name", "namespaces")

    def __init__(self, namespaces: tuple[str, ...], name: str) -> None:
        self.namespaces = tuple(namespaces)
        self.name = name

    def namespaced_name(self) -> tuple[str, ...]:
        """Return all parts of the name: ``("std_msgs", "msg", "Header")``."""
        return (*self.namespaces, self.name)

    def __repr__(self) -> str:
        return f"NamespacedType({self.namespaces!r}, {self.name!r})"


class ResolvedType(NamespacedType):
    """Another message whose class is created from a definition in a recording, not found by its name."""

    __slots__ = ("message_class",)

    def __init__(self, namespaces: tuple[str, ...], name: str, message_class: type[Any]) -> None:
        super().__init__(namespaces, name)
        self.message_class = message_class

    def _properties(self) -> tuple[Any, ...]:
        return (self.namespaces, self.name, self.message_class)


class AbstractGenericString(AbstractNestableType):
    """A string of either kind."""

    __slots__ = ()

    def has_maximum_size(self) -> bool:
        """Return whether the length is bounded."""
        return isinstance(self, (BoundedString, BoundedWString))


class AbstractString(AbstractGenericString):
    """A string that is serialized as UTF-8."""

    __slots__ = ()


class UnboundedString(AbstractString):
    """The type ``string``."""

    __slots__ = ()


class BoundedString(AbstractString):
    """The type ``string<=N``."""

    __slots__ = ("maximum_size",)

    def __init__(self, maximum_size: int) -> None:
        self.maximum_size = maximum_size


class AbstractWString(AbstractGenericString):
    """A string that is serialized as UTF-16 code units in four bytes each."""

    __slots__ = ()


class UnboundedWString(AbstractWString):
    """The type ``wstring``."""

    __slots__ = ()


class BoundedWString(AbstractWString):
    """The type ``wstring<=N``."""

    __slots__ = ("maximum_size",)

    def __init__(self, maximum_size: int) -> None:
        self.maximum_size = maximum_size


class AbstractNestedType(AbstractType):
    """An array or sequence of values of one type."""

    __slots__ = ("value_type",)

    def __init__(self, value_type: AbstractNestableType) -> None:
        self.value_type = value_type


class Array(AbstractNestedType):
    """The type ``T[N]``."""

    __slots__ = ("size",)

    def __init__(self, value_type: AbstractNestableType, size: int) -> None:
        super().__init__(value_type)
        self.size = size

    def _properties(self) -> tuple[Any, ...]:
        return (self.value_type, self.size)


class AbstractSequence(AbstractNestedType):
    """A sequence with or without a bound on its length."""

    __slots__ = ()

    def has_maximum_size(self) -> bool:
        """Return whether the number of values is bounded."""
        return isinstance(self, BoundedSequence)

    def _properties(self) -> tuple[Any, ...]:
        return (self.value_type,)


class UnboundedSequence(AbstractSequence):
    """The type ``T[]``."""

    __slots__ = ()


class BoundedSequence(AbstractSequence):
    """The type ``T[<=N]``."""

    __slots__ = ("maximum_size",)

    def __init__(self, value_type: AbstractNestableType, maximum_size: int) -> None:
        super().__init__(value_type)
        self.maximum_size = maximum_size

    def _properties(self) -> tuple[Any, ...]:
        return (self.value_type, self.maximum_size)


def describe(type_: AbstractType) -> str:
    """Return a type as ``get_fields_and_field_types()`` shows it: ``sequence<std_msgs/Header, 3>``, ``double[9]``."""
    if isinstance(type_, Array):
        return f"{describe(type_.value_type)}[{type_.size}]"
    if isinstance(type_, BoundedSequence):
        return f"sequence<{describe(type_.value_type)}, {type_.maximum_size}>"
    if isinstance(type_, AbstractSequence):
        return f"sequence<{describe(type_.value_type)}>"
    if isinstance(type_, NamespacedType):
        return f"{type_.namespaces[0]}/{type_.name}"
    if isinstance(type_, BasicType):
        return type_.typename
    text = "wstring" if isinstance(type_, AbstractWString) else "string"
    return f"{text}<{type_.maximum_size}>" if isinstance(type_, (BoundedString, BoundedWString)) else text
