# SPDX-License-Identifier: Apache-2.0
"""The current time of a ROS graph: the time of /clock if a simulator publishes it, otherwise the system time."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from coframe.time import SECOND

if TYPE_CHECKING:
    from coframe.connection.connection import Connection
    from coframe.connection.message_streams import MessageSubscription

__all__ = ["GraphClock"]

CLOCK = "/clock"
_FIRST_TIMEOUT = "2s"


class GraphClock:
    """The clock of a graph. Not thread-safe.

    Args:
        connection: The connection, which subscribes to /clock once a node publishes it.
    """

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._subscription: MessageSubscription[Any] | None = None
        self._last: int | None = None

    def now(self) -> int:
        """Return the time in nanoseconds; wait up to two seconds for the first message on /clock.

        Raises:
            WireError: The middleware cannot create the subscription.
        """
        if not self._connection.participant.publishers(CLOCK):
            return time.time_ns()
        if self._subscription is None:
            # Imported here because only publishing needs the message classes.
            from coframe.messages import find  # noqa: PLC0415
            from coframe.wire.qos import QoS  # noqa: PLC0415

            # Simulators may offer only best effort. With a depth of 1, the last message is the newest one.
            qos = QoS(depth=1, reliable=False)
            self._subscription = self._connection.subscribe(CLOCK, find("rosgraph_msgs/msg/Clock"), qos=qos)
        message = self._subscription.receive(_FIRST_TIMEOUT if self._last is None else 0)
        while message is not None:
            self._last = message.clock.sec * SECOND + message.clock.nanosec
            message = self._subscription.receive(0)
        return time.time_ns() if self._last is None else self._last

    def close(self) -> None:
        """Unsubscribe."""
        if self._subscription is not None:
            self._subscription.close()
