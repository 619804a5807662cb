"""The ROS graph as it is now: a connection, with subscriptions for as long as a display wants them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.viewer.displays import DISPLAYS
from coframe.viewer.messages import LiveMessages
from coframe.viewer.sources import Mode, Topic
from coframe.wire.qos import QoS

if TYPE_CHECKING:
    from coframe.wire.connection import Connection

__all__ = ["LiveSource"]

# What the viewer listens to besides what it displays.
OTHER_TYPES = ("std_msgs/msg/String",)
_KEEP_EVERYTHING = 60_000_000_000  # where the buffer has no end, messages have


class LiveSource:
    """A connection to the ROS graph.

    Args:
        connection: Its buffer is shown, and its node subscribes.
        own: Whether the connection is closed with the source.
    """

    mode: Mode = "live"
    span: tuple[int, int] | None = None

    def __init__(self, connection: Connection, *, own: bool = False) -> None:
        self._connection = connection
        self.connection: Connection | None = connection
        self.buffer = connection.buffer
        self.title = f"coframe: ROS domain {connection.participant.domain_id}"
        self._own = own

    def topics(self) -> list[Topic]:
        """What somebody publishes or wants, and a display can show."""
        found = self._connection.participant.topics()
        return [
            Topic(topic, ros_type, DISPLAYS[ros_type])
            for topic, ros_types in found.items()
            for ros_type in ros_types
            if ros_type in DISPLAYS
        ]

    def open(self, topic: str) -> LiveMessages | None:
        """Subscribes to a topic, such that every publisher of it that is there fits."""
        from coframe.messages import find  # noqa: PLC0415 - only who looks at messages needs them

        participant = self._connection.participant
        publishers = [one for one in participant.publishers(topic) if one.ros_type in {*DISPLAYS, *OTHER_TYPES}]
        if not publishers:
            return None
        ros_type = publishers[0].ros_type
        qos = QoS(
            depth=10,
            reliable=all(publisher.qos.reliable for publisher in publishers),
            transient_local=all(publisher.qos.transient_local for publisher in publishers),
        )
        subscription = participant.subscription(self._connection.node, topic, find(ros_type), qos)
        keep = self.buffer.cache_ns
        return LiveMessages(subscription, ros_type, keep if keep >= 0 else _KEEP_EVERYTHING)

    def close(self) -> None:
        """Leaves the graph, where that is the source's to do."""
        if self._own:
            self._connection.close()
