# SPDX-License-Identifier: Apache-2.0
"""Publishers and subscriptions of requests and replies, for nodes whose middleware sends services in the same way."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.wire.endpoints import RawPublisher, Sample, Subscription
from coframe.wire.vendors import shares_services

if TYPE_CHECKING:
    from coframe import _core
    from coframe.wire.endpoints import GraphNode
    from coframe.wire.graph import Graph
    from coframe.wire.qos import QoS


class ServicePublisher(RawPublisher):
    """A publisher of requests or replies."""

    def __init__(
        self, native: _core.Writer, node: GraphNode, topic: str, dds_type: str, qos: QoS, graph: Graph
    ) -> None:
        self._graph = graph
        super().__init__(native, node, topic, dds_type, qos)

    @property
    def matched(self) -> int:
        """The number of matched subscriptions that understand the messages."""
        handles = self.matched_handles()
        if not handles:
            return 0
        readers = self._graph.readers(self.topic)
        return sum(shares_services(reader.guid) for handle, reader in readers.items() if handle in handles)


class ServiceSubscription(Subscription):
    """A subscription to requests or replies."""

    def __init__(
        self, native: _core.Reader, node: GraphNode, topic: str, dds_type: str, qos: QoS, graph: Graph
    ) -> None:
        self._graph = graph
        super().__init__(native, node, topic, dds_type, qos)

    @property
    def matched(self) -> int:
        """The number of matched publishers whose messages can be understood."""
        handles = self.matched_handles()
        if not handles:
            return 0
        writers = self._graph.writers(self.topic)
        return sum(shares_services(writer.guid) for handle, writer in writers.items() if handle in handles)

    def take(self, limit: int = 100) -> list[Sample]:
        """Return up to `limit` queued messages that can be understood, oldest first, without waiting."""
        return [sample for sample in super().take(limit) if self._is_understood(sample)]

    def _is_understood(self, sample: Sample) -> bool:
        writer = self._graph.writer(sample.writer)
        return writer is None or shares_services(writer.guid)
