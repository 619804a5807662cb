# SPDX-License-Identifier: Apache-2.0
"""Decode recorded messages with coframe's classes or with the definitions in the recording."""

from __future__ import annotations

import functools
import json
from typing import TYPE_CHECKING, Any

from coframe._process.optional_imports import pip_install
from coframe.bags._recorded_types import UnknownTypeError
from coframe.errors import DecodeError
from coframe.messages import deserialize
from coframe.messages.codec import deserialize_ros1
from coframe.messages.limits import MAX_DEFINITION

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.bags._problems import Problems
    from coframe.bags._recorded_types import RecordedTypes
    from coframe.bags.storage import Channel

__all__ = ["decoder"]


def decoder(channel: Channel, types: RecordedTypes, problems: Problems) -> Callable[[bytes], Any]:
    """Return the function that decodes the messages of a channel.

    ROS messages become instances of coframe's class if the definition in the recording matches it, otherwise of a class
    created from that definition. Protobuf messages become objects of the protobuf package, JSON becomes the result of
    :func:`json.loads`. Messages of unknown types are returned as bytes, and a problem is added.

    Returns:
        A function that raises a DecodeError if the bytes are damaged.
    """
    if channel.encoding == "json":
        return functools.partial(_decode_checked, json.loads, channel.type)
    makers = {"cdr": _cdr_decoder, "ros1": _ros1_decoder, "protobuf": _protobuf_decoder}
    if channel.encoding not in makers:
        problems.add(f"{channel.topic}: messages with the encoding {channel.encoding!r} are returned as bytes")
        return bytes
    try:
        return makers[channel.encoding](channel, types)
    except UnknownTypeError as error:
        problems.add(f"{channel.topic}: messages of type {channel.type} are returned as bytes: {error}")
        return bytes


def _cdr_decoder(channel: Channel, types: RecordedTypes) -> Callable[[bytes], Any]:
    cls = types.message_class(channel)
    return lambda data: deserialize(data, cls)


def _ros1_decoder(channel: Channel, types: RecordedTypes) -> Callable[[bytes], Any]:
    cls = types.message_class(channel)
    return lambda data: deserialize_ros1(data, cls)


def _protobuf_decoder(channel: Channel, types: RecordedTypes) -> Callable[[bytes], Any]:
    """Return a decoder for the descriptors of messages (a FileDescriptorSet) in the recording."""
    try:
        from google.protobuf import descriptor_pb2, descriptor_pool, message_factory  # noqa: PLC0415 - optional
    except ModuleNotFoundError:
        raise UnknownTypeError(f"the package protobuf is not installed ({pip_install('protobuf')})") from None
    if not channel.definition or len(channel.definition) > MAX_DEFINITION:
        raise UnknownTypeError(
            "the recording contains no definition"
            if not channel.definition
            else f"the definition is longer than the maximum of {MAX_DEFINITION} bytes"
        )
    types.count(channel)
    pool = descriptor_pool.DescriptorPool()
    try:
        found = descriptor_pb2.FileDescriptorSet.FromString(channel.definition).file
        _add_all({file.name: file for file in found}, pool)
        kind = message_factory.GetMessageClass(pool.FindMessageTypeByName(channel.type))
    except Exception as error:  # noqa: BLE001 - protobuf raises errors of several kinds for damaged descriptors
        reason = " ".join(str(error).split())[:200]
        raise UnknownTypeError(f"its definition cannot be used ({reason or type(error).__name__})") from None
    return functools.partial(_decode_checked, kind.FromString, channel.type)


def _add_all(files: dict[str, Any], pool: Any) -> None:
    """Add descriptors to a pool, dependencies first."""

    def add(name: str) -> None:
        if (file := files.pop(name, None)) is not None:
            for other in file.dependency:
                add(other)
            pool.Add(file)

    while files:
        add(next(iter(files)))


def _decode_checked(decode: Callable[[bytes], Any], name: str, data: bytes) -> Any:
    """Decode a message, and convert any library error to a DecodeError."""
    try:
        return decode(data)
    except Exception as error:  # noqa: BLE001
        raise DecodeError(
            f"{name}: {str(error) or type(error).__name__}",
            hint="The bytes are truncated, damaged or of another type.",
        ) from None
