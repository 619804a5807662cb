# SPDX-License-Identifier: Apache-2.0
"""Listener for static transforms."""

import tf2_py as tf2
from rclpy.node import Node
from rclpy.qos import QoSProfile
from tf2_ros.static_transform_broadcaster import DEFAULT_STATIC_TF_TOPIC
from tf2_ros.transform_listener import TransformListener


class StaticTransformListener(TransformListener):
    """Listener that fills a buffer from `/tf_static` only, for programs that need no dynamic transforms."""

    def __init__(
        self,
        buffer: tf2.BufferCore,
        node: Node | None = None,
        *,
        spin_thread: bool = False,
        static_qos: QoSProfile | int | None = None,
        tf_static_topic: str = DEFAULT_STATIC_TF_TOPIC,
    ) -> None:
        """Create the subscription. The arguments are the same as for `TransformListener`."""
        super().__init__(
            buffer,
            node,
            spin_thread=spin_thread,
            static_qos=static_qos,
            tf_static_topic=tf_static_topic,
            static_only=True,
        )
