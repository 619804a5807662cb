# SPDX-License-Identifier: Apache-2.0
"""Base class of the elements of XML and YAML launch files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["Entity"]


class Entity:
    """An element of a launch file: its name, its attributes and its child elements."""

    @property
    def type_name(self) -> str:
        """The name of the element, such as ``node``."""
        raise NotImplementedError

    @property
    def parent(self) -> Entity | None:
        """The element around it."""
        raise NotImplementedError

    @property
    def children(self) -> list[Entity]:
        """The elements in it."""
        raise NotImplementedError

    def assert_entity_completely_parsed(self) -> None:
        """Check that all attributes and elements were read.

        Raises:
            ValueError: Some were not, because they are unknown.
        """
        raise NotImplementedError

    def get_attr(self, name: str, *, data_type: Any = str, optional: bool = False, can_be_str: bool = True) -> Any:
        """Return an attribute.

        Args:
            name: The name of the attribute.
            data_type: Its type: a scalar, a list of scalars, ``List[Entity]`` for elements, or None for any.
            optional: Return None if it is missing.
            can_be_str: Return the text if it is not of this type, because it may contain substitutions.

        Raises:
            AttributeError: It is missing.
            TypeError: It has another type.
        """
        raise NotImplementedError


def is_list_of_entities(data_type: Any) -> bool:
    """Return whether a type is ``List[Entity]``, or a list without a type."""
    arguments = getattr(data_type, "__args__", ())
    return data_type is list or any(isinstance(each, type) and issubclass(each, Entity) for each in arguments)


def missing_attribute_error(name: str, type_name: str, known: Iterable[str]) -> AttributeError:
    """Return the error for a missing attribute."""
    there = ", ".join(known)
    return AttributeError(f"Attribute '{name}' not found in '{type_name}'; attributes there: {there or 'none'}")
