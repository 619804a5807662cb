# SPDX-License-Identifier: Apache-2.0
"""The simulated time of a ROS graph: the time on /clock, as nodes with use_sim_time follow it."""

from __future__ import annotations

import struct
import time
from typing import TYPE_CHECKING

from coframe.errors import WireError
from coframe.messages.encapsulation import HEADER_SIZE, byte_order
from coframe.time import MILLISECOND, SECOND
from coframe.viewer.sources._time_jumps import BackwardJumps
from coframe.wire.qos import QoS

if TYPE_CHECKING:
    from coframe.connection.connection import Connection
    from coframe.wire.endpoints import Subscription

__all__ = ["SimTime"]

CLOCK = "/clock"
_CLOCK_TYPE = "rosgraph_msgs/msg/Clock"
_NEWEST = QoS(depth=1, reliable=False)  # matches every publisher
# A simulation is paused when its clock has not advanced for this long.
_PAUSED_AFTER = 700 * MILLISECOND


class SimTime:
    """Follows /clock. Use only on the server's thread.

    Args:
        connection: The connection that subscribes.
        follow: Whether /clock is followed; None follows it when a node publishes it.
    """

    def __init__(self, connection: Connection, *, follow: bool | None = None) -> None:
        self._connection = connection
        self._follow = follow
        self._subscription: Subscription | None = None
        self._jumps = BackwardJumps()
        self._last = 0  # The last time on /clock.
        self._advanced_at = 0  # When it advanced last, on the monotonic clock.
        self._paused_for = 0  # Nanoseconds on the monotonic clock, all pauses before the current one together.

    @property
    def is_followed(self) -> bool:
        """Whether the current time is that of /clock."""
        return self._subscription is not None and (self._last > 0 or self._follow is True)

    @property
    def is_paused(self) -> bool:
        """Whether a node publishes /clock, but the simulated time does not advance."""
        return self.is_followed and time.monotonic_ns() - self._advanced_at > _PAUSED_AFTER

    def now(self) -> int:
        """Return the simulated time in nanoseconds, or the system time if no node publishes /clock."""
        return self._last if self.is_followed else time.time_ns()

    def running(self) -> int:
        """Return the time on the monotonic clock in nanoseconds, without the pauses of the simulation."""
        now = time.monotonic_ns()
        return (self._advanced_at if self.is_paused else now) - self._paused_for

    def poll(self, now: int) -> int:
        """Return by how many nanoseconds the simulated time has jumped back since the last call, or 0.

        Args:
            now: The time on the monotonic clock in nanoseconds.
        """
        self._open_or_close()
        jump = 0
        if self._subscription is not None and self._subscription.pending():
            for sample in self._subscription.take():
                stamp = _clock_time(sample.data)
                if stamp != self._last and stamp >= 0:
                    if self.is_paused:
                        self._paused_for += now - self._advanced_at
                    self._last, self._advanced_at = stamp, now
                    jump = self._jumps.add(CLOCK, stamp, now)
        return jump

    def clear(self) -> None:
        """Forget all earlier times."""
        self._jumps.clear()

    def close(self) -> None:
        """Unsubscribe."""
        if self._subscription is not None:
            self._subscription.close()
            self._subscription = None

    def _open_or_close(self) -> None:
        if self._follow is False:
            return
        exists = self._follow is True or bool(self._connection.participant.publishers(CLOCK))
        if exists and self._subscription is None:
            from coframe.messages import find  # noqa: PLC0415 - recordings do not need the message classes

            connection = self._connection
            try:
                self._subscription = connection.participant.subscription(
                    connection.node, CLOCK, find(_CLOCK_TYPE), _NEWEST, adapts=True
                )
            except WireError:  # The next call tries again.
                return
            self._advanced_at = time.monotonic_ns()
        elif not exists and self._subscription is not None:
            self.close()
            self._last = 0


def _clock_time(data: bytes) -> int:
    """Return the time in the bytes of a Clock message in nanoseconds, or -1 if they are damaged."""
    order = byte_order(data)
    if order is None or len(data) < HEADER_SIZE + 8:
        return -1
    sec, nanosec = struct.unpack_from(f"{order}iI", data, HEADER_SIZE)
    return int(sec) * SECOND + int(nanosec)
