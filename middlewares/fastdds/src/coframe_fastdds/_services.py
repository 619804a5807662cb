# SPDX-License-Identifier: Apache-2.0
"""Requests and replies in both forms of ROS 2, so that services work with nodes on every implementation of DDS.

rmw_cyclonedds sends a header of 16 bytes before the payload: the header form. rmw_fastrtps and others send the identity
of a request beside the payload, as inline QoS: the plain form. To the layers above, both look like the header form.

A writer sends one form only, because a reader misreads the other. Each endpoint for requests or replies therefore has
two writers:

- The plain writer offers a latency budget, which Cyclone DDS refuses (its readers request 0) and Fast DDS ignores.
- The header writer is created when an endpoint of Cyclone DDS is discovered. Fast DDS matches it as well. A client on
  Fast DDS ignores its replies, which have no identity. A server on Fast DDS would misread its requests, so none are
  sent while there is such a server: of two servers with one name, that on Fast DDS is called.

All these endpoints except the plain writer are in the partition `HEADER_PARTITION` as well, which shows other processes
that use coframe that they understand the header form.
"""

from __future__ import annotations

import hashlib
import threading
import time
import weakref
from collections import OrderedDict
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from coframe.time import MILLISECOND
from coframe.wire import names, request_header, vendors
from coframe.wire.request_header import RequestHeader
from coframe_fastdds import _fastdds as native

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe import _core
    from coframe.wire.graph import DiscoveredEndpoint
    from coframe.wire.names import Endpoint
    from coframe_fastdds._graph import FastDdsGraph

MAX_CLIENTS: Final = 10_000  # of a service, which can be answered
MAX_PENDING: Final = 10_000  # requests of a client that can be answered

PLAIN_LATENCY_BUDGET: Final = 1000 * MILLISECOND
_UNKNOWN: Final = bytes(16)
_READER_KIND: Final = 0x04  # a bit of the last byte of a reader's GUID
_PREFIX_SIZE: Final = 12  # bytes of a GUID that identify the participant
_DISCOVERY: Final = 1.0  # seconds in which the writer of replies of a server, or a writer of requests, is discovered
_DISCOVERY_NS: Final = 1000 * MILLISECOND
_POLL: Final = 0.001  # seconds
_NO_SEQUENCE_NUMBER: Final = 0


class _Client(NamedTuple):
    """A client that has sent a request.

    Attributes:
        guid: The identity in its requests; of a client that uses the header form, the GUID of its writer.
        uses_header: Whether it uses the header form.
    """

    guid: bytes
    uses_header: bool


class Clients:
    """The clients of a service, by the number that stands for each in headers."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._known: OrderedDict[int, _Client] = OrderedDict()

    def add(self, number: int, client: _Client) -> int:
        """Store a client, and return its number: the given one, or the next if another client has it."""
        with self._lock:
            while self._known.get(number, client) != client:
                number = (number + 1) % 2**64
            self._known[number] = client
            self._known.move_to_end(number)
            if len(self._known) > MAX_CLIENTS:
                self._known.popitem(last=False)
            return number

    def find(self, number: int) -> _Client | None:
        """Return a client, or None if it is unknown."""
        with self._lock:
            return self._known.get(number)


class PendingRequests:
    """The requests that clients of this process have sent in the plain form, by their identities.

    A reply may arrive before `write` has returned the number of its request, so that both use the same lock.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._headers: OrderedDict[tuple[bytes, int], RequestHeader] = OrderedDict()
        self._readers: weakref.WeakValueDictionary[object, ReplyReader] = weakref.WeakValueDictionary()

    def offer_reader(self, node: object, reader: ReplyReader) -> None:
        """Store the reader for the replies to the next client of a node."""
        self._readers[node] = reader

    def take_reader(self, node: object) -> ReplyReader | None:
        """Return that reader, once."""
        return self._readers.pop(node, None)

    def send(self, header: RequestHeader, guid: bytes, write: Callable[[], int]) -> None:
        """Send a request with `write`, which returns its number."""
        with self._lock:
            self._headers[guid, write()] = header
            if len(self._headers) > MAX_PENDING:
                self._headers.popitem(last=False)

    def find(self, guid: bytes, sequence: int) -> RequestHeader | None:
        """Return the header of the request that a reply answers, or None if this process has not sent it."""
        with self._lock:
            return self._headers.get((guid, sequence))


class Services:
    """What the endpoints of each service in this process share."""

    def __init__(self) -> None:
        self._clients: weakref.WeakValueDictionary[str, Clients] = weakref.WeakValueDictionary()
        self._pending: weakref.WeakValueDictionary[str, PendingRequests] = weakref.WeakValueDictionary()
        self.writers: weakref.WeakSet[_RequestForms] = weakref.WeakSet()

    def clients(self, service: str) -> Clients:
        """Return the clients of a service."""
        return self._clients.setdefault(service, Clients())

    def pending(self, service: str) -> PendingRequests:
        """Return the requests to a service."""
        return self._pending.setdefault(service, PendingRequests())

    def adapt(self) -> bool:
        """Create header writers where endpoints of Cyclone DDS have been discovered.

        Return whether there are new ones since the last call, which must be announced.
        """
        writers = list(self.writers)
        for writer in writers:
            writer.adapt()
        new = [writer for writer in writers if writer.is_new]
        for writer in new:
            writer.is_new = False
        return bool(new)


class _ServiceReader(native.Reader):
    """A reader of requests or replies. Implements `coframe.wire._backend.BackendServiceReader`."""

    def take(self, limit: int) -> list[tuple[bytes, int, int]]:
        """Return up to `limit` messages in the header form: bytes, time of publication, the writer's handle."""
        messages = []
        for data, sent, handle, guid, sequence, related, related_sequence in self.take_identified(limit):
            if (message := self._read(data, guid, sequence, related, related_sequence)) is not None:
                messages.append((message, sent, handle))
        return messages

    def take_decoded(self, limit: int, codec: _core.MessageCodec) -> list[tuple[Any, int, int]]:
        """Return what `take` returns: requests and replies are decoded by the caller."""
        del codec
        return self.take(limit)

    def reject(self, header: RequestHeader) -> None:
        """Do nothing: requests are not stored until they are answered."""

    def _read(self, data: bytes, guid: bytes, sequence: int, related: bytes, related_sequence: int) -> bytes | None:
        raise NotImplementedError


class RequestReader(_ServiceReader):
    """The reader of requests of a server."""

    def __init__(self, clients: Clients, *arguments: Any) -> None:
        self._clients = clients
        super().__init__(*arguments)

    def _read(self, data: bytes, guid: bytes, sequence: int, related: bytes, related_sequence: int) -> bytes:
        """Return a request with the number of its client in the header."""
        del related_sequence
        if not vendors.uses_request_header(guid):
            identity = guid if related == _UNKNOWN else related
            number = self._clients.add(_number_of(identity), _Client(identity, uses_header=False))
            return request_header.join(RequestHeader(number, sequence), data)
        if (parts := request_header.split(data)) is None:
            return data  # the caller reports it
        header, cdr = parts
        number = self._clients.add(header.client, _Client(guid, uses_header=True))
        return data if number == header.client else request_header.join(RequestHeader(number, header.sequence), cdr)


class ReplyReader(_ServiceReader):
    """The reader of replies of a client."""

    def __init__(self, pending: PendingRequests, *arguments: Any) -> None:
        self._pending = pending
        super().__init__(*arguments)

    def _read(self, data: bytes, guid: bytes, sequence: int, related: bytes, related_sequence: int) -> bytes | None:
        """Return a reply with the header of its request, or None if it answers no request of this process."""
        del sequence
        if vendors.uses_request_header(guid):
            return data
        header = self._pending.find(related, related_sequence)
        return None if header is None else request_header.join(header, data)


class _RequestForms:
    """A publisher of requests or replies in both forms. Implements `coframe.wire._backend.BackendServiceWriter`.

    Args:
        endpoint: The topic of the requests or replies.
        graph: The graph, which contains the endpoints on the other side.
        make_writer: Creates the plain writer (False) or the header writer (True).

    Attributes:
        client_id: The client ID for the headers of requests.
        is_new: Whether the header writer has been created and not been announced.
    """

    client_id: int

    def __init__(self, endpoint: Endpoint, graph: FastDdsGraph, make_writer: Callable[[bool], native.Writer]) -> None:
        self._topic = endpoint.dds_topic
        self._graph = graph
        self._make_writer = make_writer
        self._plain = make_writer(False)
        self._header: native.Writer | None = None
        self._lock = threading.Lock()
        self._closed = False
        self.is_new = False
        self.guid = self._plain.guid
        self.adapt()

    @property
    def guids(self) -> list[bytes]:
        """The GUIDs of both writers."""
        return [writer.guid for writer in self._writers()]

    def adapt(self) -> None:
        """Create the header writer if there is an endpoint of Cyclone DDS on the other side."""
        if self._header is None and any(vendors.uses_request_header(peer.guid) for peer in self._peers().values()):
            self._header_writer()

    @property
    def matched(self) -> int:
        """The number of endpoints on the other side."""
        return len(self.matched_handles())

    def matched_handles(self) -> list[int]:
        """Return the handles of the endpoints on the other side that receive their form."""
        peers = self._peers()
        header = self._header
        plain_handles, header_handles = (
            set(self._plain.matched_handles()),
            set() if header is None else set(header.matched_handles()),
        )
        return [
            handle
            for handle, peer in peers.items()
            if handle in (header_handles if vendors.uses_request_header(peer.guid) else plain_handles)
        ]

    @property
    def refused_policy(self) -> int:
        """The DDS number of the QoS policy that made the last match fail, or 0 if no match failed."""
        return self._plain.refused_policy

    def take_status(self, kind: int) -> tuple[int, int, int, int] | None:
        """Return the counts of a status if it has changed since the last call."""
        return self._plain.take_status(kind)

    def write(self, message: bytes) -> None:
        """Send a message with its header."""
        self.forward(message)

    def forward(self, message: bytes) -> None:
        """Send a message with its header."""
        parts = request_header.split(message)
        if parts is None:
            raise ValueError("The message is too short: it has no request header.")
        self._send(*parts, message)

    def publish(self, codec: _core.MessageCodec, message: object) -> bool:
        """Return False: the message must be serialized first."""
        del codec, message
        return False

    def direct(self, *_: object) -> None:
        """Return None: there is no native function that publishes."""

    def assert_liveliness(self) -> None:
        """Assert that this publisher is alive."""
        for writer in self._writers():
            writer.assert_liveliness()

    def wait_for_acks(self, timeout_ns: int) -> bool:
        """Return True: the readers that refuse the plain writer never acknowledge its messages."""
        del timeout_ns
        return True

    def close(self) -> None:
        """Close the writers. A second call has no effect."""
        with self._lock:
            self._closed = True
            for writer in self._writers():
                writer.close()

    def reaches(self, header: RequestHeader, writer: int) -> bool:
        """Return whether a reply that is sent now reaches the client of a request."""
        raise NotImplementedError

    def _send(self, header: RequestHeader, cdr: bytes, message: bytes) -> None:
        raise NotImplementedError

    def _header_writer(self) -> native.Writer:
        with self._lock:
            if self._header is None:
                self._header = self._make_writer(True)
                self.is_new = True
                if self._closed:
                    self._header.close()
            return self._header

    def _writers(self) -> list[native.Writer]:
        return [self._plain] if self._header is None else [self._plain, self._header]

    def _peers(self) -> dict[int, DiscoveredEndpoint]:
        return self._graph.readers(self._topic)


class RequestWriter(_RequestForms):
    """The publisher of requests of a client."""

    def __init__(
        self,
        endpoint: Endpoint,
        graph: FastDdsGraph,
        make_writer: Callable[[bool], native.Writer],
        pending: PendingRequests,
        reader: ReplyReader | None,
    ) -> None:
        super().__init__(endpoint, graph, make_writer)
        self._pending = pending
        self._reader = reader
        self._replies = names.dds_topic(endpoint.name, "reply")
        self._identity = self.guid if reader is None else reader.guid
        self.client_id = _number_of(self._identity)
        self._knowing: set[bytes] = set()  # the readers of servers that know the header writer
        self._ready: set[bytes] = set()  # the participants of servers whose replies arrive

    def _send(self, header: RequestHeader, cdr: bytes, message: bytes) -> None:
        peers = self._peers()
        servers = [peers[handle].guid for handle in self.matched_handles() if handle in peers]
        plain = {guid[:_PREFIX_SIZE] for guid in servers if not vendors.uses_request_header(guid)}
        if servers and not plain:
            writer = self._header_writer()
            self._wait_until_known(writer, set(servers))
            writer.forward(message)
            return
        self._wait_for_replies(plain)
        self._pending.send(
            header, self._identity, lambda: self._plain.write_related(cdr, self._identity, _NO_SEQUENCE_NUMBER)
        )

    def reaches(self, header: RequestHeader, writer: int) -> bool:
        """Return True: requests are not replies."""
        del header, writer
        return True

    def _wait_until_known(self, writer: native.Writer, servers: set[bytes]) -> None:
        """Wait until the readers of servers on Cyclone DDS know the writer.

        A reader is matched here as soon as it is discovered, often before it has discovered the writer. Cyclone DDS
        drops messages of unknown writers, and acknowledges them later without requesting them: it takes them for
        the history, which the reader does not want. Therefore a message without a payload is sent first: a reader that
        acknowledges it knows the writer. A server that does not acknowledge it in time is not waited for again.
        """
        if not servers <= self._knowing:
            writer.write_nothing()
            writer.wait_for_acks(_DISCOVERY_NS)
            self._knowing = servers

    def _wait_for_replies(self, servers: set[bytes]) -> None:
        """Wait until one of these participants can reply: another server may have been found before.

        A server that does not reply in time is not waited for again.
        """
        deadline = time.monotonic() + _DISCOVERY
        while self._reader is not None and servers and self._ready.isdisjoint(servers):
            writers, matched = self._graph.writers(self._replies), self._reader.matched_handles()
            found = [writers[handle] for handle in matched if handle in writers]
            plain = (writer for writer in found if not vendors.shares_services(writer.guid, writer.partitions))
            self._ready = {writer.guid[:_PREFIX_SIZE] for writer in plain}
            if time.monotonic() > deadline:
                self._ready |= servers
                return
            time.sleep(_POLL)


class ReplyWriter(_RequestForms):
    """The publisher of replies of a server."""

    def __init__(
        self,
        endpoint: Endpoint,
        graph: FastDdsGraph,
        make_writer: Callable[[bool], native.Writer],
        clients: Clients,
    ) -> None:
        super().__init__(endpoint, graph, make_writer)
        self.client_id = 0  # no client
        self._clients = clients

    def reaches(self, header: RequestHeader, writer: int) -> bool:
        """Return whether the subscription to replies of a client is matched."""
        client = self._clients.find(header.client)
        if client is None:
            return True  # the reply is not sent
        if client.uses_header:
            return self._graph.has_matched_client(self._header_writer().matched_handles(), writer)
        matched = self._plain.matched_handles()
        if client.guid[-1] & _READER_KIND:
            return native.handle_of(client.guid) in matched
        return self._graph.has_matched_client(matched, writer)

    def _send(self, header: RequestHeader, cdr: bytes, message: bytes) -> None:
        client = self._clients.find(header.client)
        if client is None:
            return
        if client.uses_header:
            self._header_writer().forward(message)
        else:
            self._plain.write_related(cdr, client.guid, header.sequence)


def _number_of(guid: bytes) -> int:
    return int.from_bytes(hashlib.blake2b(guid, digest_size=8).digest(), "little")
