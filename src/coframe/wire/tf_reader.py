# SPDX-License-Identifier: Apache-2.0
"""A subscription that stores the transforms of a topic in a buffer."""

from __future__ import annotations

import threading
from collections import deque
from typing import TYPE_CHECKING, NamedTuple

from coframe.wire.endpoints import LocalEndpoint

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.wire._backend import BackendTfReader
    from coframe.wire.endpoints import GraphNode, Sample
    from coframe.wire.graph import Graph
    from coframe.wire.names import Endpoint
    from coframe.wire.qos import QoS

# tf2's authority for a transform without a publisher.
NO_AUTHORITY = "<no authority available>"

# How long to wait for static transforms of publishers that were started earlier. Fast DDS takes 2 to 3.5 seconds.
STATICS_TIMEOUT = 5.0  # seconds

_DEPARTED_WRITERS = 100  # writers whose node names are kept after they have left


class WriterStatistics(NamedTuple):
    """Statistics of the messages received from one transform writer.

    Attributes:
        writer: The writer's handle.
        messages: The number of messages.
        received_at: The time at which the last one arrived, in nanoseconds of `time.monotonic_ns`.
        period: The median interval between the arrivals of the last messages, in nanoseconds, or 0 for fewer than two.
        lag: The delay of the stamps relative to the system clock on arrival, in nanoseconds: the lower quartile of
            the last messages. None if there are too few messages.
        slashed: A frame name that begins with a slash, or "" if there is none.
        prefixed: A frame name that already has the prefix of the reader, or "" if there is none.
        plain: A frame name without that prefix, or "" if there is none.
    """

    writer: int
    messages: int
    received_at: int
    period: int
    lag: int | None
    slashed: str
    prefixed: str
    plain: str


class TfReader(LocalEndpoint):
    """A subscription that stores the transforms of a topic in a buffer as they arrive, without the GIL."""

    def __init__(
        self,
        native: BackendTfReader,
        node: GraphNode,
        endpoint: Endpoint,
        qos: QoS,
        *,
        static: bool,
        name_writers: bool,
        on_mismatch: Callable[[str, str], object] | None = None,
    ) -> None:
        self.on_mismatch = on_mismatch
        self.static = static
        self._reader = native
        self._node_names: dict[int, str] | None = {} if name_writers else None
        self._departed_writers: deque[int] = deque()
        self._naming = threading.Lock()
        super().__init__(native, node, endpoint, qos)

    @property
    def stored_at(self) -> int:
        """The time at which the last transforms were stored, in nanoseconds of `time.monotonic_ns`, or 0 if never."""
        return self._reader.stored_at

    def pending(self) -> bool:
        """Return False: unlike a `Subscription`, this reader never queues messages."""
        return False

    def take(self, limit: int = 100) -> list[Sample]:
        """Return no messages: unlike a `Subscription`, this reader never queues them."""
        del limit
        return []

    @property
    def received(self) -> int:
        """The number of received messages."""
        return self._reader.received

    def arm(self) -> None:
        """Let the next message set the event that was passed to `Participant.tf_reader`."""
        self._reader.arm()

    def writer_statistics(self) -> list[WriterStatistics]:
        """Return statistics for each writer, including writers that have left; nothing after `close`."""
        return [] if self._closed else [WriterStatistics(*facts) for facts in self._reader.writers()]

    def awaited_writers(self) -> set[int]:
        """Return the handles of the matched writers from which no message was received."""
        return self.matched_handles() - {known.writer for known in self.writer_statistics() if known.messages}

    def settle_statics(self) -> None:
        """From now on, count previously shared static transforms as published only if they were received."""
        if not self._closed:
            self._reader.settle_statics()

    def graph_changed(self, graph: Graph) -> None:
        """Set the names of the publishing nodes in the buffer, as far as the graph contains them."""
        if self._node_names is None or self._closed:
            return
        with self._naming:
            received = [known.writer for known in self.writer_statistics()] if self.static else []
            writers = graph.writers(self.topic)  # read afterwards, so that it contains all of these that still exist
            for handle in set(received) - writers.keys():
                self._reader.writer_left(handle)
            for handle in self._node_names.keys() - writers.keys():
                self._departed_writers.append(handle)
                del self._node_names[handle]
            while len(self._departed_writers) > _DEPARTED_WRITERS:
                self._reader.forget_writer(self._departed_writers.popleft())
            for handle, writer in writers.items():
                node = graph.owner(writer.guid)
                if node is not None and self._node_names.get(handle) != node:
                    self._reader.name_writer(handle, node)
                    self._node_names[handle] = node
