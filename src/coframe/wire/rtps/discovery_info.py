# SPDX-License-Identifier: Apache-2.0
"""The CDR message of the topic ros_discovery_info, on which ROS participants publish their nodes.

The message, rmw_dds_common/msg/ParticipantEntitiesInfo, contains the identifier of the participant, then for each node
its namespace, its name, and the identifiers of its readers and of its writers.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, NamedTuple

from coframe.distributions import BEHAVIORS, selected
from coframe.wire.graph import NodeInfo
from coframe.wire.names import MAX_NAME

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

TOPIC = "ros_discovery_info"
ROS_TYPE = "rmw_dds_common/msg/ParticipantEntitiesInfo"
TYPE = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_"

# Marks a writer on this topic whose form depends on the readers, so that no other process adapts to it.
ADAPTS = "coframe=adapts;"

_GUID_SIZE = 16
_COUNT = struct.Struct("<I")
_MAX_LISTED_NAMES = 10  # in a warning
_GID_SIZES = (24, 16)  # the longer form is the GUID, padded with zeros
_USED_BY = {24: "ROS 2 Humble or earlier", 16: "ROS 2 Iron or later"}


class ParticipantInfo(NamedTuple):
    """The contents of a message: the participant, its nodes, and the size of an identifier in bytes."""

    participant: bytes
    nodes: list[NodeInfo]
    gid_size: int


def gid_size(environment: Mapping[str, str]) -> int:
    """Return the size of an identifier in bytes in the distribution that the environment selects."""
    has_short = selected(environment) >= BEHAVIORS["short_identifiers"].since
    return 16 if has_short else 24


def choose_gid_size(preferred: int, others: Collection[int]) -> int:
    """Return the size of the identifiers to publish: the size that all other participants use, else `preferred`.

    Args:
        preferred: The size to use if there are no others or if they differ, from `gid_size`.
        others: The sizes that other participants publish.
    """
    sizes = set(others)
    return sizes.pop() if len(sizes) == 1 else preferred


def unseen_text(size: int, others: Mapping[int, Collection[str]]) -> str:
    """Return the warning if some participants cannot read identifiers of `size` bytes, or "" if all can.

    Args:
        size: The size that this process publishes.
        others: The nodes of the other participants, by the size that these publish.
    """
    unable = [other for other in others if other != size]
    if not unable:
        return ""
    nodes = ", ".join(sorted(others[unable[0]])[:_MAX_LISTED_NAMES]) or "without a name"
    return (
        f"Nodes of {_USED_BY[unable[0]]} ({nodes}) cannot list the nodes of this process, because nodes of "
        f"{_USED_BY[size]} are in the same domain and the two describe nodes differently. Topics and services work. "
        "Use another ROS_DOMAIN_ID for one of them, or set COFRAME_DISTRO to choose whose tools list this process."
    )


def encode_node(node: NodeInfo, size: int) -> bytes:
    """Return the part of the message about a node, with identifiers of `size` bytes.

    Its size is a multiple of four bytes, so that the parts can be joined in any order.
    """
    padding = bytes(size - _GUID_SIZE)
    parts: list[bytes] = []
    for text in (node.namespace, node.name):
        data = text.encode() + b"\0"
        parts += (_COUNT.pack(len(data)), data, bytes(-len(data) % _COUNT.size))
    for guids in (node.readers, node.writers):
        parts.append(_COUNT.pack(len(guids)))
        parts += [guid + padding for guid in guids]
    return b"".join(parts)


def join_info(participant: bytes, nodes: Sequence[bytes], size: int) -> bytes:
    """Return the message as CDR, given the parts about its nodes from `encode_node`."""
    return b"".join((b"\0\1\0\0", participant, bytes(size - _GUID_SIZE), _COUNT.pack(len(nodes)), *nodes))


def encode_info(participant: bytes, nodes: Sequence[NodeInfo], size: int) -> bytes:
    """Return the message as CDR, with identifiers of `size` bytes."""
    return join_info(participant, [encode_node(node, size) for node in nodes], size)


def decode_info(message: bytes) -> ParticipantInfo | None:
    """Return the contents of a message with either identifier size, or None if it is invalid."""
    if len(message) < 4 or message[0] != 0 or message[1] not in (0, 1):
        return None
    order = "<" if message[1] else ">"
    decoded = (_decode(message[4:], order, size) for size in _GID_SIZES)
    return next((info for info in decoded if info is not None), None)


def _decode(body: bytes, order: str, size: int) -> ParticipantInfo | None:
    try:
        return ParticipantInfo(*_Cursor(body, order, size).info(), size)
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
        gid = self._take(self._gid_size)
        if any(gid[_GUID_SIZE:]):
            raise ValueError("the padding of an identifier is not zero")
        return gid[:_GUID_SIZE]

    def _guids(self) -> tuple[bytes, ...]:
        # Built from a list of known length: CPython caches up to 2000 resized tuples per size.
        return tuple([self._guid() for _ in range(self._number(len(self._body) // self._gid_size))])
