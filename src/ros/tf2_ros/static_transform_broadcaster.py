"""Sending transforms that hold for ever."""

# ruff: noqa: SLF001 - rclpy's nodes let this broadcaster in, so that those of a process share one DDS writer

from collections.abc import Iterable
from copy import deepcopy
from typing import List, Optional, Union  # noqa: F401, UP035 - leaked upstream

from coframe.frame_names import renaming
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, as_qos_profile
from tf2_msgs.msg import TFMessage
from tf2_ros._renaming import renamed
from tf2_ros.transform_broadcaster import as_list

DEFAULT_STATIC_TF_TOPIC = "/tf_static"


class StaticTransformBroadcaster:
    """Publishes static transforms on `/tf_static`, all it ever sent in every message.

    A late subscription hears a writer's last message only. By default all broadcasters of the process share one writer,
    and what one of them publishes goes out together with what the others did.

    Attributes:
        pub_tf: The publisher.
        net_message: What was sent so far; one transform per child frame. Taking one out and publishing the rest with
            `pub_tf` ends it for those who come later.
    """

    def __init__(
        self,
        node: Node,
        qos: QoSProfile | int | None = None,
        *,
        tf_static_topic: str = DEFAULT_STATIC_TF_TOPIC,
        prefix: str = "",
        keep: Iterable[str] = (),
    ) -> None:
        """Create the publisher.

        Args:
            node: The node that publishes.
            qos: Quality of service of a publisher of its own; by default all broadcasters of the process share one,
                reliable and transient-local with a depth of 1.
            tf_static_topic: Topic to publish on.
            prefix: Goes in front of the names of frames as it is, such as `robot1/`.
            keep: Frames that get no prefix, such as `["map"]`.
        """
        self._renaming = renaming(prefix, keep)
        self.pub_tf = _shared_publisher(node, tf_static_topic) if qos is None else _own(node, tf_static_topic, qos)
        self.net_message = TFMessage()
        self._child_frame_ids: set[str] = set()

    def sendTransform(self, transform: TransformStamped | Iterable[TransformStamped]) -> None:
        """Publish one transform or several together with all earlier ones; the last word on a child frame holds."""
        transforms = {known.child_frame_id: known for known in self.net_message.transforms}
        # Copies: callers fill the same message again for their next frame.
        added = renamed(as_list(transform), self._renaming)
        transforms.update((new.child_frame_id, deepcopy(new)) for new in added)
        self.net_message.transforms = list(transforms.values())
        self._child_frame_ids = set(transforms)
        self.pub_tf.publish(self.net_message)


def _shared_publisher(node: Node, topic: str) -> Publisher:
    qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL, history=HistoryPolicy.KEEP_LAST)
    name = node.resolve_topic_name(topic)
    writer = node._participant.static_broadcaster(node._graph_node, name)
    return node._add_entity(Publisher(writer, TFMessage, name, qos, node.context))


def _own(node: Node, topic: str, qos: QoSProfile | int) -> Publisher:
    return node.create_publisher(TFMessage, topic, as_qos_profile(qos))
