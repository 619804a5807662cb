# SPDX-License-Identifier: Apache-2.0
"""A subscription that returns arrival times and message bytes as arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import coframe.lazy_numpy as np
from coframe.wire.endpoints import LocalEndpoint

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.wire._backend import BackendTap
    from coframe.wire.endpoints import GraphNode
    from coframe.wire.names import Endpoint
    from coframe.wire.qos import QoS


MAX_QUEUED_BYTES = 256 << 20  # per subscription, until its messages are taken


class MessageBatch(NamedTuple):
    """N received messages, or the first bytes of each, oldest first. Times are nanoseconds since 1970.

    Attributes:
        data: The messages one after the other, each with 4 bytes of encapsulation before the CDR.
        ends: The end of each message in `data`, (N,) uint64.
        arrived: The arrival times on the clock of this machine, (N,) int64.
        sent: The publication times on the clock of the publisher's machine, (N,) int64.
        writers: The handles of the writers, (N,) uint64, for `Participant.writer_node`.
        dropped: The number of messages that were dropped because the queue was full.
    """

    data: bytes
    ends: NDArray[np.uint64]
    arrived: NDArray[np.int64]
    sent: NDArray[np.int64]
    writers: NDArray[np.uint64]
    dropped: int


class BatchSubscription(LocalEndpoint):
    """A subscription that records messages and their arrival times on a thread of the wire, for callers that poll."""

    def __init__(self, native: BackendTap, node: GraphNode, endpoint: Endpoint, qos: QoS) -> None:
        self._reader = native
        self._missed_count = 0
        super().__init__(native, node, endpoint, qos)

    def take(self) -> MessageBatch:
        """Return the messages that arrived since the last call."""
        data, ends, arrived, sent, writers = self._reader.take()
        before, self._missed_count = self._missed_count, self._reader.missed
        return MessageBatch(
            data,
            np.frombuffer(ends, np.uint64),
            np.frombuffer(arrived, np.int64),
            np.frombuffer(sent, np.int64),
            np.frombuffer(writers, np.uint64),
            self._missed_count - before,
        )
