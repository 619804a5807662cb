# SPDX-License-Identifier: Apache-2.0
"""The ROS graph: its nodes, publishers and subscriptions, from ros_discovery_info and DDS discovery."""

from __future__ import annotations

import threading
from collections import OrderedDict
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from coframe import _core
from coframe.wire import names
from coframe.wire.discovery_info import ADAPTS, TOPIC, NodeInfo, decode_info
from coframe.wire.qos import QoS
from coframe.wire.user_data import type_hash_of

if TYPE_CHECKING:
    from coframe.wire.names import Kind

UNKNOWN_NODE = "_NODE_NAME_UNKNOWN_"
UNKNOWN_NAMESPACE = "_NODE_NAMESPACE_UNKNOWN_"

_DEPARTED_WRITERS = 1000  # writers whose node names are kept after they have left
_BATCH = 256  # messages


@dataclass(frozen=True)
class EndpointInfo:
    """A publisher or subscription on the graph.

    Attributes:
        node: The name of its node; "_NODE_NAME_UNKNOWN_" if no node has announced the endpoint.
        namespace: The namespace of its node; "_NODE_NAMESPACE_UNKNOWN_" if no node has announced the endpoint.
        ros_type: The ROS type, such as "tf2_msgs/msg/TFMessage".
        qos: The offered or requested quality of service. DDS discovery does not always contain the depth.
        guid: The DDS GUID, 16 bytes.
        type_hash: The hash of the message definition, "RIHS01_..."; "" if it is not announced, as in Humble.
    """

    node: str
    namespace: str
    ros_type: str
    qos: QoS
    guid: bytes
    type_hash: str = ""


class DiscoveredEndpoint(NamedTuple):
    """A DDS reader or writer, as described by DDS discovery."""

    guid: bytes
    participant: bytes
    topic: str
    type: str
    qos: QoS
    user_data: bytes = b""


class Graph:
    """The current state of the graph. Most queries first process pending discovery messages."""

    def __init__(self, participant: int, topic: int, changed: _core.Event) -> None:
        qos = _core.QosProfile(depth=1, reliable=True, transient_local=True, keep_all=True)
        self._lock = threading.Lock()
        self._info_reader = _core.Reader(participant, topic, qos, "", changed)
        self._writer_reader = _core.EndpointReader(participant, _core.PUBLICATIONS, changed)
        self._reader_reader = _core.EndpointReader(participant, _core.SUBSCRIPTIONS, changed)
        self._nodes: dict[bytes, list[NodeInfo]] = {}
        self._gid_sizes: dict[bytes, int] = {}
        self._owners: dict[bytes, NodeInfo] = {}
        self._writers: dict[int, DiscoveredEndpoint] = {}
        self._readers: dict[int, DiscoveredEndpoint] = {}
        self._writer_nodes: OrderedDict[int, str] = OrderedDict()  # includes writers that have left
        self._version = 0

    def close(self) -> None:
        """Close the discovery readers. The state stays available."""
        for reader in (self._info_reader, self._writer_reader, self._reader_reader):
            reader.close()

    def refresh(self) -> int:
        """Process pending discovery messages and return a version number that increases with every change."""
        with self._lock:
            # Nodes are read before endpoints: if a participant leaves in between, its endpoints remove the nodes.
            changed = self._take_info()
            changed |= self._take_endpoints(self._writer_reader, self._writers)
            changed |= self._take_endpoints(self._reader_reader, self._readers)
            if changed:
                self._remove_departed()
                self._owners = {
                    guid: node
                    for nodes in self._nodes.values()
                    for node in nodes
                    for guid in (*node.readers, *node.writers)
                }
                self._store_writer_nodes()
                self._version += 1
            return self._version

    def nodes(self) -> list[tuple[str, str]]:
        """Return the (namespace, name) of every node."""
        self.refresh()
        with self._lock:
            return [(node.namespace, node.name) for nodes in self._nodes.values() for node in nodes]

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

    def types(self, kinds: tuple[Kind, ...]) -> dict[str, list[str]]:
        """Return the topics or services of these kinds with their ROS types."""
        self.refresh()
        found: dict[str, set[str]] = {}
        with self._lock:
            for endpoint in (*self._writers.values(), *self._readers.values()):
                for kind in kinds:
                    if (name := names.ros_topic(endpoint.topic, kind)) is not None:
                        found.setdefault(name, set()).add(names.ros_type(endpoint.type))
        return {name: sorted(types) for name, types in sorted(found.items())}

    def writers(self, topic: str) -> dict[int, DiscoveredEndpoint]:
        """Return the writers on a DDS topic by their handles."""
        self.refresh()
        with self._lock:
            return {handle: writer for handle, writer in self._writers.items() if writer.topic == topic}

    def readers(self, topic: str) -> dict[int, DiscoveredEndpoint]:
        """Return the readers of a DDS topic by their handles."""
        self.refresh()
        with self._lock:
            return {handle: reader for handle, reader in self._readers.items() if reader.topic == topic}

    def writer(self, handle: int) -> DiscoveredEndpoint | None:
        """Return a writer by its handle; None if it has left."""
        if handle not in self._writers:
            self.refresh()
        return self._writers.get(handle)

    def by_topic(self, *, writers: bool) -> dict[str, dict[int, DiscoveredEndpoint]]:
        """Return all writers or all readers by DDS topic and handle, without processing discovery messages."""
        grouped: dict[str, dict[int, DiscoveredEndpoint]] = {}
        with self._lock:
            for handle, endpoint in (self._writers if writers else self._readers).items():
                grouped.setdefault(endpoint.topic, {})[handle] = endpoint
        return grouped

    def describe(self, endpoint: DiscoveredEndpoint) -> EndpointInfo:
        """Return the endpoint together with its node."""
        node = self._owners.get(endpoint.guid)
        return EndpointInfo(
            node=node.name if node else UNKNOWN_NODE,
            namespace=node.namespace if node else UNKNOWN_NAMESPACE,
            ros_type=names.ros_type(endpoint.type),
            qos=endpoint.qos,
            guid=endpoint.guid,
            type_hash=type_hash_of(endpoint.user_data),
        )

    def owner(self, guid: bytes) -> str | None:
        """Return the full name of the node that owns an endpoint, such as "/talker"; None if it is unknown."""
        node = self._owners.get(guid)
        return names.full_name(node.namespace, node.name) if node else None

    def writer_node(self, handle: int) -> str | None:
        """Return the full name of the node of a writer, also for some time after it has left; None if it is unknown."""
        self.refresh()
        with self._lock:
            return self._writer_nodes.get(handle)

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
                known[handle] = DiscoveredEndpoint(guid, participant, topic, type_name, qos, user_data)
            else:
                known.pop(handle, None)
        return bool(changes)

    def _store_writer_nodes(self) -> None:
        """Store the node names of writers, which are needed for samples whose writer has already left."""
        for handle, writer in self._writers.items():
            if (node := self.owner(writer.guid)) is not None:
                self._writer_nodes[handle] = node
                self._writer_nodes.move_to_end(handle)
        while len(self._writer_nodes) > len(self._writers) + _DEPARTED_WRITERS:
            self._writer_nodes.popitem(last=False)

    def _remove_departed(self) -> None:
        participants = {writer.participant for writer in self._writers.values() if writer.topic == TOPIC}
        self._nodes = {guid: nodes for guid, nodes in self._nodes.items() if guid in participants}
        self._gid_sizes = {guid: size for guid, size in self._gid_sizes.items() if guid in participants}
