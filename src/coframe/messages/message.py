# SPDX-License-Identifier: Apache-2.0
"""Base classes of all message, service and action classes."""

from __future__ import annotations

from functools import partial
from itertools import islice
from operator import ne
from typing import Any, ClassVar, Final

import coframe.lazy_numpy as np
from coframe._output import html_tables
from coframe.errors import DecodeError
from coframe.messages._fields import CHECKS_FIELDS, Setter, attribute, constructor_setter, number_of
from coframe.messages._yaml_text import to_yaml
from coframe.messages.definition import AbstractNestedType, AbstractSequence, AbstractType, describe
from coframe.messages.registry import classes, find

MAX_REPR_ITEMS: Final = 36
"""A longer array or sequence is abbreviated in the repr of a message. The covariance of a pose is shown completely."""
_FIRST_ITEMS = 3  # of an abbreviated array


class MessageType(type):
    """The metaclass of message classes, which makes their constants read-only."""

    def __setattr__(cls, name: str, value: Any) -> None:
        if name.isupper():
            raise AttributeError(f"{cls.__name__}.{name} is a constant and cannot be assigned")
        super().__setattr__(name, value)


class Message(metaclass=MessageType):
    """A message. Its class defines ROS_TYPE, ``__slots__`` and SLOT_TYPES, from which the attributes are made."""

    # The slots are named _field. Private names of this class begin with two underscores to be different from them.
    __slots__: ClassVar[list[str]] = []
    ROS_TYPE: ClassVar[str]
    SLOT_TYPES: ClassVar[tuple[AbstractType, ...]]
    __recorded__: ClassVar[bool] = False  # whether a definition in a recording describes it; its name does not find it
    _fields_and_field_types: ClassVar[dict[str, str]]
    __setters: ClassVar[dict[str, Setter]]  # what the constructor calls with the message and the value of a field

    def __init_subclass__(cls) -> None:
        if "SLOT_TYPES" not in cls.__dict__:
            # A subclass that a user has derived from a message class can have properties of its own.
            own = {name: partial(_set_attribute, name) for name in cls.__dict__ if name in cls.__setters}
            cls.__setters = {**cls.__setters, **own}
            return
        fields = {slot[1:]: type_ for slot, type_ in zip(cls.__slots__, cls.SLOT_TYPES, strict=True)}
        for name, type_ in fields.items():
            # Not setattr(): fields of IDL files may have names in capital letters.
            type.__setattr__(cls, name, attribute(name, type_, cls.__dict__[f"_{name}"]))
        cls._fields_and_field_types = {name: describe(type_) for name, type_ in fields.items()}
        cls.__setters = {name: constructor_setter(type_, cls.__dict__[name]) for name, type_ in fields.items()}
        _register(cls)

    def __init__(self, **fields: Any) -> None:
        """Set the fields that are passed to the constructor."""
        set_fields(self, fields)

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        """Return the type of each field by name, in order, as a new dict."""
        return dict(cls._fields_and_field_types)

    def __values(self) -> list[Any]:
        return [getattr(self, slot) for slot in self.__slots__]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, type(self)):
            return False
        return not any(map(_differ, self.__values(), other.__values()))

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return _text(self, MAX_REPR_ITEMS)

    def _repr_html_(self) -> str:
        from coframe.sensors.message_pictures import picture_of  # noqa: PLC0415 - sensors are above this module

        lines = to_yaml(self, max_items=html_tables.MAX_ROWS).splitlines()
        try:
            picture = picture_of(self)
            image = html_tables.image(picture, self.ROS_TYPE) if picture else ""
        except DecodeError as error:
            image = html_tables.paragraph(f"There is no picture: {error}")
        return html_tables.section(self.ROS_TYPE, image, html_tables.preformatted(lines))


def complete_repr(message: Message) -> str:
    """Return the repr of a message with all elements of its arrays and sequences, as rclpy prints it."""
    return _text(message, None)


def _text(message: Message, most: int | None) -> str:
    values = [getattr(message, slot) for slot in message.__slots__]
    fields = zip(message.get_fields_and_field_types(), values, message.SLOT_TYPES, strict=True)
    content = ", ".join(f"{name}={_show(value, type_, most)}" for name, value, type_ in fields)
    return f"{type(message).__module__}.{type(message).__name__}({content})"


EVENT_SUFFIX: Final = "_Event"  # of the type in which a service publishes its requests and responses


class _EventClass:
    """Attribute ``Event`` of services: the class is created when it is first used."""

    def __get__(self, _: object, service: type[Service]) -> Any:
        return find(service.ROS_TYPE + EVENT_SUFFIX)


class Service:
    """Base class of services, which contain the classes Request, Response and Event and have no instances."""

    ROS_TYPE: ClassVar[str]
    Request: ClassVar[Any]
    Response: ClassVar[Any]
    Event: ClassVar[Any] = _EventClass()

    def __init_subclass__(cls) -> None:
        _register(cls)

    def __init__(self) -> None:
        raise NotImplementedError("Service classes can not be instantiated")


class Action:
    """Base class of actions, which contain Goal, Result, Feedback and Impl and have no instances."""

    ROS_TYPE: ClassVar[str]

    def __init_subclass__(cls) -> None:
        _register(cls)

    def __init__(self) -> None:
        raise NotImplementedError("Action classes can not be instantiated")


def _register(cls: type[Message | Service | Action]) -> None:
    cls.__module__ = ".".join(cls.ROS_TYPE.split("/")[:-1])
    if not (issubclass(cls, Message) and cls.__recorded__):
        classes[cls.ROS_TYPE] = cls


def set_fields(message: Message, fields: dict[str, Any]) -> None:
    """Set the fields that are passed to a constructor, which has set the defaults before."""
    setters = message._Message__setters  # type: ignore[attr-defined]  # noqa: SLF001 - the class is above
    for name, value in fields.items():
        setter = setters.get(name)
        if setter is not None:
            setter(message, value)
        elif CHECKS_FIELDS:
            unknown = ", ".join(sorted(fields.keys() - setters.keys()))
            raise AssertionError(f"Invalid arguments passed to constructor: {unknown}")


def _set_attribute(name: str, message: object, value: Any) -> None:
    setattr(message, name, value)


def _differ(left: Any, right: Any) -> bool:
    if np.is_array(left):
        return not np.array_equal(left, right)
    return ne(left, right)  # type: ignore[no-any-return]


def _show(value: Any, type_: AbstractType, most: int | None) -> str:
    """Return the repr of a field's value; sequences of numbers are shown without ``array(...)`` around them."""
    if isinstance(value, Message):
        return _text(value, most)
    if not isinstance(type_, AbstractNestedType):
        return repr(value)
    if most is not None and len(value) > most:
        first = value[:_FIRST_ITEMS].tolist() if np.is_array(value) else islice(value, _FIRST_ITEMS)
        return f"[{', '.join(_show_item(item, most) for item in first)}, ...] ({len(value)} items)"
    if isinstance(type_, AbstractSequence) and number_of(type_):
        return repr(value)[len("array('X', ") : -1] if len(value) else "[]"
    if isinstance(value, list):
        return f"[{', '.join(_show_item(item, most) for item in value)}]"
    return repr(value)


def _show_item(item: Any, most: int | None) -> str:
    return _text(item, most) if isinstance(item, Message) else repr(item)
