# SPDX-License-Identifier: Apache-2.0
"""Message classes for the definitions in a recording.

A message has coframe's class if its definition in the recording has the same fields. Otherwise a class is made from the
definition, which exists only for this recording: its name does not find it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.errors import InterfaceError
from coframe.messages._class_factory import class_name, new_message_class
from coframe.messages._class_limits import check_limits
from coframe.messages._parser import Field, MessageStructure
from coframe.messages.definition import (
    AbstractNestedType,
    AbstractType,
    Array,
    BasicType,
    BoundedSequence,
    NamespacedType,
    ResolvedType,
    UnboundedSequence,
)
from coframe.messages.limits import MAX_DEPTH, MAX_RECORDED_FIELDS
from coframe.messages.message import Message
from coframe.messages.registry import class_of, find
from coframe.type_names import TF_MESSAGE, TF_MESSAGES_OF_ROS1

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.messages.schemas import Schema

__all__ = ["ResolvedSchema", "SchemaClasses", "known_class"]

_CLASS_COST = 20  # fields that take as much memory as a class without fields
_HEADER = "std_msgs/msg/Header"
_SEQUENCE_NUMBER = Field("seq", BasicType("uint32"), None)
# Names of ROS 1 for types with another name in ROS 2.
_ALIASES = {name.replace("/", "/msg/"): TF_MESSAGE for name in TF_MESSAGES_OF_ROS1}


def known_class(ros_type: str) -> Any:
    """Return coframe's class for the messages of a type in a recording, or None if there is none."""
    for name in _full_names(_ALIASES.get(ros_type, ros_type)):
        try:
            cls = find(name)
        except LookupError:
            continue
        if issubclass(cls, Message):
            return cls
    return None


def _full_names(ros_type: str) -> list[str]:
    """Return the names that a type can have: definitions write parts of services and actions as messages."""
    package, separator, name = ros_type.partition("/msg/")
    is_part = separator and "_" in name
    return [ros_type, *(f"{package}/{kind}/{name}" for kind in ("srv", "action") if is_part)]


class SchemaClasses:
    """The classes of one recording: each definition that occurs several times has one class."""

    def __init__(self) -> None:
        self._classes: dict[Any, type[Message]] = {}
        self._cost = 0

    def of(self, schema: ResolvedSchema, *, is_ros1: bool) -> Any:
        """Return the class of the message that a definition describes.

        Args:
            schema: The definition.
            is_ros1: Whether the message is one of ROS 1, whose headers have a sequence number.

        Raises:
            InterfaceError: The classes of the recording have too many fields.
        """
        made: dict[str, Any] = {}
        for name, structure in schema.structures.items():  # Each comes after those inside it.
            made[name] = self._class(name, structure, made, is_ros1=is_ros1)
        return made[schema.name]

    def _class(self, name: str, structure: MessageStructure, made: dict[str, Any], *, is_ros1: bool) -> Any:
        fields = [field._replace(type=_add_class(field.type, made)) for field in structure.fields]
        known = known_class(name)
        if known is not None and _matches(name, fields, known, is_ros1=is_ros1):
            return known
        key = (name, tuple(map(repr, structure.constants)), tuple((f.name, f.type, repr(f.default)) for f in fields))
        if key not in self._classes:
            self._cost += len(fields) + _CLASS_COST
            if self._cost > MAX_RECORDED_FIELDS:
                raise InterfaceError(
                    f"the definitions of the recording exceed the maximum of {MAX_RECORDED_FIELDS} fields"
                )
            inner = {
                class_name(type_): class_of(type_) for type_ in map(_value_type, (f.type for f in fields)) if type_
            }
            new = MessageStructure(fields, structure.constants, structure.comment)
            self._classes[key] = new_message_class(name, new, inner, is_recorded=True)
        return self._classes[key]


class ResolvedSchema:
    """A definition with full names in all fields, which coframe or the definition itself describes.

    Attributes:
        name: The name of the message.
        structures: The messages of the definition by name, each after those inside it.

    Raises:
        InterfaceError: The definition refers to messages that are unknown, or is too large.
    """

    def __init__(self, schema: Schema) -> None:
        self.name = schema.name
        self.structures: dict[str, MessageStructure] = {}
        self._schema = schema
        self._add(schema.name, schema.structures[schema.name], [])
        try:
            check_limits(self.types_of(schema.name), self.types_of)
        except ValueError as error:
            raise InterfaceError(str(error), line=self._large_line()) from None

    def types_of(self, ros_type: str) -> Sequence[AbstractType]:
        """Return the types of the fields of a message."""
        if ros_type in self.structures:
            return [field.type for field in self.structures[ros_type].fields]
        types: tuple[AbstractType, ...] = known_class(ros_type).SLOT_TYPES
        return types

    def _large_line(self) -> int | None:
        """Return the line of the first field of the message that exceeds a limit; of the last message if none does."""
        fields = self.structures[self.name].fields
        for field in fields:
            try:
                check_limits([field.type], self.types_of)
            except ValueError:
                return self._schema.find_line(self.name, field.name)
        return self._schema.find_line(self.name, fields[-1].name)

    def has_field(self, name: str) -> bool:
        """Return whether the message has a field."""
        return any(field.name == name for field in self.structures[self.name].fields)

    def _add(self, name: str, structure: MessageStructure, outer_names: list[str]) -> None:
        if name in self.structures:
            return
        if name in outer_names:
            chain = " > ".join([*outer_names[outer_names.index(name) :], name])
            raise InterfaceError(f"a message cannot contain itself: {chain}")
        if len(outer_names) > MAX_DEPTH:
            raise InterfaceError(f"messages are nested more than {MAX_DEPTH} levels deep")
        outer_names.append(name)
        fields = [self._field(field, name, outer_names) for field in structure.fields]
        if [field.name for field in fields] == ["structure_needs_at_least_one_member"]:
            fields = []  # rosidl writes this member into structures without fields.
        outer_names.pop()
        self.structures[name] = MessageStructure(fields, structure.constants, structure.comment)

    def _field(self, field: Field, owner: str, outer_names: list[str]) -> Field:
        type_ = _value_type(field.type)
        if type_ is None:
            return field
        home = owner.partition("/")[0] if "/" in owner else ""
        name = self._schema.find(type_, home)
        if name is not None:
            try:
                self._add(name, self._schema.structures[name], outer_names)
            except InterfaceError as error:
                error.line = error.line or self._schema.find_line(owner, field.name)
                raise
        else:
            name = _known_name(type_, home)
        if name is None:
            missing = "/".join(filter(None, type_.namespaced_name()))
            raise InterfaceError(
                f"field {field.name!r} of {owner}: the recording does not define {missing}",
                line=self._schema.find_line(owner, field.name),
            )
        *namespaces, last = name.split("/")
        return field._replace(type=_replace_value_type(field.type, NamespacedType(tuple(namespaces), last)))


def _known_name(type_: NamespacedType, home: str) -> str | None:
    """Return the name of a message that only coframe has, or None if it has not."""
    package, kind = type_.namespaces
    packages = [package] if package else [home, *(["std_msgs"] if type_.name == "Header" else [])]
    names = (f"{owner}/{kind}/{type_.name}" for owner in packages)
    return next((name for name in names if known_class(name) is not None), None)


def _matches(name: str, fields: list[Field], known: Any, *, is_ros1: bool) -> bool:
    """Return whether a class of coframe has the fields of a definition. Names of ROS 1 can have capital letters."""
    if is_ros1 and name == _HEADER and fields[:1] == [_SEQUENCE_NUMBER]:
        fields = fields[1:]  # Bags have this field also if they were converted with the definition of ROS 2.
    names = [slot[1:].lower() for slot in known.__slots__]
    return [field.name.lower() for field in fields] == names and all(
        _is_same_type(field.type, type_) for field, type_ in zip(fields, known.SLOT_TYPES, strict=True)
    )


def _is_same_type(recorded: AbstractType, known: AbstractType) -> bool:
    if isinstance(recorded, NamespacedType) and isinstance(known, NamespacedType):
        return class_of(recorded) is class_of(known)
    if isinstance(recorded, AbstractNestedType) and isinstance(known, AbstractNestedType):
        return (
            type(recorded) is type(known)
            and recorded == _replace_value_type(known, recorded.value_type)
            and _is_same_type(recorded.value_type, known.value_type)
        )
    return recorded == known


def _add_class(type_: AbstractType, made: dict[str, Any]) -> AbstractType:
    """Return the type of a field, with its message class if the class cannot be found by name."""
    inner = _value_type(type_)
    cls = None if inner is None else made.get("/".join(inner.namespaced_name()))
    if inner is None or cls is None or not (cls.__recorded__ or "/".join(inner.namespaced_name()) != cls.ROS_TYPE):
        return type_
    return _replace_value_type(type_, ResolvedType(inner.namespaces, inner.name, cls))


def _value_type(type_: AbstractType) -> NamespacedType | None:
    """Return the type of the messages in a field, or None if it contains no messages."""
    value_type = type_.value_type if isinstance(type_, AbstractNestedType) else type_
    return value_type if isinstance(value_type, NamespacedType) else None


def _replace_value_type(type_: AbstractType, value_type: Any) -> AbstractType:
    """Return the type of a field with another type of its values."""
    if isinstance(type_, Array):
        return Array(value_type, type_.size)
    if isinstance(type_, BoundedSequence):
        return BoundedSequence(value_type, type_.maximum_size)
    if isinstance(type_, UnboundedSequence):
        return UnboundedSequence(value_type)
    return value_type  # type: ignore[no-any-return]
