# SPDX-License-Identifier: Apache-2.0
"""The part of tf2_ros that the lab needs, on top of the sourced rclpy and of coframe's buffer.

For a ROS 2 that has rclpy but no tf2. As in ROS 2, the subscriptions of a listener are callbacks of its node: a lookup
that waits in a callback of a single-threaded executor receives nothing.
"""

import time
from threading import Thread

import coframe
from coframe.errors import ConnectivityException, ExtrapolationException, LookupException, TransformException
from geometry_msgs.msg import TransformStamped
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from tf2_msgs.msg import TFMessage

__all__ = [
    "Buffer",
    "ConnectivityException",
    "ExtrapolationException",
    "LookupException",
    "StaticTransformBroadcaster",
    "TransformBroadcaster",
    "TransformException",
    "TransformListener",
]

_LATCHED = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class TransformBroadcaster:
    def __init__(self, node, topic="/tf", qos=100):
        self._publisher = node.create_publisher(TFMessage, topic, qos)

    def sendTransform(self, transform):  # noqa: N802 - its name in ROS 2
        transforms = list(transform) if isinstance(transform, (list, tuple)) else [transform]
        self._publisher.publish(TFMessage(transforms=transforms))


class StaticTransformBroadcaster(TransformBroadcaster):
    def __init__(self, node):
        super().__init__(node, "/tf_static", _LATCHED)
        self._sent = {}

    def sendTransform(self, transform):  # noqa: N802 - its name in ROS 2
        transforms = transform if isinstance(transform, (list, tuple)) else [transform]
        self._sent.update((each.child_frame_id, each) for each in transforms)
        super().sendTransform(list(self._sent.values()))


class Buffer:
    def __init__(self, cache_time=None):
        self._buffer = coframe.Buffer() if cache_time is None else coframe.Buffer(cache_time.nanoseconds)

    def set_transform(self, message, _authority, *, static=False):
        move, turn = message.transform.translation, message.transform.rotation
        pose = coframe.Transform([move.x, move.y, move.z], [turn.x, turn.y, turn.z, turn.w])
        stamp = Time.from_msg(message.header.stamp).nanoseconds
        self._buffer.set(message.header.frame_id, message.child_frame_id, pose, stamp, static=static)

    def lookup_transform(self, target, source, when, timeout=Duration()):  # noqa: B008 - as in ROS 2
        return self.lookup_transform_full(target, when, source, when, None, timeout)

    def lookup_transform_full(self, target, target_time, source, source_time, fixed, timeout=Duration()):  # noqa: B008
        deadline = time.monotonic() + timeout.nanoseconds / 1e9
        while True:
            try:
                if fixed is None:
                    found = self._buffer.lookup(target, source, target_time.nanoseconds)
                else:
                    then = self._buffer.lookup(fixed, source, source_time.nanoseconds)
                    found = self._buffer.lookup(target, fixed, target_time.nanoseconds) @ then
                break
            except TransformException:
                if time.monotonic() >= deadline:
                    raise
                time.sleep(0.02)
        message = TransformStamped(child_frame_id=source)
        message.header.frame_id = target
        stamp = target_time.nanoseconds or found.stamp
        message.header.stamp = Time(nanoseconds=stamp).to_msg()
        move, turn = message.transform.translation, message.transform.rotation
        move.x, move.y, move.z = found.translation.tolist()
        turn.x, turn.y, turn.z, turn.w = found.quaternion.tolist()
        return message


class TransformListener:
    def __init__(self, buffer, node, *, spin_thread=False):
        group = ReentrantCallbackGroup()
        for topic, qos, static in (("/tf", 100, False), ("/tf_static", _LATCHED, True)):

            def store(message, static=static):
                for each in message.transforms:
                    buffer.set_transform(each, "listener", static=static)

            node.create_subscription(TFMessage, topic, store, qos, callback_group=group)
        if spin_thread:
            self.executor = SingleThreadedExecutor()
            self.executor.add_node(node)
            Thread(target=self.executor.spin, daemon=True).start()
