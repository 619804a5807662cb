# SPDX-License-Identifier: Apache-2.0
"""Stamps of messages, and the clock for messages that have none."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.clock import Clock, ROSClock
from rclpy.duration import Duration
from rclpy.logging import get_logger
from rclpy.time import Time

if TYPE_CHECKING:
    from collections.abc import Iterable


def header_stamp(message: Any) -> Time | None:
    """Return the stamp in the header of a message, or None if the message has no header."""
    stamp = getattr(getattr(message, "header", None), "stamp", None)
    return stamp if stamp is None or hasattr(stamp, "nanoseconds") else Time.from_msg(stamp)


def header_nanoseconds(message: Any) -> int:
    """Return the stamp in the header of a message in nanoseconds.

    Raises:
        AttributeError: The message has no header.
    """
    stamp = message.header.stamp
    if hasattr(stamp, "nanoseconds"):
        return int(stamp.nanoseconds)
    return int(stamp.sec) * 1_000_000_000 + int(stamp.nanosec)


def as_nanoseconds(duration: Duration | float) -> int:
    """Return a `Duration`, or a number of seconds, in nanoseconds."""
    if isinstance(duration, Duration):
        return int(duration.nanoseconds)
    return int(duration * 1_000_000_000)


class ArrivalClock:
    """The clock of the filters' node, or ROS time without simulation if no filter has a node."""

    def __init__(self, filters: Iterable[Any]) -> None:
        nodes = (getattr(filter_, "node", None) for filter_ in filters)
        node = next((node for node in nodes if node is not None), None)
        self._clock: Clock = ROSClock() if node is None else node.get_clock()
        self._last = 0

    def now(self) -> Time:
        """Return the current time."""
        return self._clock.now()

    def clear_after_jump_back(self, queues: list[dict[int, Any]]) -> None:
        """Drop all messages if the clock has jumped back since the last call: their stamps are in the future."""
        now = self._clock.now().nanoseconds
        if now < self._last:
            for queue in queues:
                queue.clear()
        self._last = now


def warn_headerless(user: str) -> None:
    """Warn about a message that was ignored because it has no header."""
    get_logger(user).warning(
        "Ignored a message without a header. Pass allow_headerless=True to use the time of arrival as its stamp.",
        throttle_duration_sec=5.0,
    )
