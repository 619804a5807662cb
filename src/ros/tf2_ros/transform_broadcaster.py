"""Sending transforms that change over time."""

from collections.abc import Iterable
from typing import List, Optional, Union  # noqa: F401, UP035 - leaked upstream

from coframe.frame_names import renaming
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from rclpy.qos import QoSProfile
from tf2_msgs.msg import TFMessage
from tf2_ros._renaming import renamed

DEFAULT_TF_TOPIC = "/tf"


class TransformBroadcaster:
    """Publishes transforms on `/tf`.

    Attributes:
        pub_tf: The publisher.
    """

    def __init__(
        self,
        node: Node,
        qos: QoSProfile | int | None = None,
        *,
        tf_topic: str = DEFAULT_TF_TOPIC,
        prefix: str = "",
        keep: Iterable[str] = (),
    ) -> None:
        """Create the publisher.

        Args:
            node: The node that publishes.
            qos: Quality of service; reliable with a depth of 100 by default.
            tf_topic: Topic to publish on.
            prefix: Goes in front of the names of frames as it is, such as `robot1/`.
            keep: Frames that get no prefix, such as `["map"]`.
        """
        self._renaming = renaming(prefix, keep)
        if qos is None:
            qos = QoSProfile(depth=100)
        self.pub_tf = node.create_publisher(TFMessage, tf_topic, qos)

    def sendTransform(self, transform: TransformStamped | Iterable[TransformStamped]) -> None:
        """Publish one transform or several, in one message."""
        self.pub_tf.publish(TFMessage(transforms=renamed(as_list(transform), self._renaming)))


def as_list(transform: TransformStamped | Iterable[TransformStamped]) -> list[TransformStamped]:
    """One transform or several, as a list."""
    return list(transform) if isinstance(transform, Iterable) else [transform]
