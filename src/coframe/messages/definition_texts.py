# SPDX-License-Identifier: Apache-2.0
"""Definitions of message types as text, which make recordings readable without ROS."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.messages._parser import parse
from coframe.messages.compounds import event, member_messages
from coframe.messages.definition import (
    AbstractNestedType,
    AbstractType,
    AbstractWString,
    Array,
    BasicType,
    BoundedSequence,
    BoundedString,
    BoundedWString,
    NamespacedType,
)
from coframe.messages.packages import find_package, find_shipped, is_generated
from coframe.messages.registry import class_of, find

if TYPE_CHECKING:
    from coframe.messages._parser import MessageStructure
    from coframe.messages.message import Message
    from coframe.messages.schema_classes import ResolvedSchema

__all__ = ["definition_of", "recorded_definition", "source_of"]

_SEPARATOR = "=" * 80
_NAMES = {"boolean": "bool", "octet": "byte", "float": "float32", "double": "float64"}
_EVENT = "_Event"


@functools.cache
def definition_of(ros_type: str) -> str:
    """Return the definition of a message type and of all types inside it, as ``ros2msg``, or "" if it is unknown.

    The text has rosbag2's format: of the ``.msg`` files, each but the first after a line of 80 ``=`` and a line
    such as ``MSG: std_msgs/Header``. Types that have no such file, because they belong to a service, an action or an
    ``.idl`` file, are written as if they had one.
    """
    texts: dict[str, str] = {}
    try:
        _collect(ros_type, texts)
    except LookupError:
        return ""
    return _join(texts)


def source_of(ros_type: str) -> tuple[str, str]:
    """Return the format and the text of the file that defines a type.

    The format is ``msg``, ``srv``, ``action`` or ``idl``; it is ``implicit``, and the text empty, for parts of services
    and actions.

    Raises:
        LookupError: coframe does not have the type.
    """
    package, kind, name = ros_type.split("/")
    find(ros_type)
    found = find_shipped(package) if is_generated(package) else find_package(package)
    if found is None or name not in found.names(kind):
        return "implicit", ""
    definition = found.definition(kind, name)
    return ("idl" if definition.is_idl else kind), definition.text


def recorded_definition(cls: type[Message], schema: ResolvedSchema) -> str:
    """Return the definition of a class created for a recording, in the format of :func:`definition_of`.

    Args:
        cls: The class.
        schema: The definition in the recording.
    """
    texts: dict[str, str] = {}
    _collect_recorded(cls, schema, texts)
    return _join(texts)


def _join(texts: dict[str, str]) -> str:
    parts: list[str] = []
    for name, text in texts.items():
        package, _, own = name.split("/")
        parts.append(f"{_SEPARATOR}\nMSG: {package}/{own}\n{text}" if parts else text)
    return "\n".join(parts) or "\n"


class _Definition(NamedTuple):
    text: str
    structure: MessageStructure


def _collect(ros_type: str, texts: dict[str, str]) -> None:
    """Add the definition of a type, then the definitions of the types in its fields."""
    if ros_type in texts:
        return
    definition = _definition(ros_type)
    texts[ros_type] = definition.text
    for field in definition.structure.fields:
        type_ = field.type.value_type if isinstance(field.type, AbstractNestedType) else field.type
        if isinstance(type_, NamespacedType):
            _collect("/".join(type_.namespaced_name()), texts)


def _collect_recorded(cls: type[Message], schema: ResolvedSchema, texts: dict[str, str]) -> None:
    """Add the definition of a recorded class, then the definitions of the classes in its fields."""
    if not cls.__recorded__:
        _collect(cls.ROS_TYPE, texts)
    elif cls.ROS_TYPE not in texts:
        structure = schema.structures[cls.ROS_TYPE]
        texts[cls.ROS_TYPE] = _write_definition(structure).text
        for type_ in cls.SLOT_TYPES:
            inner = type_.value_type if isinstance(type_, AbstractNestedType) else type_
            if isinstance(inner, NamespacedType):
                _collect_recorded(class_of(inner), schema, texts)


def _definition(ros_type: str) -> _Definition:
    """Return the definition of one type.

    Raises:
        LookupError: coframe does not have the type.
    """
    package, _, rest = ros_type.partition("/")
    kind, _, name = rest.partition("/")
    if kind in ("srv", "action") and name.endswith(_EVENT):
        find(ros_type.removesuffix(_EVENT))
        return _write_definition(event(package, name.removesuffix(_EVENT), kind))
    find(ros_type)
    found = find_shipped(package) if is_generated(package) else find_package(package)
    if found is None:
        raise LookupError(f"no package {package}")
    if kind == "msg":
        definition = found.definition(kind, name)
        if not definition.is_idl:
            (structure,) = parse(definition.text, package, file=definition.file)
            return _Definition(definition.text.replace("\r\n", "\n").rstrip("\n") + "\n", structure)
    owner = name.partition("_")[0]
    return _write_definition(member_messages(package, kind, owner, found.parse(kind, owner))[name])


def _write_definition(structure: MessageStructure) -> _Definition:
    """Return the definition of a message, written from its class."""
    # ROS 1 and IDL allow small letters in names of constants, and readers of ROS 2's definitions refuse them.
    constants = {constant.name.upper(): constant for constant in structure.constants}
    lines = [f"{_type(constant.type)} {name}={_value(constant.value)}" for name, constant in constants.items()]
    for field in structure.fields:
        default = "" if field.default is None else f" {_value(field.default)}"
        lines.append(f"{_type(field.type)} {field.name}{default}")
    return _Definition("".join(f"{line}\n" for line in lines), structure)


def _type(type_: AbstractType) -> str:
    if isinstance(type_, Array):
        return f"{_type(type_.value_type)}[{type_.size}]"
    if isinstance(type_, BoundedSequence):
        return f"{_type(type_.value_type)}[<={type_.maximum_size}]"
    if isinstance(type_, AbstractNestedType):
        return f"{_type(type_.value_type)}[]"
    if isinstance(type_, NamespacedType):
        return f"{type_.namespaces[0]}/{type_.name}"
    if isinstance(type_, BasicType):
        return _NAMES.get(type_.typename, type_.typename)
    text = "wstring" if isinstance(type_, AbstractWString) else "string"
    return f"{text}<={type_.maximum_size}" if isinstance(type_, (BoundedString, BoundedWString)) else text


def _value(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, bytes):
        return str(value[0])
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'
    return repr(value)
