# SPDX-License-Identifier: Apache-2.0
"""Graph queries of nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from coframe.distributions import since
from coframe.wire.type_hashes import type_hash_of_name
from rclpy.client import wait_until_ready
from rclpy.duration import Duration
from rclpy.exceptions import NodeNameNonExistentError, RCLError, _with_hint
from rclpy.qos import DurabilityPolicy, HistoryPolicy, LivelinessPolicy, QoSProfile, ReliabilityPolicy
from rclpy.service_endpoint_info import ServiceEndpointInfo, ServiceEndpointTypeEnum
from rclpy.topic_endpoint_info import TopicEndpointInfo, TopicEndpointTypeEnum
from rclpy.type_hash import TypeHash

if TYPE_CHECKING:
    from types import ModuleType

    from coframe.wire.endpoints import GraphNode
    from coframe.wire.graph import EndpointInfo
    from coframe.wire.names import Kind
    from coframe.wire.participant import Participant
    from coframe.wire.qos import QoS as WireQoS
    from rclpy.context import Context

NamesAndTypes = list[tuple[str, list[str]]]
_HUMBLE_GID_LENGTH: Final = 24


def _action_graph() -> ModuleType:
    from rclpy.action import graph  # noqa: PLC0415 - actions need nodes

    return graph


class NodeGraph:
    """Base class of `Node` with the queries of the ROS graph.

    Attributes:
        _Coframe__participant: The participant, which tf2_ros also uses.
        _Coframe__graph_node: The participant's graph entry of this node, which tf2_ros also uses.
    """

    _Coframe__participant: Participant
    _Coframe__graph_node: GraphNode

    @property
    def context(self) -> Context:
        """The context of the node."""
        raise TypeError(f"{type(self).__name__} has no context")

    def get_action_names_and_types(self) -> NamesAndTypes:
        """Return all actions with their types."""
        names: NamesAndTypes = _action_graph().get_action_names_and_types(self)
        return names

    def get_action_client_names_and_types_by_node(self, node_name: str, node_namespace: str) -> NamesAndTypes:
        """Return the actions for which a node has clients. Raise an error if the node does not exist."""
        query = _action_graph().get_action_client_names_and_types_by_node
        names: NamesAndTypes = query(self, node_name, node_namespace)
        return names

    def get_action_server_names_and_types_by_node(self, node_name: str, node_namespace: str) -> NamesAndTypes:
        """Return the actions that a node serves; an error if the node does not exist."""
        query = _action_graph().get_action_server_names_and_types_by_node
        names: NamesAndTypes = query(self, node_name, node_namespace)
        return names

    def resolve_service_name(self, service: str, *, only_expand: bool = False) -> str:
        """Return the fully qualified name of a service, remapped unless `only_expand` is set."""
        raise TypeError(f"{type(self).__name__} cannot resolve {service} (only_expand={only_expand})")

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

    def get_node_names_and_namespaces_with_enclaves(self) -> list[tuple[str, str, str]]:
        """Return the names, namespaces and security enclaves of all nodes. Without security, the enclave is "/"."""
        return [(name, namespace, "/") for name, namespace in self.get_node_names_and_namespaces()]

    def get_topic_names_and_types(self, no_demangle: bool = False) -> list[tuple[str, list[str]]]:
        """Return all topics with their types.

        Args:
            no_demangle: Whether to return the DDS names and types of all topics, including topics of services.
        """
        participant = self._Coframe__participant
        return sorted((participant.dds_topics() if no_demangle else participant.topics()).items())

    def get_service_names_and_types(self) -> list[tuple[str, list[str]]]:
        """Return all services with their types."""
        services = sorted(self._Coframe__participant.services().items())
        return [(name, sorted({_service_type(ros_type) for ros_type in types})) for name, types in services]

    def count_publishers(self, topic_name: str) -> int:
        """Return the number of publishers of a topic; raise ValueError if its name is not valid."""
        return len(self._Coframe__participant.publishers(self.__resolved(topic_name)))

    def count_subscribers(self, topic_name: str) -> int:
        """Return the number of subscriptions of a topic; raise ValueError if its name is not valid."""
        return len(self._Coframe__participant.subscribers(self.__resolved(topic_name)))

    def count_clients(self, service_name: str) -> int:
        """Return the number of clients of a service; raise ValueError if its name is not valid."""
        return len(
            self._Coframe__participant.publishers(self.__resolved(service_name, is_service=True), kind="request")
        )

    def count_services(self, service_name: str) -> int:
        """Return the number of servers of a service; raise ValueError if its name is not valid."""
        return len(
            self._Coframe__participant.subscribers(self.__resolved(service_name, is_service=True), kind="request")
        )

    def get_publishers_info_by_topic(self, topic_name: str, no_mangle: bool = False) -> list[TopicEndpointInfo]:
        """Return information about all publishers of a topic.

        Args:
            topic_name: Name of the topic.
            no_mangle: Whether the name is a DDS topic name, for example `rt/tf`.

        Raises:
            ValueError: The name is not valid.
        """
        topic, kind = self.__topic_and_kind(topic_name, no_mangle=no_mangle)
        endpoints = self._Coframe__participant.publishers(topic, kind=kind)
        return [_info(endpoint, TopicEndpointTypeEnum.PUBLISHER) for endpoint in endpoints]

    def get_subscriptions_info_by_topic(self, topic_name: str, no_mangle: bool = False) -> list[TopicEndpointInfo]:
        """Return information about all subscriptions of a topic. See `get_publishers_info_by_topic`."""
        topic, kind = self.__topic_and_kind(topic_name, no_mangle=no_mangle)
        endpoints = self._Coframe__participant.subscribers(topic, kind=kind)
        return [_info(endpoint, TopicEndpointTypeEnum.SUBSCRIPTION) for endpoint in endpoints]

    def get_clients_info_by_service(self, service_name: str, no_mangle: bool = False) -> list[ServiceEndpointInfo]:
        """Return information about all clients of a service.

        Args:
            service_name: Name of the service.
            no_mangle: Whether the name is that of a DDS topic, for example `rq/add_two_intsRequest`.

        Raises:
            ValueError: The name is not valid.
        """
        return self.__service_endpoints(service_name, ServiceEndpointTypeEnum.CLIENT, no_mangle=no_mangle)

    def get_servers_info_by_service(self, service_name: str, no_mangle: bool = False) -> list[ServiceEndpointInfo]:
        """Return information about all servers of a service. See `get_clients_info_by_service`."""
        return self.__service_endpoints(service_name, ServiceEndpointTypeEnum.SERVER, no_mangle=no_mangle)

    def __service_endpoints(
        self, name: str, side: ServiceEndpointTypeEnum, *, no_mangle: bool
    ) -> list[ServiceEndpointInfo]:
        if no_mangle:
            name, _ = self.__topic_and_kind(name, no_mangle=True)
        else:
            name = self.__resolved(name, is_service=True)
        participant = self._Coframe__participant
        senders, receivers = (participant.publishers, participant.subscribers)
        if side is ServiceEndpointTypeEnum.SERVER:
            senders, receivers = receivers, senders
        requests, replies = senders(name, kind="request"), receivers(name, kind="reply")
        return [_service_info(request, _reply_of(request, replies), side) for request in requests]

    def get_publisher_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """Return the topics that a node publishes, with their types.

        Args:
            node_name: Name of the node.
            node_namespace: Namespace of the node.
            no_demangle: Whether to return the DDS names and types.

        Raises:
            NodeNameNonExistentError: There is no such node.
        """
        self.__check_node(node_name, node_namespace, "publisher")
        participant = self._Coframe__participant
        endpoints = {topic: participant.publishers(topic) for topic in participant.topics()}
        return _types_by_node(endpoints, node_name, node_namespace, no_demangle=no_demangle)

    def get_subscriber_names_and_types_by_node(
        self, node_name: str, node_namespace: str, no_demangle: bool = False
    ) -> NamesAndTypes:
        """Return the topics that a node subscribes to. See `get_publisher_names_and_types_by_node`."""
        self.__check_node(node_name, node_namespace, "subscriber")
        participant = self._Coframe__participant
        endpoints = {topic: participant.subscribers(topic) for topic in participant.topics()}
        return _types_by_node(endpoints, node_name, node_namespace, no_demangle=no_demangle)

    def get_service_names_and_types_by_node(self, node_name: str, node_namespace: str) -> NamesAndTypes:
        """Return the services that a node serves, with their types.

        Raises:
            NodeNameNonExistentError: There is no such node.
        """
        self.__check_node(node_name, node_namespace, "service")
        participant = self._Coframe__participant
        endpoints = {name: participant.subscribers(name, kind="request") for name in participant.services()}
        return _types_by_node(endpoints, node_name, node_namespace)

    def get_client_names_and_types_by_node(self, node_name: str, node_namespace: str) -> NamesAndTypes:
        """Return the services that a node has clients for, with their types.

        Raises:
            NodeNameNonExistentError: There is no such node.
        """
        self.__check_node(node_name, node_namespace, "client")
        participant = self._Coframe__participant
        endpoints = {name: participant.publishers(name, kind="request") for name in participant.services()}
        return _types_by_node(endpoints, node_name, node_namespace)

    def wait_for_node(self, fully_qualified_node_name: str, timeout: float) -> bool:
        """Wait until a node is in the graph.

        Args:
            fully_qualified_node_name: Name of the node with its namespace.
            timeout: Maximum time to wait in seconds.

        Returns:
            Whether the node is in the graph.
        """
        name = f"/{fully_qualified_node_name.lstrip('/')}"
        return wait_until_ready(
            self.context, self._Coframe__participant, lambda: name in self.get_fully_qualified_node_names(), timeout
        )

    def __check_node(self, name: str, namespace: str, kind: str) -> None:
        namespace = f"/{namespace.strip('/')}"
        if (name, namespace) not in self.get_node_names_and_namespaces():
            raise _with_hint(
                NodeNameNonExistentError(f"cannot get {kind} names and types for nonexistent node"),
                f"There is no node {namespace.rstrip('/')}/{name}. The nodes: "
                f"{', '.join(sorted(self.get_fully_qualified_node_names()))}.",
            )

    def __topic_and_kind(self, name: str, *, no_mangle: bool) -> tuple[str, Kind]:
        if no_mangle:
            from coframe.wire import names  # noqa: PLC0415 - importing rclpy needs no middleware

            kinds: tuple[Kind, ...] = ("topic", "request", "reply")
            found = ((topic, kind) for kind in kinds if (topic := names.ros_topic(name, kind)) is not None)
            return next(found, (name, "topic"))
        try:
            return self.__resolved(name), "topic"
        except ValueError as error:
            if since("exception_texts"):
                raise
            raise _with_hint(
                ValueError(f"topic name '{name}' is invalid: topic name is invalid"), f"{error}."
            ) from None

    def __resolved(self, name: str, *, is_service: bool = False) -> str:
        try:
            return self.resolve_service_name(name) if is_service else self.resolve_topic_name(name)
        except RCLError as error:
            reason = str(error).removeprefix("failed to resolve name: ")
            raise ValueError(f"topic name '{name}' is invalid: {reason}") from None


def _types_by_node(
    endpoints: dict[str, list[EndpointInfo]], name: str, namespace: str, *, no_demangle: bool = False
) -> NamesAndTypes:
    found: NamesAndTypes = []
    namespace = f"/{namespace.strip('/')}"
    for topic in sorted(endpoints):
        types = {end.ros_type for end in endpoints[topic] if (end.node, end.namespace) == (name, namespace)}
        if types:
            found.append((topic, sorted({_service_type(ros_type) for ros_type in types})))
    if not no_demangle:
        return found
    from coframe.wire import names  # noqa: PLC0415 - importing rclpy needs no middleware

    return [(names.dds_topic(topic), [names.dds_type(ros_type) for ros_type in types]) for topic, types in found]


def _info(endpoint: EndpointInfo, kind: TopicEndpointTypeEnum) -> TopicEndpointInfo:
    return TopicEndpointInfo(
        node_name=endpoint.node or "_NODE_NAME_UNKNOWN_",
        node_namespace=endpoint.namespace or "_NODE_NAMESPACE_UNKNOWN_",
        topic_type=endpoint.ros_type,
        endpoint_type=kind,
        endpoint_gid=_gid(endpoint),
        qos_profile=_profile(endpoint.qos),
        topic_type_hash=TypeHash.from_text(endpoint.type_hash),
    )


def _gid(endpoint: EndpointInfo) -> list[int]:
    guid = endpoint.guid
    return list(guid if since("endpoint_information") else guid.ljust(_HUMBLE_GID_LENGTH, b"\0"))


def _reply_of(request: EndpointInfo, replies: list[EndpointInfo]) -> EndpointInfo | None:
    """Return the endpoint for replies that belongs to the same node, or None if it is not discovered yet."""
    return next((each for each in replies if (each.node, each.namespace) == (request.node, request.namespace)), None)


def _service_info(
    request: EndpointInfo, reply: EndpointInfo | None, side: ServiceEndpointTypeEnum
) -> ServiceEndpointInfo:
    ends = [request] if reply is None else [request, reply]
    return ServiceEndpointInfo(
        node_name=request.node or "_NODE_NAME_UNKNOWN_",
        node_namespace=request.namespace or "_NODE_NAMESPACE_UNKNOWN_",
        service_type=_service_type(request.ros_type),
        service_type_hash=TypeHash.from_text(_service_hash(request)),
        endpoint_type=side,
        endpoint_count=len(ends),
        endpoint_gids=[_gid(end) for end in ends],
        qos_profiles=[_profile(end.qos) for end in ends],
    )


def _service_hash(request: EndpointInfo) -> str:
    """Return the hash of a service. Over DDS, an endpoint announces only the hash of its requests."""
    own = type_hash_of_name(request.ros_type)
    return type_hash_of_name(_service_type(request.ros_type)) if own == request.type_hash else request.type_hash


def _profile(qos: WireQoS) -> QoSProfile:
    return QoSProfile(
        history=HistoryPolicy.KEEP_ALL if qos.keep_all else HistoryPolicy.KEEP_LAST,
        depth=qos.depth,
        reliability=ReliabilityPolicy.RELIABLE if qos.reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if qos.transient_local else DurabilityPolicy.VOLATILE,
        lifespan=Duration(nanoseconds=qos.lifespan),
        deadline=Duration(nanoseconds=qos.deadline),
        liveliness=LivelinessPolicy.MANUAL_BY_TOPIC if qos.manual_liveliness else LivelinessPolicy.AUTOMATIC,
        liveliness_lease_duration=Duration(nanoseconds=qos.lease),
    )


def _service_type(ros_type: str) -> str:
    """Return the service type of a request or response type, and the type itself of a message."""
    return ros_type.removesuffix("_Request").removesuffix("_Response")
