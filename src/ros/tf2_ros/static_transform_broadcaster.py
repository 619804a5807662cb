"""Sending transforms that hold for ever."""

from collections.abc import Iterable
from copy import deepcopy

from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from rclpy.qos import QoSProfile
from tf2_msgs.msg import TFMessage
from tf2_ros.transform_broadcaster import as_list

DEFAULT_STATIC_TF_TOPIC = "/tf_static"


class StaticPublisher:
    """Publishes on the static writer that this process has on a topic.

    What is published there joins what any broadcaster of the process published before: a depth-1 subscription hears
    one message only, so it has to hold everything.

    Attributes:
        topic_name: The topic, fully qualified.
    """

    def __init__(self, node: Node, topic: str) -> None:
        self.topic_name = node.resolve_topic_name(topic)
        self._node = node
        self._writer = node._wire.static_broadcaster(node._graph_node, self.topic_name)  # noqa: SLF001 - same house

    def publish(self, msg: TFMessage) -> None:
        """Publish static transforms, together with the earlier ones of this process."""
        self._writer.send(msg.transforms)

    def get_subscription_count(self) -> int:
        """How many subscriptions the topic has."""
        return self._node.count_subscribers(self.topic_name)

    def destroy(self) -> None:
        """Leave the topic; what was published stays as long as another broadcaster of the process is there."""
        self._writer.close()


class StaticTransformBroadcaster:
    """Publishes static transforms on `/tf_static`, all it ever sent in every message.

    Attributes:
        pub_tf: The publisher.
        net_message: What was sent so far; one transform per child frame.
    """

    def __init__(
        self, node: Node, qos: QoSProfile | int | None = None, *, tf_static_topic: str = DEFAULT_STATIC_TF_TOPIC
    ) -> None:
        """Create the publisher.

        Args:
            node: The node that publishes.
            qos: Quality of service of a publisher of its own; by default all broadcasters of the process share one,
                reliable and transient-local with a depth of 1.
            tf_static_topic: Topic to publish on.
        """
        self.pub_tf = (
            StaticPublisher(node, tf_static_topic)
            if qos is None
            else node.create_publisher(TFMessage, tf_static_topic, qos)
        )
        self.net_message = TFMessage()

    def sendTransform(self, transform: TransformStamped | Iterable[TransformStamped]) -> None:
        """Publish one transform or several together with all earlier ones; the last word on a child frame holds."""
        transforms = {known.child_frame_id: known for known in self.net_message.transforms}
        # Copies: callers fill the same message again for their next frame.
        transforms.update((new.child_frame_id, deepcopy(new)) for new in as_list(transform))
        self.net_message.transforms = list(transforms.values())
        self.pub_tf.publish(self.net_message)
