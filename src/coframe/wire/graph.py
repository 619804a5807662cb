# SPDX-License-Identifier: Apache-2.0
"""The ROS graph: its nodes, publishers and subscriptions."""

from __future__ import annotations

import threading
from collections import OrderedDict
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from coframe.wire import names
from coframe.wire._endpoint_table import EndpointTable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.wire.names import Kind
    from coframe.wire.qos import QoS

UNKNOWN_NODE = "_NODE_NAME_UNKNOWN_"
UNKNOWN_NAMESPACE = "_NODE_NAMESPACE_UNKNOWN_"

# Writers whose node names are kept after they, or their nodes, have left.
_MAX_DEPARTED_WRITERS = 500
_MAX_FORMER_OWNERS = 2_000  # includes all endpoints of the nodes


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
        self._nodes: dict[bytes, Sequence[NodeInfo]] = {}  # by participant; changed by `_set_nodes`
        self._owners: dict[bytes, NodeInfo] = {}  # by endpoint
        self._writers = EndpointTable()
        self._readers = EndpointTable()
        self._departed_writers: OrderedDict[int, bytes] = OrderedDict()  # on ROS topics: their GUIDs
        self._former_owners: OrderedDict[bytes, str] = OrderedDict()  # the names of nodes that have left
        self._types: dict[tuple[Kind, ...], tuple[int, dict[str, list[str]]]] = {}  # with the version they are of
        self._version = 0

    def close(self) -> None:
        """Stop discovery. The state remains available."""
        raise NotImplementedError

    def foreign_services(self, peer: DiscoveredEndpoint) -> str:
        """Return the middleware of an endpoint whose requests have a different form from ours, or ""."""
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
        with self._lock:
            version, types = self._types.get(kinds, (-1, {}))
            if version != self._version:
                types = self._find_types(kinds)
                self._types[kinds] = self._version, types
            return {name: list(found) for name, found in types.items()}

    def writers(self, topic: str) -> dict[int, DiscoveredEndpoint]:
        """Return the writers on a DDS topic by their handles."""
        self.refresh()
        with self._lock:
            return self._writers.on_topic(topic)

    def readers(self, topic: str) -> dict[int, DiscoveredEndpoint]:
        """Return the readers of a DDS topic by their handles."""
        self.refresh()
        with self._lock:
            return self._readers.on_topic(topic)

    def writer(self, handle: int) -> DiscoveredEndpoint | None:
        """Return a writer by its handle, or None if it has left."""
        if handle not in self._writers:
            self.refresh()
        return self._writers.get(handle)

    def by_topic(self, *, writers: bool) -> dict[str, dict[int, DiscoveredEndpoint]]:
        """Return all writers or all readers by DDS topic and handle, without processing discovery messages."""
        with self._lock:
            return (self._writers if writers else self._readers).by_topic()

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
            writer = self._writers.get(handle)
            guid = writer.guid if writer is not None else self._departed_writers.get(handle)
            return None if guid is None else self.owner(guid) or self._former_owners.get(guid)

    def _take_changes(self) -> bool:
        """Process pending discovery messages and return whether the nodes or the endpoints have changed."""
        raise NotImplementedError

    def _set_nodes(self, participant: bytes, nodes: Sequence[NodeInfo] | None) -> None:
        """Replace the nodes of a participant. None: it has left."""
        owners = _owners_of(nodes or ())
        former = _owners_of(self._nodes.get(participant, ()))
        for guid in former.keys() - owners.keys():
            if self._owners.get(guid) is former[guid]:
                del self._owners[guid]
            self._former_owners[guid] = names.full_name(former[guid].namespace, former[guid].name)
        while len(self._former_owners) > _MAX_FORMER_OWNERS:
            self._former_owners.popitem(last=False)
        self._owners.update(owners)
        if nodes is None:
            self._nodes.pop(participant, None)
        else:
            self._nodes[participant] = nodes

    def _remove_writer(self, handle: int) -> DiscoveredEndpoint | None:
        """Remove a writer and return it. Its samples may still be queued, so its GUID is kept for `writer_node`."""
        writer = self._writers.remove(handle)
        if writer is not None and names.is_topic(writer.topic):
            self._departed_writers[handle] = writer.guid
            if len(self._departed_writers) > _MAX_DEPARTED_WRITERS:
                self._departed_writers.popitem(last=False)
        return writer

    def _find_types(self, kinds: tuple[Kind, ...]) -> dict[str, list[str]]:
        found: dict[str, set[str]] = {}
        for table in (self._writers, self._readers):
            for topic, types in table.types():
                for kind in kinds:
                    if (name := names.ros_topic(topic, kind)) is not None:
                        found.setdefault(name, set()).update(map(names.ros_type, types))
        return {name: sorted(types) for name, types in sorted(found.items())}


def _owners_of(nodes: Sequence[NodeInfo]) -> dict[bytes, NodeInfo]:
    return {guid: node for node in nodes for guid in (*node.readers, *node.writers)}
