# SPDX-License-Identifier: Apache-2.0
"""The ROS graph as a source: a connection, with a subscription for each displayed topic."""

from __future__ import annotations

import time
import weakref
from typing import TYPE_CHECKING, Any

from coframe._output.formatting import duration
from coframe.time import MINUTE, SECOND
from coframe.viewer.sources._sim_time import SimTime
from coframe.viewer.sources._time_jumps import TransformStamps
from coframe.viewer.sources.adaptive_subscription import AdaptiveSubscription
from coframe.viewer.sources.requested_quality import AUTOMATIC, RequestedQuality
from coframe.viewer.sources.topic_messages import LiveMessages
from coframe.viewer.sources.topic_names import NodeName, resolve_topic

if TYPE_CHECKING:
    from collections.abc import Callable, Generator

    from coframe.bags import Recording
    from coframe.connection.connection import Connection
    from coframe.doctor import Report
    from coframe.viewer.protocol.common import ClockState
    from coframe.viewer.sources.source import Mode
    from coframe.wire.endpoints import Subscription
    from coframe.wire.qos import QoS

__all__ = ["LiveSource"]

# The doctor examines the last ten seconds. The first report is delayed, because half a window may look like a fault.
_WINDOW = 10 * SECOND
_FIRST_REPORT, _REPORT_PERIOD = 5.0, 2.0
# The maximum share of a processor for the doctor's reports, not counting its subscriptions.
_SHARE = 0.01
DOCTOR_NODE = "coframe_view_doctor"
_DAY = 24 * 60 * MINUTE
# How long messages are kept if the buffer has no cache length.
_KEEP_IF_UNLIMITED = MINUTE


class LiveSource:
    """A connection to the ROS graph as a source.

    Args:
        connection: The connection whose buffer is shown and whose node subscribes.
        own: Whether closing the source also closes the connection.
        use_sim_time: Whether the clock is that of /clock; None follows /clock when a node publishes it.
    """

    mode: Mode = "live"
    recording: Recording | None = None
    span: tuple[int, int] | None = None

    def __init__(self, connection: Connection, *, own: bool = False, use_sim_time: bool | None = None) -> None:
        self._connection = connection
        self.connection: Connection | None = connection
        self.buffer = connection.buffer
        self.title = f"coframe: ROS domain {connection.participant.domain_id}"
        self.node = NodeName(connection.node.namespace, connection.node.name)
        self._owns_connection = own
        self._subscriptions: weakref.WeakSet[AdaptiveSubscription] = weakref.WeakSet()
        self._sim_time = SimTime(connection, follow=use_sim_time)
        self._stamps = TransformStamps(connection)

    def topics(self) -> list[tuple[str, str]]:
        """Return the topics with a publisher or subscriber, with their types."""
        found = self._connection.participant.topics()
        return [(topic, ros_type) for topic, ros_types in found.items() for ros_type in ros_types]

    def resolve(self, topic: str) -> str:
        """Return the full name of a topic."""
        return resolve_topic(topic, self.node)

    def open(self, topic: str, quality: RequestedQuality = AUTOMATIC) -> LiveMessages | None:
        """Subscribe to a topic so that messages of all its publishers are received."""
        participant = self._connection.participant
        types = (one.ros_type for one in participant.publishers(topic))
        known = ((ros_type, cls) for ros_type in types if (cls := _message_class(ros_type)) is not None)
        ros_type, message_class = next(known, ("", None))
        if message_class is None:
            return None

        def offers() -> list[QoS]:
            return [one.qos for one in participant.publishers(topic) if one.ros_type == ros_type]

        def subscribe(qos: QoS) -> Subscription:
            return participant.subscription(self._connection.node, topic, message_class, qos, adapts=True)

        subscription = AdaptiveSubscription(offers, subscribe, quality)
        self._subscriptions.add(subscription)
        keep = self.buffer.cache_ns
        keep = keep if keep >= 0 else _KEEP_IF_UNLIMITED
        return LiveMessages(subscription, ros_type, keep, self._connection.frame, self._sim_time.now)

    def refresh(self) -> None:
        """Adapt all subscriptions to new publishers."""
        for subscription in list(self._subscriptions):
            subscription.follow()

    @property
    def clock(self) -> ClockState:
        """The clock: that of the system, or /clock, which may be paused."""
        if not self._sim_time.is_followed:
            return "system"
        return "paused" if self._sim_time.is_paused else "simulated"

    def watch(self, newest: Callable[[str], int]) -> str:
        """Return why everything has to start again: the stamps of transforms or of /clock have jumped back."""
        now = time.monotonic_ns()
        on_clock, on_transforms = self._sim_time.poll(now), self._stamps.poll(now, newest)
        jump = on_clock or on_transforms
        if not jump:
            return ""
        what = "/clock" if on_clock else "The time of the transforms"
        return f"{what} jumped back by {duration(jump)}" if jump < _DAY else f"{what} jumped back"

    def restart(self) -> None:
        """Remove the transforms of the time before a jump, as tf2 does after a jump of its clock."""
        self.buffer.clear()
        self._sim_time.clear()
        self._stamps.clear()

    def running(self) -> int:
        """Return the time of the monotonic clock in nanoseconds, without pauses of a simulation."""
        return self._sim_time.running()

    def other_subscriptions(self, topic: str) -> int:
        """Return the number of subscriptions to a topic without those of the viewer and its doctor."""
        own = {guid for subscription in list(self._subscriptions) for guid in subscription.guids}
        found = self._connection.participant.subscribers(topic)
        return sum(one.guid not in own and one.node != DOCTOR_NODE for one in found)

    def examine(self) -> Generator[dict[str, Report] | None, None, None]:
        """Return a generator of reports on the last ten seconds, as `coframe doctor --watch` prints them.

        Raises:
            WireError: The doctor cannot join the graph.
        """
        # Imported here because the first frame update does not need the doctor.
        from coframe.doctor import diagnose  # noqa: PLC0415
        from coframe.doctor.live import LiveObserver  # noqa: PLC0415
        from coframe.doctor.observation import DEFAULT_CACHE  # noqa: PLC0415

        config = self._connection.config.with_cache(DEFAULT_CACHE)
        with LiveObserver(config, window=_WINDOW, node_name=DOCTOR_NODE) as observer:
            due = time.monotonic() + _FIRST_REPORT
            while True:
                observer.poll()
                if time.monotonic() < due:
                    yield None
                    continue
                begin = time.thread_time()
                yield {"": diagnose(observer.observe())}
                due = time.monotonic() + max(_REPORT_PERIOD, (time.thread_time() - begin) / _SHARE)

    def close(self) -> None:
        """Close the connection if the source owns it, and the subscriptions of the source in any case."""
        self._sim_time.close()
        self._stamps.close()
        if self._owns_connection:
            self._connection.close()


def _message_class(ros_type: str) -> Any:
    """Return the class of a type, or None if it is unknown."""
    # Imported here because only message displays need the message classes.
    from coframe.messages import find  # noqa: PLC0415

    try:
        return find(ros_type)
    except LookupError:
        return None
