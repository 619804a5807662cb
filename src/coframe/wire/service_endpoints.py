# SPDX-License-Identifier: Apache-2.0
"""Publishers and subscriptions of requests and replies, for nodes whose middleware encodes services the same way."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from coframe.errors import WireError
from coframe.wire import names, request_header
from coframe.wire._delayed_replies import DelayedReplies
from coframe.wire._foreign_services import foreign_services_text
from coframe.wire.endpoints import RawPublisher, Sample, Subscription

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from coframe.wire._backend import BackendServiceReader, BackendServiceWriter
    from coframe.wire.endpoints import GraphNode, LocalEndpoint
    from coframe.wire.graph import DiscoveredEndpoint, Graph
    from coframe.wire.names import Endpoint
    from coframe.wire.qos import QoS
    from coframe.wire.request_header import RequestHeader


class RejectedRequestError(WireError):
    """A request was not sent because the server would misread it."""


class ServiceMessage(NamedTuple):
    """A received request or reply: its header, the message without the header, and the handle of the writer."""

    header: RequestHeader
    cdr: bytes
    writer: int


class _Peers(NamedTuple):
    """The endpoints on the other side of an endpoint.

    Attributes:
        understood: The number of matched endpoints that use the same form of requests and replies.
        foreign: An endpoint that uses another form, whether it is matched or not, or None if there is none.
        receiver: An endpoint of the same kind that may receive what this process publishes.
    """

    understood: int
    foreign: DiscoveredEndpoint | None
    receiver: DiscoveredEndpoint | None

    @property
    def refusing(self) -> DiscoveredEndpoint | None:
        """The endpoint that prevents requests from being sent, or None if requests can be sent."""
        return self.receiver if self.understood else self.foreign


def _peers(own: LocalEndpoint, graph: Graph, handles: frozenset[int], found: dict[int, DiscoveredEndpoint]) -> _Peers:
    understood, foreign, receiver = 0, None, None
    for handle, peer in found.items():
        if not graph.foreign_services(peer):
            understood += handle in handles
            continue
        foreign = peer
        if not graph.ignores_requests(peer, own.qos):
            receiver = peer
    return _Peers(understood, foreign, receiver)


class ServicePublisher(RawPublisher):
    """A publisher of requests or replies.

    Attributes:
        on_unreachable: Called with a message, on the maintenance thread of the participant, while all servers would
            misread the requests.
    """

    on_unreachable: Callable[[str], object] | None = None

    def __init__(
        self, native: BackendServiceWriter, node: GraphNode, endpoint: Endpoint, qos: QoS, graph: Graph
    ) -> None:
        self._service_writer = native
        self._graph = graph
        self._sends_requests = endpoint.kind == "request"
        self._known: tuple[int, frozenset[int], _Peers] | None = None
        self._delayed_replies = DelayedReplies(endpoint.name)
        super().__init__(native, node, endpoint, qos)

    @property
    def guids(self) -> Sequence[bytes]:
        """The identifiers of everything on the graph that this publisher consists of."""
        return self._service_writer.guids

    @property
    def client_id(self) -> int:
        """The client ID for the headers of requests."""
        return self._service_writer.client_id

    @property
    def matched(self) -> int:
        """The number of matched subscriptions that understand the messages, or 0 if no request can be sent."""
        peers = self._peers()
        return 0 if self._sends_requests and peers.refusing else peers.understood

    @property
    def refusal(self) -> str:
        """The warning about a server that would misread a request, so that none can be sent, or "" if there is none."""
        peer = self._peers().refusing
        return "" if peer is None else self._text(peer)

    def write(self, cdr: bytes) -> None:
        """Publish a request with its header.

        Raises:
            RejectedRequestError: A server on the graph would misread the request. The request is sent if that server
                does not receive it and another one understands it.
            WireError: As for `Publisher.write`.
        """
        if self._sends_requests and (reason := self.refusal):
            raise RejectedRequestError(reason)
        super().write(cdr)

    def reply(self, header: RequestHeader, cdr: bytes, writer: int) -> None:
        """Send the reply to a request as soon as its client is discovered, and return at once.

        The reply is sent after one second at the latest. Replies to other clients do not wait for that.

        Args:
            header: The header of the request.
            cdr: The reply: 4 bytes of encapsulation, then CDR.
            writer: The handle of the writer of the request, or 0 if it is not known.

        Raises:
            WireError: As for `Publisher.write`. A reply that cannot be sent later is reported with a warning.
        """
        message = request_header.join(header, cdr)
        self._delayed_replies.send(writer, partial(self._reaches, header, writer), partial(self.write, message))

    def leave(self, node: GraphNode) -> None:
        """Remove this endpoint from `node`, after the last replies were sent."""
        self._delayed_replies.finish()
        super().leave(node)

    def report_unreachable(self) -> None:
        """Call `on_unreachable` if all servers would misread the requests."""
        if self.on_unreachable is not None:
            peers = self._peers()
            if peers.foreign is not None and not peers.understood:
                self.on_unreachable(self._text(peers.foreign))

    def _peers(self) -> _Peers:
        handles = frozenset(self.matched_handles())
        known = self._known
        if known is not None and known[:2] == (self._graph.version, handles):
            return known[2]
        version = self._graph.refresh()
        peers = _peers(self, self._graph, handles, self._graph.readers(self.topic))
        self._known = version, handles, peers
        return peers

    def _text(self, peer: DiscoveredEndpoint) -> str:
        middleware = self._graph.foreign_services(peer)
        return foreign_services_text(self.topic, middleware, self._graph.owner(peer.guid), is_writer=True)

    def _reaches(self, header: RequestHeader, writer: int) -> bool:
        return self._read_unless_closed(lambda: self._service_writer.reaches(header, writer), True)


class ServiceSubscription(Subscription):
    """A subscription to requests or replies.

    Attributes:
        ignored: The number of messages that were ignored because they are not requests or replies of the service.
    """

    def __init__(
        self, native: BackendServiceReader, node: GraphNode, endpoint: Endpoint, qos: QoS, graph: Graph
    ) -> None:
        self._service_reader = native
        self._graph = graph
        self._what = "requests" if endpoint.kind == "request" else "replies"
        self.ignored = 0
        self._reported = 0
        self._last_ignored = (0, "")
        super().__init__(native, node, endpoint, qos)

    @property
    def matched(self) -> int:
        """The number of matched publishers whose messages can be understood."""
        handles = self.matched_handles()
        if not handles:
            return 0
        return _peers(self, self._graph, frozenset(handles), self._graph.writers(self.topic)).understood

    def take(self, limit: int = 100) -> list[Sample]:
        """Return up to `limit` queued messages that can be understood, oldest first, without waiting."""
        return [sample for sample in super().take(limit) if not self._graph.foreign_writer(sample.writer)]

    def take_messages(self, limit: int = 100) -> list[ServiceMessage]:
        """Return the messages without their headers. Messages without a header are ignored."""
        messages = []
        for sample in self.take(limit):
            parts = request_header.split(sample.data)
            if parts is None:
                self.ignore(sample.writer, f"has {len(sample.data)} bytes without a CDR header and a request header")
            else:
                messages.append(ServiceMessage(*parts, sample.writer))
        return messages

    def ignore(self, writer: int, reason: str) -> None:
        """Count an ignored message.

        Args:
            writer: The handle of its writer.
            reason: The problem, as a phrase: "has 3 bytes too many".
        """
        self.ignored += 1
        self._last_ignored = writer, reason

    def ignore_request(self, request: ServiceMessage, reason: str) -> None:
        """Count an ignored request that will not be answered. See `ignore`."""
        self.ignore(request.writer, reason)
        self._service_reader.reject(request.header)

    @property
    def has_warning(self) -> bool:
        """Whether messages were ignored since the last call of `take_warning`."""
        return self.ignored > self._reported

    def take_warning(self) -> str:
        """Return a warning about the messages that were ignored since the last call."""
        count = self.ignored - self._reported
        self._reported += count
        handle, reason = self._last_ignored
        writer = self._graph.writer(handle)
        node = None if writer is None else self._graph.owner(writer.guid)
        what = self._what if count > 1 else self._what.replace("ies", "y").removesuffix("s")
        return (
            f"Ignored {count} {what} of {names.any_ros_name(self.topic)}{f' from {node}' if node else ''}: "
            f"{'the last one' if count > 1 else 'it'} {reason}. Check that both sides have the same definition of the "
            "service and the same middleware."
        )
