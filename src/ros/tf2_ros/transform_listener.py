"""Filling a buffer with the transforms that arrive."""

# ruff: noqa: SLF001 - rclpy's nodes and tf2's buffers let this listener in, so that Python need not run

from collections.abc import Iterable
from threading import Thread
from typing import Any, Optional, Union  # noqa: F401 - leaked upstream

import rclpy
import tf2_py as tf2
from coframe.frame_names import renaming
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, as_qos_profile
from rclpy.subscription import Subscription
from tf2_msgs.msg import TFMessage
from tf2_ros._renaming import renamed
from tf2_ros.buffer import Buffer, clear_on_time_jump
from tf2_ros.static_transform_broadcaster import DEFAULT_STATIC_TF_TOPIC
from tf2_ros.transform_broadcaster import DEFAULT_TF_TOPIC

_AUTHORITY = "default_authority"
_STATIC_QOS = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL, history=HistoryPolicy.KEEP_LAST)


class TransformListener:
    """Subscribes to `/tf` and `/tf_static` and fills a buffer.

    Transforms go from the wire straight into the buffer: the node need not spin, and no Python runs for them. They go
    through `callback` and `static_callback` only where someone changed what a buffer or a listener does with them. The
    buffer is filled as long as the node lives, also if nobody keeps the listener.

    Attributes:
        node: The node that subscribes.
        tf_sub: The subscription to `/tf`; None if only static transforms are listened to.
        tf_static_sub: The subscription to `/tf_static`.
        group: The callback group of both.
        executor: Spins the node, if asked for with `spin_thread`; not there otherwise.
        dedicated_listener_thread: The thread that does; not there otherwise.
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
        prefix: str = "",
        keep: Iterable[str] = (),
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
            prefix: Goes in front of the names of frames in the buffer as it is, such as `robot1/`.
            keep: Frames that get no prefix, such as `["map"]`.
        """
        self.__renaming = renaming(prefix, keep)
        self.node = node if node is not None else _hidden_node(self)
        self.group = ReentrantCallbackGroup()
        self.__buffer = buffer
        self.__topics = {True: tf_static_topic} if static_only else {False: tf_topic, True: tf_static_topic}
        self.__qos = {
            False: as_qos_profile(100 if qos is None else qos),
            True: as_qos_profile(_STATIC_QOS if static_qos is None else static_qos),
        }
        self.__arrivals: _Arrivals | None = None
        self.__subscribe()
        # A buffer without a node of its own knows no simulated time; this listener's node does.
        self.__jump_handle = None
        if isinstance(buffer, Buffer) and buffer.clock is not self.node.get_clock():
            self.__jump_handle = clear_on_time_jump(buffer, self.node.get_clock())
        if spin_thread:
            self.executor = SingleThreadedExecutor(context=self.node.context)
            self.dedicated_listener_thread = Thread(target=self.__spin, daemon=True)
            self.dedicated_listener_thread.start()

    @property
    def buffer(self) -> tf2.BufferCore:
        """The buffer to fill; another one may be put in its place, and is told the static transforms anew."""
        return self.__buffer

    @buffer.setter
    def buffer(self, buffer: tf2.BufferCore) -> None:
        self.__buffer = buffer
        if self.__is_listening:
            former = (self.tf_sub, self.tf_static_sub)
            # The new subscriptions first, so that nothing falls in between.
            self.__subscribe()
            self.__end(former)

    def unregister(self) -> None:
        """Stop listening; doing so twice does no harm."""
        self.__is_listening = False
        self.__end((self.tf_sub, self.tf_static_sub))
        self.__count_arrivals(None)
        if self.__jump_handle is not None:
            self.__jump_handle.unregister()
            self.__jump_handle = None
        if hasattr(self, "executor"):
            self.executor.shutdown()

    def callback(self, data: TFMessage) -> None:
        """Take in transforms that change."""
        for transform in renamed(data.transforms, self.__renaming):
            self.buffer.set_transform(transform, _AUTHORITY)

    def static_callback(self, data: TFMessage) -> None:
        """Take in static transforms."""
        for transform in renamed(data.transforms, self.__renaming):
            self.buffer.set_transform_static(transform, _AUTHORITY)

    def __subscribe(self) -> None:
        self.__is_listening = True
        is_plain = self.__is_plain()
        listen = self.__listen_natively if is_plain else self.__listen
        self.__count_arrivals(_Arrivals(self.__buffer) if is_plain else None)
        self.tf_sub = listen(static=False) if False in self.__topics else None
        self.tf_static_sub = listen(static=True)

    def __listen(self, *, static: bool) -> Subscription:
        callback = self.static_callback if static else self.callback
        return self.node.create_subscription(
            TFMessage, self.__topics[static], callback, self.__qos[static], callback_group=self.group
        )

    def __listen_natively(self, *, static: bool) -> Subscription:
        """A subscription whose messages go into the buffer without passing through Python."""
        topic, qos = self.node.resolve_topic_name(self.__topics[static]), self.__qos[static]
        reader = self.node._participant.tf_reader(
            self.node._graph_node,
            topic,
            self.__buffer._coframe_buffer,
            static=static,
            qos=qos._to_wire(),
            authority=_AUTHORITY,
            renaming=self.__renaming,
        )
        callback = self.static_callback if static else self.callback
        return self.node._add_entity(Subscription(reader, TFMessage, topic, callback, self.group, qos, raw=False))

    def __end(self, subscriptions: tuple[Subscription | None, ...]) -> None:
        for subscription in subscriptions:
            if subscription is not None:
                self.node.destroy_subscription(subscription)

    def __count_arrivals(self, arrivals: "_Arrivals | None") -> None:
        if self.__arrivals is not None:
            self.node._polled_subscriptions.remove(self.__arrivals)
        if arrivals is not None:
            self.node._polled_subscriptions.append(arrivals)
        self.__arrivals = arrivals

    def __is_plain(self) -> bool:
        """Return whether nobody wants to see the transforms on their way into the buffer."""
        ours: type[Any] = type(self)
        theirs: type[Any] = type(self.__buffer)
        return (
            ours.callback is TransformListener.callback
            and ours.static_callback is TransformListener.static_callback
            and issubclass(theirs, tf2.BufferCore)
            and theirs.set_transform in {Buffer.set_transform, tf2.BufferCore.set_transform}
            and theirs.set_transform_static in {Buffer.set_transform_static, tf2.BufferCore.set_transform_static}
            and vars(self.__buffer).keys().isdisjoint({"set_transform", "set_transform_static"})
        )

    def __spin(self) -> None:
        try:
            self.executor.add_node(self.node)
            self.executor.spin()
        except ExternalShutdownException:
            pass
        finally:
            self.executor.remove_node(self.node)


class _Arrivals:
    """The messages that a buffer is given natively, told to `spin_once`, one by one."""

    # More would not wait for an executor either.
    _DEPTH = 100

    def __init__(self, buffer: tf2.BufferCore) -> None:
        self._buffer = buffer._coframe_buffer
        self._told = self._count()

    def _count(self) -> int:
        return self._buffer.statistics["messages"]

    def _take_one(self) -> bool:
        count = self._count()
        self._told = max(self._told, count - self._DEPTH)
        if self._told == count:
            return False
        self._told += 1
        return True


def _hidden_node(listener: TransformListener) -> Node:
    name = f"transform_listener_impl_{id(listener):010x}"
    return rclpy.create_node(name, start_parameter_services=False, enable_rosout=False)
