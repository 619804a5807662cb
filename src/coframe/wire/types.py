# SPDX-License-Identifier: Apache-2.0
"""The DDS types of ROS messages: name and layout. `coframe.messages.codec` encodes and decodes the messages."""

from __future__ import annotations

from functools import cache
from typing import Any

from coframe import _core
from coframe.errors import WireError
from coframe.wire import names
from coframe.wire.discovery_info import MAX_NAME

# The basic types of `SLOT_TYPES` that have another name in cyclonedds.
_BASIC = {"octet": "byte", "char": "uint8", "float": "float32", "double": "float64"}
_BASIC_PYTHON = {"boolean": bool}


@cache
def dds_type(message_type: type) -> Any:
    """Return the DDS type of a message class."""
    fields: dict[str, Any] = {}
    field_names = message_type.get_fields_and_field_types()  # type: ignore[attr-defined]
    slots = message_type.SLOT_TYPES  # type: ignore[attr-defined]
    for name, slot in zip(field_names, slots, strict=True):
        fields[name] = _field_type(slot)
    if not fields:
        # DDS does not allow an empty structure, so ROS adds this member.
        fields["structure_needs_at_least_one_member"] = _idl_types().uint8
    return _struct(names.dds_type(ros_type(message_type)), fields)


def ros_type(message_type: type) -> str:
    """Return the ROS type of a message class, such as "tf2_msgs/msg/TFMessage"."""
    return str(message_type.ROS_TYPE)  # type: ignore[attr-defined]


@cache
def graph_type() -> Any:
    """Return the DDS type of the topic ros_discovery_info.

    The identifiers are declared with 16 bytes, although Humble sends 24. Humble's messages have zeros at the position
    of the node count in this layout, so DDS delivers both forms to a reader of this type.
    """
    types = _idl_types()
    prefix = "rmw_dds_common::msg::dds_::"
    gid = _struct(prefix + "Gid_", {"data": types.array[types.uint8, 16]})
    node = _struct(
        prefix + "NodeEntitiesInfo_",
        {
            "node_namespace": types.bounded_str[MAX_NAME],
            "node_name": types.bounded_str[MAX_NAME],
            "reader_gid_seq": types.sequence[gid],
            "writer_gid_seq": types.sequence[gid],
        },
    )
    return _struct(prefix + "ParticipantEntitiesInfo_", {"gid": gid, "node_entities_info_seq": types.sequence[node]})


def create_topic(participant: int, name: str, data_type: Any) -> int:
    """Create a DDS topic and return its handle.

    Args:
        participant: The handle of the participant.
        name: The DDS name of the topic.
        data_type: The type, from `dds_type` or `graph_type`.

    Raises:
        WireError: DDS cannot create the topic.
    """
    from cyclonedds import _clayer  # noqa: PLC0415 - optional, see dds.py

    data_type.__idl__.populate()
    data_type.__idl__.fill_type_data()
    topic: int = _clayer.ddspy_topic_create(participant, name, data_type, None, None)
    if topic < 0:
        raise _topic_error(name, f"code {topic}")
    return topic


def create_unchecked_topic(participant: int, name: str, type_name: str) -> int:
    """Create a DDS topic whose messages DDS does not validate, and return its handle.

    Args:
        participant: The handle of the participant.
        name: The DDS name of the topic.
        type_name: The DDS name of the type.

    Raises:
        WireError: DDS cannot create the topic.
    """
    try:
        return _core.create_unchecked_topic(participant, name, type_name)
    except _core.DdsError as error:
        raise _topic_error(name, str(error)) from error


def _topic_error(name: str, why: str) -> WireError:
    return WireError(f"DDS cannot create the topic {name} ({why}).", hint="Check the name of the topic.")


def _field_type(slot: Any) -> Any:
    from coframe.messages import definition  # noqa: PLC0415 - joining the graph does not need it

    types = _idl_types()
    match slot:
        case definition.Array():
            return types.array[_field_type(slot.value_type), slot.size]
        case definition.BoundedSequence():
            return types.sequence[_field_type(slot.value_type), slot.maximum_size]
        case definition.UnboundedSequence():
            return types.sequence[_field_type(slot.value_type)]
        case _:
            return _single_type(slot)


def _single_type(slot: Any) -> Any:
    from coframe.messages import definition, registry  # noqa: PLC0415 - joining the graph does not need it

    types = _idl_types()
    match slot:
        case definition.BasicType():
            return _BASIC_PYTHON.get(slot.typename) or getattr(types, _BASIC.get(slot.typename, slot.typename))
        case definition.UnboundedString():
            return str
        case definition.BoundedString():
            return types.bounded_str[slot.maximum_size]
        # cyclonedds has no wstring. ROS sends a count and 32 bits for each unit, which is the layout of a sequence.
        case definition.UnboundedWString():
            return types.sequence[types.uint32]
        case definition.BoundedWString():
            return types.sequence[types.uint32, slot.maximum_size]
        case _:
            return dds_type(registry.find("/".join(slot.namespaced_name())))


def _struct(name: str, fields: dict[str, Any]) -> Any:
    from cyclonedds.idl import make_idl_struct  # noqa: PLC0415 - optional, see dds.py

    return make_idl_struct(name.rsplit("::", maxsplit=1)[-1].rstrip("_"), name, fields, dataclassify=False)


def _idl_types() -> Any:
    from cyclonedds.idl import types  # noqa: PLC0415 - optional, see dds.py

    return types
