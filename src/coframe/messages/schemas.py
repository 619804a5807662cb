# SPDX-License-Identifier: Apache-2.0
"""Parser for the definitions in recordings: a message and all messages inside it in one text.

The text is that of ``.msg`` files or of ``.idl`` files, as ROS 1, rosbag2 and other programs write it. Before each file
but the first is a line of 80 ``=`` and a line such as ``MSG: std_msgs/Header``.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from coframe.errors import InterfaceError
from coframe.messages._idl import parse_recorded_idl
from coframe.messages._parser import MessageStructure, Rules, parse_structure, truncate
from coframe.messages.compounds import NUMBER_OF_PARTS, event, member_messages
from coframe.messages.definition import NamespacedType
from coframe.messages.limits import MAX_DEFINITION, MAX_TYPES

__all__ = ["IDL_FORMATS", "Schema", "parse_schema", "ros_name"]

IDL_FORMATS = {"ros2idl", "omgidl"}

_SEPARATOR = re.compile(r"\s*={10,}\s*")
_TITLE = re.compile(r"\s*(MSG|SRV|ACTION|IDL):\s*(.*?)\s*")
_PART = re.compile(r"---\s*")
_NAME = r"[A-Za-z]\w*"
_TYPE = re.compile(rf"(?:(?P<package>{_NAME})/)?(?:(?P<kind>msg|srv|action)/)?(?P<name>{_NAME})", re.ASCII)
_DDS = re.compile(
    rf"(?P<package>{_NAME})::(?P<kind>msg|srv|action)::(?:dds_::(?P<dds>\w+)_|(?P<name>{_NAME}))", re.ASCII
)
_MEMBER = re.compile(rf"{_NAME}", re.ASCII)
# Types of ROS 1 that are messages in ROS 2.
_TIMES = {"time": "Time", "duration": "Duration"}

_Lines = list[tuple[int, str]]


class Schema:
    """The definition of a message and of messages inside it.

    Attributes:
        name: The name of the message, a key of `structures`.
        structures: The messages by names such as ``std_msgs/msg/Header``.
    """

    def __init__(self, name: str, structures: dict[str, MessageStructure], text: str = "") -> None:
        self.structures = structures
        self._text = text
        self._by_last_name: dict[str, list[str]] = {}
        for full in structures:
            self._by_last_name.setdefault(full.rpartition("/")[2], []).append(full)
        package, kind, own = _split_name(name)
        found = self.find(NamespacedType((package, kind), own), "")
        if found is None:
            names = ", ".join(list(structures)[:10]) or "no message"
            raise InterfaceError(f"expected the message {name}, found {names}")
        self.name = found

    def find(self, type_: NamespacedType, home: str) -> str | None:
        """Return the name of a message in the definition, or None if it has no such message.

        Args:
            type_: The message as a field names it; its package is empty if the field does not name one.
            home: The package of the message with the field.
        """
        package, kind = type_.namespaces
        full = _full_name(package or home, kind, type_.name)
        if full in self.structures:
            return full
        names = self._by_last_name.get(type_.name, [])
        of_package = [name for name in names if name.startswith(f"{package or home}/")]
        if of_package or package:
            return of_package[0] if of_package else None
        return names[0] if len(names) == 1 else None

    def find_line(self, owner: str, field: str) -> int | None:
        """Return the number of the line with a field of a message, or None if it is not found."""
        title = re.compile(rf"(?:\s*\w+:.*|.*struct\s+){re.escape(owner.rpartition('/')[2])}_?\b")
        line = re.compile(rf"[^#]*[\s,]{re.escape(field)}_?\s*(?:[;,\[#].*)?")
        lines = self._text.split("\n")
        start = next((number for number, text in enumerate(lines) if title.match(text)), 0)
        found = (number for number, text in enumerate(lines[start:], start + 1) if line.fullmatch(text.rstrip()))
        return next(found, None)


class _Block(NamedTuple):
    """The lines of one file, and its title line. The first file has no title line."""

    kind: str
    name: str
    line: int
    lines: _Lines


def ros_name(name: str) -> str:
    """Return the full name of a message type in ROS 2.

    Args:
        name: The name in a recording, such as ``std_msgs/Header``, ``std_msgs::msg::dds_::Header_`` or ``Header``.

    Raises:
        ValueError: It is not the name of a type.
    """
    match = _TYPE.fullmatch(name) or _DDS.fullmatch(name)
    if match is None:
        raise ValueError(f"{name[:60]!r} is not the name of a message type")
    found = match.groupdict()
    if not found["package"]:
        return str(found["name"])
    return _full_name(found["package"], found["kind"] or "msg", found.get("dds") or found["name"])


def _full_name(package: str, kind: str, name: str) -> str:
    return f"{package}/{kind}/{name}" if package else name


def parse_schema(text: bytes, name: str, format_: str) -> Schema:
    """Parse the definition of a message in a recording.

    Args:
        text: The definition.
        name: The name of the message, as :func:`ros_name` returns it.
        format_: ``ros1msg``, ``ros2msg``, ``ros2idl`` or ``omgidl``. Other formats are treated as ``ros2msg``.

    Raises:
        InterfaceError: The text is not valid, too large, or does not define the message.
    """
    if len(text) > MAX_DEFINITION:
        raise InterfaceError(f"the definition has {len(text)} bytes; the maximum is {MAX_DEFINITION}")
    decoded = text.decode("utf-8-sig", "replace")
    blocks = _split(decoded)
    if format_ in IDL_FORMATS or any(block.kind == "IDL" for block in blocks):
        structures = _idl_structures(blocks)
    else:
        structures = _structures(blocks, name, is_ros1=format_ == "ros1msg")
    return Schema(name, structures, decoded)


def _split(text: str) -> list[_Block]:
    """Split a definition into files. The first has no title."""
    blocks = [_Block("", "", 1, [])]
    for number, raw in enumerate(text.split("\n"), 1):
        line = raw.rstrip("\r")
        if _SEPARATOR.fullmatch(line):
            continue
        if title := _TITLE.fullmatch(line):
            if len(blocks) > MAX_TYPES:
                raise InterfaceError(f"the definition has more than {MAX_TYPES} messages", line=number)
            blocks.append(_Block(title[1], title[2], number, []))
        else:
            blocks[-1].lines.append((number, line))
    return blocks


def _idl_structures(blocks: list[_Block]) -> dict[str, MessageStructure]:
    texts = [
        (block.lines[0][0], "\n".join(line for _, line in block.lines)) for block in reversed(blocks) if block.lines
    ]
    found = parse_recorded_idl(texts)
    return {"/".join(_add_kind(path)): structure for path, structure in found.items()}


def _add_kind(path: tuple[str, ...]) -> tuple[str, ...]:
    return (path[0], "msg", path[1]) if len(path) == 2 else path


def _structures(blocks: list[_Block], name: str, *, is_ros1: bool) -> dict[str, MessageStructure]:
    structures: dict[str, MessageStructure] = {}
    rules = _ROS1 if is_ros1 else _ROS2
    for block in blocks[1:]:
        try:
            full = ros_name(block.name)
        except ValueError as error:
            raise InterfaceError(str(error), line=block.line) from None
        for found, structure in _parse_block(block.lines, full, rules).items():
            structures.setdefault(found, structure)
    first = _parse_block(blocks[0].lines, name, rules)
    if any(structure.fields or structure.constants for structure in first.values()) or len(blocks) == 1:
        structures.update(first)
    return structures


def _parse_block(lines: _Lines, name: str, rules: Rules) -> dict[str, MessageStructure]:
    """Return the messages of one file: one of a message, several of a service or an action."""
    package, kind, own = _split_name(name)
    pieces: list[_Lines] = [[]]
    for number, line in lines:
        if _PART.fullmatch(line):
            pieces.append([])
        else:
            pieces[-1].append((number, line))
    structures = [parse_structure(piece, package, rules) for piece in pieces]
    if len(structures) == 1:
        return {name: structures[0]}
    own = own.partition("_")[0]
    kind = next((kind for kind, parts in NUMBER_OF_PARTS.items() if parts == len(structures)), "")
    if not kind:
        raise InterfaceError(f"expected at most 3 parts separated by '---', found {len(structures)}", line=lines[0][0])
    members = member_messages(package, kind, own, structures)
    if kind == "srv":
        members[f"{own}_Event"] = event(package, own)
    return {f"{package}/{kind}/{member}": structure for member, structure in members.items()}


def _split_name(name: str) -> tuple[str, str, str]:
    """Return package, kind and last part of a name. The package can be missing."""
    namespace, _, own = name.rpartition("/")
    package, _, kind = namespace.partition("/")
    return package, kind or "msg", own


def _find_named(name: str, _package: str) -> NamespacedType:
    """Return the type with a name for :meth:`Schema.find` to look up."""
    if name in _TIMES:
        return NamespacedType(("builtin_interfaces", "msg"), _TIMES[name])
    match = _TYPE.fullmatch(name)
    if match is None:
        raise ValueError(f"no type {truncate(name)!r}")
    return NamespacedType((match["package"] or "", match["kind"] or "msg"), match["name"])


def _resolve_ros1_name(name: str, package: str) -> NamespacedType:
    # ROS 1 has one Header for all packages.
    return NamespacedType(("std_msgs", "msg"), "Header") if name == "Header" else _find_named(name, package)


_TEXT = "letters, digits and underscores"
_ROS1 = Rules(_MEMBER, _TEXT, _MEMBER, _TEXT, _resolve_ros1_name)
_ROS2 = Rules(_MEMBER, _TEXT, _MEMBER, _TEXT, _find_named)
