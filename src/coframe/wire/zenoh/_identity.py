# SPDX-License-Identifier: Apache-2.0
"""The tokens of an endpoint of this process."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.wire.zenoh import _keys
from coframe.wire.zenoh._tokens import user_data_token

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.wire.names import Endpoint
    from coframe.wire.qos import QoS
    from coframe.wire.zenoh._tokens import NodeToken


class Identity:
    """The identity of an endpoint of this process on the graph.

    Several nodes of this process can share an endpoint (`LocalEndpoint.share`). Each node announces it by its own
    token; messages contain the identifier of the first one.

    Args:
        node: The node that creates the endpoint.
        number: The number of the endpoint in the session.
        kind: The kind of the token.
        endpoint: The topic or service.
        type_hash: The hash of its type; `keys.ANY_HASH` if it is unknown.
        qos: Its quality of service.
        buffers: Whether it is a subscription that also receives messages at the buffer key.
        user_data: Pairs `key=value;`, which only coframe reads.
    """

    def __init__(
        self,
        node: NodeToken,
        number: int,
        kind: str,
        endpoint: Endpoint,
        type_hash: str,
        qos: QoS,
        *,
        buffers: bool,
        user_data: str,
    ) -> None:
        self.endpoint = endpoint
        self.type_hash = type_hash
        self._kind = kind
        self._qos = qos
        self._buffers = buffers
        self._user_data = user_data
        self._numbers = {node: number}
        self.gid = _keys.gid_of(self._token(node))

    def tokens(self, node: NodeToken, numbers: Iterator[int]) -> list[str]:
        """Return the tokens of the endpoint for one of its nodes; none as long as the hash of its type is unknown.

        Args:
            node: The node that has the endpoint.
            numbers: The counter of the session, from which each additional node of the endpoint takes a number.
        """
        if self.type_hash == _keys.ANY_HASH:
            return []
        if node not in self._numbers:
            self._numbers[node] = next(numbers)
        token = self._token(node)
        return [token, user_data_token(node.domain, token, self._user_data)] if self._user_data else [token]

    def _token(self, node: NodeToken) -> str:
        return node.endpoint(
            self._numbers[node], self._kind, self.endpoint, self.type_hash, self._qos, buffers=self._buffers
        )
