# SPDX-License-Identifier: Apache-2.0
"""The ROS graph from the topic ros_discovery_info and DDS discovery."""

from __future__ import annotations

from coframe import _core
from coframe.wire import names
from coframe.wire.dds import vendors
from coframe.wire.dds.discovery_info import ADAPTS, TOPIC, decode_info
from coframe.wire.dds.user_data import type_hash_of
from coframe.wire.graph import DiscoveredEndpoint, Graph
from coframe.wire.qos import QoS

_BATCH = 256  # messages


class DdsGraph(Graph):
    """The graph of a DDS domain.

    Args:
        participant: The handle of the participant.
        topic: The handle of the topic ros_discovery_info, which is released.
        changed: Set whenever discovery messages arrive.
    """

    def __init__(self, participant: int, topic: int, changed: _core.Event) -> None:
        super().__init__()
        qos = _core.QosProfile(depth=1, reliable=True, transient_local=True, keep_all=True)
        self._info_reader = _core.Reader(participant, topic, qos, "", changed)
        self._writer_reader = _core.EndpointReader(participant, _core.PUBLICATIONS, changed)
        self._reader_reader = _core.EndpointReader(participant, _core.SUBSCRIPTIONS, changed)
        self._gid_sizes: dict[bytes, int] = {}  # by participant

    def close(self) -> None:
        """Close the discovery readers. The state stays available."""
        for reader in (self._info_reader, self._writer_reader, self._reader_reader):
            reader.close()

    def foreign_services(self, guid: bytes) -> str:
        """Return the DDS implementation of an endpoint if it sends requests in another form; "" if not."""
        return "" if vendors.shares_services(guid) else vendors.vendor(guid)

    def gid_sizes(self) -> dict[int, list[str]]:
        """Return the sizes of identifiers that participants of other implementations publish, with their nodes."""
        with self._lock:
            adapting = {
                writer.participant
                for writer in self._writers.values()
                if writer.topic == TOPIC and ADAPTS.encode() in writer.user_data
            }
            found: dict[int, list[str]] = {}
            for participant, size in self._gid_sizes.items():
                if participant not in adapting:
                    nodes = self._nodes[participant]
                    found.setdefault(size, []).extend(names.full_name(node.namespace, node.name) for node in nodes)
        return found

    def _take_changes(self) -> bool:
        # Nodes are read before endpoints: if a participant leaves in between, its endpoints remove the nodes.
        changed = self._take_info()
        changed |= self._take_endpoints(self._writer_reader, self._writers)
        changed |= self._take_endpoints(self._reader_reader, self._readers)
        if changed:
            self._remove_departed()
        return changed

    def _take_info(self) -> bool:
        changed = False
        while messages := self._info_reader.take(_BATCH):
            for message, _, _ in messages:
                if (info := decode_info(message)) is not None:
                    self._nodes[info.participant] = info.nodes
                    self._gid_sizes[info.participant] = info.gid_size
                    changed = True
        return changed

    def _take_endpoints(self, reader: _core.EndpointReader, known: dict[int, DiscoveredEndpoint]) -> bool:
        changes = reader.take()
        for handle, alive, guid, participant, topic, type_name, (depth, *policies), user_data in changes:
            if alive:
                qos = QoS(max(depth, 1), *policies)
                known[handle] = DiscoveredEndpoint(
                    guid, participant, topic, type_name, qos, user_data, type_hash_of(user_data)
                )
            else:
                known.pop(handle, None)
        return bool(changes)

    def _remove_departed(self) -> None:
        participants = {writer.participant for writer in self._writers.values() if writer.topic == TOPIC}
        self._nodes = {guid: nodes for guid, nodes in self._nodes.items() if guid in participants}
        self._gid_sizes = {guid: size for guid, size in self._gid_sizes.items() if guid in participants}
