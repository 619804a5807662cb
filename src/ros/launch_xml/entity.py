# SPDX-License-Identifier: Apache-2.0
"""Elements of XML launch files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.frontend import Entity as BaseEntity
from launch.frontend.entity import is_list_of_entities, missing_attribute_error
from launch.utilities.type_utils import get_typed_value, is_typing_list

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

__all__ = ["Entity"]


class Entity(BaseEntity):
    """An element of an XML file."""

    def __init__(self, xml_element: Element | None = None, *, parent: BaseEntity | None = None) -> None:
        assert xml_element is not None
        self.__element = xml_element
        self.__parent = parent
        self.__read_attributes: set[str] = set()
        self.__read_children: set[str] = set()

    @property
    def type_name(self) -> str:
        """The name of the element."""
        return self.__element.tag

    @property
    def parent(self) -> BaseEntity | None:
        """The element around it."""
        return self.__parent

    @property
    def children(self) -> list[BaseEntity]:
        """The elements in it."""
        self.__read_children = {child.tag for child in self.__element}
        return [Entity(child, parent=self) for child in self.__element]

    def assert_entity_completely_parsed(self) -> None:
        """Check that all attributes and elements were read.

        Raises:
            ValueError: Some were not, because they are unknown.
        """
        attributes = set(self.__element.attrib) - self.__read_attributes
        if attributes:
            raise ValueError(f"Unexpected attribute(s) found in `{self.type_name}`: {sorted(attributes)}")
        children = {child.tag for child in self.__element} - self.__read_children
        if children:
            raise ValueError(f"Unexpected nested entity(ies) found in `{self.type_name}`: {sorted(children)}")

    def get_attr(self, name: str, *, data_type: Any = str, optional: bool = False, can_be_str: bool = True) -> Any:
        """Return an attribute. See `launch.frontend.Entity.get_attr`. ``NAME-sep`` splits it into a list."""
        if is_list_of_entities(data_type):
            found = [Entity(child, parent=self) for child in self.__element if child.tag == name]
            self.__read_children.add(name)
            if not found and not optional:
                raise missing_attribute_error(name, self.type_name, (child.tag for child in self.__element))
            return found or None
        if name not in self.__element.attrib:
            if optional:
                return None
            raise missing_attribute_error(name, self.type_name, self.__element.attrib)
        self.__read_attributes.add(name)
        value: Any = self.__element.attrib[name]
        separator = self.__element.attrib.get(f"{name}-sep")
        if separator is not None:
            self.__read_attributes.add(f"{name}-sep")
            value = value.split(separator)
        if "$(" in self.__element.attrib[name]:
            return value  # The type is that of the text after the substitutions.
        if isinstance(value, list) and data_type is not None and not is_typing_list(data_type):
            raise TypeError(f"Attribute '{name}' of '{self.type_name}' is a list, expected {data_type}")
        try:
            return get_typed_value(value, data_type, can_be_str=can_be_str)
        except ValueError as error:
            raise TypeError(f"Attribute '{name}' of '{self.type_name}': {error}") from None
