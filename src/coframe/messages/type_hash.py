# SPDX-License-Identifier: Apache-2.0
"""Type hashes (REP-2016), by which ROS 2 compares definitions from Iron on: ``RIHS01_`` and the definition's SHA-256.

Hashes are computed from the message classes when they are first needed, in about 0.1 ms, and kept.
"""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

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
    UnboundedSequence,
)
from coframe.messages.message import Action, Message, Service
from coframe.messages.registry import find

__all__ = ["description_text", "type_hash"]

_PREFIX = "RIHS01_"
# The numbers of type_description_interfaces/msg/FieldType.
_NESTED, _STRING, _WSTRING, _BOUNDED_STRING, _BOUNDED_WSTRING = 1, 17, 18, 21, 22
_ARRAY, _BOUNDED_SEQUENCE, _SEQUENCE = 48, 96, 144
_BASIC = {
    "int8": 2,
    "uint8": 3,
    "char": 3,
    "int16": 4,
    "uint16": 5,
    "int32": 6,
    "uint32": 7,
    "int64": 8,
    "uint64": 9,
    "float": 10,
    "double": 11,
    "long double": 12,
    "wchar": 14,
    "boolean": 15,
    "octet": 16,
}
_UINT8 = BasicType("uint8")
_TIME = NamespacedType(("builtin_interfaces", "msg"), "Time")
# A message that every service has from Iron on, independently of the interfaces that are installed.
_EVENT_INFO = "service_msgs/msg/ServiceEventInfo"
_EVENT_INFO_FIELDS = {
    "event_type": _UINT8,
    "stamp": _TIME,
    "client_gid": Array(_UINT8, 16),
    "sequence_number": BasicType("int64"),
}


class _Description(NamedTuple):
    """The description of a type as JSON, and the descriptions of all referenced types by name."""

    name: str
    text: str
    referenced: dict[str, str]


@cache
def type_hash(interface: Any) -> str:
    """Return the type hash of a message, service or action class: ``RIHS01_`` and 64 hexadecimal digits.

    Args:
        interface: The class, such as that which `coframe.messages.find` returns.

    Raises:
        LookupError: The definition contains a message that is unknown.
        TypeError: It is not such a class.

    Example:
        >>> from coframe.messages import find
        >>> type_hash(find("std_msgs/msg/String"))
        'RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18'
    """
    import hashlib  # noqa: PLC0415 - it loads OpenSSL, which takes 3 ms

    return _PREFIX + hashlib.sha256(description_text(interface).encode()).hexdigest()


def description_text(interface: Any) -> str:
    """Return the description of a message, service or action class as JSON, whose SHA-256 is the hash.

    It has the fields of type_description_interfaces/msg/TypeDescription, without the default values.

    Raises:
        LookupError: The definition contains a message that is unknown.
        TypeError: It is not such a class.
    """
    if not _is_interface(interface):
        raise TypeError(f"expected a message, service or action class, not {interface!r}")
    described = _description(interface)
    referenced = ", ".join(described.referenced[name] for name in sorted(described.referenced))
    return f'{{"type_description": {described.text}, "referenced_type_descriptions": [{referenced}]}}'


def _is_interface(interface: Any) -> bool:
    return isinstance(interface, type) and issubclass(interface, (Message, Service, Action))


@cache
def _description(interface: Any) -> _Description:
    name = interface.ROS_TYPE
    if issubclass(interface, Message):
        return _describe_type(name, _message_fields(interface))
    if issubclass(interface, Service):
        return _describe_service(name)
    return _describe_type(
        name,
        {
            "goal": _named_type(f"{name}_Goal"),
            "result": _named_type(f"{name}_Result"),
            "feedback": _named_type(f"{name}_Feedback"),
            "send_goal_service": _named_type(f"{name}_SendGoal"),
            "get_result_service": _named_type(f"{name}_GetResult"),
            "feedback_message": _named_type(f"{name}_FeedbackMessage"),
        },
    )


def _message_fields(message: type[Message]) -> dict[str, AbstractType]:
    fields = dict(zip(message.get_fields_and_field_types(), message.SLOT_TYPES, strict=True))
    if not fields:  # C has no empty structures, so rosidl adds this member.
        return {"structure_needs_at_least_one_member": _UINT8}
    return fields


def _describe_service(name: str) -> _Description:
    request, response = _named_type(f"{name}_Request"), _named_type(f"{name}_Response")
    info = _describe_type(_EVENT_INFO, dict(_EVENT_INFO_FIELDS))
    fields = {
        "info": _named_type(_EVENT_INFO),
        "request": BoundedSequence(request, 1),
        "response": BoundedSequence(response, 1),
    }
    event = _describe_type(f"{name}_Event", fields, {_EVENT_INFO: info})
    fields = {"request_message": request, "response_message": response, "event_message": _named_type(event.name)}
    return _describe_type(name, fields, {event.name: event})


def _describe_type(
    name: str, fields: dict[str, AbstractType], without_class: dict[str, _Description] | None = None
) -> _Description:
    """Return the description of a type with these fields.

    Args:
        name: The name of the type.
        fields: The types of its fields.
        without_class: The descriptions of types that have no class.
    """
    import json  # noqa: PLC0415 - most programs need no description

    referenced: dict[str, str] = {}
    for nested in filter(None, map(_nested_name, fields.values())):
        described = (without_class or {}).get(nested) or _description(find(nested))
        referenced |= {nested: described.text, **described.referenced}
    described_fields = [{"name": field, "type": _field_type(type_)} for field, type_ in fields.items()]
    return _Description(name, json.dumps({"type_name": name, "fields": described_fields}), referenced)


def _field_type(type_: AbstractType) -> dict[str, Any]:
    offset, capacity, value = 0, 0, type_
    if isinstance(type_, Array):
        offset, capacity, value = _ARRAY, type_.size, type_.value_type
    elif isinstance(type_, BoundedSequence):
        offset, capacity, value = _BOUNDED_SEQUENCE, type_.maximum_size, type_.value_type
    elif isinstance(type_, UnboundedSequence):
        offset, value = _SEQUENCE, type_.value_type
    return {
        "type_id": offset + _type_id(value),
        "capacity": capacity,
        "string_capacity": value.maximum_size if isinstance(value, (BoundedString, BoundedWString)) else 0,
        "nested_type_name": _nested_name(value) or "",
    }


def _type_id(type_: AbstractType) -> int:
    if isinstance(type_, BasicType):
        return _BASIC[type_.typename]
    if isinstance(type_, NamespacedType):
        return _NESTED
    if isinstance(type_, (BoundedString, BoundedWString)):
        return _BOUNDED_WSTRING if isinstance(type_, AbstractWString) else _BOUNDED_STRING
    return _WSTRING if isinstance(type_, AbstractWString) else _STRING


def _nested_name(type_: AbstractType) -> str | None:
    value = type_.value_type if isinstance(type_, AbstractNestedType) else type_
    return "/".join(value.namespaced_name()) if isinstance(value, NamespacedType) else None


def _named_type(name: str) -> NamespacedType:
    *namespaces, last = name.split("/")
    return NamespacedType(tuple(namespaces), last)
