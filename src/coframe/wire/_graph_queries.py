# SPDX-License-Identifier: Apache-2.0
"""Query the nodes, topics, services and endpoints of the ROS graph."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.wire import names

if TYPE_CHECKING:
    from coframe.wire.graph import DiscoveredEndpoint, EndpointInfo, Graph
    from coframe.wire.names import Kind

__all__ = ["GraphQueries"]


class GraphQueries:
    """The methods of a participant that query the ROS graph."""

    _graph: Graph

    @property
    def qos_must_match(self) -> bool:
        """Whether endpoints with incompatible quality of service do not communicate. The middleware decides."""
        return self._graph.qos_must_match

    def nodes(self) -> list[tuple[str, str]]:
        """Return the (namespace, name) of every node on the graph, including the nodes of this process."""
        return self._graph.nodes()

    def unnamed_participants(self) -> list[str]:
        """Return the middlewares of processes that have been discovered but have not published their nodes yet."""
        return self._graph.unnamed_participants()

    def topics(self) -> dict[str, list[str]]:
        """Return the topics and their ROS types: {"/tf": ["tf2_msgs/msg/TFMessage"]}."""
        return self._graph.types(("topic",))

    def services(self) -> dict[str, list[str]]:
        """Return the services and the ROS types of their requests and replies.

        An example is {"/reset": ["std_srvs/srv/Empty_Request", "std_srvs/srv/Empty_Response"]}.
        """
        return self._graph.types(("request", "reply"))

    def dds_topics(self) -> dict[str, list[str]]:
        """Return all DDS topics and their DDS types, including topics of services and of programs without ROS."""
        self._graph.refresh()
        found: dict[str, set[str]] = {}
        for writers in (True, False):
            for topic, endpoints in self._graph.by_topic(writers=writers).items():
                found.setdefault(topic, set()).update(endpoint.type for endpoint in endpoints.values())
        return {topic: sorted(types) for topic, types in sorted(found.items())}

    def publishers(self, topic: str, *, kind: Kind = "topic") -> list[EndpointInfo]:
        """Return the publishers on a topic, given its ROS name."""
        return self._describe_endpoints(self._graph.writers(names.dds_topic(topic, kind)))

    def published(self) -> dict[str, dict[int, EndpointInfo]]:
        """Return the publishers of every topic: {ROS name of the topic: {handle of the writer: publisher}}.

        The handles are those in `Sample.writer`.
        """
        self._graph.refresh()
        found = {}
        for name, writers in self._graph.by_topic(writers=True).items():
            if (topic := names.ros_topic(name)) is not None:
                found[topic] = {handle: self._graph.describe(writer) for handle, writer in writers.items()}
        return found

    def endpoints(self, *, writers: bool) -> dict[str, list[tuple[DiscoveredEndpoint, EndpointInfo]]]:
        """Return all publishers or all subscriptions by the ROS name of their topic."""
        self._graph.refresh()
        found = {}
        for name, endpoints in self._graph.by_topic(writers=writers).items():
            if (topic := names.ros_topic(name)) is not None:
                found[topic] = [(endpoint, self._graph.describe(endpoint)) for endpoint in endpoints.values()]
        return found

    def subscribers(self, topic: str, *, kind: Kind = "topic") -> list[EndpointInfo]:
        """Return the subscriptions to a topic, given its ROS name."""
        return self._describe_endpoints(self._graph.readers(names.dds_topic(topic, kind)))

    def writers(self, topic: str) -> dict[int, DiscoveredEndpoint]:
        """Return the writers on a topic, given its ROS name, by the handles in `Sample.writer`."""
        return self._graph.writers(names.dds_topic(topic))

    def writer_node(self, handle: int) -> str | None:
        """Return the full name of the node that a writer belongs to, such as "/talker", or None if it is unknown."""
        return self._graph.writer_node(handle)

    def find_writer(self, handle: int) -> DiscoveredEndpoint | None:
        """Return a writer by its handle, or None if it has left."""
        return self._graph.writer(handle)

    def _describe_endpoints(self, endpoints: dict[int, DiscoveredEndpoint]) -> list[EndpointInfo]:
        return [self._graph.describe(endpoint) for endpoint in endpoints.values()]
