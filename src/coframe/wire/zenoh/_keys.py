# SPDX-License-Identifier: Apache-2.0
"""The key expressions, attachments and identifiers of rmw_zenoh_cpp."""

from __future__ import annotations

import struct
import time
from typing import TYPE_CHECKING, Final, NamedTuple

from coframe.wire import names

if TYPE_CHECKING:
    from coframe.wire.names import Endpoint

ANY_HASH: Final = "*"  # matches every definition of a type; for subscriptions only
BUFFER_SUFFIX: Final = "_buf_cpu"  # at which Lyrical and later send large types to subscriptions that request it

_ATTACHMENT: Final = struct.Struct("<qqB16s")
_GID_SIZE: Final = 16


class Attachment(NamedTuple):
    """The metadata of each message, request and reply.

    Attributes:
        sequence: The sequence number of the message or request, from 1.
        sent: The time of sending, in nanoseconds since 1970 on the sender's clock.
        gid: The identifier of the publisher or client.
    """

    sequence: int
    sent: int
    gid: bytes

    def encode(self) -> bytes:
        """Return the 33 bytes."""
        return _ATTACHMENT.pack(self.sequence, self.sent, _GID_SIZE, self.gid)


def attachment(sequence: int, gid: bytes) -> bytes:
    """Return the attachment for a message sent now."""
    return _ATTACHMENT.pack(sequence, time.time_ns(), _GID_SIZE, gid)


def decode_attachment(data: bytes) -> Attachment | None:
    """Return the contents of an attachment, or None if it is not valid."""
    if len(data) != _ATTACHMENT.size:
        return None
    sequence, sent, size, gid = _ATTACHMENT.unpack(data)
    return Attachment(sequence, sent, gid) if size == _GID_SIZE else None


def data_key(domain: int, endpoint: Endpoint, type_hash: str) -> str:
    """Return the key of a topic or service.

    Args:
        domain: The domain ID.
        endpoint: The topic or service.
        type_hash: The hash of its type, or `ANY_HASH`.
    """
    return f"{domain}/{endpoint.name.strip('/')}/{type_name(endpoint)}/{type_hash}"


def interface(endpoint: Endpoint) -> str:
    """Return the ROS type of a topic or service."""
    if endpoint.kind == "topic":
        return endpoint.ros_type
    return endpoint.ros_type.removesuffix("_Request").removesuffix("_Response")


def type_name(endpoint: Endpoint) -> str:
    """Return the type in a key: "std_msgs::msg::dds_::String_"; services have no suffix Request or Response."""
    return names.dds_type(interface(endpoint))


def mangle(name: str) -> str:
    """Return a name as one chunk of a token: "%robot1%chatter" for "/robot1/chatter"."""
    return name.replace("/", "%")


def demangle(chunk: str) -> str:
    """Return the name encoded in a chunk of a token."""
    return chunk.replace("%", "/")


def gid_of(token: str) -> bytes:
    """Return the identifier of the entity with a token: XXH3-128 of the token, little-endian, 16 bytes."""
    import xxhash  # noqa: PLC0415 - only Zenoh needs it

    return xxhash.xxh3_128_digest(token.encode())[::-1]


def handle_of(gid: bytes) -> int:
    """Return the handle of a writer with an identifier."""
    return int.from_bytes(gid[:8], "little")


def other_half(gid: bytes) -> bytes:
    """Return the identifier of the second endpoint of a service or client.

    A service has one token. In `coframe.wire` it is a subscription to requests and a publisher of replies, and a client
    is a publisher of requests and a subscription to replies. The endpoint of replies gets this identifier.
    """
    return bytes(255 - byte for byte in gid)
