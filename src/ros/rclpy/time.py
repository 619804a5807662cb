# SPDX-License-Identifier: Apache-2.0
"""Points in time, each of which belongs to one type of clock."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, overload

import builtin_interfaces.msg
from coframe.distributions import since
from rclpy import _absent
from rclpy._clock_type import ClockType
from rclpy._numbers import require_number
from rclpy.constants import S_TO_NS
from rclpy.duration import INT64_LIMIT, Duration
from rclpy.exceptions import _with_hint

if TYPE_CHECKING:
    from typing_extensions import Self

__all__ = ["CONVERSION_CONSTANT", "Time"]

CONVERSION_CONSTANT = S_TO_NS


class Time:
    """A point in time. Times of different clock types can be neither compared nor subtracted.

    Args:
        seconds: Seconds since the clock's epoch. A float is truncated to whole nanoseconds.
        nanoseconds: Nanoseconds, added to the seconds.
        clock_type: The type of the clock that this time belongs to.

    Raises:
        TypeError: `clock_type` is not a ClockType, or a time is not a number.
        ValueError: Seconds or nanoseconds are negative.
        OverflowError: The sum does not fit into 64 bits.
    """

    __slots__ = ("_clock_type", "_nanoseconds")

    def __init__(
        self, *, seconds: float = 0, nanoseconds: float = 0, clock_type: ClockType = ClockType.SYSTEM_TIME
    ) -> None:
        if not isinstance(clock_type, ClockType):
            raise TypeError("Clock type must be a ClockType enum")
        seconds, nanoseconds = require_number(seconds), require_number(nanoseconds)
        if seconds < 0:
            raise ValueError("Seconds value must not be negative")
        if nanoseconds < 0:
            raise ValueError("Nanoseconds value must not be negative")
        total = int(seconds * S_TO_NS) + int(nanoseconds)
        if total >= INT64_LIMIT:
            raise OverflowError("Total nanoseconds value is too large to store in C time point.")
        self._nanoseconds = total
        self._clock_type = clock_type

    @property
    def nanoseconds(self) -> int:
        """Nanoseconds since the clock's epoch."""
        return self._nanoseconds

    def seconds_nanoseconds(self) -> tuple[int, int]:
        """Return the whole seconds and the remaining nanoseconds."""
        return divmod(self.nanoseconds, S_TO_NS)

    @property
    def clock_type(self) -> ClockType:
        """The type of the clock that this time belongs to."""
        return self._clock_type

    def __repr__(self) -> str:
        return f"Time(nanoseconds={self.nanoseconds}, clock_type={self.clock_type.name})"

    def __add__(self, other: Duration) -> Time:
        if not isinstance(other, Duration):
            return NotImplemented
        try:
            return Time(nanoseconds=self.nanoseconds + other.nanoseconds, clock_type=self.clock_type)
        except OverflowError as error:
            raise OverflowError("Addition leads to overflow in C storage.") from error

    def __radd__(self, other: Duration) -> Time:
        return self.__add__(other)

    @overload
    def __sub__(self, other: Time) -> Duration: ...
    @overload
    def __sub__(self, other: Duration) -> Time: ...
    def __sub__(self, other: Time | Duration) -> Time | Duration:
        if isinstance(other, Time):
            self._check_same_clock(other, "subtract")
            return Duration(nanoseconds=self.nanoseconds - other.nanoseconds)
        if isinstance(other, Duration):
            try:
                return Time(nanoseconds=self.nanoseconds - other.nanoseconds, clock_type=self.clock_type)
            except ValueError as error:
                raise ValueError("Subtraction leads to negative time") from error
        return NotImplemented

    # Up to Humble, `Time(nanoseconds=5) == 5` raises an error, because it would silently be False.
    def __eq__(self, other: object) -> bool:
        if isinstance(other, Time):
            self._check_same_clock(other, "compare")
            return self.nanoseconds == other.nanoseconds
        if since("comparisons"):
            return NotImplemented
        raise TypeError("Can't compare time with object of type: ", type(other))

    __hash__ = None  # type: ignore[assignment]

    def __lt__(self, other: Time) -> bool:
        if isinstance(other, Time):
            self._check_same_clock(other, "compare")
            return self.nanoseconds < other.nanoseconds
        return NotImplemented

    def __le__(self, other: Time) -> bool:
        if isinstance(other, Time):
            self._check_same_clock(other, "compare")
            return self.nanoseconds <= other.nanoseconds
        return NotImplemented

    def __gt__(self, other: Time) -> bool:
        if isinstance(other, Time):
            self._check_same_clock(other, "compare")
            return self.nanoseconds > other.nanoseconds
        return NotImplemented

    def __ge__(self, other: Time) -> bool:
        if isinstance(other, Time):
            self._check_same_clock(other, "compare")
            return self.nanoseconds >= other.nanoseconds
        return NotImplemented

    def _check_same_clock(self, other: Time, verb: str) -> None:
        if self.clock_type != other.clock_type:
            raise TypeError(f"Can't {verb} times with different clock types")

    def to_msg(self) -> builtin_interfaces.msg.Time:
        """Return the time as a `builtin_interfaces/Time`."""
        seconds, nanoseconds = divmod(self._nanoseconds, S_TO_NS)
        try:
            return builtin_interfaces.msg.Time(sec=seconds, nanosec=nanoseconds)
        except AssertionError as error:
            hint = f"Times in messages end at 2038-01-19, {2**31 - 1} s after 1970. If this is now(), check the clock."
            raise _with_hint(error, hint) from None

    @classmethod
    def from_msg(cls, msg: builtin_interfaces.msg.Time, clock_type: ClockType = ClockType.ROS_TIME) -> Self:
        """Create a Time from a message.

        Raises:
            TypeError: `msg` is not a `builtin_interfaces/Time`.
        """
        if not isinstance(msg, builtin_interfaces.msg.Time):
            raise TypeError("Must pass a builtin_interfaces.msg.Time object")
        return cls(seconds=msg.sec, nanoseconds=msg.nanosec, clock_type=clock_type)


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
