# SPDX-License-Identifier: Apache-2.0
"""Services over Zenoh: requests are queries, and replies are query replies.

In `coframe.wire`, a client is a publisher of requests and a subscription to replies, and a service is a subscription to
requests and a publisher of replies. Requests and replies have a header with a client ID and a sequence number, as in
rmw_cyclonedds (`coframe.wire.request_header`). The classes here convert it to the attachments of rmw_zenoh_cpp.
"""

from __future__ import annotations

import logging
import threading
from collections import Counter, deque
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from coframe import _core
from coframe.messages.encapsulation import byte_order
from coframe.wire import request_header
from coframe.wire.counted_warning import CountedWarning
from coframe.wire.request_header import RequestHeader
from coframe.wire.zenoh import _keys, _library, config
from coframe.wire.zenoh._endpoint import ZenohEndpoint
from coframe.wire.zenoh._receiver import KEEP_ALL, queue_length, ring_length
from coframe.wire.zenoh._writer import TOO_SHORT_ERROR, BytesWriter

if TYPE_CHECKING:
    from coframe.wire.qos import QoS
    from coframe.wire.zenoh._endpoint import Place

# The result of an action is requested when the action starts, and may take any time.
_UNLIMITED: Final = "/_action/get_result"
_FOREVER: Final = 10 * 365 * 86_400.0  # seconds; Zenoh has no value for "no limit"

# Requests that wait for the thread of their service. Invalid ones, which it ignores, must not displace others.
_MIN_RING: Final = 256

_logger = logging.getLogger("coframe.wire")


class _Request(NamedTuple):
    """A received request that is not answered yet."""

    query: Any
    sequence: int
    gid: bytes


class ServiceTable:
    """Connects the two halves of the services and clients of a session. All methods are thread-safe."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._replies: dict[str, list[ReplyReader]] = {}  # by the key of the service
        self._requests: dict[str, dict[RequestHeader, _Request]] = {}  # by the same key; oldest first

    def add_reader(self, reader: ReplyReader) -> None:
        """Add a reader, which receives the replies of its service."""
        with self._lock:
            self._replies.setdefault(reader.key, []).append(reader)

    def remove_reader(self, reader: ReplyReader) -> None:
        """Stop passing replies to a reader."""
        with self._lock:
            readers = self._replies.get(reader.key, [])
            if reader in readers:
                readers.remove(reader)
            if not readers:
                self._replies.pop(reader.key, None)

    def deliver(self, key: str, message: bytes, sent: int, writer: int) -> None:
        """Pass a reply with its header to the readers of a service. Each client recognizes its own."""
        with self._lock:
            readers = list(self._replies.get(key, ()))
        for reader in readers:
            reader.push(message, sent, writer)

    def store_request(self, key: str, header: RequestHeader, request: _Request) -> _Request | None:
        """Store a request until it is answered.

        Return the request that will not be answered: this one if it is already pending, the oldest one of the service
        if too many are pending, else None.
        """
        with self._lock:
            pending = self._requests.setdefault(key, {})
            if header in pending:
                return request
            pending[header] = request
            return pending.pop(next(iter(pending))) if len(pending) > KEEP_ALL else None

    def take_request(self, key: str, header: RequestHeader) -> _Request | None:
        """Return a request and forget it, or None if it is not pending."""
        with self._lock:
            return self._requests.get(key, {}).pop(header, None)

    def forget_service(self, key: str) -> None:
        """Drop the requests of a closed service."""
        with self._lock:
            left = self._requests.pop(key, {})
        for request in left.values():
            request.query.drop()


class _Queue(ZenohEndpoint):
    """A queue of requests or replies with their headers. Implements `coframe.wire._backend.BackendServiceReader`."""

    def __init__(self, place: Place, qos: QoS, on_data: _core.Event | None) -> None:
        super().__init__(place.graph, place.endpoint, place.type_hash, place.guid, on_data)
        self.key = place.key_list[0]
        self._queue: deque[tuple[bytes, int, int]] = deque()
        self._lengths: Counter[int] = Counter()  # the number of queued messages of each writer
        self._queue_lock = threading.Lock()
        self._max_length = queue_length(qos)
        self._on_data = on_data

    def push(self, message: bytes, sent: int, writer: int) -> bytes | None:
        """Queue a message. If the queue is full, remove one and return it.

        It is the oldest message of the writer with the most messages, so that one writer cannot displace the others.
        """
        with self._queue_lock:
            removed = self._pop(self._longest_writer()) if len(self._queue) >= self._max_length else None
            self._queue.append((message, sent, writer))
            self._lengths[writer] += 1
        if self._on_data is not None:
            self._on_data.set()
        return removed

    def take(self, limit: int) -> list[tuple[bytes, int, int]]:
        """Return up to `limit` messages, oldest first."""
        with self._queue_lock:
            taken = [self._queue.popleft() for _ in range(min(limit, len(self._queue)))]
            self._lengths -= Counter(writer for _, _, writer in taken)  # removes writers without messages
            return taken

    def take_decoded(self, limit: int, codec: _core.MessageCodec) -> list[tuple[Any, int, int]]:
        """Return what `take` returns: requests and replies are decoded by the caller."""
        del codec
        return self.take(limit)

    def reject(self, header: RequestHeader) -> None:
        """Do nothing: only requests are stored until they are answered."""

    def _longest_writer(self) -> int:
        return max(self._lengths, key=self._lengths.__getitem__)

    def _pop(self, writer: int) -> bytes:
        """Remove the oldest message of a writer, and return it."""
        index = next(index for index, queued in enumerate(self._queue) if queued[2] == writer)
        message = self._queue[index][0]
        del self._queue[index]
        self._lengths -= Counter([writer])
        return message

    @property
    def pending(self) -> bool:
        """Whether messages are queued."""
        return bool(self._queue)


class ReplyReader(_Queue):
    """The subscription to replies of a client."""

    def __init__(self, place: Place, qos: QoS, on_data: _core.Event | None, table: ServiceTable) -> None:
        super().__init__(place, qos, on_data)
        self._table = table
        table.add_reader(self)

    def _undeclare(self) -> None:
        self._table.remove_reader(self)


class RequestReader(_Queue):
    """The subscription to requests of a service: a queryable.

    Attributes:
        dropped: The number of requests dropped because too many were waiting.
    """

    def __init__(self, place: Place, qos: QoS, on_data: _core.Event | None, table: ServiceTable) -> None:
        super().__init__(place, qos, on_data)
        module = _library.load()
        self._closed_error = module.ZError
        self._table = table
        self._warn_of_invalid = CountedWarning(_logger.warning)
        self.dropped = 0
        ring = module.handlers.RingChannel(max(ring_length(qos), _MIN_RING))
        self._queryable: Any = place.session.declare_queryable(self.key, ring, complete=True)
        self._thread = threading.Thread(target=self._run, name=f"coframe{place.endpoint.name}", daemon=True)
        self._thread.start()

    def _undeclare(self) -> None:
        self._queryable.undeclare()
        if self._thread is not threading.current_thread():
            self._thread.join()
        self._table.forget_service(self.key)

    def _run(self) -> None:
        handler: Any = self._queryable.handler
        try:
            while True:
                self._receive(handler.recv())
        except self._closed_error:
            pass

    def _receive(self, query: Any) -> None:
        header = None if query.attachment is None else _keys.decode_attachment(query.attachment.to_bytes())
        data = b"" if query.payload is None else query.payload.to_bytes()
        if header is None or byte_order(data) is None:
            query.drop()
            self._warn_of_invalid(
                f"A request of {self.endpoint.name} is ignored, because it was not sent by rmw_zenoh_cpp. Check for a "
                "program that sends requests without ROS 2."
            )
            return
        writer = _keys.handle_of(header.gid)
        identity = RequestHeader(writer, header.sequence)
        request = _Request(query, header.sequence, header.gid)
        unanswered = self._table.store_request(self.key, identity, request)
        if unanswered is not request:
            self._drop(unanswered)
            self._drop(self._removed_by(request_header.join(identity, data), header.sent, writer))
        else:
            query.drop()

    def reject(self, header: RequestHeader) -> None:
        """Drop a request that will not be answered, so that its client stops waiting."""
        request = self._table.take_request(self.key, header)
        if request is not None:
            request.query.drop()

    def _removed_by(self, message: bytes, sent: int, writer: int) -> _Request | None:
        """Queue a request, and return the one that is displaced, if any."""
        removed = self.push(message, sent, writer)
        parts = None if removed is None else request_header.split(removed)
        return None if parts is None else self._table.take_request(self.key, parts[0])

    def _drop(self, request: _Request | None) -> None:
        """Drop a request without answering it."""
        if request is None:
            return
        request.query.drop()
        self.dropped += 1
        if self.dropped == 1:
            _logger.warning(
                "Requests of %s are dropped: %d wait for the node, or %d for a response.",
                self.endpoint.name,
                self._max_length,
                KEEP_ALL,
            )


class _Sender(BytesWriter):
    """A publisher of requests or replies. Implements `coframe.wire._backend.BackendServiceWriter`."""

    def __init__(self, place: Place, table: ServiceTable) -> None:
        super().__init__(place.graph, place.endpoint, place.type_hash, place.guid, None)
        self.guids = (place.guid,)
        self.client_id = _keys.handle_of(place.guid)
        self.key = place.key_list[0]
        self._table = table
        self._error = _library.load().ZError

    def write(self, message: bytes) -> None:
        """Send a message with its header."""
        self.forward(message)

    def forward(self, message: bytes) -> None:
        """Send a message with its header."""
        parts = request_header.split(message)
        if parts is None:
            raise ValueError(TOO_SHORT_ERROR)
        self._check_open()
        try:
            self._send(*parts)
        except self._error as error:
            raise _core.EndpointError(f"could not write: {config.reason_of(error)}") from error

    def reaches(self, header: RequestHeader, writer: int) -> bool:
        """Return True: a reply needs no discovery."""
        del header, writer
        return True

    def assert_liveliness(self) -> None:
        """Do nothing: an endpoint is alive as long as its session."""

    def wait_for_acks(self, timeout_ns: int) -> bool:
        """Return True, because Zenoh has no message acknowledgements to wait for."""
        del timeout_ns
        return True

    def _send(self, header: RequestHeader, cdr: bytes) -> None:
        raise NotImplementedError


class RequestWriter(_Sender):
    """The publisher of requests of a client.

    Attributes:
        ignored: The number of replies that were ignored because they are not replies to the requests.
    """

    def __init__(self, place: Place, table: ServiceTable) -> None:
        super().__init__(place, table)
        module = _library.load()
        self.ignored = 0
        self._callback = module.handlers.Callback
        options: dict[str, Any] = {"timeout": _FOREVER} if _UNLIMITED in f"/{self.key}/" else {}
        self._querier: Any = place.session.declare_querier(
            self.key,
            target=module.QueryTarget.ALL_COMPLETE,
            consolidation=module.ConsolidationMode.NONE,
            **options,
        )

    def _undeclare(self) -> None:
        self._querier.undeclare()

    def _send(self, header: RequestHeader, cdr: bytes) -> None:
        answered = header.sequence, self.guid

        def receive(reply: Any) -> None:
            # This runs on Zenoh's network thread and only queues the reply, so no thread per request is needed.
            if reply.ok is None:
                return
            data, attachment = reply.ok.payload.to_bytes(), reply.ok.attachment
            attached = None if attachment is None else _keys.decode_attachment(attachment.to_bytes())
            if attached is None or (attached.sequence, attached.gid) != answered or byte_order(data) is None:
                self._ignore()
                return
            handle = _keys.handle_of(attached.gid)
            self._table.deliver(self.key, request_header.join(header, data), attached.sent, handle)

        self._querier.get(
            handler=self._callback(receive, indirect=False),
            payload=cdr,
            attachment=_keys.attachment(header.sequence, self.guid),
        )

    def _ignore(self) -> None:
        self.ignored += 1
        if self.ignored == 1:
            _logger.warning(
                "A reply of %s is ignored, because it is not a reply of rmw_zenoh_cpp to this client. More are only "
                "counted.",
                self.endpoint.name,
            )


class ReplyWriter(_Sender):
    """The publisher of replies of a service."""

    def _send(self, header: RequestHeader, cdr: bytes) -> None:
        request = self._table.take_request(self.key, header)
        if request is not None:
            request.query.reply(self.key, cdr, attachment=_keys.attachment(request.sequence, request.gid))
            request.query.drop()
