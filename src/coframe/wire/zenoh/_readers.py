# SPDX-License-Identifier: Apache-2.0
"""Subscriptions over Zenoh, which queue messages, record them with arrival times, or store transforms."""

from __future__ import annotations

import threading
import time
from array import array
from collections import deque
from typing import TYPE_CHECKING, Any

from coframe import _core
from coframe.wire.zenoh._endpoint import ZenohEndpoint
from coframe.wire.zenoh._receiver import Received, Receiver, queue_length

if TYPE_CHECKING:
    from coframe.buffer.buffer import Buffer
    from coframe.wire._backend import QueueLimits
    from coframe.wire.qos import QoS
    from coframe.wire.zenoh._endpoint import Place


class _Subscription(ZenohEndpoint):
    """Base class of subscriptions. Subclasses consume the messages."""

    _receiver: Receiver | None = None

    def __init__(self, place: Place, on_change: _core.Event | None) -> None:
        super().__init__(place.graph, place.endpoint, place.type_hash, place.guid, on_change)

    def _undeclare(self) -> None:
        if self._receiver is not None:
            self._receiver.close()

    def end_burst(self) -> None:
        """Do nothing at the end of a burst of messages."""

    def add(self, message: Received) -> None:
        """Process a message."""
        raise NotImplementedError

    def _start(self, place: Place, qos: QoS) -> None:
        self._receiver = Receiver(place.session, place.key_list, qos, self, self._add_lost, place.endpoint.name)


class ZenohReader(_Subscription):
    """A subscription that queues messages. Implements `coframe.wire._backend.BackendReader`.

    Attributes:
        dropped: The number of messages dropped because the queue was full.
    """

    def __init__(self, place: Place, qos: QoS, on_data: _core.Event | None) -> None:
        super().__init__(place, on_data)
        self._queue: deque[Received] = deque(maxlen=queue_length(qos))
        self._on_data = on_data
        self.dropped = 0
        self._start(place, qos)

    def add(self, message: Received) -> None:
        """Queue a message; drop the oldest one if the queue is full."""
        self.dropped += len(self._queue) == self._queue.maxlen
        self._queue.append(message)

    def end_burst(self) -> None:
        """Wake the thread that takes messages."""
        if self._on_data is not None:
            self._on_data.set()

    def take(self, limit: int) -> list[tuple[bytes, int, int]]:
        """Return up to `limit` messages, oldest first."""
        taken: list[tuple[bytes, int, int]] = []
        try:
            while len(taken) < limit:
                taken.append(self._queue.popleft())
        except IndexError:
            pass
        return taken

    def take_decoded(self, limit: int, codec: _core.MessageCodec) -> list[tuple[Any, int, int]]:
        """Return what `take` returns: the bytes of Zenoh's messages belong to Python."""
        del codec
        return self.take(limit)

    @property
    def pending(self) -> bool:
        """Whether messages are queued."""
        return bool(self._queue)


class ZenohTap(_Subscription):
    """A subscription that records messages. Implements `coframe.wire._backend.BackendTap`.

    Attributes:
        missed: The number of messages dropped because a limit was reached.
    """

    def __init__(self, place: Place, qos: QoS, limits: QueueLimits) -> None:
        super().__init__(place, None)
        self._limits = limits
        self._messages_lock = threading.Lock()
        self._messages = _Messages()
        self.missed = 0
        self._start(place, qos)

    def add(self, message: Received) -> None:
        """Record a message."""
        arrived = time.time_ns()
        with self._messages_lock:
            messages = self._messages
            if len(messages.ends) >= self._limits.messages or len(messages.data) >= self._limits.size:
                self.missed += 1
                return
            messages.data += message.data[: self._limits.head]
            messages.ends.append(len(messages.data))
            messages.arrived.append(arrived)
            messages.sent.append(message.sent)
            messages.writers.append(message.writer)

    def take(self) -> tuple[bytes, bytes, bytes, bytes, bytes]:
        """Return the messages since the last call. See `_core.Tap.take`."""
        with self._messages_lock:
            taken, self._messages = self._messages, _Messages()
        return (
            bytes(taken.data),
            taken.ends.tobytes(),
            taken.arrived.tobytes(),
            taken.sent.tobytes(),
            taken.writers.tobytes(),
        )


class _Messages:
    """Recorded messages, as in `coframe.wire.batch_subscription.MessageBatch`."""

    def __init__(self) -> None:
        self.data = bytearray()
        self.ends = array("Q")
        self.arrived = array("q")
        self.sent = array("q")
        self.writers = array("Q")


class ZenohTfReader(_Subscription):
    """A subscription that stores transforms in a buffer. Implements `coframe.wire._backend.BackendTfReader`.

    Messages are decoded and stored by native code without the GIL.
    """

    def __init__(
        self,
        place: Place,
        qos: QoS,
        buffer: Buffer,
        *,
        static: bool,
        authority: str,
        renaming: _core.Renaming | None,
        on_data: _core.Event | None,
    ) -> None:
        super().__init__(place, on_data)
        store = _core.TransformStore(buffer, static, authority, renaming, on_data)
        self._store = store
        self.arm = store.arm
        self.writers = store.writers
        self.name_writer = store.name_writer
        self.forget_writer = store.forget_writer
        self.writer_left = store.writer_left
        self.settle_statics = store.settle_statics
        self._start(place, qos)

    def add(self, message: Received) -> None:
        """Store the transforms of a message."""
        self._store.add(message.writer, message.data)

    @property
    def stored_at(self) -> int:
        """When the transforms of the newest message were stored, in nanoseconds of the steady clock, or 0 if never."""
        return self._store.stored_at

    @property
    def received(self) -> int:
        """The number of received messages."""
        return self._store.received
