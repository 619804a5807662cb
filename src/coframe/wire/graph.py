# SPDX-License-Identifier: Apache-2.0
"""The ROS graph: its nodes, publishers and subscriptions."""

from __future__ import annotations

import threading
from collections import OrderedDict
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from coframe.wire import names

if TYPE_CHECKING:
    from coframe.wire.names import Kind
    from coframe.wire.qos import QoS

UNKNOWN_NODE = "_NODE_NAME_UNKNOWN_"
UNKNOWN_NAMESPACE = "_NODE_NAMESPACE_UNKNOWN_"

_DEPARTED_WRITERS = 500  # writers whose node names are kept after they have left


@dataclass(frozen=True)
class EndpointInfo:
    """A publisher or subscription on the graph.

    Attributes:
        node: The name of its node; "_NODE_NAME_UNKNOWN_" if no node has announced the endpoint.
        namespace: The namespace of its node; "_NODE_NAMESPACE_UNKNOWN_" if no node has announced the endpoint.
        ros_type: The ROS type, such as "tf2_msgs/msg/TFMessage".
        qos: The offered or requested quality of service. The depth is not always announced.
        guid: The identifier of the endpoint, 16 bytes; in DDS, its GUID.
        type_hash: The hash of the message definition, "RIHS01_...", or "" if it is not announced, as in Humble.
    """

    node: str
    namespace: str
    ros_type: str
    qos: QoS
    guid: bytes
    type_hash: str = ""


class NodeInfo(NamedTuple):
    """A node and the 16-byte GUIDs of its endpoints."""

    namespace: str
    name: str
    readers: tuple[bytes, ...] = ()
    writers: tuple[bytes, ...] = ()


class DiscoveredEndpoint(NamedTuple):
    """A reader or writer on the graph, with the names of its topic and type in DDS."""

    guid: bytes
    participant: bytes
    topic: str
    type: str
    qos: QoS
    user_data: bytes = b""
    type_hash: str = ""
    partitions: tuple[str, ...] = ()


class Graph:
    """The current state of the graph. Most queries first process pending discovery messages.

    Attributes:
        qos_must_match: Whether endpoints with incompatible quality of service do not communicate.
    """

    qos_must_match = True

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._nodes: dict[bytes, list[NodeInfo]] = {}  # by participant
        self._owners: dict[bytes, NodeInfo] = {}
        self._writers: dict[int, DiscoveredEndpoint] = {}
        self._readers: dict[int, DiscoveredEndpoint] = {}
        self._writer_nodes: OrderedDict[int, str] = OrderedDict()  # includes writers that have left
        self._version = 0

    def close(self) -> None:
        """Stop discovery. The state remains available."""
        raise NotImplementedError

    def foreign_services(self, peer: DiscoveredEndpoint) -> str:
        """Return the middleware of an endpoint if it sends requests in another form than this process, or "" if not."""
        del peer
        return ""

    def ignores_requests(self, peer: DiscoveredEndpoint, qos: QoS) -> bool:
        """Return whether a reader with foreign services does not match request writers of this process.

        Args:
            peer: The reader.
            qos: The quality of service of the writer.
        """
        del peer, qos
        return False

    def foreign_writer(self, handle: int) -> str:
        """Return what `foreign_services` returns for a writer, given its handle. It may have left."""
        writer = self.writer(handle)
        return "" if writer is None else self.foreign_services(writer)

    @property
    def version(self) -> int:
        """The number that `refresh` last returned."""
        return self._version

    def refresh(self) -> int:
        """Process pending discovery messages and return a version number that increases with every change."""
        with self._lock:
            if self._take_changes():
                self._owners = {
                    guid: node
                    for nodes in self._nodes.values()
                    for node in nodes
                    for guid in (*node.readers, *node.writers)
                }
                self._store_writer_nodes()
                self._version += 1
            return self._version

    def unnamed_participants(self) -> list[str]:
        """Return the middlewares of processes that have been discovered but have not published their nodes yet."""
        return []

    def nodes(self) -> list[tuple[str, str]]:
        """Return the (namespace, name) of every node."""
        self.refresh()
        with self._lock:
            return [(node.namespace, node.name) for nodes in self._nodes.values() for node in nodes]

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
        """Return a writer by its handle, or None if it has left."""
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
            type_hash=endpoint.type_hash,
        )

    def owner(self, guid: bytes) -> str | None:
        """Return the full name of the node that owns an endpoint, such as "/talker", or None if it is unknown."""
        node = self._owners.get(guid)
        return names.full_name(node.namespace, node.name) if node else None

    def writer_node(self, handle: int) -> str | None:
        """Return the full name of the node of a writer on a ROS topic, or None if it is unknown.

        The names of recently departed writers are kept.
        """
        self.refresh()
        with self._lock:
            return self._writer_nodes.get(handle)

    def _take_changes(self) -> bool:
        """Process pending discovery messages and return whether the nodes or the endpoints have changed."""
        raise NotImplementedError

    def _store_writer_nodes(self) -> None:
        """Store the node names of writers, which are needed for samples whose writer has already left."""
        for handle, writer in self._writers.items():
            if names.is_topic(writer.topic) and (node := self.owner(writer.guid)) is not None:
                self._writer_nodes[handle] = node
                self._writer_nodes.move_to_end(handle)
        while len(self._writer_nodes) > len(self._writers) + _DEPARTED_WRITERS:
            self._writer_nodes.popitem(last=False)
