"""The ROS graph as it is now: a connection, with subscriptions for as long as a display wants them."""

from __future__ import annotations

import time
import weakref
from typing import TYPE_CHECKING

from coframe.viewer.displays import DISPLAYS
from coframe.viewer.sources.adaptive_subscription import AdaptiveSubscription
from coframe.viewer.sources.messages import LiveMessages
from coframe.viewer.sources.source import Mode, Topic

if TYPE_CHECKING:
    from collections.abc import Generator

    from coframe.connection import Connection
    from coframe.doctor import Report
    from coframe.wire.endpoints import Subscription
    from coframe.wire.qos import QoS

__all__ = ["LiveSource"]

# What the viewer listens to besides what it displays.
OTHER_TYPES = ("std_msgs/msg/String",)
_TYPES = frozenset({*DISPLAYS, *OTHER_TYPES})
# The doctor looks at the last seconds, and says something after some of them: half a window may look like a fault.
_WINDOW = 10_000_000_000
_FIRST_VERDICT, _VERDICT_PERIOD = 5.0, 2.0
# Its verdicts, without the listening, take at most this part of a processor.
_SHARE = 0.01
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
        self._subscriptions: weakref.WeakSet[AdaptiveSubscription] = weakref.WeakSet()

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
        """Subscribes to a topic, such that every publisher of it is heard."""
        from coframe.messages import find  # noqa: PLC0415 - only who looks at messages needs them

        participant = self._connection.participant
        ros_type = next((one.ros_type for one in participant.publishers(topic) if one.ros_type in _TYPES), None)
        if ros_type is None:
            return None

        def offers() -> list[QoS]:
            return [one.qos for one in participant.publishers(topic) if one.ros_type == ros_type]

        def subscribe(qos: QoS) -> Subscription:
            return participant.subscription(self._connection.node, topic, find(ros_type), qos, adapts=True)

        subscription = AdaptiveSubscription(offers, subscribe)
        self._subscriptions.add(subscription)
        keep = self.buffer.cache_ns
        keep = keep if keep >= 0 else _KEEP_EVERYTHING
        return LiveMessages(subscription, ros_type, keep, self._connection.frame)

    def refresh(self) -> None:
        """Listens to publishers that have come since, too."""
        for subscription in list(self._subscriptions):
            subscription.follow()

    def examine(self) -> Generator[dict[str, Report] | None, None, None]:
        """A running verdict, as `coframe doctor --watch` has it.

        Raises:
            WireError: The graph cannot be joined once more.
        """
        from coframe.doctor import diagnose  # noqa: PLC0415 - the first picture needs no doctor
        from coframe.doctor.live import LiveObserver  # noqa: PLC0415 - likewise

        tf_topic, tf_static_topic = self._connection.tf_topics
        with LiveObserver(
            self._connection.participant.domain_id,
            window=_WINDOW,
            tf_topic=tf_topic,
            tf_static_topic=tf_static_topic,
            node_name="coframe_view_doctor",
            prefix=self._connection.prefix,
            keep=self._connection.keep,
        ) as listening:
            due = time.monotonic() + _FIRST_VERDICT
            while True:
                listening.poll()
                if time.monotonic() < due:
                    yield None
                    continue
                begin = time.thread_time()
                report = diagnose(listening.observe())
                due = time.monotonic() + max(_VERDICT_PERIOD, (time.thread_time() - begin) / _SHARE)
                yield {"": report}

    def close(self) -> None:
        """Leaves the graph, where that is the source's to do."""
        if self._own:
            self._connection.close()
