# SPDX-License-Identifier: Apache-2.0
"""The graph of nodes and topics, including publishers and subscriptions that do not match."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from coframe import _core
from coframe._output.formatting import duration
from coframe.viewer.protocol.panel_messages import GraphLink, GraphNode, GraphTopic, NodeGraph
from coframe.wire.endpoint_mismatch import mismatch_reasons
from coframe.wire.graph import UNKNOWN_NODE
from coframe.wire.names import full_name, ros_type
from coframe.wire.qos import INFINITE

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.connection.connection import Connection
    from coframe.viewer.sources.source import ViewerSource
    from coframe.wire.graph import DiscoveredEndpoint, EndpointInfo
    from coframe.wire.qos import QoS

    Endpoints = list[tuple[DiscoveredEndpoint, EndpointInfo]]

__all__ = ["NodeGraphWatcher"]

_PERIOD = 1.0  # seconds between two updates
MAX_LINKS = 5_000
# Every node has these topics; they would obscure the structure of the graph.
_INFRASTRUCTURE = {"/rosout", "/parameter_events"}
_OWN_NODES = ("/coframe_view", "/coframe_view_doctor")
_NO_GRAPH = {
    "recording": "A recording does not contain which nodes published and subscribed. Its topics are in the inspector.",
    "buffer": "A buffer from Python has no nodes and topics.",
    "live": "Joining the ROS graph …",
}


class NodeGraphWatcher:
    """Describes the graph of one source while a page shows it. Use only on the server's thread.

    Args:
        source: The source whose graph is described.

    Attributes:
        graph: The last description.
        version: A number that changes with the description.
    """

    def __init__(self, source: ViewerSource) -> None:
        self._source = source
        self._changed = _core.Event()
        self._users = 0
        self._due = 0.0
        self.graph = _empty_graph(_NO_GRAPH[source.mode])
        self.version = 0

    def open(self) -> None:
        """Watch the graph. Call `release` at the end."""
        self._users += 1
        if self._users == 1 and self._source.connection is not None:
            self._source.connection.participant.watch_graph(self._changed)
            self._changed.set()
            self._due = 0.0

    def release(self) -> None:
        """Stop watching if no other page shows the graph."""
        self._users = max(0, self._users - 1)
        if self._users == 0 and self._source.connection is not None:
            self._source.connection.participant.unwatch_graph(self._changed)

    def poll(self) -> None:
        """Describe the graph again if it has changed."""
        now = time.monotonic()
        connection = self._source.connection
        if not self._users or connection is None or now < self._due:
            return
        self._due = now + _PERIOD
        if self._changed.wait(0):
            graph = describe_graph(connection)
            if graph != self.graph:
                self.graph = graph
                self.version += 1

    def close(self) -> None:
        """Stop watching."""
        while self._users:
            self.release()


def describe_graph(connection: Connection) -> NodeGraph:
    """Return the nodes, the topics and their publishers and subscriptions."""
    participant = connection.participant
    writers = participant.endpoints(writers=True)
    readers = participant.endpoints(writers=False)
    own = {connection.node.full_name, *_OWN_NODES}
    nodes: dict[str, int] = {}
    for namespace, name in participant.nodes():
        nodes.setdefault(full_name(namespace, name), len(nodes))
    topics: list[GraphTopic] = []
    links: list[GraphLink] = []
    for topic in sorted(writers.keys() | readers.keys()):
        published, subscribed = writers.get(topic, []), readers.get(topic, [])
        types = sorted({info.ros_type for _, info in (*published, *subscribed)})
        topics.append(GraphTopic(topic=topic, types=types, infrastructure=_is_infrastructure(topic)))
        for publishes, mine, others in ((True, published, subscribed), (False, subscribed, published)):
            for endpoint, info in mine[: MAX_LINKS - len(links)]:
                name = _name(info)
                links.append(
                    GraphLink(
                        node=nodes.setdefault(name, len(nodes)),
                        topic=len(topics) - 1,
                        publishes=publishes,
                        qos=_qos_text(info.qos),
                        problem=""
                        if name in own
                        else _problem(endpoint, others, publishes=publishes, qos_must_match=participant.qos_must_match),
                    )
                )
    left_out = sum(map(len, (*writers.values(), *readers.values()))) - len(links)
    return NodeGraph(
        type="graph",
        text=f"{left_out} more connections are not shown: the graph shows at most {MAX_LINKS}." if left_out else "",
        nodes=[GraphNode(name=name, infrastructure=name in own) for name in nodes],
        topics=topics,
        links=_merge_links(links),
    )


def _problem(endpoint: DiscoveredEndpoint, others: Endpoints, *, publishes: bool, qos_must_match: bool) -> str:
    """Return why an endpoint does not match one on the other side, or "" if it matches all."""
    for other, info in others:
        writer, reader = (endpoint, other) if publishes else (other, endpoint)
        reasons = mismatch_reasons(writer, reader, qos_must_match=qos_must_match)
        if not reasons:
            continue
        verbs = ("offers", "requests") if publishes else ("requests", "offers")
        own, peer = (writer, reader) if publishes else (reader, writer)
        if reasons == ["type"]:
            return f"has the type {ros_type(own.type)}, but {_name(info)} has {info.ros_type}: no messages arrive"
        mine, theirs = (_words(each.qos, reasons) for each in (own, peer))
        return f"{verbs[0]} {mine}, but {_name(info)} {verbs[1]} {theirs}: no messages arrive"
    return ""


def _words(qos: QoS, reasons: list[str]) -> str:
    words = {
        "reliability": "reliable" if qos.reliable else "best-effort",
        "durability": "transient-local" if qos.transient_local else "volatile",
        "deadline": "no deadline" if qos.deadline == INFINITE else f"a deadline of {duration(qos.deadline)}",
        "liveliness": f"{'manual' if qos.manual_liveliness else 'automatic'} liveliness"
        + ("" if qos.lease == INFINITE else f" with a lease of {duration(qos.lease)}"),
    }
    return ", ".join(words[reason] for reason in reasons)


def _qos_text(qos: QoS) -> str:
    return _words(qos, ["reliability", "durability"])


def _name(info: EndpointInfo) -> str:
    return "(unnamed node)" if info.node == UNKNOWN_NODE else full_name(info.namespace, info.node)


def _is_infrastructure(topic: str) -> bool:
    """Return whether a topic belongs to ROS itself or is hidden: a part of its name begins with an underscore."""
    return topic in _INFRASTRUCTURE or "/_" in topic


def _merge_links(links: Iterable[GraphLink]) -> list[GraphLink]:
    """Merge equal links of a node, such as the links of several listeners."""
    return list({tuple(link.values()): link for link in links}.values())


def _empty_graph(text: str) -> NodeGraph:
    return NodeGraph(type="graph", text=text, nodes=[], topics=[], links=[])
