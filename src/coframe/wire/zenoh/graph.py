# SPDX-License-Identifier: Apache-2.0
"""The ROS graph from liveliness tokens."""

from __future__ import annotations

import threading
from collections import deque
from typing import TYPE_CHECKING, Any, Final

from coframe.wire import names
from coframe.wire.graph import DiscoveredEndpoint, Graph, NodeInfo
from coframe.wire.zenoh import keys, library, tokens

if TYPE_CHECKING:
    from collections.abc import Iterator

    import zenoh
    from coframe import _core
    from coframe.wire.names import Endpoint, Kind
    from coframe.wire.zenoh.tokens import Token

# Tokens that wait to be processed. They must not be dropped, but a process that declares them without end must not fill
# the memory.
_MOST_PENDING: Final = 200_000
_MOST_ENDPOINTS: Final = 100_000  # on the graph; further ones are not listed


class _Node:
    """A node of the graph: its token, and the tokens of its endpoints."""

    def __init__(self) -> None:
        self.token: Token | None = None
        self.endpoints: dict[str, Token] = {}

    def info(self) -> NodeInfo | None:
        """Return the node with its endpoints; None if it has left."""
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
        session: The session.
        domain: The domain ID.
        changed: Set whenever tokens arrive.
    """

    qos_must_match = False

    def __init__(self, session: zenoh.Session, domain: int, changed: _core.Event) -> None:
        super().__init__()
        module = library.load()
        self._pending: deque[tuple[bool, str]] = deque(maxlen=_MOST_PENDING)  # (declared, token)
        self._members: dict[bytes, _Node] = {}  # by session and node
        self._topics: dict[tuple[bool, str], dict[int, DiscoveredEndpoint]] = {}  # by (is a writer, topic)
        self._changed = changed
        self._closed_error = module.ZError
        self._delete = module.SampleKind.DELETE
        self._user_data: dict[bytes, bytes] = {}  # by the identifier of the endpoint
        self._subscribers: list[Any] = [
            session.liveliness().declare_subscriber(space, module.handlers.FifoChannel(_MOST_PENDING), history=True)
            for space in (tokens.all_user_data(domain), tokens.all_tokens(domain))
        ]
        self._threads = [
            threading.Thread(target=self._receive, args=(subscriber.handler,), name="coframe-graph", daemon=True)
            for subscriber in self._subscribers
        ]
        for thread in self._threads:
            thread.start()

    def close(self) -> None:
        """Stop discovery. The state stays available."""
        for subscriber in self._subscribers:
            subscriber.undeclare()
        for thread in self._threads:
            thread.join()

    def add_own(self, token: str, *, declared: bool) -> None:
        """Process a token of this process at once; it also arrives from Zenoh, a little later."""
        self._pending.append((declared, token))

    def matching(self, endpoint: Endpoint, type_hash: str, *, writers: bool) -> dict[int, DiscoveredEndpoint]:
        """Return the writers or readers that an endpoint exchanges messages with, by their handles.

        Args:
            endpoint: The endpoint.
            type_hash: The hash of its type; `keys.ANY_HASH` matches every hash.
            writers: Whether to return writers.
        """
        self.refresh()
        with self._lock:
            others = self._topics.get((writers, endpoint.dds_topic), {})
            wanted = endpoint.dds_type
            return {
                handle: other
                for handle, other in others.items()
                if other.type == wanted and type_hash in (other.type_hash, keys.ANY_HASH)
            }

    def known_hash(self, endpoint: Endpoint) -> str:
        """Return the hash of a type that other nodes announce on a topic; "" if there is none."""
        self.refresh()
        with self._lock:
            for writers in (True, False):
                for other in self._topics.get((writers, endpoint.dds_topic), {}).values():
                    if other.type == endpoint.dds_type:
                        return other.type_hash
        return ""

    def _receive(self, handler: Any) -> None:
        """Queue the tokens that arrive until the subscriber is closed."""
        try:
            while True:
                sample = handler.recv()
                while sample is not None:
                    self._pending.append((sample.kind != self._delete, str(sample.key_expr)))
                    sample = handler.try_recv()
                self._changed.set()
        except self._closed_error:
            pass

    def _take_changes(self) -> bool:
        touched: set[bytes] = set()
        while self._pending:
            declared, text = self._pending.popleft()
            if (token := tokens.decode_token(text)) is not None:
                touched.add(self._apply(text, token, declared=declared))
            elif (user_data := tokens.decode_user_data(text)) is not None:
                self._apply_user_data(*user_data, declared=declared)
        for participant in touched:
            info = self._members[participant].info()
            if info is None:
                del self._members[participant]
                self._nodes.pop(participant, None)
            else:
                self._nodes[participant] = [info]
        return bool(touched)

    def _apply(self, text: str, token: Token, *, declared: bool) -> bytes:
        """Process one token, and return the identifier of its node."""
        participant = f"{token.session}/{token.node}".encode()
        node = self._members.setdefault(participant, _Node())
        if token.kind == tokens.NODE:
            node.token = token if declared else None
            if not declared:
                for left in node.endpoints.values():
                    self._remove(left)
                node.endpoints.clear()
        elif declared:
            if len(self._writers) + len(self._readers) >= _MOST_ENDPOINTS:
                return participant
            node.endpoints[text] = token
            for is_writer, end in _endpoints_of(token):
                self._store(is_writer, end._replace(user_data=self._user_data.get(end.guid, b"")))
        elif node.endpoints.pop(text, None) is not None:
            self._remove(token)
        return participant

    def _store(self, is_writer: bool, end: DiscoveredEndpoint) -> None:
        handle = keys.handle_of(end.guid)
        (self._writers if is_writer else self._readers)[handle] = end
        self._topics.setdefault((is_writer, end.topic), {})[handle] = end

    def _apply_user_data(self, gid: bytes, user_data: bytes, *, declared: bool) -> None:
        """Store the user data of an endpoint, whose token may arrive earlier or later."""
        if declared and len(self._user_data) < _MOST_PENDING:
            self._user_data[gid] = user_data
        else:
            self._user_data.pop(gid, None)
        if declared and (writer := self._writers.get(keys.handle_of(gid))) is not None:
            self._store(True, writer._replace(user_data=user_data))

    def _remove(self, token: Token) -> None:
        for is_writer, end in _endpoints_of(token):
            handle = keys.handle_of(end.guid)
            (self._writers if is_writer else self._readers).pop(handle, None)
            topic = self._topics.get((is_writer, end.topic), {})
            topic.pop(handle, None)
            if not topic:
                self._topics.pop((is_writer, end.topic), None)


def _endpoints_of(token: Token) -> Iterator[tuple[bool, DiscoveredEndpoint]]:
    """Yield the endpoints that a token stands for, each with whether it is a writer."""
    participant = f"{token.session}/{token.node}".encode()
    ros_type = names.ros_type(token.type)
    if token.kind in (tokens.PUBLISHER, tokens.SUBSCRIPTION):
        topic = names.dds_topic(token.topic)
        end = DiscoveredEndpoint(token.gid, participant, topic, token.type, token.qos, b"", token.type_hash)
        yield token.kind == tokens.PUBLISHER, end
        return
    halves: tuple[tuple[Kind, bytes, str], ...] = (
        ("request", token.gid, "Request"),
        ("reply", keys.other_half(token.gid), "Response"),
    )
    for kind, gid, suffix in halves:
        topic, type_name = names.dds_topic(token.topic, kind), names.dds_type(f"{ros_type}_{suffix}")
        end = DiscoveredEndpoint(gid, participant, topic, type_name, token.qos, b"", token.type_hash)
        yield (token.kind == tokens.CLIENT) == (kind == "request"), end
