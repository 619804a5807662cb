# SPDX-License-Identifier: Apache-2.0
"""The CDR message of the topic ros_discovery_info, on which ROS participants publish their nodes.

The message, rmw_dds_common/msg/ParticipantEntitiesInfo, contains the identifier of the participant, then for each node
its namespace, its name, and the identifiers of its readers and of its writers.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping

TOPIC = "ros_discovery_info"
MAX_NAME = 256  # bytes of a namespace or a name

_LONG_GID_DISTROS = ("foxy", "galactic", "humble")
_GUID_SIZE = 16
_GID_SIZES = (24, 16)  # the longer form is the GUID, padded with zeros


class NodeInfo(NamedTuple):
    """A node and the 16-byte GUIDs of its endpoints."""

    namespace: str
    name: str
    readers: tuple[bytes, ...] = ()
    writers: tuple[bytes, ...] = ()


def gid_size(environment: Mapping[str, str]) -> int:
    """Return the size of a published identifier in bytes: 24 up to Humble and if ROS_DISTRO is unset, else 16."""
    distro = environment.get("ROS_DISTRO", "").strip().lower() or "humble"
    return 24 if distro in _LONG_GID_DISTROS else 16


def encode_info(participant: bytes, nodes: list[NodeInfo], size: int) -> bytes:
    """Return the message as CDR, with identifiers of `size` bytes."""
    padding = bytes(size - _GUID_SIZE)
    body = bytearray(participant + padding)

    def put_count(count: int) -> None:
        body.extend(bytes(-len(body) % 4))
        body.extend(struct.pack("<I", count))

    put_count(len(nodes))
    for node in nodes:
        for text in (node.namespace, node.name):
            data = text.encode() + b"\0"
            put_count(len(data))
            body.extend(data)
        for guids in (node.readers, node.writers):
            put_count(len(guids))
            for guid in guids:
                body.extend(guid + padding)
    return b"\0\1\0\0" + bytes(body)


def decode_info(message: bytes) -> tuple[bytes, list[NodeInfo]] | None:
    """Return the GUID of the participant and its nodes from a message with either identifier size; None if invalid."""
    if len(message) < 4 or message[0] != 0 or message[1] not in (0, 1):
        return None
    order = "<" if message[1] else ">"
    decoded = (_decode(message[4:], order, size) for size in _GID_SIZES)
    return next((info for info in decoded if info is not None), None)


def _decode(body: bytes, order: str, size: int) -> tuple[bytes, list[NodeInfo]] | None:
    try:
        return _Cursor(body, order, size).info()
    except ValueError:
        return None


class _Cursor:
    """A reader of CDR values in order, which raises ValueError if the bytes are invalid."""

    def __init__(self, body: bytes, order: str, gid_size: int) -> None:
        self._body = body
        self._count = struct.Struct(order + "I")
        self._gid_size = gid_size
        self._offset = 0

    def info(self) -> tuple[bytes, list[NodeInfo]]:
        participant = self._guid()
        nodes = [
            NodeInfo(self._text(), self._text(), self._guids(), self._guids())
            for _ in range(self._number(len(self._body)))
        ]
        if len(self._body) - self._offset >= 4:
            raise ValueError("the message has extra bytes")
        return participant, nodes

    def _take(self, size: int) -> bytes:
        data = self._body[self._offset : self._offset + size]
        if len(data) < size:
            raise ValueError("the message is truncated")
        self._offset += size
        return data

    def _number(self, limit: int) -> int:
        self._offset += -self._offset % 4
        (number,) = self._count.unpack(self._take(4))
        if number > limit:
            raise ValueError("the count exceeds the limit")
        return int(number)

    def _text(self) -> str:
        data = self._take(self._number(MAX_NAME + 1))
        if not data.endswith(b"\0"):
            raise ValueError("a string has no terminator")
        return data[:-1].decode()

    def _guid(self) -> bytes:
        return self._take(self._gid_size)[:_GUID_SIZE]

    def _guids(self) -> tuple[bytes, ...]:
        return tuple(self._guid() for _ in range(self._number(len(self._body) // self._gid_size)))
