# SPDX-License-Identifier: Apache-2.0
"""Jumps back in time, on which RViz resets: a replay that starts again, or a simulation that was reset.

Late messages, and two publishers whose clocks differ, are not jumps: between old stamps, they bring new ones.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING

from coframe.errors import WireError
from coframe.messages.encapsulation import HEADER_SIZE, byte_order
from coframe.time import MILLISECOND, SECOND
from coframe.type_names import TF_MESSAGE
from coframe.wire.qos import QoS

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.connection.connection import Connection
    from coframe.wire.endpoints import Subscription

__all__ = ["BackwardJumps", "TransformStamps"]

# How long only old stamps must arrive, and how many. Shorter jumps are over before they could be reported.
_CONFIRMATION, _MIN_OLD = 400 * MILLISECOND, 2
# Where new stamps arrive rarely, only old ones must arrive for this many of their intervals; this one is assumed for a
# series whose interval is not known yet.
_INTERVALS, _UNKNOWN_INTERVAL = 2, SECOND // 2
_INTERVAL_DECAY = 0.9  # per new stamp, so that a single long interval is forgotten
# Older than the newest stamp by at most this is late, not old.
_TOLERANCE = 50 * MILLISECOND
MAX_SERIES = 10_000
"""How many frames are observed; their names come from the network."""
MAX_QUEUED = 200
"""How many messages are queued. Each call takes all of them: those left in the queue would look old at the next one."""
_ANY_PUBLISHER = QoS(depth=MAX_QUEUED, reliable=False)


class _Series:
    """The stamps of a frame or of /clock: the newest stamp, and all older stamps received after it."""

    __slots__ = ("count", "interval", "newest", "newest_at", "since")

    def __init__(self) -> None:
        self.newest = 0
        self.newest_at = 0  # When it arrived, on the monotonic clock; 0 if that is unknown.
        self.interval = 0.0  # Between the arrivals of new stamps, in nanoseconds; 0 if it is unknown.
        self.since = 0  # When the first old stamp arrived.
        self.count = 0

    def add_new(self, stamp: int, now: int) -> None:
        if stamp > self.newest:
            if self.newest_at:
                self.interval = max(float(now - self.newest_at), _INTERVAL_DECAY * self.interval)
            self.newest, self.newest_at = stamp, now
        self.count = 0

    def is_jump(self, now: int) -> bool:
        needed = max(_CONFIRMATION, _INTERVALS * (self.interval or _UNKNOWN_INTERVAL))
        return self.count >= _MIN_OLD and now - self.since >= needed


class BackwardJumps:
    """Decides whether the stamps of several series have jumped back."""

    def __init__(self) -> None:
        self._series: dict[str, _Series] = {}

    def add(self, key: str, stamp: int, now: int, newest: int = 0) -> int:
        """Add a stamp, and return by how many nanoseconds its series has jumped back, or 0.

        Args:
            key: The series.
            stamp: The stamp in nanoseconds.
            now: The time on the monotonic clock in nanoseconds.
            newest: The newest stamp of the series that is known from elsewhere.
        """
        series = self._series.get(key)
        if series is None:
            if len(self._series) >= MAX_SERIES:
                return 0
            series = self._series[key] = _Series()
        if newest > series.newest:  # However late the queue of stamps is, the buffer receives new ones.
            series.add_new(newest, now)
        if stamp >= series.newest - _TOLERANCE:
            series.add_new(stamp, now)
            return 0
        if series.count == 0:
            series.since = now
        series.count += 1
        return series.newest - stamp if series.is_jump(now) else 0

    def clear(self) -> None:
        """Forget all stamps, but not how often they arrive."""
        for series in self._series.values():
            series.newest = series.newest_at = series.count = 0


class TransformStamps:
    """Observes the stamps on the topic of transforms: a buffer drops old transforms, and therefore shows no jump.

    Args:
        connection: The connection whose topic is observed.
    """

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._subscription: Subscription | None = None
        self._has_failed = False
        self._jumps = BackwardJumps()

    def poll(self, now: int, newest: Callable[[str], int]) -> int:
        """Return by how many nanoseconds the transforms have jumped back since the last call, or 0.

        Args:
            now: The time on the monotonic clock in nanoseconds.
            newest: Returns the newest stamp of a frame in the buffer, or 0 if there is none.
        """
        subscription = self._open()
        if subscription is None or not subscription.pending():
            return 0
        found: dict[str, int] = {}
        for sample in subscription.take(MAX_QUEUED):
            child, stamp = _first_transform(sample.data)
            found[child] = max(stamp, found.get(child, 0))
        jump = 0
        for child, stamp in found.items():
            if stamp == 0:
                continue
            frame = self._connection.frame(child)
            jump = max(jump, self._jumps.add(frame, stamp, now, newest(frame)))
        return jump

    def clear(self) -> None:
        """Forget all stamps."""
        self._jumps.clear()

    def close(self) -> None:
        """Unsubscribe."""
        if self._subscription is not None:
            self._subscription.close()

    def _open(self) -> Subscription | None:
        if self._subscription is None and not self._has_failed:
            from coframe.messages import find  # noqa: PLC0415 - recordings do not need the message classes

            connection = self._connection
            try:
                self._subscription = connection.participant.subscription(
                    connection.node, connection.config.tf_topic, find(TF_MESSAGE), _ANY_PUBLISHER, adapts=True
                )
            except WireError:  # Without it, only jumps of /clock are detected.
                self._has_failed = True
        return self._subscription


def _first_transform(data: bytes) -> tuple[str, int]:
    """Return the child frame and the stamp of the first transform in the bytes of a TFMessage; 0 if it has none."""
    order = byte_order(data)
    if order is None:
        return "", 0
    try:
        count, sec, nanosec, length = struct.unpack_from(f"{order}IiII", data, HEADER_SIZE)
        start = HEADER_SIZE + 16 + -(-length // 4) * 4
        (size,) = struct.unpack_from(f"{order}I", data, start)
        name = bytes(data[start + 4 : start + 3 + size])
    except struct.error:
        return "", 0
    return name.decode(errors="replace"), max(0, sec * SECOND + nanosec) if count else 0
