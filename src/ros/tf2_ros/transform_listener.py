"""Filling a buffer with the transforms that arrive."""

# ruff: noqa: SLF001 - rclpy's nodes and tf2's buffers let this listener in, so that Python need not run

import threading
from typing import Any

import rclpy
import tf2_py as tf2
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, qos_from
from tf2_msgs.msg import TFMessage
from tf2_ros.buffer import Buffer, clear_on_time_jump
from tf2_ros.static_transform_broadcaster import DEFAULT_STATIC_TF_TOPIC
from tf2_ros.transform_broadcaster import DEFAULT_TF_TOPIC

_AUTHORITY = "default_authority"
_STATIC_QOS = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL, history=HistoryPolicy.KEEP_LAST)


class NativeSubscription:
    """A subscription whose messages go into a buffer without passing through Python.

    Attributes:
        topic_name: The topic, fully qualified.
        qos_profile: What was asked for.
    """

    def __init__(self, node: Node, topic: str, qos: QoSProfile, buffer: tf2.BufferCore, *, static: bool) -> None:
        self.topic_name = node.resolve_topic_name(topic)
        self.qos_profile = qos
        self._reader = node._wire.tf_reader(
            node._graph_node,
            self.topic_name,
            buffer._buffer,
            static=static,
            qos=qos._to_wire(),
            authority=_AUTHORITY,
        )

    def get_publisher_count(self) -> int:
        """How many publishers were found."""
        return int(self._reader.matched)

    def destroy(self) -> None:
        """Leave the topic; doing so twice does no harm."""
        self._reader.close()


class TransformListener:
    """Subscribes to `/tf` and `/tf_static` and fills a buffer.

    Transforms go from the wire straight into the buffer: the node need not spin, and no Python runs for them. They go
    through `callback` and `static_callback` only where someone changed what a buffer or a listener does with them. The
    buffer is filled as long as the node lives, also if nobody keeps the listener.

    Attributes:
        node: The node that subscribes.
        tf_sub: The subscription to `/tf`; None if only static transforms are listened to.
        tf_static_sub: The subscription to `/tf_static`.
        group: The callback group of subscriptions that go through Python.
        executor: Spins the node in `dedicated_listener_thread`, if asked for with `spin_thread`.
    """

    def __init__(
        self,
        buffer: tf2.BufferCore,
        node: Node | None = None,
        *,
        spin_thread: bool = False,
        qos: QoSProfile | int | None = None,
        static_qos: QoSProfile | int | None = None,
        tf_topic: str = DEFAULT_TF_TOPIC,
        tf_static_topic: str = DEFAULT_STATIC_TF_TOPIC,
        static_only: bool = False,
    ) -> None:
        """Start listening.

        Args:
            buffer: The buffer to fill.
            node: The node that subscribes; a hidden one is created if there is none.
            spin_thread: Spin the node in a thread of its own. The buffer does not need that.
            qos: Quality of service for `/tf`; reliable with a depth of 100 by default.
            static_qos: Quality of service for `/tf_static`; the same and transient-local by default.
            tf_topic: Topic of the transforms that change.
            tf_static_topic: Topic of the static transforms.
            static_only: Leave the transforms that change alone.
        """
        self.node = node if node is not None else _hidden_node(self)
        self.group = ReentrantCallbackGroup()
        self._buffer = buffer
        self._topics = {True: tf_static_topic} if static_only else {False: tf_topic, True: tf_static_topic}
        self._qos = {
            False: qos_from(100 if qos is None else qos),
            True: qos_from(_STATIC_QOS if static_qos is None else static_qos),
        }
        self._subscribe()
        # A buffer without a node of its own knows no simulated time; this listener's node does.
        self._jump_handle = None
        if isinstance(buffer, Buffer) and buffer.clock is not self.node.get_clock():
            self._jump_handle = clear_on_time_jump(buffer, self.node.get_clock())
        if spin_thread:
            self.executor = SingleThreadedExecutor(context=self.node.context)
            self.dedicated_listener_thread = threading.Thread(target=self._spin, daemon=True)
            self.dedicated_listener_thread.start()

    @property
    def buffer(self) -> tf2.BufferCore:
        """The buffer to fill; another one may be put in its place."""
        return self._buffer

    @buffer.setter
    def buffer(self, buffer: tf2.BufferCore) -> None:
        self._buffer = buffer
        self._unsubscribe()
        self._subscribe()

    def unregister(self) -> None:
        """Stop listening; doing so twice does no harm."""
        self._unsubscribe()
        if self._jump_handle is not None:
            self._jump_handle.unregister()
            self._jump_handle = None
        if hasattr(self, "executor"):
            self.executor.shutdown()

    def callback(self, data: TFMessage) -> None:
        """Take in transforms that change."""
        for transform in data.transforms:
            self.buffer.set_transform(transform, _AUTHORITY)

    def static_callback(self, data: TFMessage) -> None:
        """Take in static transforms."""
        for transform in data.transforms:
            self.buffer.set_transform_static(transform, _AUTHORITY)

    def _subscribe(self) -> None:
        self.tf_sub = self._listen(static=False) if False in self._topics else None
        self.tf_static_sub = self._listen(static=True)

    def _listen(self, *, static: bool) -> Any:
        topic, qos = self._topics[static], self._qos[static]
        if self._is_plain():
            return NativeSubscription(self.node, topic, qos, self._buffer, static=static)
        callback = self.static_callback if static else self.callback
        return self.node.create_subscription(TFMessage, topic, callback, qos, callback_group=self.group)

    def _unsubscribe(self) -> None:
        for subscription in (self.tf_sub, self.tf_static_sub):
            if isinstance(subscription, NativeSubscription):
                subscription.destroy()
            elif subscription is not None:
                self.node.destroy_subscription(subscription)
        self.tf_sub = self.tf_static_sub = None

    def _is_plain(self) -> bool:
        """Whether nobody wants to see the transforms on their way into the buffer."""
        ours: type[Any] = type(self)
        theirs: type[Any] = type(self._buffer)
        return (
            ours.callback is TransformListener.callback
            and ours.static_callback is TransformListener.static_callback
            and issubclass(theirs, tf2.BufferCore)
            and theirs.set_transform in {Buffer.set_transform, tf2.BufferCore.set_transform}
            and theirs.set_transform_static in {Buffer.set_transform_static, tf2.BufferCore.set_transform_static}
        )

    def _spin(self) -> None:
        try:
            self.executor.add_node(self.node)
            self.executor.spin()
        except ExternalShutdownException:
            pass
        finally:
            self.executor.remove_node(self.node)


def _hidden_node(listener: TransformListener) -> Node:
    name = f"transform_listener_impl_{id(listener):010x}"
    return rclpy.create_node(name, start_parameter_services=False, enable_rosout=False)
