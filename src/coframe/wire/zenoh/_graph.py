# SPDX-License-Identifier: Apache-2.0
"""The ROS graph from liveliness tokens."""

from __future__ import annotations

import threading
from collections import deque
from typing import TYPE_CHECKING, Any, Final

from coframe.wire import names
from coframe.wire.graph import DiscoveredEndpoint, Graph, NodeInfo
from coframe.wire.zenoh import _keys, _library, _tokens
from coframe.wire.zenoh._token_limits import TokenLimits

if TYPE_CHECKING:
    from collections.abc import Iterator

    import zenoh
    from coframe import _core
    from coframe.wire.names import Endpoint, Kind
    from coframe.wire.zenoh._tokens import Token

# A process that keeps declaring tokens must not fill the memory, but none may be dropped, because the removal of a node
# is announced only once. The receiving thread therefore processes tokens itself if no other thread does.
_MAX_PENDING: Final = 10_000
# Tokens in Zenoh's queue, which drops the oldest. A blocking queue would deadlock a process that joins a graph with
# more tokens, because Zenoh delivers all of them before it returns the queue. Larger than `token_limits.MAX_TOKENS`.
_MAX_QUEUED: Final = 200_000


class _Node:
    """A node of the graph: its token, and the tokens of its endpoints."""

    def __init__(self) -> None:
        self.token: Token | None = None
        self.endpoints: dict[str, Token] = {}

    def info(self) -> NodeInfo | None:
        """Return the node with its endpoints, or None if it has left."""
        described = self.token or next(iter(self.endpoints.values()), None)
        if described is None:
            return None
        ends = [end for token in self.endpoints.values() for end in _endpoints_of(token)]
        return NodeInfo(
            described.namespace,
            described.name,
            readers=tuple(end.guid for is_writer, end in ends if not is_writer),
            writers=tuple(end.guid for is_writer, end in ends if is_writer),
        )


class ZenohGraph(Graph):
    """The graph of a domain.

    Args:
        session: The Zenoh session that receives the tokens.
        domain: The domain ID.
        changed: Set when tokens arrive.
    """

    qos_must_match = False

    def __init__(self, session: zenoh.Session, domain: int, changed: _core.Event) -> None:
        super().__init__()
        module = _library.load()
        self._pending: deque[tuple[bool, str]] = deque()  # (declared, token)
        self._limits = TokenLimits()
        self._members: dict[bytes, _Node] = {}  # by session and node
        self._changed = changed
        self._closed_error = module.ZError
        self._delete = module.SampleKind.DELETE
        self._user_data: dict[bytes, bytes] = {}  # by the identifier of the endpoint
        self._subscribers: list[Any] = [
            session.liveliness().declare_subscriber(space, module.handlers.RingChannel(_MAX_QUEUED), history=True)
            for space in (_tokens.all_user_data(domain), _tokens.all_tokens(domain))
        ]
        self._threads = [
            threading.Thread(target=self._receive, args=(subscriber.handler,), name="coframe-graph", daemon=True)
            for subscriber in self._subscribers
        ]
        for thread in self._threads:
            thread.start()

    def close(self) -> None:
        """Stop discovery. The state remains available."""
        for subscriber in self._subscribers:
            subscriber.undeclare()
        for thread in self._threads:
            thread.join()

    def add_own(self, token: str, *, declared: bool) -> None:
        """Process a token of this process immediately. It also arrives from Zenoh, slightly later."""
        self._limits.add_own(token, declared=declared)
        self._pending.append((declared, token))

    def matching(self, endpoint: Endpoint, type_hash: str, *, writers: bool) -> dict[int, DiscoveredEndpoint]:
        """Return the writers or readers with which an endpoint exchanges messages, by their handles.

        Args:
            endpoint: The publisher or subscription of this process.
            type_hash: The hash of its type; `keys.ANY_HASH` matches every hash.
            writers: Whether to return writers.
        """
        self.refresh()
        with self._lock:
            others = (self._writers if writers else self._readers).on_topic(endpoint.dds_topic)
            wanted = endpoint.dds_type
            return {
                handle: other
                for handle, other in others.items()
                if other.type == wanted and type_hash in (other.type_hash, _keys.ANY_HASH)
            }

    def known_hash(self, endpoint: Endpoint) -> str:
        """Return the hash of a type that other nodes announce on a topic, or "" if there is none."""
        self.refresh()
        with self._lock:
            for table in (self._writers, self._readers):
                for other in table.on_topic(endpoint.dds_topic).values():
                    if other.type == endpoint.dds_type:
                        return other.type_hash
        return ""

    def _receive(self, handler: Any) -> None:
        """Queue the tokens that arrive until the subscriber is closed."""
        try:
            while True:
                sample = handler.recv()
                while sample is not None:
                    text = str(sample.key_expr)[: _tokens.MAX_BYTES + 1]  # longer ones are not valid
                    self._pending.append((sample.kind != self._delete, text))
                    if len(self._pending) >= _MAX_PENDING:
                        self.refresh()
                    sample = handler.try_recv()
                self._changed.set()
        except self._closed_error:
            pass

    def _take_changes(self) -> bool:
        touched: set[bytes] = set()
        for _ in range(len(self._pending)):
            declared, text = self._pending.popleft()
            if (token := _tokens.decode_token(text)) is not None:
                touched |= self._apply(text, token, declared=declared)
            elif (user_data := _tokens.decode_user_data(text)) is not None:
                self._apply_user_data(text, *user_data, declared=declared)
            else:
                self._limits.warn_of_invalid_token(text)
        for participant in touched:
            info = self._members[participant].info()
            if info is None:
                del self._members[participant]
                self._set_nodes(participant, None)
            else:
                self._set_nodes(participant, [info])
        return bool(touched)

    def _apply(self, text: str, token: Token, *, declared: bool) -> set[bytes]:
        """Process one token and return the identifier of its node, or None if it is not stored."""
        if declared and not self._limits.add(text):
            return set()
        participant = f"{token.session}/{token.node}".encode()
        node = self._members.setdefault(participant, _Node())
        if token.kind == _tokens.NODE:
            node.token = token if declared else None
        elif declared:
            node.endpoints[text] = token
            for is_writer, end in _endpoints_of(token):
                self._store(is_writer, end._replace(user_data=self._user_data.get(end.guid, b"")))
        if not declared:
            for left in [text] if token.kind != _tokens.NODE else [text, *node.endpoints]:
                self._limits.remove(left)
                if (endpoint := node.endpoints.pop(left, None)) is not None:
                    self._remove(endpoint)
        return {participant}

    def _store(self, is_writer: bool, end: DiscoveredEndpoint) -> None:
        handle = _keys.handle_of(end.guid)
        (self._writers if is_writer else self._readers).store(handle, end)

    def _apply_user_data(self, text: str, gid: bytes, user_data: bytes, *, declared: bool) -> None:
        """Store the user data of an endpoint, whose token may arrive earlier or later."""
        if not declared:
            self._limits.remove(text)
            self._user_data.pop(gid, None)
        elif self._limits.add(text):
            self._user_data[gid] = user_data
            if (writer := self._writers.get(_keys.handle_of(gid))) is not None:
                self._store(True, writer._replace(user_data=user_data))

    def _remove(self, token: Token) -> None:
        for is_writer, end in _endpoints_of(token):
            handle = _keys.handle_of(end.guid)
            if is_writer:
                self._remove_writer(handle)
            else:
                self._readers.remove(handle)


def _endpoints_of(token: Token) -> Iterator[tuple[bool, DiscoveredEndpoint]]:
    """Yield the endpoints that a token represents, each with whether it is a writer."""
    participant = f"{token.session}/{token.node}".encode()
    ros_type = names.ros_type(token.type)
    if token.kind in (_tokens.PUBLISHER, _tokens.SUBSCRIPTION):
        topic = names.dds_topic(token.topic)
        end = DiscoveredEndpoint(token.gid, participant, topic, token.type, token.qos, b"", token.type_hash)
        yield token.kind == _tokens.PUBLISHER, end
        return
    halves: tuple[tuple[Kind, bytes, str], ...] = (
        ("request", token.gid, "Request"),
        ("reply", _keys.other_half(token.gid), "Response"),
    )
    for kind, gid, suffix in halves:
        topic, type_name = names.dds_topic(token.topic, kind), names.dds_type(f"{ros_type}_{suffix}")
        end = DiscoveredEndpoint(gid, participant, topic, type_name, token.qos, b"", token.type_hash)
        yield (token.kind == _tokens.CLIENT) == (kind == "request"), end
