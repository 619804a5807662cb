# SPDX-License-Identifier: Apache-2.0
"""Durations in nanoseconds."""

from __future__ import annotations

import math
from functools import partial
from typing import Final

import builtin_interfaces.msg
from coframe.distributions import since
from rclpy import _absent
from rclpy._numbers import require_number
from rclpy.constants import S_TO_NS

INT64_LIMIT: Final = 2**63


class Duration:
    """A duration, which may be negative.

    Args:
        seconds: Seconds. A float is truncated to whole nanoseconds.
        nanoseconds: Nanoseconds, added to the seconds.

    Raises:
        TypeError: An argument is not a number.
        OverflowError: The sum does not fit into 64 bits.
    """

    __slots__ = ("_nanoseconds",)

    def __init__(self, *, seconds: float = 0, nanoseconds: float = 0) -> None:
        total = int(require_number(seconds) * S_TO_NS) + int(require_number(nanoseconds))
        if not -INT64_LIMIT <= total < INT64_LIMIT:
            raise OverflowError("Total nanoseconds value is too large to store in C duration.")
        self._nanoseconds = total

    @property
    def nanoseconds(self) -> int:
        """The duration in nanoseconds."""
        return self._nanoseconds

    def __repr__(self) -> str:
        return f"Duration(nanoseconds={self.nanoseconds})"

    def __str__(self) -> str:
        return "Infinite" if self.nanoseconds == INT64_LIMIT - 1 else f"{self.nanoseconds} nanoseconds"

    def __add__(self, other: Duration) -> Duration:
        if isinstance(other, Duration):
            return Duration(nanoseconds=self.nanoseconds + other.nanoseconds)
        return NotImplemented

    def __sub__(self, other: Duration) -> Duration:
        if isinstance(other, Duration):
            return Duration(nanoseconds=self.nanoseconds - other.nanoseconds)
        return NotImplemented

    def __mul__(self, other: float) -> Duration:
        if isinstance(other, int):
            return Duration(nanoseconds=self.nanoseconds * other)
        if not isinstance(other, float):
            return NotImplemented
        if other == math.inf:
            return Infinite
        if not math.isfinite(other):
            raise ValueError("Can't multiply duration with nan")
        return Duration(nanoseconds=int(self.nanoseconds * other))

    # Up to Humble, `Duration(seconds=5) == 5` raises an error, because it would silently be False.
    def __eq__(self, other: object) -> bool:
        if isinstance(other, Duration):
            return self.nanoseconds == other.nanoseconds
        if since("comparisons"):
            return NotImplemented
        raise TypeError("Can't compare duration with object of type: ", type(other))

    __hash__ = None  # type: ignore[assignment]

    def __lt__(self, other: Duration) -> bool:
        if isinstance(other, Duration):
            return self.nanoseconds < other.nanoseconds
        return NotImplemented

    def __le__(self, other: Duration) -> bool:
        if isinstance(other, Duration):
            return self.nanoseconds <= other.nanoseconds
        return NotImplemented

    def __gt__(self, other: Duration) -> bool:
        if isinstance(other, Duration):
            return self.nanoseconds > other.nanoseconds
        return NotImplemented

    def __ge__(self, other: Duration) -> bool:
        if isinstance(other, Duration):
            return self.nanoseconds >= other.nanoseconds
        return NotImplemented

    def get_c_duration(self) -> Duration:
        """Return the duration itself, since there is no C implementation."""
        return self

    def to_msg(self) -> builtin_interfaces.msg.Duration:
        """Return the duration as a `builtin_interfaces/Duration`."""
        seconds, nanoseconds = divmod(self.nanoseconds, S_TO_NS)
        return builtin_interfaces.msg.Duration(sec=seconds, nanosec=nanoseconds)

    @classmethod
    def from_msg(cls, msg: builtin_interfaces.msg.Duration) -> Duration:
        """Create a Duration from a message.

        Raises:
            TypeError: `msg` is not a `builtin_interfaces/Duration`.
        """
        if not isinstance(msg, builtin_interfaces.msg.Duration):
            raise TypeError("Must pass a builtin_interfaces.msg.Duration object")
        return cls(seconds=msg.sec, nanoseconds=msg.nanosec)


Infinite: Final = Duration(nanoseconds=INT64_LIMIT - 1)

__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
