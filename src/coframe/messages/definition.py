"""The types a field can have, named as ``rosidl_parser.definition`` names them."""

from __future__ import annotations

from typing import Any


class AbstractType:
    """Any type; equal to another of the same kind with the same facts."""

    __slots__: tuple[str, ...] = ()

    def _facts(self) -> tuple[Any, ...]:
        return tuple(getattr(self, slot) for slot in self.__slots__)

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and self._facts() == other._facts()

    def __hash__(self) -> int:
        return hash((type(self), self._facts()))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(map(repr, self._facts()))})"


class AbstractNestableType(AbstractType):
    """A type that arrays and sequences can hold."""

    __slots__ = ()


class BasicType(AbstractNestableType):
    """A number, boolean or octet, by its IDL name: ``double``, ``uint8``, ``boolean``, ..."""

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
        """All parts of the name: ``("std_msgs", "msg", "Header")``."""
        return (*self.namespaces, self.name)

    def __repr__(self) -> str:
        return f"NamespacedType({self.namespaces!r}, {self.name!r})"


class AbstractGenericString(AbstractNestableType):
    """Text of either kind."""

    __slots__ = ()

    def has_maximum_size(self) -> bool:
        """Whether the length is bounded."""
        return isinstance(self, (BoundedString, BoundedWString))


class AbstractString(AbstractGenericString):
    """Text that travels as UTF-8."""

    __slots__ = ()


class UnboundedString(AbstractString):
    """``string``."""

    __slots__ = ()


class BoundedString(AbstractString):
    """``string<=N``."""

    __slots__ = ("maximum_size",)

    def __init__(self, maximum_size: int) -> None:
        self.maximum_size = maximum_size


class AbstractWString(AbstractGenericString):
    """Text that travels as UTF-16 code units, each in four bytes."""

    __slots__ = ()


class UnboundedWString(AbstractWString):
    """``wstring``."""

    __slots__ = ()


class BoundedWString(AbstractWString):
    """``wstring<=N``."""

    __slots__ = ("maximum_size",)

    def __init__(self, maximum_size: int) -> None:
        self.maximum_size = maximum_size


class AbstractNestedType(AbstractType):
    """Many values of one type."""

    __slots__ = ("value_type",)

    def __init__(self, value_type: AbstractNestableType) -> None:
        self.value_type = value_type


class Array(AbstractNestedType):
    """``T[N]``."""

    __slots__ = ("size",)

    def __init__(self, value_type: AbstractNestableType, size: int) -> None:
        super().__init__(value_type)
        self.size = size

    def _facts(self) -> tuple[Any, ...]:
        return (self.value_type, self.size)


class AbstractSequence(AbstractNestedType):
    """As many values as there are, or up to a bound."""

    __slots__ = ()

    def has_maximum_size(self) -> bool:
        """Whether the number of values is bounded."""
        return isinstance(self, BoundedSequence)

    def _facts(self) -> tuple[Any, ...]:
        return (self.value_type,)


class UnboundedSequence(AbstractSequence):
    """``T[]``."""

    __slots__ = ()


class BoundedSequence(AbstractSequence):
    """``T[<=N]``."""

    __slots__ = ("maximum_size",)

    def __init__(self, value_type: AbstractNestableType, maximum_size: int) -> None:
        super().__init__(value_type)
        self.maximum_size = maximum_size

    def _facts(self) -> tuple[Any, ...]:
        return (self.value_type, self.maximum_size)


def describe(type_: AbstractType) -> str:
    """The text that ``get_fields_and_field_types()`` shows: ``sequence<std_msgs/Header, 3>``, ``double[9]``."""
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
