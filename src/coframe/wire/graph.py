"""The ROS graph: who is there, from ros_discovery_info and from DDS's own discovery."""

from __future__ import annotations

import threading
from collections import OrderedDict
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from coframe import _core
from coframe.wire import names
from coframe.wire.discovery_info import TOPIC, NodeInfo, decode_info
from coframe.wire.qos import QoS

if TYPE_CHECKING:
    from coframe.wire.names import Kind

UNKNOWN_NODE = "_NODE_NAME_UNKNOWN_"
UNKNOWN_NAMESPACE = "_NODE_NAMESPACE_UNKNOWN_"

_GONE_WRITERS = 1000
_TAKE = 256


@dataclass(frozen=True)
class Endpoint:
    """A publisher or a subscription of the graph.

    Attributes:
        node: its node's name; "_NODE_NAME_UNKNOWN_" if no node has claimed it.
        namespace: its node's namespace.
        ros_type: such as "tf2_msgs/msg/TFMessage".
        qos: what it offers or asks for. A reader's and a writer's depth is not always told by DDS.
        guid: 16 bytes.
    """

    node: str
    namespace: str
    ros_type: str
    qos: QoS
    guid: bytes


class DdsEndpoint(NamedTuple):
    """A reader or writer as DDS discovery describes it."""

    guid: bytes
    participant: bytes
    topic: str
    type: str
    qos: QoS
    user_data: bytes = b""


class Graph:
    """What is known of the graph. Each question first takes in what DDS has learnt meanwhile."""

    def __init__(self, participant: int, topic: int, changed: _core.Event) -> None:
        qos = _core.QosProfile(depth=1, reliable=True, transient_local=True, keep_all=True)
        self._lock = threading.Lock()
        self._info_reader = _core.Reader(participant, topic, qos, "", changed)
        self._writer_reader = _core.EndpointReader(participant, _core.PUBLICATIONS, changed)
        self._reader_reader = _core.EndpointReader(participant, _core.SUBSCRIPTIONS, changed)
        self._nodes: dict[bytes, list[NodeInfo]] = {}
        self._owners: dict[bytes, NodeInfo] = {}
        self._writers: dict[int, DdsEndpoint] = {}
        self._readers: dict[int, DdsEndpoint] = {}
        self._writer_nodes: OrderedDict[int, str] = OrderedDict()  # of gone writers too
        self._version = 0

    def close(self) -> None:
        """Ends the readers; what is known stays."""
        for reader in (self._info_reader, self._writer_reader, self._reader_reader):
            reader.close()

    def refresh(self) -> int:
        """Takes in what is new: a number that grows with every change."""
        with self._lock:
            # The nodes first: a participant that leaves meanwhile takes them along by its endpoints.
            changed = self._take_info()
            changed |= self._take_endpoints(self._writer_reader, self._writers)
            changed |= self._take_endpoints(self._reader_reader, self._readers)
            if changed:
                self._forget_departed()
                self._owners = {
                    guid: node
                    for nodes in self._nodes.values()
                    for node in nodes
                    for guid in (*node.readers, *node.writers)
                }
                self._remember_writers()
                self._version += 1
            return self._version

    def nodes(self) -> list[tuple[str, str]]:
        """(namespace, name) of every node."""
        self.refresh()
        with self._lock:
            return [(node.namespace, node.name) for nodes in self._nodes.values() for node in nodes]

    def types(self, kinds: tuple[Kind, ...]) -> dict[str, list[str]]:
        """The ROS names of these kinds with the ROS types that are used on them."""
        self.refresh()
        found: dict[str, set[str]] = {}
        with self._lock:
            for endpoint in (*self._writers.values(), *self._readers.values()):
                for kind in kinds:
                    if (name := names.ros_topic(endpoint.topic, kind)) is not None:
                        found.setdefault(name, set()).add(names.ros_type(endpoint.type))
        return {name: sorted(types) for name, types in sorted(found.items())}

    def writers(self, topic: str) -> dict[int, DdsEndpoint]:
        """The writers of a DDS topic, by their handles."""
        self.refresh()
        with self._lock:
            return {handle: writer for handle, writer in self._writers.items() if writer.topic == topic}

    def readers(self, topic: str) -> dict[int, DdsEndpoint]:
        """The readers of a DDS topic, by their handles."""
        self.refresh()
        with self._lock:
            return {handle: reader for handle, reader in self._readers.items() if reader.topic == topic}

    def by_topic(self, *, writers: bool) -> dict[str, dict[int, DdsEndpoint]]:
        """All writers, or all readers, by DDS topic and handle, as of the last refresh."""
        grouped: dict[str, dict[int, DdsEndpoint]] = {}
        with self._lock:
            for handle, endpoint in (self._writers if writers else self._readers).items():
                grouped.setdefault(endpoint.topic, {})[handle] = endpoint
        return grouped

    def describe(self, endpoint: DdsEndpoint) -> Endpoint:
        """The endpoint with its node."""
        node = self._owners.get(endpoint.guid)
        return Endpoint(
            node=node.name if node else UNKNOWN_NODE,
            namespace=node.namespace if node else UNKNOWN_NAMESPACE,
            ros_type=names.ros_type(endpoint.type),
            qos=endpoint.qos,
            guid=endpoint.guid,
        )

    def owner(self, guid: bytes) -> str | None:
        """The full name of the node that has this endpoint, such as "/talker"."""
        node = self._owners.get(guid)
        return names.full_name(node.namespace, node.name) if node else None

    def writer_node(self, handle: int) -> str | None:
        """The full name of the node whose writer has this handle, also for a while after the writer has gone."""
        self.refresh()
        with self._lock:
            return self._writer_nodes.get(handle)

    def _take_info(self) -> bool:
        changed = False
        while messages := self._info_reader.take(_TAKE):
            for message, _, _ in messages:
                if (info := decode_info(message)) is not None:
                    participant, nodes = info
                    self._nodes[participant] = nodes
                    changed = True
        return changed

    def _take_endpoints(self, reader: _core.EndpointReader, known: dict[int, DdsEndpoint]) -> bool:
        changes = reader.take()
        for handle, alive, guid, participant, topic, type_name, (depth, *policies), user_data in changes:
            if alive:
                qos = QoS(max(depth, 1), *policies)
                known[handle] = DdsEndpoint(guid, participant, topic, type_name, qos, user_data)
            else:
                known.pop(handle, None)
        return bool(changes)

    def _remember_writers(self) -> None:
        """A sample may be asked about when its writer has left already."""
        for handle, writer in self._writers.items():
            if (node := self.owner(writer.guid)) is not None:
                self._writer_nodes[handle] = node
                self._writer_nodes.move_to_end(handle)
        while len(self._writer_nodes) > len(self._writers) + _GONE_WRITERS:
            self._writer_nodes.popitem(last=False)

    def _forget_departed(self) -> None:
        present = {writer.participant for writer in self._writers.values() if writer.topic == TOPIC}
        self._nodes = {guid: nodes for guid, nodes in self._nodes.items() if guid in present}
