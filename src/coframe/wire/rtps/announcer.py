# SPDX-License-Identifier: Apache-2.0
"""Publish the nodes of this process on the topic ros_discovery_info, in the form that the other participants read."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from coframe import _core
from coframe.wire.rtps.discovery_info import choose_gid_size, encode_node, gid_size, join_info, unseen_text
from coframe.wire.system_clock import clock_fault

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.wire._backend import BackendWriter
    from coframe.wire.graph import NodeInfo
    from coframe.wire.rtps.graph import DdsGraph


class NodeAnnouncer:
    """Publishes the nodes of a participant.

    Args:
        participant: The GUID of the participant.
        writer: The writer of the topic, which the announcer closes.

    Attributes:
        gid_size: The size of the published identifiers in bytes.
    """

    def __init__(self, participant: bytes, writer: BackendWriter) -> None:
        self._participant = participant
        self._writer = writer
        self.gid_size = self._preferred_gid_size = gid_size(os.environ)
        self._nodes: Sequence[NodeInfo] = ()
        self._encoded: dict[NodeInfo, bytes] = {}  # the parts of the last message
        self._is_published = True  # whether the published state of this process's nodes is current

    def announce(self, nodes: Sequence[NodeInfo]) -> None:
        """Publish the nodes of this process with their endpoints."""
        self._nodes = nodes
        self._publish()

    def repeat(self) -> None:
        """Publish the nodes again if the last time failed."""
        if not self._is_published:
            self._publish()

    def adapt(self, graph: DdsGraph) -> str:
        """Publish the nodes in the form that the other participants can read. Return a warning, or ""."""
        others = graph.gid_sizes()
        size = choose_gid_size(self._preferred_gid_size, others)
        if size != self.gid_size:
            self.gid_size = size
            self._encoded.clear()
            self._publish()
        return unseen_text(size, others)

    def close(self) -> None:
        """Close the writer."""
        self._writer.close()

    def _publish(self) -> None:
        try:
            self._writer.write(self._message())
            self._is_published = True
        except _core.EndpointError:
            # A node must be able to shut down while the clock is wrong. The next announcement contains all nodes.
            self._is_published = False
            if clock_fault() is None:
                raise

    def _message(self) -> bytes:
        # Most nodes have not changed since the last message.
        known = self._encoded
        self._encoded = {node: known.get(node) or encode_node(node, self.gid_size) for node in self._nodes}
        return join_info(self._participant, [self._encoded[node] for node in self._nodes], self.gid_size)
