"""What all message, service and action classes share."""

from __future__ import annotations

from operator import ne
from typing import Any, ClassVar

import numpy as np

from coframe.messages.definition import AbstractSequence, AbstractType, describe
from coframe.messages.fields import CHECKED, Check, attribute, constructor_conversion, number_of
from coframe.messages.registry import classes


class MessageType(type):
    """The class of message classes: keeps their constants constant."""

    def __setattr__(cls, name: str, value: Any) -> None:
        if name.isupper():
            raise AttributeError(f"{cls.__name__}.{name} is a constant; it cannot be assigned")
        super().__setattr__(name, value)


class Message(metaclass=MessageType):
    """A message. Its class gives ROS_TYPE, ``__slots__`` and SLOT_TYPES; the attributes follow from them."""

    # Slots take the names _field: what is private here must not look like one.
    __slots__: ClassVar[list[str]] = []
    ROS_TYPE: ClassVar[str]
    SLOT_TYPES: ClassVar[tuple[AbstractType, ...]]
    _fields_and_field_types: ClassVar[dict[str, str]]
    __conversions: ClassVar[dict[str, Check]]

    def __init_subclass__(cls) -> None:
        if "SLOT_TYPES" not in cls.__dict__:
            return  # a user's subclass of a message
        fields = {slot[1:]: type_ for slot, type_ in zip(cls.__slots__, cls.SLOT_TYPES, strict=True)}
        for name, type_ in fields.items():
            setattr(cls, name, attribute(name, type_, cls.__dict__[f"_{name}"]))
        cls._fields_and_field_types = {name: describe(type_) for name, type_ in fields.items()}
        conversions = {name: constructor_conversion(type_) for name, type_ in fields.items()}
        cls.__conversions = {name: convert for name, convert in conversions.items() if convert}
        _announce(cls)

    def __init__(self, **fields: Any) -> None:
        """Takes over what a constructor was given; the generated ones have set the defaults before."""
        unknown = fields.keys() - self._fields_and_field_types.keys() if CHECKED else ()
        assert not unknown, f"Invalid arguments passed to constructor: {', '.join(sorted(unknown))}"
        for name in self._fields_and_field_types:
            if name in fields:
                convert = self.__conversions.get(name)
                setattr(self, name, convert(fields[name]) if convert else fields[name])

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        """The name and the type of each field, in order, as a new dict."""
        return dict(cls._fields_and_field_types)

    def __values(self) -> list[Any]:
        return [getattr(self, slot) for slot in self.__slots__]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, type(self)):
            return False
        return not any(map(_differ, self.__values(), other.__values()))

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        fields = zip(self._fields_and_field_types, self.__values(), self.SLOT_TYPES, strict=True)
        content = ", ".join(f"{name}={_show(value, type_)}" for name, value, type_ in fields)
        return f"{type(self).__module__}.{type(self).__name__}({content})"


class Service:
    """A service: the pair of its classes Request and Response, never an object."""

    ROS_TYPE: ClassVar[str]

    def __init_subclass__(cls) -> None:
        _announce(cls)

    def __init__(self) -> None:
        raise NotImplementedError("Service classes can not be instantiated")


class Action:
    """An action: its classes Goal, Result and Feedback, and in Impl what carries them; never an object."""

    ROS_TYPE: ClassVar[str]

    def __init_subclass__(cls) -> None:
        _announce(cls)

    def __init__(self) -> None:
        raise NotImplementedError("Action classes can not be instantiated")


def _announce(cls: type[Message | Service | Action]) -> None:
    package, kind, _ = cls.ROS_TYPE.split("/")
    cls.__module__ = f"{package}.{kind}"
    classes[cls.ROS_TYPE] = cls


def _differ(left: Any, right: Any) -> bool:
    if isinstance(left, np.ndarray):
        return not np.array_equal(left, right)
    return ne(left, right)  # type: ignore[no-any-return]


def _show(value: Any, type_: AbstractType) -> str:
    """The repr of a field's value; sequences of numbers without the array.array around them."""
    if isinstance(type_, AbstractSequence) and number_of(type_):
        return repr(value)[len("array('X', ") : -1] if len(value) else "[]"
    return repr(value)
