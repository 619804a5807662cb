# SPDX-License-Identifier: Apache-2.0
"""The liveliness tokens of rmw_zenoh_cpp, which are the ROS graph.

`@ros2_lv/<domain>/<session>/<node>/<id>/<kind>/<enclave>/<namespace>/<name>`, and for endpoints
`/<topic>/<type>/<type hash>/<QoS>`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from coframe.wire.names import MAX_NAME
from coframe.wire.qos import DEFAULT
from coframe.wire.zenoh import _keys
from coframe.wire.zenoh._qos_text import decode_qos, encode_qos

if TYPE_CHECKING:
    from coframe.wire.names import Endpoint
    from coframe.wire.qos import QoS

NODE: Final = "NN"
PUBLISHER: Final = "MP"
SUBSCRIPTION: Final = "MS"
SERVICE: Final = "SS"
CLIENT: Final = "SC"

_SPACE: Final = "@ros2_lv"
_USER_DATA_SPACE: Final = "@coframe_lv"  # ROS 2 does not read these
_ENCLAVE: Final = "/"
_KINDS: Final = {PUBLISHER, SUBSCRIPTION, SERVICE, CLIENT}
_NODE_CHUNKS: Final = 9
_ENDPOINT_CHUNKS: Final = 13
_BACKENDS: Final = "backends:cpu:"
MAX_BYTES: Final = 4096  # of a token; the longest ROS tokens have a fifth of this


class NodeToken(NamedTuple):
    """The token of a node of this process."""

    domain: int
    session: str
    id: int
    namespace: str
    name: str

    @property
    def text(self) -> str:
        """The token."""
        return self.entity(self.id, NODE)

    def entity(self, number: int, kind: str) -> str:
        """Return the common beginning of the tokens of this node's entities."""
        return (
            f"{_SPACE}/{self.domain}/{self.session}/{self.id}/{number}/{kind}/"
            f"{_keys.mangle(_ENCLAVE)}/{_keys.mangle(self.namespace)}/{_keys.mangle(self.name)}"
        )

    def endpoint(
        self, number: int, kind: str, endpoint: Endpoint, type_hash: str, qos: QoS, *, buffers: bool = False
    ) -> str:
        """Return the token of an endpoint of this node.

        Args:
            number: The number of the endpoint in the session.
            kind: The kind of the endpoint.
            endpoint: Its topic or service.
            type_hash: The hash of its type.
            qos: Its quality of service.
            buffers: Whether it is a subscription that also receives messages at the buffer key.
        """
        token = (
            f"{self.entity(number, kind)}/{_keys.mangle(endpoint.name)}/{_keys.type_name(endpoint)}/{type_hash}/"
            f"{encode_qos(qos)}"
        )
        return f"{token}/{_BACKENDS}" if buffers else token


class Token(NamedTuple):
    """A received token.

    Attributes:
        session: The identifier of the session.
        node: The number of the node in the session.
        kind: "NN" or the kind of an endpoint.
        namespace: The namespace of the node.
        name: The name of the node.
        topic: The topic or service of an endpoint.
        type: Its type, such as "std_msgs::msg::dds_::String_".
        type_hash: The hash of its type.
        qos: Its quality of service; the default for a node.
        gid: The identifier of the entity.
    """

    session: str
    node: int
    kind: str
    namespace: str
    name: str
    topic: str
    type: str
    type_hash: str
    qos: QoS
    gid: bytes


def all_tokens(domain: int) -> str:
    """Return the key expression of all tokens of a domain."""
    return f"{_SPACE}/{domain}/**"


def all_user_data(domain: int) -> str:
    """Return the key expression of the user data of all endpoints of a domain."""
    return f"{_USER_DATA_SPACE}/{domain}/**"


def user_data_token(domain: int, token: str, user_data: str) -> str:
    """Return the token that contains the user data of the endpoint with a token: pairs `key=value;`."""
    return f"{_USER_DATA_SPACE}/{domain}/{_keys.gid_of(token).hex()}/{user_data}"


def decode_user_data(text: str) -> tuple[bytes, bytes] | None:
    """Return the identifier and the user data of an endpoint, or None if the token is of another kind."""
    chunks = text.split("/")
    if len(chunks) != 4 or chunks[0] != _USER_DATA_SPACE or len(text) > MAX_BYTES:
        return None
    try:
        return bytes.fromhex(chunks[2]), chunks[3].encode()
    except ValueError:
        return None


def decode_token(text: str) -> Token | None:
    """Return the contents of a token, or None if it is not valid."""
    chunks = text.split("/")
    if len(text) > MAX_BYTES or len(chunks) < _NODE_CHUNKS or not all(chunks) or chunks[0] != _SPACE:
        return None
    _, _, session, node, number, kind, _, namespace, name, *endpoint = chunks
    if not (_is_number(node) and _is_number(number)):
        return None
    topic = type_name = type_hash = ""
    qos = DEFAULT
    if kind in _KINDS:
        if len(chunks) < _ENDPOINT_CHUNKS:
            return None
        topic, type_name, type_hash = _keys.demangle(endpoint[0]), endpoint[1], endpoint[2]
        decoded = decode_qos(endpoint[3])
        if decoded is None or not topic.startswith("/"):
            return None
        qos = decoded
    longest = max(len(part.encode()) for part in (session, namespace, name, topic, type_name, type_hash))
    if longest > MAX_NAME or kind not in {NODE, *_KINDS}:
        return None
    return Token(
        session,
        int(node),
        kind,
        _keys.demangle(namespace),
        _keys.demangle(name),
        topic,
        type_name,
        type_hash,
        qos,
        _keys.gid_of(text),
    )


def _is_number(text: str) -> bool:
    return text.isascii() and text.isdigit() and len(text) <= 20
