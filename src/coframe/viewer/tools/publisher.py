# SPDX-License-Identifier: Apache-2.0
"""Publish points, poses and static transforms from the viewer's node, like RViz's tools."""

from __future__ import annotations

import math
import re
import threading
import time
from collections import OrderedDict
from typing import TYPE_CHECKING, Any

from coframe.errors import ViewerError
from coframe.time import SECOND
from coframe.viewer.tools._graph_clock import GraphClock

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.connection.connection import Connection
    from coframe.connection.message_streams import MessagePublisher
    from coframe.viewer.protocol.client_messages import UseControl
    from coframe.wire.static_broadcaster import StaticBroadcaster

__all__ = ["ToolPublisher"]

_TOPIC = re.compile(r"(/[A-Za-z_][A-Za-z0-9_]*)+")
_MAX_TOPIC_LENGTH = 200
# Each pair of topic and type has a publisher, which is kept for the next message.
_MAX_PUBLISHERS = 16
# How long a new publisher waits for discovered subscriptions to match, in seconds.
_MATCH_TIMEOUT, _MATCH_STEP = 1.0, 0.01
_NORM_TOLERANCE = 1e-3
# The events of InteractiveMarkerFeedback.
_EVENTS = {"pose": 1, "menu": 2, "button": 3, "down": 4, "up": 5}


class ToolPublisher:
    """Publishes the messages of all pages' tools. Thread-safe.

    Args:
        connection: The connection whose node publishes.
    """

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._lock = threading.Lock()
        self._clock = GraphClock(connection)
        self._publishers: OrderedDict[tuple[str, str], MessagePublisher[Any]] = OrderedDict()
        self._statics: StaticBroadcaster | None = None

    def publish_point(self, topic: str, frame: str, point: Sequence[float]) -> int:
        """Publish a PointStamped with the current time.

        Args:
            topic: The topic to publish on.
            frame: The frame of the point.
            point: x, y and z in meters.

        Returns:
            The number of subscriptions that receive it.

        Raises:
            ViewerError: The topic is invalid.
            WireError: The message cannot be sent.
        """
        with self._lock:
            message = self._message("geometry_msgs/msg/PointStamped", frame)
            message.point.x, message.point.y, message.point.z = point
            return self._publish(topic, message)

    def publish_pose(
        self,
        topic: str,
        frame: str,
        position: Sequence[float],
        yaw: float,
        covariance: Sequence[float] | None = None,
    ) -> int:
        """Publish a PoseStamped, or a PoseWithCovarianceStamped if there is a covariance, with the current time.

        Args:
            topic: The topic to publish on.
            frame: The frame of the pose.
            position: x, y and z in meters.
            yaw: The rotation about z in radians.
            covariance: The variances of x and y in square meters and of yaw in square radians.

        Returns:
            The number of subscriptions that receive it.

        Raises:
            ViewerError: The topic is invalid.
            WireError: The message cannot be sent.
        """
        with self._lock:
            if covariance is None:
                message = self._message("geometry_msgs/msg/PoseStamped", frame)
                pose = message.pose
            else:
                message = self._message("geometry_msgs/msg/PoseWithCovarianceStamped", frame)
                pose = message.pose.pose
                for place, variance in zip((0, 7, 35), covariance, strict=True):  # of 6 x 6: x, y, z, roll, pitch, yaw
                    message.pose.covariance[place] = variance
            pose.position.x, pose.position.y, pose.position.z = position
            pose.orientation.z, pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
            return self._publish(topic, message)

    def publish_static(self, parent: str, child: str, translation: Sequence[float], quaternion: Sequence[float]) -> int:
        """Publish a static transform, which remains available to later subscribers while the viewer runs.

        Args:
            parent: The parent frame.
            child: The child frame.
            translation: x, y and z in meters.
            quaternion: x, y, z and w, normalized.

        Returns:
            The number of subscriptions that receive it.

        Raises:
            ViewerError: The quaternion is not normalized.
            WireError: The message cannot be sent.
        """
        norm = math.hypot(*quaternion)
        if abs(norm - 1.0) > _NORM_TOLERANCE:
            raise ViewerError(f"the quaternion has the norm {norm:.4g}, but must have 1")
        with self._lock:
            message = self._message("geometry_msgs/msg/TransformStamped", parent)
            message.child_frame_id = self._graph_frame_name(child)
            target, rotation = message.transform.translation, message.transform.rotation
            target.x, target.y, target.z = translation
            rotation.x, rotation.y, rotation.z, rotation.w = (part / norm for part in quaternion)
            if self._statics is None:
                connection = self._connection
                topic = connection.config.tf_static_topic
                self._statics = connection.participant.static_broadcaster(connection.node, topic)
            self._statics.send([message])
            return self._statics.matched

    def publish_feedback(self, topic: str, used: UseControl) -> int:
        """Publish the use of a control as InteractiveMarkerFeedback, and return the number of subscriptions.

        Raises:
            ViewerError: The topic or the quaternion is invalid.
            WireError: The message cannot be sent.
        """
        norm = math.hypot(*used.quaternion)
        if abs(norm - 1.0) > _NORM_TOLERANCE:
            raise ViewerError(f"the quaternion has the norm {norm:.4g}, but must have 1")
        with self._lock:
            message = self._message("visualization_msgs/msg/InteractiveMarkerFeedback", "")
            message.header.frame_id = used.frame
            message.client_id = f"{self._connection.node.name}/{used.id}"
            message.marker_name, message.control_name = used.marker, used.control
            message.event_type = _EVENTS[used.event]
            message.menu_entry_id = used.menu
            position, orientation = message.pose.position, message.pose.orientation
            position.x, position.y, position.z = used.position
            orientation.x, orientation.y, orientation.z, orientation.w = (part / norm for part in used.quaternion)
            if used.point is not None:
                message.mouse_point_valid = True
                message.mouse_point.x, message.mouse_point.y, message.mouse_point.z = used.point
            return self._publish(topic, message)

    def close(self) -> None:
        """Remove all publishers."""
        with self._lock:
            for publisher in self._publishers.values():
                publisher.close()
            self._publishers.clear()
            if self._statics is not None:
                self._statics.close()
            self._clock.close()

    def _message(self, ros_type: str, frame: str) -> Any:
        # Imported here because only publishing needs the message classes.
        from coframe.messages import find  # noqa: PLC0415

        message: Any = find(ros_type)()
        message.header.frame_id = self._graph_frame_name(frame)
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(self._clock.now(), SECOND)
        return message

    def _graph_frame_name(self, frame: str) -> str:
        """Return the name of a frame on the graph, without the prefix used in the buffer."""
        return frame.removeprefix(self._connection.config.prefix)

    def _publish(self, topic: str, message: Any) -> int:
        if len(topic) > _MAX_TOPIC_LENGTH or not _TOPIC.fullmatch(topic):
            raise ViewerError(
                f"{topic[:60]!r} is not a valid topic name",
                hint="Write it as /name or /namespace/name with letters, digits and underscores.",
            )
        key = (topic, type(message).__name__)
        publisher = self._publishers.get(key)
        if publisher is None:
            publisher = self._publishers[key] = self._connection.publisher(topic, type(message))
            self._wait_for_subscriptions(topic, publisher)
        self._publishers.move_to_end(key)
        while len(self._publishers) > _MAX_PUBLISHERS:
            self._publishers.popitem(last=False)[1].close()
        publisher.publish(message)
        return publisher.matched

    def _wait_for_subscriptions(self, topic: str, publisher: MessagePublisher[Any]) -> None:
        """Wait until the known subscriptions have matched: a new publisher cannot reach them earlier."""
        deadline = time.monotonic() + _MATCH_TIMEOUT
        expected = len(self._connection.participant.subscribers(topic))
        while publisher.matched < expected and time.monotonic() < deadline:
            time.sleep(_MATCH_STEP)
