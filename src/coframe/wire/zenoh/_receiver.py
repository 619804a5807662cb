# SPDX-License-Identifier: Apache-2.0
"""The thread of a subscription, which takes messages from Zenoh as they arrive."""

from __future__ import annotations

import logging
import threading
from collections import OrderedDict
from typing import TYPE_CHECKING, Any, Final, NamedTuple, Protocol

from coframe.wire.counted_warning import CountedWarning
from coframe.wire.zenoh import _keys, _library

if TYPE_CHECKING:
    from collections.abc import Callable

    import zenoh
    from coframe.wire.qos import QoS

KEEP_ALL: Final = 10_000  # queue length for KEEP_ALL; memory must be bounded
# Zenoh's network thread must not wait for Python, which may be busy for a few milliseconds. The oldest messages are
# dropped when the thread of the subscription does not keep up.
_MIN_RING: Final = 10
_MAX_PUBLISHERS: Final = 1024  # limit of the publishers whose last sequence numbers are stored
_BURST: Final = 64  # messages after which `end_burst` is called
_REPEATS: Final = 1000  # messages that are compared to detect duplicates at two keys

_logger = logging.getLogger("coframe.wire")


class Received(NamedTuple):
    """A received message."""

    data: bytes
    sent: int
    writer: int


class Consumer(Protocol):
    """Processes the messages of a receiver, on its threads, one at a time."""

    def add(self, message: Received) -> None:
        """Process one message."""

    def end_burst(self) -> None:
        """Finish a burst of messages that arrived together."""


class Receiver:
    """Passes the messages at given keys to a consumer.

    Args:
        session: The Zenoh session from which the messages are received.
        key_list: The keys. A message that arrives at several of them is passed on once.
        qos: The requested quality of service.
        consumer: Processes the messages.
        on_lost: Called with the number of messages that were lost.
        name: The name of the topic, for threads and warnings.
    """

    def __init__(
        self,
        session: zenoh.Session,
        key_list: list[str],
        qos: QoS,
        consumer: Consumer,
        on_lost: Callable[[int], None],
        name: str,
    ) -> None:
        module = _library.load()
        self._closed_error = module.ZError
        self._delete = module.SampleKind.DELETE
        self._consumer = consumer
        self._on_lost = on_lost
        self._name = name
        self._lock = threading.Lock()
        self._numbers: OrderedDict[bytes, int] = OrderedDict()  # the last message of each publisher
        self._recent_messages: OrderedDict[tuple[bytes, int], None] | None = (
            OrderedDict() if len(key_list) > 1 else None
        )
        self._has_warned = False
        self._warn_of_failure = CountedWarning(_logger.error)
        self._subscribers = [_declare(session, key, qos) for key in key_list]
        self._threads = [
            threading.Thread(target=self._run, args=(subscriber.handler,), name=f"coframe{name}", daemon=True)
            for subscriber in self._subscribers
        ]
        for thread in self._threads:
            thread.start()

    def close(self) -> None:
        """Stop. The consumer is not called afterwards, unless it is the caller."""
        for subscriber in self._subscribers:
            subscriber.undeclare()
        for thread in self._threads:
            if thread is not threading.current_thread():
                thread.join()

    def _run(self, handler: Any) -> None:
        try:
            while True:
                sample = handler.recv()
                with self._lock:
                    self._process(sample)
                    for _ in range(_BURST - 1):
                        if (sample := handler.try_recv()) is None:
                            break
                        self._process(sample)
                    self._consumer.end_burst()
        except self._closed_error:
            pass

    def _process(self, sample: Any) -> None:
        try:
            attached = sample.attachment
            header = None if attached is None else _keys.decode_attachment(attached.to_bytes())
            if header is None or sample.kind == self._delete:
                self._warn_of_foreign_sample(sample)
            elif self._is_new(header):
                self._consumer.add(Received(sample.payload.to_bytes(), header.sent, _keys.handle_of(header.gid)))
        except Exception as error:
            # The thread must survive an error in one message, because nothing would restart it.
            _logger.debug("A message on %s could not be processed.", self._name, exc_info=True)
            reason = f"{type(error).__name__}: {error}"
            self._warn_of_failure(f"A message on {self._name} could not be processed: {reason}.")

    def _is_new(self, header: _keys.Attachment) -> bool:
        """Record a message's sequence number. Return False if the message already arrived at another key."""
        if self._recent_messages is not None:
            key = header.gid, header.sequence
            if key in self._recent_messages:
                return False
            self._recent_messages[key] = None
            if len(self._recent_messages) > _REPEATS:
                self._recent_messages.popitem(last=False)
        last = self._numbers.get(header.gid)
        if last is None and len(self._numbers) >= _MAX_PUBLISHERS:
            self._numbers.popitem(last=False)
        if last is not None and header.sequence > last + 1:
            self._on_lost(header.sequence - last - 1)
        self._numbers[header.gid] = max(header.sequence, last or 0)
        return True

    def _warn_of_foreign_sample(self, sample: Any) -> None:
        if not self._has_warned:
            self._has_warned = True
            _logger.warning(
                "Messages on %s at the key %s are dropped: they do not have the attachment that rmw_zenoh_cpp sends. "
                "Check for a program that publishes at this key without ROS 2.",
                self._name,
                sample.key_expr,
            )


def queue_length(qos: QoS) -> int:
    """Return the maximum number of queued messages of a subscription."""
    return KEEP_ALL if qos.keep_all else qos.depth


def ring_length(qos: QoS) -> int:
    """Return how many messages may wait for the thread of a subscription. Zenoh allocates this memory immediately."""
    return min(max(queue_length(qos), _MIN_RING), KEEP_ALL)


def _declare(session: zenoh.Session, key: str, qos: QoS) -> Any:
    module = _library.load()
    ring = module.handlers.RingChannel(ring_length(qos))
    if not qos.transient_local:
        return session.declare_subscriber(key, ring)
    ext = module.ext
    return ext.declare_advanced_subscriber(
        session,
        key,
        ring,
        history=ext.HistoryConfig(detect_late_publishers=True, max_samples=qos.depth),
        recovery=ext.RecoveryConfig(periodic_queries=None, heartbeat=True) if qos.reliable else None,
        subscriber_detection=True,
    )
