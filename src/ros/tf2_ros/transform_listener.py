# SPDX-License-Identifier: Apache-2.0
"""Listener that fills a buffer with received transforms."""

from collections.abc import Iterable
from threading import Thread
from typing import TYPE_CHECKING, Any, Optional, Union  # noqa: F401 - leaked upstream

import rclpy
import tf2_py as tf2
from coframe.frame_names import renaming
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile
from tf2_msgs.msg import TFMessage
from tf2_ros._rclpy_side import profile
from tf2_ros._renaming import rename_transforms
from tf2_ros._subscriptions import AUTHORITY, WIRES, Request, Topic
from tf2_ros._ways import open_subscriptions
from tf2_ros.buffer import Buffer, clear_on_time_jump
from tf2_ros.static_transform_broadcaster import DEFAULT_STATIC_TF_TOPIC
from tf2_ros.transform_broadcaster import DEFAULT_TF_TOPIC

_STATIC_QOS = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL, history=HistoryPolicy.KEEP_LAST)


class TransformListener:
    """Listener that subscribes to `/tf` and `/tf_static` and fills a buffer.

    Transforms are inserted natively: the node does not need to spin, and no Python code runs. `callback` and
    `static_callback` are called only if a subclass or an instance overrides the methods of the listener or the buffer.
    The buffer is filled as long as the node exists, even if there is no reference to the listener.

    Attributes:
        node: Node of the subscriptions.
        tf_sub: Subscription to `/tf`, or None if `static_only` is set.
        tf_static_sub: Subscription to `/tf_static`.
        group: Callback group of both subscriptions.
        executor: Executor that spins the node. It exists only with `spin_thread`.
        dedicated_listener_thread: Thread of the executor. It exists only with `spin_thread`.
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
        wire: str | None = None,
    ) -> None:
        """Create the subscriptions.

        Args:
            buffer: Buffer to fill.
            node: Node of the subscriptions. None: an internal node is created.
            spin_thread: Whether to spin the node in a separate thread. The buffer does not require this.
            qos: QoS profile of `/tf`, or its depth. Default: reliable with a depth of 100.
            static_qos: QoS profile of `/tf_static`, or its depth. Default: reliable and transient-local with a depth of
                100.
            tf_topic: Topic of the dynamic transforms.
            tf_static_topic: Topic of the static transforms.
            static_only: Whether to subscribe only to static transforms.
            prefix: Prefix of the frame names in the buffer, such as `robot1/`. No separator is added.
            keep: Frames without prefix, such as `["map"]`.
            wire: How transforms are received: "native", without an executor, or "rclpy", by subscriptions of the node,
                which must then be spun. Default: "native"; in a sourced ROS 2, see `coframe.ros2`.

        Raises:
            ValueError: `wire` has another value.
        """
        if wire not in {None, *WIRES}:
            raise ValueError(f"wire is {wire!r}. Valid values: {', '.join(WIRES)}.")
        self.__wire = wire
        self.__renaming = renaming(prefix, keep)
        self.node = node if node is not None else _create_internal_node(self)
        self.group = ReentrantCallbackGroup()
        self.__buffer = buffer
        self.__dynamic_topic = None if static_only else tf_topic
        self.__static_topic = tf_static_topic
        self.__qos = {
            False: profile(100 if qos is None else qos),
            True: profile(_STATIC_QOS if static_qos is None else static_qos),
        }
        self.__subscribe()
        # A buffer without a node uses the system clock. The clock of the listener's node may be simulated.
        self.__jump_handle = None
        if isinstance(buffer, Buffer) and buffer.clock is not self.node.get_clock():
            self.__jump_handle = clear_on_time_jump(buffer, self.node.get_clock())
        if spin_thread:
            self.executor = SingleThreadedExecutor(context=self.node.context)
            self.dedicated_listener_thread = Thread(target=self.__spin, daemon=True)
            self.dedicated_listener_thread.start()

    @property
    def buffer(self) -> tf2.BufferCore:
        """The buffer to fill. A new buffer receives the static transforms again."""
        return self.__buffer

    @buffer.setter
    def buffer(self, buffer: tf2.BufferCore) -> None:
        self.__buffer = buffer
        if self.__is_listening:
            previous = self.__subscriptions
            # The new subscriptions are created first, so that no message is lost in between.
            # A program replaces a buffer to forget transforms, so the new one must not contain those received before.
            self.__subscribe(shared=False)
            previous.close()

    def unregister(self) -> None:
        """Destroy the subscriptions. Repeated calls have no effect."""
        self.__is_listening = False
        self.__subscriptions.close()
        if self.__jump_handle is not None:
            self.__jump_handle.unregister()
            self.__jump_handle = None
        if hasattr(self, "executor"):
            self.executor.shutdown()

    def callback(self, data: TFMessage) -> None:
        """Insert the dynamic transforms of a message."""
        for transform in rename_transforms(data.transforms, self.__renaming):
            self.buffer.set_transform(transform, AUTHORITY)

    def static_callback(self, data: TFMessage) -> None:
        """Insert the static transforms of a message."""
        for transform in rename_transforms(data.transforms, self.__renaming):
            self.buffer.set_transform_static(transform, AUTHORITY)

    def __subscribe(self, *, shared: bool = True) -> None:
        self.__is_listening = True
        qos = self.__qos
        request = Request(
            self.node,
            self.__buffer,
            self.group,
            self.__renaming,
            None if self.__dynamic_topic is None else Topic(self.__dynamic_topic, qos[False], self.callback),
            Topic(self.__static_topic, qos[True], self.static_callback),
            shared,
            self.__wire,
            overridden=not self.__is_plain(),
        )
        self.__subscriptions = open_subscriptions(request)
        self.tf_sub, self.tf_static_sub = self.__subscriptions.dynamic, self.__subscriptions.static

    def __is_plain(self) -> bool:
        """Return whether no method on the path of the transforms into the buffer is overridden."""
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


def _create_internal_node(listener: TransformListener) -> Node:
    name = f"transform_listener_impl_{id(listener):010x}"
    return rclpy.create_node(name, start_parameter_services=False, enable_rosout=False)
