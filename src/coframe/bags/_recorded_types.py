# SPDX-License-Identifier: Apache-2.0
"""The message types of a recording: coframe's classes, or classes created from the definitions in the recording."""

from __future__ import annotations

import functools
import re
import threading
from collections import OrderedDict
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.errors import CoframeError, InterfaceError
from coframe.messages.compounds import event
from coframe.messages.header_peek import (
    FirstStamp,
    HeaderPeek,
    StampReader,
    first_stamp,
    known_first_stamp,
    peek_header,
)
from coframe.messages.limits import MAX_RECORDED_TEXT
from coframe.messages.schema_classes import ResolvedSchema, SchemaClasses, known_class
from coframe.messages.schemas import Schema, parse_schema, ros_name

if TYPE_CHECKING:
    from coframe.bags.storage import Channel

__all__ = ["RecordedTypes", "UnknownTypeError"]

_ROS_ENCODINGS = {"cdr", "ros1"}
_EVENT_SUFFIX = "_Event"
_MAX_CACHED_TEXT = 2 << 20  # bytes of the definitions that are kept parsed
_MAX_SHORT_TEXT = 1 << 13  # bytes of definitions whose beginning is cached for the next recording
_MIN_COUNTED_BYTES = 1 << 12  # minimum bytes counted per definition

# The definition of a message that begins with a stamp contains one of these, or a sequence of messages that do.
_find_stamp_type = re.compile(rb"Header|[Tt]ime|\[|sequence").search

_Key = tuple[str, str, str, bytes]


class _MessagePrefix(NamedTuple):
    """Cached information about the beginning of the messages of a type.

    Attributes:
        first: The first field, or None if it is not a stamp or is unknown.
        has_header: Whether they have a field ``header``, or None if that is unknown.
    """

    first: FirstStamp | None
    has_header: bool | None


_UNKNOWN, _NO_STAMP = _MessagePrefix(None, None), _MessagePrefix(None, has_header=False)


class UnknownTypeError(CoframeError):
    """The definition of a type is not available or cannot be used."""


class RecordedTypes:
    """The types of one recording. Equal definitions are read once, and their total size is limited. Thread-safe."""

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._classes = SchemaClasses()
        self._found_classes: dict[_Key, Any] = {}  # a class, or the reason why there is none
        self._beginnings: dict[_Key, _MessagePrefix] = {}
        self._parsed_schemas: OrderedDict[_Key, ResolvedSchema] = OrderedDict()
        self._parsed_text_bytes = 0
        self._text = 0

    def message_class(self, channel: Channel) -> Any:
        """Return the class of the messages of a channel in ``cdr`` or ``ros1``.

        Raises:
            UnknownTypeError: The recording has no definition of the type that can be used, and coframe has none.
        """
        key = _key(channel)
        with self._lock:
            if key not in self._found_classes:
                try:
                    self._found_classes[key] = self._new_class(channel)
                except UnknownTypeError as error:
                    self._found_classes[key] = str(error)
        if isinstance(self._found_classes[key], str):
            raise UnknownTypeError(self._found_classes[key])
        return self._found_classes[key]

    def own_class(self, channel: Channel) -> Any:
        """Return the class of the messages of a channel if it is one of coframe's, or None otherwise."""
        try:
            cls = self.message_class(channel)
        except UnknownTypeError:
            return None
        return None if cls.__recorded__ else cls

    def schema(self, channel: Channel) -> ResolvedSchema:
        """Return the messages that a channel's definition describes.

        Raises:
            UnknownTypeError: The recording has no definition of the type that can be used.
        """
        key = _key(channel)
        with self._lock:
            if key not in self._parsed_schemas:
                self._parsed_schemas[key] = self._new_schema(channel, key)
                self._parsed_text_bytes += _weight(key)
                while len(self._parsed_schemas) > 1 and self._parsed_text_bytes > _MAX_CACHED_TEXT:
                    self._parsed_text_bytes -= _weight(self._parsed_schemas.popitem(last=False)[0])
            self._parsed_schemas.move_to_end(key)
            return self._parsed_schemas[key]

    def stamp_reader(self, channel: Channel) -> StampReader | None:
        """Return the reader for the stamps of a channel's messages, or None if they do not begin with a stamp."""
        if channel.definition and not _find_stamp_type(channel.definition):
            return None  # Reading the definition takes longer, and a recording can have tens of thousands.
        first = self._beginning(channel).first
        return None if first is None else StampReader(first, channel.encoding)

    def peek_header(self, channel: Channel, data: bytes) -> HeaderPeek | None:
        """Return the header of a message without decoding the rest, or None if it does not begin with a valid one."""
        is_header = self._beginning(channel).first is FirstStamp.HEADER
        return peek_header(data, channel.encoding) if is_header else None

    def may_have_header(self, channel: Channel) -> bool:
        """Return whether the messages of a channel have a field ``header``, or True if that is unknown."""
        return self._beginning(channel).has_header is not False

    def _beginning(self, channel: Channel) -> _MessagePrefix:
        if channel.encoding not in _ROS_ENCODINGS:
            return _UNKNOWN
        key = _key(channel)
        if key not in self._beginnings:
            self._beginnings[key] = self._new_beginning(channel)
        return self._beginnings[key]

    def _new_beginning(self, channel: Channel) -> _MessagePrefix:
        try:
            known = None if channel.definition else known_class(_name(channel))
            if known is not None:
                return _MessagePrefix(known_first_stamp(known.ROS_TYPE), hasattr(known, "header"))
            if not 0 < len(channel.definition) <= _MAX_SHORT_TEXT:
                return _find_beginning(self.schema(channel))
            if _key(channel) not in self._found_classes:
                self.count(channel)
            return _parse_beginning(channel.definition, _name(channel), channel.definition_format)
        except (UnknownTypeError, InterfaceError):
            return _UNKNOWN

    def _new_class(self, channel: Channel) -> Any:
        if not channel.definition:
            known = known_class(_name(channel))
            if known is not None:
                return known
        schema = self.schema(channel)
        try:
            return self._classes.of(schema, is_ros1=channel.encoding == "ros1")
        except InterfaceError as error:
            raise _definition_problem(error) from None

    def _new_schema(self, channel: Channel, key: _Key) -> ResolvedSchema:
        name = _name(channel)
        if key not in self._found_classes and key not in self._beginnings:
            self.count(channel)
        try:
            if not channel.definition:
                return _schema_without_text(name)
            return ResolvedSchema(parse_schema(channel.definition, name, channel.definition_format))
        except InterfaceError as error:
            raise _definition_problem(error) from None

    def count(self, channel: Channel) -> None:
        """Count the definition of a channel.

        Raises:
            UnknownTypeError: The definitions of the recording are too large in total.
        """
        if self._text + len(channel.definition) > MAX_RECORDED_TEXT:
            raise UnknownTypeError(f"the definitions of the recording exceed the maximum of {MAX_RECORDED_TEXT} bytes")
        self._text += len(channel.definition)


def _find_beginning(schema: ResolvedSchema) -> _MessagePrefix:
    first, has_header = first_stamp(schema), schema.has_field("header")
    return _NO_STAMP if first is None and not has_header else _MessagePrefix(first, has_header)


@functools.lru_cache(64)  # The same definitions, such as that of /tf, are in most recordings.
def _parse_beginning(definition: bytes, name: str, format_: str) -> _MessagePrefix:
    return _find_beginning(ResolvedSchema(parse_schema(definition, name, format_)))


def _weight(key: _Key) -> int:
    return max(len(key[-1]), _MIN_COUNTED_BYTES)


def _key(channel: Channel) -> _Key:
    return (channel.type, channel.encoding, channel.definition_format, channel.definition)


def _name(channel: Channel) -> str:
    try:
        return ros_name(channel.type)
    except ValueError as error:
        raise UnknownTypeError(str(error)) from None


def _schema_without_text(name: str) -> ResolvedSchema:
    """Return the definition of service events, derived from the service."""
    package, _, rest = name.partition("/srv/")
    if (
        not rest.endswith(_EVENT_SUFFIX)
        or known_class(f"{package}/srv/{rest.removesuffix(_EVENT_SUFFIX)}_Request") is None
    ):
        raise UnknownTypeError("the recording contains no definition")
    return ResolvedSchema(Schema(name, {name: event(package, rest.removesuffix(_EVENT_SUFFIX))}))


def _definition_problem(error: InterfaceError) -> UnknownTypeError:
    reason = str(error).partition("\n")[0]
    return UnknownTypeError(f"its definition cannot be used ({reason[:300]})")
