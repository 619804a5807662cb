# SPDX-License-Identifier: Apache-2.0
"""Publishers and subscriptions of requests and replies, for nodes whose middleware sends services in the same way."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.wire.endpoints import RawPublisher, Sample, Subscription

if TYPE_CHECKING:
    from coframe.wire.backend import BackendReader, BackendWriter
    from coframe.wire.endpoints import GraphNode
    from coframe.wire.graph import Graph
    from coframe.wire.names import Endpoint
    from coframe.wire.qos import QoS


class ServicePublisher(RawPublisher):
    """A publisher of requests or replies."""

    def __init__(self, native: BackendWriter, node: GraphNode, endpoint: Endpoint, qos: QoS, graph: Graph) -> None:
        self._graph = graph
        super().__init__(native, node, endpoint, qos)

    @property
    def matched(self) -> int:
        """The number of matched subscriptions that understand the messages."""
        handles = self.matched_handles()
        if not handles:
            return 0
        readers = self._graph.readers(self.topic)
        return sum(
            handle in handles and not self._graph.foreign_services(reader.guid) for handle, reader in readers.items()
        )


class ServiceSubscription(Subscription):
    """A subscription to requests or replies."""

    def __init__(self, native: BackendReader, node: GraphNode, endpoint: Endpoint, qos: QoS, graph: Graph) -> None:
        self._graph = graph
        super().__init__(native, node, endpoint, qos)

    @property
    def matched(self) -> int:
        """The number of matched publishers whose messages can be understood."""
        handles = self.matched_handles()
        if not handles:
            return 0
        writers = self._graph.writers(self.topic)
        return sum(
            handle in handles and not self._graph.foreign_services(writer.guid) for handle, writer in writers.items()
        )

    def take(self, limit: int = 100) -> list[Sample]:
        """Return up to `limit` queued messages that can be understood, oldest first, without waiting."""
        return [sample for sample in super().take(limit) if self._is_understood(sample)]

    def _is_understood(self, sample: Sample) -> bool:
        writer = self._graph.writer(sample.writer)
        return writer is None or not self._graph.foreign_services(writer.guid)
