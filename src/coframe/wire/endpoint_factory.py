# SPDX-License-Identifier: Apache-2.0
"""Creation of publishers and subscriptions in DDS."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe import _core
from coframe.errors import WireError
from coframe.wire import names, types
from coframe.wire.batch_subscription import BatchSubscription
from coframe.wire.endpoints import GraphNode, Publisher, RawPublisher, Subscription
from coframe.wire.qos import TF, TF_STATIC_READER, QoS
from coframe.wire.service_endpoints import ServicePublisher, ServiceSubscription
from coframe.wire.tf_reader import NO_AUTHORITY, TfReader
from coframe.wire.user_data import TF_MESSAGE, endpoint_user_data

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe import Buffer
    from coframe.wire.graph import Graph
    from coframe.wire.names import Kind
    from coframe.wire.rejected_transforms import RejectedTransformMonitor

__all__ = ["EndpointFactory", "native_qos"]


class EndpointFactory:
    """The methods of a participant that create publishers and subscriptions."""

    _native: _core.DomainParticipant
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
            user_data: The DDS user data, which subscribers can read before the first message.
            on_change: An event that is set whenever a status changes (see `LocalEndpoint.take_status`).
            on_mismatch: The attribute of the publisher; see `LocalEndpoint`.

        Raises:
            WireError: DDS cannot create the publisher.
        """
        ros_type = types.ros_type(message_type)
        data = endpoint_user_data(ros_type, user_data)
        name, type_name, entity = self._topic_of(topic, ros_type, kind)
        checked = kind == "topic" and ros_type == TF_MESSAGE
        native = _create(
            lambda: _core.Writer(self._native.entity, entity, native_qos(qos), data, checked, on_change), topic
        )
        if kind != "topic":
            return ServicePublisher(native, node, name, type_name, qos, self._graph)
        return Publisher(native, node, name, type_name, qos, on_mismatch=on_mismatch)

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
            on_data: An event that is set whenever messages arrive or a status changes (see
                `LocalEndpoint.take_status`).
            kind: "topic", "request" or "reply". The type and the bytes of requests and replies are not checked.
            adapts: Whether the caller replaces the subscription when publishers offer less than `qos`. If so, no
                warning about incompatible QoS is logged.
            on_mismatch: The attribute of the subscription; see `LocalEndpoint`.

        Raises:
            WireError: DDS cannot create the subscription.
        """
        ros_type = types.ros_type(message_type)
        data = endpoint_user_data(ros_type)
        name, type_name, entity = self._topic_of(topic, ros_type, kind)
        native = _create(lambda: _core.Reader(self._native.entity, entity, native_qos(qos), data, on_data), topic)
        if kind != "topic":
            return ServiceSubscription(native, node, name, type_name, qos, self._graph)
        return Subscription(native, node, name, type_name, qos, adapts=adapts, on_mismatch=on_mismatch)

    def raw_publisher(self, node: GraphNode, topic: str, ros_type: str, qos: QoS) -> RawPublisher:
        """Create a publisher of `node` for serialized messages of any type.

        Args:
            node: The node that owns the publisher.
            topic: The fully qualified name of the topic, such as "/scan".
            ros_type: The type, such as "sensor_msgs/msg/LaserScan". It does not have to be known in this process.
            qos: The offered quality of service.

        Raises:
            WireError: DDS cannot create the publisher.
        """
        name, type_name, entity = self._topic_of(topic, ros_type)
        data = endpoint_user_data(ros_type)
        native = _create(lambda: _core.Writer(self._native.entity, entity, native_qos(qos), data), topic)
        return RawPublisher(native, node, name, type_name, qos)

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
            on_data: An event that is set whenever messages arrive.
            adapts: Whether the caller replaces the subscription when publishers offer less than `qos`. If so, no
                warning about incompatible QoS is logged.

        Raises:
            WireError: DDS cannot create the subscription.
        """
        name, type_name, entity = self._topic_of(topic, ros_type)
        data = endpoint_user_data(ros_type)
        native = _create(lambda: _core.Reader(self._native.entity, entity, native_qos(qos), data, on_data), topic)
        return Subscription(native, node, name, type_name, qos, adapts=adapts)

    def batch_subscription(
        self, node: GraphNode, topic: str, ros_type: str, qos: QoS, *, max_bytes: int, capacity: int = 100_000
    ) -> BatchSubscription:
        """Create a subscription of `node` that records messages and their arrival times on the DDS thread.

        Args:
            node: The node that owns the subscription.
            topic: The fully qualified name of the topic, such as "/scan".
            ros_type: The type, such as "sensor_msgs/msg/LaserScan". It does not have to be known in this process.
            qos: The requested quality of service.
            max_bytes: The number of bytes to keep of each message.
            capacity: The number of messages that can be queued; further messages are dropped and counted.

        Raises:
            WireError: DDS cannot create the subscription.
        """
        name, type_name, entity = self._topic_of(topic, ros_type)
        data = endpoint_user_data(ros_type)
        native = _create(
            lambda: _core.Tap(self._native.entity, entity, native_qos(qos), data, max_bytes, capacity), topic
        )
        return BatchSubscription(native, node, name, type_name, qos)

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
        """Create a subscription of `node` that stores transforms in `buffer` on the DDS thread, without the GIL.

        Args:
            node: The node that owns the subscription.
            topic: The fully qualified name of the topic, such as "/tf".
            buffer: The buffer that stores the transforms.
            static: Whether the transforms are static.
            qos: The requested quality of service. If None, it is that of tf2's listener.
            authority: The source that the buffer records for the transforms. If None, it is the publishing node.
            renaming: The renaming of frames (see `coframe.frame_names.renaming`). If None, frames keep their names.
            on_data: An event that is set whenever a status changes, and by the next message after `TfReader.arm`.
            on_mismatch: The attribute of the reader; see `LocalEndpoint`.

        Raises:
            WireError: DDS cannot create the subscription.
        """
        chosen = qos or (TF_STATIC_READER if static else TF)
        name, type_name, entity = self._topic_of(topic, TF_MESSAGE)
        source = NO_AUTHORITY if authority is None else authority
        data = endpoint_user_data(TF_MESSAGE)
        native = _create(
            lambda: _core.TfReader(
                self._native.entity, entity, native_qos(chosen), data, buffer, static, source, renaming, on_data
            ),
            topic,
        )
        reader = TfReader(
            native,
            node,
            name,
            type_name,
            chosen,
            static=static,
            name_writers=authority is None,
            on_mismatch=on_mismatch,
        )
        reader.name_writers(self._graph)
        self._rejections.add(reader, buffer)
        return reader

    def _topic_of(self, topic: str, ros_type: str, kind: Kind = "topic") -> tuple[str, str, int]:
        """Return the name of the DDS topic, the name of its type, and its handle."""
        name, type_name = names.dds_topic(topic, kind), names.dds_type(ros_type)
        return name, type_name, self._topic(name, type_name)

    def _topic(self, name: str, type_name: str) -> int:
        """Create a topic for one endpoint, which releases it."""
        return types.create_topic(self._native.entity, name, type_name)


def native_qos(qos: QoS) -> _core.QosProfile:
    """Return the quality of service as the native code takes it."""
    return _core.QosProfile(
        qos.depth,
        qos.reliable,
        qos.transient_local,
        qos.keep_all,
        qos.manual_liveliness,
        qos.deadline,
        qos.lifespan,
        qos.lease,
    )


def _create(make: Callable[[], Any], topic: str) -> Any:
    try:
        return make()
    except _core.DdsError as error:
        raise WireError(
            f"DDS cannot create an endpoint on {topic}: {error}.", hint="Check that the participant is not closed."
        ) from error
