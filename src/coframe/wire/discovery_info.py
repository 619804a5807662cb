"""The topic ros_discovery_info, by which ROS participants tell their nodes: its message as CDR.

The definition, rmw_dds_common/ParticipantEntitiesInfo: the participant's identifier, then for each node its
namespace, its name, and the identifiers of its readers and of its writers.
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
_GID_SIZES = (24, 16)  # the longer is the GUID and zeros


class NodeInfo(NamedTuple):
    """One node and its endpoints, by their 16-byte GUIDs."""

    namespace: str
    name: str
    readers: tuple[bytes, ...] = ()
    writers: tuple[bytes, ...] = ()


def gid_size(environment: Mapping[str, str]) -> int:
    """Bytes of an identifier in what is sent: 24 for Humble and older or an unset ROS_DISTRO, 16 from Iron on."""
    distro = environment.get("ROS_DISTRO", "").strip().lower() or "humble"
    return 24 if distro in _LONG_GID_DISTROS else 16


def encode_info(participant: bytes, nodes: list[NodeInfo], size: int) -> bytes:
    """The message as CDR, with identifiers of `size` bytes."""
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
    """The participant's GUID and its nodes from a message in either form; None if it is in neither."""
    if len(message) < 4 or message[0] != 0 or message[1] not in (0, 1):
        return None
    order = "<" if message[1] else ">"
    forms = (_decode(message[4:], order, size) for size in _GID_SIZES)
    return next((info for info in forms if info is not None), None)


def _decode(body: bytes, order: str, size: int) -> tuple[bytes, list[NodeInfo]] | None:
    try:
        return _Cursor(body, order, size).info()
    except ValueError:
        return None


class _Cursor:
    """Reads CDR from the front; ValueError where the bytes cannot be what is read."""

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
            raise ValueError("bytes are left over")
        return participant, nodes

    def _take(self, size: int) -> bytes:
        data = self._body[self._offset : self._offset + size]
        if len(data) < size:
            raise ValueError("the message ends early")
        self._offset += size
        return data

    def _number(self, limit: int) -> int:
        self._offset += -self._offset % 4
        (number,) = self._count.unpack(self._take(4))
        if number > limit:
            raise ValueError("more than there can be")
        return int(number)

    def _text(self) -> str:
        data = self._take(self._number(MAX_NAME + 1))
        if not data.endswith(b"\0"):
            raise ValueError("a string does not end")
        return data[:-1].decode()

    def _guid(self) -> bytes:
        return self._take(self._gid_size)[:_GUID_SIZE]

    def _guids(self) -> tuple[bytes, ...]:
        return tuple(self._guid() for _ in range(self._number(len(self._body) // self._gid_size)))
