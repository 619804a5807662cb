# SPDX-License-Identifier: Apache-2.0
"""Elements of YAML launch files."""

from __future__ import annotations

from typing import Any

from launch.frontend import Entity as BaseEntity
from launch.frontend.entity import is_list_of_entities, missing_attribute_error
from launch.utilities.type_utils import get_typed_value, is_instance_of

__all__ = ["Entity"]


class Entity(BaseEntity):
    """An element of a YAML file: a name, and a dictionary of attributes or a list of elements."""

    def __init__(self, element: Any = None, type_name: str = "", *, parent: BaseEntity | None = None) -> None:
        self.__element = element
        self.__type_name = type_name
        self.__parent = parent
        self.__read_keys: set[str] = set()
        self.__read_children = False

    @property
    def type_name(self) -> str:
        """The name of the element."""
        return self.__type_name

    @property
    def parent(self) -> BaseEntity | None:
        """The element around it."""
        return self.__parent

    @property
    def children(self) -> list[BaseEntity]:
        """The elements in it."""
        self.__read_children = True
        children = self.__element
        if isinstance(self.__element, dict):
            if "children" not in self.__element:
                raise ValueError(
                    f"Expected entity `{self.type_name}` to have children entities: add the key 'children'"
                )
            self.__read_keys.add("children")
            children = self.__element["children"]
        found: list[BaseEntity] = []
        for child in children or ():
            if not isinstance(child, dict) or len(child) != 1:
                raise ValueError(f"the entities in `{self.type_name}` must be like '- node: ...', found {child!r}")
            name, element = next(iter(child.items()))
            found.append(Entity(element, str(name), parent=self))
        return found

    def assert_entity_completely_parsed(self) -> None:
        """Check that all keys were read.

        Raises:
            ValueError: Some were not, because they are unknown.
        """
        if isinstance(self.__element, list) and not self.__read_children:
            raise ValueError(f"Unexpected nested entity(ies) found in `{self.type_name}`: {self.__element}")
        if isinstance(self.__element, dict) and (unread := set(self.__element) - self.__read_keys):
            raise ValueError(f"Unexpected key(s) found in `{self.type_name}`: {sorted(map(str, unread))}")

    def get_attr(self, name: str, *, data_type: Any = str, optional: bool = False, can_be_str: bool = True) -> Any:
        """Return an attribute. See `launch.frontend.Entity.get_attr`."""
        if not isinstance(self.__element, dict) or name not in self.__element:
            if optional:
                return None
            raise missing_attribute_error(
                name, self.type_name, self.__element if isinstance(self.__element, dict) else ()
            )
        self.__read_keys.add(name)
        value = self.__element[name]
        if is_list_of_entities(data_type):
            if not isinstance(value, list) or not all(isinstance(each, dict) for each in value):
                raise TypeError(f"'{name}' of '{self.type_name}' must be a list of keys and values, found {value!r}")
            return [Entity(each, name, parent=self) for each in value]
        if data_type is str and isinstance(value, int | float):
            return str(value).lower() if isinstance(value, bool) else str(value)
        if data_type is float and type(value) is int:
            return float(value)
        if is_instance_of(value, data_type):
            return value
        if isinstance(value, str) and can_be_str:
            return value if "$(" in value else get_typed_value(value, data_type, can_be_str=True)
        raise TypeError(f"'{name}' of '{self.type_name}' must be of the type {data_type}, found {value!r}")
