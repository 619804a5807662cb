# SPDX-License-Identifier: Apache-2.0
"""Graph queries of nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.topic_endpoint_info import TopicEndpointInfo, TopicEndpointTypeEnum

if TYPE_CHECKING:
    from coframe.wire import EndpointInfo, GraphNode, Participant
    from coframe.wire import QoS as WireQoS


class NodeGraph:
    """Base class of `Node` with the queries of the ROS graph.

    Attributes:
        _Coframe__participant: The DDS participant, which tf2_ros also uses.
        _Coframe__graph_node: The participant's graph entry of this node, which tf2_ros also uses.
    """

    _Coframe__participant: Participant
    _Coframe__graph_node: GraphNode

    def resolve_topic_name(self, topic: str, *, only_expand: bool = False) -> str:
        """Return the fully qualified name of a topic, remapped unless `only_expand` is set."""
        raise TypeError(f"{type(self).__name__} cannot resolve {topic} (only_expand={only_expand})")

    def get_node_names(self) -> list[str]:
        """Return the names of all nodes."""
        return [name for _, name in self._Coframe__participant.nodes()]

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        """Return the names and namespaces of all nodes."""
        return [(name, namespace) for namespace, name in self._Coframe__participant.nodes()]

    def get_fully_qualified_node_names(self) -> list[str]:
        """Return the fully qualified names of all nodes."""
        return [f"{namespace.rstrip('/')}/{name}" for namespace, name in self._Coframe__participant.nodes()]

    def get_topic_names_and_types(self, no_demangle: bool = False) -> list[tuple[str, list[str]]]:
        """Return all topics with their types.

        Args:
            no_demangle: Whether to return the DDS names and types, for example `rt/tf`.
        """
        topics = sorted(self._Coframe__participant.topics().items())
        if not no_demangle:
            return topics
        return [(f"rt{name}", [_mangle(ros_type) for ros_type in types]) for name, types in topics]

    def get_service_names_and_types(self) -> list[tuple[str, list[str]]]:
        """Return all services with their types."""
        services = sorted(self._Coframe__participant.services().items())
        return [(name, sorted({_service_type(ros_type) for ros_type in types})) for name, types in services]

    def count_publishers(self, topic_name: str) -> int:
        """Return the number of publishers of a topic."""
        return len(self._Coframe__participant.publishers(self.resolve_topic_name(topic_name)))

    def count_subscribers(self, topic_name: str) -> int:
        """Return the number of subscriptions of a topic."""
        return len(self._Coframe__participant.subscribers(self.resolve_topic_name(topic_name)))

    def get_publishers_info_by_topic(self, topic_name: str) -> list[TopicEndpointInfo]:
        """Return information about all publishers of a topic."""
        endpoints = self._Coframe__participant.publishers(self.resolve_topic_name(topic_name))
        return [_info(endpoint, TopicEndpointTypeEnum.PUBLISHER) for endpoint in endpoints]

    def get_subscriptions_info_by_topic(self, topic_name: str) -> list[TopicEndpointInfo]:
        """Return information about all subscriptions of a topic."""
        endpoints = self._Coframe__participant.subscribers(self.resolve_topic_name(topic_name))
        return [_info(endpoint, TopicEndpointTypeEnum.SUBSCRIPTION) for endpoint in endpoints]

    def get_publisher_names_and_types_by_node(self, node_name: str, node_namespace: str) -> list[tuple[str, list[str]]]:
        """Return the topics that a node publishes, with their types."""
        return _types_by_node(
            {topic: self._Coframe__participant.publishers(topic) for topic in self._Coframe__participant.topics()},
            node_name,
            node_namespace,
        )

    def get_subscriber_names_and_types_by_node(
        self, node_name: str, node_namespace: str
    ) -> list[tuple[str, list[str]]]:
        """Return the topics that a node subscribes to, with their types."""
        return _types_by_node(
            {topic: self._Coframe__participant.subscribers(topic) for topic in self._Coframe__participant.topics()},
            node_name,
            node_namespace,
        )


def _types_by_node(endpoints: dict[str, list[EndpointInfo]], name: str, namespace: str) -> list[tuple[str, list[str]]]:
    found: list[tuple[str, list[str]]] = []
    for topic in sorted(endpoints):
        types = {end.ros_type for end in endpoints[topic] if (end.node, end.namespace) == (name, namespace)}
        if types:
            found.append((topic, sorted(types)))
    return found


def _info(endpoint: EndpointInfo, kind: TopicEndpointTypeEnum) -> TopicEndpointInfo:
    return TopicEndpointInfo(
        node_name=endpoint.node or "_NODE_NAME_UNKNOWN_",
        node_namespace=endpoint.namespace or "_NODE_NAMESPACE_UNKNOWN_",
        topic_type=endpoint.ros_type,
        endpoint_type=kind,
        endpoint_gid=list(endpoint.guid),
        qos_profile=_profile(endpoint.qos),
    )


def _profile(qos: WireQoS) -> QoSProfile:
    return QoSProfile(
        history=HistoryPolicy.KEEP_ALL if qos.keep_all else HistoryPolicy.KEEP_LAST,
        depth=qos.depth,
        reliability=ReliabilityPolicy.RELIABLE if qos.reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if qos.transient_local else DurabilityPolicy.VOLATILE,
    )


def _service_type(ros_type: str) -> str:
    """Return the service type of a request or response type."""
    return ros_type.removesuffix("_Request").removesuffix("_Response")


def _mangle(ros_type: str) -> str:
    *folders, name = ros_type.split("/")
    return "::".join([*folders, "dds_", f"{name}_"])
