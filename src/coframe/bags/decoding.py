# SPDX-License-Identifier: Apache-2.0
"""Decodes recorded messages: with coframe's classes if they match, else by the definitions in the recording."""

from __future__ import annotations

import functools
import json
import re
from typing import TYPE_CHECKING, Any

from coframe.bags.definition_limits import check_definitions
from coframe.errors import CoframeError, DecodeError
from coframe.messages import deserialize, find

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.bags.problems import Problems
    from coframe.bags.storage import Channel

__all__ = ["UnknownTypeError", "decoder", "fits_humble", "humble_store", "message_class", "ros2_name", "store_for"]

_TYPE_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*/msg/[A-Za-z][A-Za-z0-9_]*", re.ASCII)
_LONGEST_DEFINITION = 1 << 20
# Names of ROS 1 for types with another name in ROS 2.
_ALIASES = {"tf/msg/tfMessage": "tf2_msgs/msg/TFMessage"}


def message_class(ros_type: str) -> Any:
    """Return coframe's class for a type; None if there is none."""
    try:
        return find(ros2_name(ros_type))
    except LookupError:
        return None


def ros2_name(ros_type: str) -> str:
    """Return the ROS 2 name of a type that may have another name in ROS 1."""
    return _ALIASES.get(ros_type, ros_type)


def decoder(channel: Channel, problems: Problems) -> Callable[[bytes], Any]:
    """Return the function that decodes the messages of a channel.

    Messages become instances of coframe's class if the definition in the recording matches it, else instances of a
    class made from that definition (of ROS or protobuf). JSON becomes what :func:`json.loads` returns. Messages of
    unknown types are returned as bytes, which is added to the problems.

    Returns:
        A function that raises a DecodeError if the bytes are damaged.
    """
    if channel.encoding == "json":
        return functools.partial(_guarded, json.loads, channel.type)
    makers = {"cdr": _ros_decoder, "ros1": _ros_decoder, "protobuf": _protobuf_decoder}
    if channel.encoding not in makers:
        problems.add(f"{channel.topic}: messages with the encoding {channel.encoding!r} are returned as bytes")
        return bytes
    try:
        return makers[channel.encoding](channel)
    except UnknownTypeError as error:
        problems.add(f"{channel.topic}: messages of type {channel.type} are returned as bytes: {error}")
        return bytes


class UnknownTypeError(CoframeError):
    """The definition of a type is not available."""


def _ros_decoder(channel: Channel) -> Callable[[bytes], Any]:
    own = message_class(channel.type)
    if not channel.definition and own is not None and channel.encoding == "cdr":
        return lambda data: deserialize(data, own)
    store = store_for(channel.type, channel.definition, channel.definition_format)
    own = own if own is not None and _fits(store) else None
    if channel.encoding == "cdr":
        if own is not None:
            return lambda data: deserialize(data, own)
        return functools.partial(_guarded, lambda data: store.deserialize_cdr(data, channel.type), channel.type)
    if own is not None:
        return functools.partial(_guarded, lambda data: _deserialize_ros1(data, channel.type), channel.type)
    return functools.partial(_guarded, lambda data: store.deserialize_ros1(data, channel.type), channel.type)


def _protobuf_decoder(channel: Channel) -> Callable[[bytes], Any]:
    """Return a decoder for the descriptors of messages (a FileDescriptorSet) in the recording."""
    try:
        from google.protobuf import descriptor_pb2, descriptor_pool, message_factory  # noqa: PLC0415 - optional
    except ModuleNotFoundError:
        raise UnknownTypeError("the package protobuf is not installed (pip install 'coframe[protobuf]')") from None
    if not channel.definition or len(channel.definition) > _LONGEST_DEFINITION:
        raise UnknownTypeError(
            "the recording contains no definition"
            if not channel.definition
            else f"the definition is longer than {_LONGEST_DEFINITION} bytes"
        )
    pool = descriptor_pool.DescriptorPool()
    try:
        found = descriptor_pb2.FileDescriptorSet.FromString(channel.definition).file
        _add_all({file.name: file for file in found}, pool)
        kind = message_factory.GetMessageClass(pool.FindMessageTypeByName(channel.type))
    except Exception as error:  # noqa: BLE001 - protobuf raises errors of several kinds for damaged descriptors
        reason = " ".join(str(error).split())[:200]
        raise UnknownTypeError(f"its definition cannot be used ({reason or type(error).__name__})") from None
    return functools.partial(_guarded, kind.FromString, channel.type)


def _add_all(files: dict[str, Any], pool: Any) -> None:
    """Add descriptors to a pool, each after those that it depends on."""

    def add(name: str) -> None:
        if (file := files.pop(name, None)) is not None:
            for other in file.dependency:
                add(other)
            pool.Add(file)

    while files:
        add(next(iter(files)))


def _guarded(decode: Callable[[bytes], Any], name: str, data: bytes) -> Any:
    """Decode a message, and turn any error of the libraries into a DecodeError."""
    try:
        return decode(data)
    except Exception as error:  # noqa: BLE001
        raise DecodeError(
            f"{name}: {str(error) or type(error).__name__}",
            hint="The bytes are truncated, damaged or of another type.",
        ) from None


@functools.lru_cache(maxsize=256)
def store_for(name: str, definition: bytes, definition_format: str) -> Any:
    """Return a type store of rosbags that contains the type.

    Raises:
        UnknownTypeError: There is no usable definition of the type.
    """
    try:
        from rosbags.typesys import Stores, get_types_from_idl, get_types_from_msg, get_typestore  # noqa: PLC0415
    except ModuleNotFoundError:
        raise UnknownTypeError("the package rosbags is not installed (pip install 'coframe[bags]')") from None
    if not definition:
        known = get_typestore(Stores.LATEST)
        if name in known.types:
            return known
        raise UnknownTypeError("the recording contains no definition")
    if not _TYPE_NAME.fullmatch(name) or len(definition) > _LONGEST_DEFINITION:
        raise UnknownTypeError(
            f"{name[:60]!r} is not the name of a message type"
            if not _TYPE_NAME.fullmatch(name)
            else f"the definition is longer than {_LONGEST_DEFINITION} bytes"
        )
    text = definition.decode("utf-8", "replace")
    store = get_typestore(Stores.EMPTY)
    try:
        types = get_types_from_idl(text) if definition_format == "ros2idl" else get_types_from_msg(text, name)
        check_definitions(types)
        store.register(types)
        store.get_msgdef(name)
    except Exception as error:  # noqa: BLE001 - the parser raises errors of many kinds for damaged definitions
        reason = str(error).partition("\n")[0] or type(error).__name__
        raise UnknownTypeError(f"its definition cannot be used ({reason[:200]})") from None
    return store


def _fits(store: Any) -> bool:
    """Return whether all types in a store have the same fields as in ROS 2 Humble."""
    humble = _humble()
    return all(_layout(name, fields) == humble[name] for name, (_, fields) in store.fielddefs.items() if name in humble)


def fits_humble(name: str, definition: bytes) -> bool:
    """Return whether a type of ROS 1, as a recording defines it, matches a type of ROS 2 Humble."""
    try:
        return _fits(store_for(name, definition, "ros1msg")) and ros2_name(name) in _humble()
    except UnknownTypeError:
        return False


@functools.cache
def humble_store() -> Any:
    """Return a type store of rosbags with the types of ROS 2 Humble."""
    from rosbags.typesys import Stores, get_typestore  # noqa: PLC0415

    return get_typestore(Stores.ROS2_HUMBLE)


@functools.cache
def _humble() -> dict[str, Any]:
    return {name: _layout(name, fields) for name, (_, fields) in humble_store().fielddefs.items()}


def _deserialize_ros1(data: bytes, name: str) -> Any:
    """Decode a message of ROS 1 through CDR, which has padding and no sequence numbers in headers."""
    name = ros2_name(name)
    return deserialize(humble_store().ros1_to_cdr(data, name), find(name))


def _layout(name: str, fields: Any) -> list[Any]:
    """Return the fields that decide the layout of the bytes.

    Names are in lower case, and the sequence number in ROS 1 headers is skipped.
    """
    skipped = {"seq"} if name == "std_msgs/msg/Header" else set()
    return [(field.lower(), type_) for field, type_ in fields if field not in skipped]
