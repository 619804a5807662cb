# SPDX-License-Identifier: Apache-2.0
"""Create publishers and subscriptions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.type_names import TF_MESSAGE
from coframe.wire import names
from coframe.wire._backend import QueueLimits
from coframe.wire.batch_subscription import MAX_QUEUED_BYTES, BatchSubscription
from coframe.wire.endpoints import GraphNode, Publisher, RawPublisher, Subscription
from coframe.wire.names import Endpoint
from coframe.wire.qos import TF, TF_STATIC_READER, QoS
from coframe.wire.service_endpoints import ServicePublisher, ServiceSubscription
from coframe.wire.tf_reader import NO_AUTHORITY, TfReader

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe import _core
    from coframe.buffer.buffer import Buffer
    from coframe.wire._backend import Session
    from coframe.wire._rejected_transforms import RejectedTransformMonitor
    from coframe.wire.graph import Graph
    from coframe.wire.names import Kind

__all__ = ["EndpointFactory"]


class EndpointFactory:
    """The methods of a participant that create publishers and subscriptions."""

    _session: Session
    _graph: Graph
    _rejections: RejectedTransformMonitor

    def publisher(
        self,
        node: GraphNode,
        topic: str,
        message_type: type,
        qos: QoS,
        *,
        kind: Kind = "topic",
        user_data: str = "",
        on_change: _core.Event | None = None,
        on_mismatch: Callable[[str, str], object] | None = None,
    ) -> Publisher:
        """Create a publisher of `node`.

        Args:
            node: The node that owns the publisher.
            topic: The fully qualified name of the topic, such as "/scan", or of the service if `kind` is "request" or
                "reply".
            message_type: The message class. For requests and replies, the caller writes the 16-byte ROS header
                (client identifier, sequence number) between the encapsulation and the message.
            qos: The offered quality of service.
            kind: "topic", "request" or "reply". The type and the bytes of requests and replies are not checked.
            user_data: Pairs `key=value;`, which subscribers can read before the first message.
            on_change: An event that is set whenever a status changes (see `LocalEndpoint.take_status`).
            on_mismatch: The attribute of the publisher; see `LocalEndpoint`.

        Raises:
            WireError: The middleware cannot create the publisher.
        """
        if kind != "topic":
            return self.service_publisher(node, topic, message_type, qos, kind)
        endpoint = Endpoint(topic, names.ros_type_of(message_type))
        checked = endpoint.ros_type == TF_MESSAGE
        native = self._session.writer(node, endpoint, qos, user_data=user_data, checked=checked, on_change=on_change)
        return Publisher(native, node, endpoint, qos, on_mismatch=on_mismatch)

    def subscription(
        self,
        node: GraphNode,
        topic: str,
        message_type: type,
        qos: QoS,
        *,
        on_data: _core.Event | None = None,
        kind: Kind = "topic",
        adapts: bool = False,
        on_mismatch: Callable[[str, str], object] | None = None,
    ) -> Subscription:
        """Create a subscription of `node`.

        Args:
            node: The node that owns the subscription.
            topic: The fully qualified name of the topic or service.
            message_type: The message class.
            qos: The requested quality of service.
            on_data: An event that is set when messages arrive or a status changes (see
                `LocalEndpoint.take_status`).
            kind: "topic", "request" or "reply". The type and the bytes of requests and replies are not checked.
            adapts: Whether the caller replaces the subscription when publishers offer less than `qos`. If so, no
                warning about incompatible QoS is logged.
            on_mismatch: The attribute of the subscription; see `LocalEndpoint`.

        Raises:
            WireError: The middleware cannot create the subscription.
        """
        if kind != "topic":
            return self.service_subscription(node, topic, message_type, qos, kind, on_data)
        endpoint = Endpoint(topic, names.ros_type_of(message_type))
        native = self._session.reader(node, endpoint, qos, on_data)
        return Subscription(native, node, endpoint, qos, adapts=adapts, on_mismatch=on_mismatch)

    def service_publisher(
        self, node: GraphNode, service: str, message_type: type, qos: QoS, kind: Kind, *, user_data: str = ""
    ) -> ServicePublisher:
        """Create a publisher of requests or replies of `node`.

        Args:
            node: The node that owns the publisher.
            service: The fully qualified name of the service.
            message_type: The class of the requests or replies. They are written after the 16-byte ROS header.
            qos: The offered quality of service.
            kind: "request" or "reply".
            user_data: Pairs `key=value;`, which the other side can read.

        Raises:
            WireError: The middleware cannot create the publisher.
        """
        endpoint = Endpoint(service, names.ros_type_of(message_type), kind)
        native = self._session.service_writer(node, endpoint, qos, user_data)
        return ServicePublisher(native, node, endpoint, qos, self._graph)

    def service_subscription(
        self,
        node: GraphNode,
        service: str,
        message_type: type,
        qos: QoS,
        kind: Kind,
        on_data: _core.Event | None = None,
        *,
        user_data: str = "",
    ) -> ServiceSubscription:
        """Create a subscription of `node` to requests or replies.

        Args:
            node: The node that owns the subscription.
            service: The fully qualified name of the service.
            message_type: The class of the requests or replies.
            qos: The requested quality of service.
            kind: "request" or "reply".
            on_data: An event that is set when messages arrive.
            user_data: Pairs `key=value;`, which the other side can read.

        Raises:
            WireError: The middleware cannot create the subscription.
        """
        endpoint = Endpoint(service, names.ros_type_of(message_type), kind)
        native = self._session.service_reader(node, endpoint, qos, on_data, user_data)
        return ServiceSubscription(native, node, endpoint, qos, self._graph)

    def raw_publisher(self, node: GraphNode, topic: str, ros_type: str, qos: QoS) -> RawPublisher:
        """Create a publisher of `node` for serialized messages of any type.

        Args:
            node: The node that owns the publisher.
            topic: The fully qualified name of the topic, such as "/scan".
            ros_type: The type, such as "sensor_msgs/msg/LaserScan". It does not have to be known in this process.
            qos: The offered quality of service.

        Raises:
            WireError: The middleware cannot create the publisher.
        """
        endpoint = Endpoint(topic, ros_type)
        return RawPublisher(self._session.writer(node, endpoint, qos), node, endpoint, qos)

    def raw_subscription(
        self,
        node: GraphNode,
        topic: str,
        ros_type: str,
        qos: QoS,
        *,
        on_data: _core.Event | None = None,
        adapts: bool = False,
    ) -> Subscription:
        """Create a subscription of `node` to messages of any type. The bytes of the messages are not checked.

        Args:
            node: The node that owns the subscription.
            topic: The fully qualified name of the topic, such as "/scan".
            ros_type: The type, such as "sensor_msgs/msg/LaserScan". It does not have to be known in this process.
            qos: The requested quality of service.
            on_data: An event that is set when messages arrive.
            adapts: Whether the caller replaces the subscription when publishers offer less than `qos`. If so, no
                warning about incompatible QoS is logged.

        Raises:
            WireError: The middleware cannot create the subscription.
        """
        endpoint = Endpoint(topic, ros_type)
        return Subscription(self._session.reader(node, endpoint, qos, on_data), node, endpoint, qos, adapts=adapts)

    def batch_subscription(
        self, node: GraphNode, topic: str, ros_type: str, qos: QoS, *, max_bytes: int, capacity: int = 100_000
    ) -> BatchSubscription:
        """Create a subscription of `node` that records messages and their arrival times on a thread of the wire.

        Args:
            node: The node that owns the subscription.
            topic: The fully qualified name of the topic, such as "/scan".
            ros_type: The type, such as "sensor_msgs/msg/LaserScan". It does not have to be known in this process.
            qos: The requested quality of service.
            max_bytes: The number of bytes to keep of each message.
            capacity: The number of messages that can be queued. Messages beyond this number, and beyond
                :data:`MAX_QUEUED_BYTES <coframe.wire.batch_subscription.MAX_QUEUED_BYTES>`, are dropped and counted.

        Raises:
            WireError: The middleware cannot create the subscription.
        """
        endpoint = Endpoint(topic, ros_type)
        limits = QueueLimits(max_bytes, capacity, MAX_QUEUED_BYTES)
        native = self._session.tap(node, endpoint, qos, limits)
        return BatchSubscription(native, node, endpoint, qos)

    def tf_reader(
        self,
        node: GraphNode,
        topic: str,
        buffer: Buffer,
        *,
        static: bool,
        qos: QoS | None = None,
        authority: str | None = "default_authority",
        renaming: _core.Renaming | None = None,
        on_data: _core.Event | None = None,
        on_mismatch: Callable[[str, str], object] | None = None,
    ) -> TfReader:
        """Create a subscription of `node` that stores transforms in `buffer` as they arrive, without the GIL.

        Args:
            node: The node that owns the subscription.
            topic: The fully qualified name of the topic, such as "/tf".
            buffer: The buffer that stores the transforms.
            static: Whether the transforms are static.
            qos: The requested quality of service. If None, tf2's listener QoS is used.
            authority: The authority that the buffer records for the transforms. If None, it is the publishing node.
            renaming: The renaming of frames (see `coframe.frame_names.renaming`). If None, frames keep their names.
            on_data: An event that is set whenever a status changes, and by the next message after `TfReader.arm`.
            on_mismatch: The attribute of the reader; see `LocalEndpoint`.

        Raises:
            WireError: The middleware cannot create the subscription.
        """
        chosen = qos or (TF_STATIC_READER if static else TF)
        endpoint = Endpoint(topic, TF_MESSAGE)
        native = self._session.tf_reader(
            node,
            endpoint,
            chosen,
            buffer,
            static=static,
            authority=NO_AUTHORITY if authority is None else authority,
            renaming=renaming,
            on_data=on_data,
        )
        reader = TfReader(
            native,
            node,
            endpoint,
            chosen,
            static=static,
            name_writers=authority is None,
            on_mismatch=on_mismatch,
        )
        reader.graph_changed(self._graph)
        self._rejections.add(reader, buffer)
        return reader
