"""Lengths of time in nanoseconds."""

from __future__ import annotations

from typing import Final

import builtin_interfaces.msg
from rclpy.constants import S_TO_NS

INT64_LIMIT: Final = 2**63


class Duration:
    """A length of time, negative ones included.

    Args:
        seconds: Seconds; a float is cut to whole nanoseconds.
        nanoseconds: Nanoseconds, added to the seconds.

    Raises:
        OverflowError: The sum does not fit into 64 bits.
    """

    __slots__ = ("_nanoseconds",)

    def __init__(self, *, seconds: float = 0, nanoseconds: float = 0) -> None:
        total = int(number(seconds) * S_TO_NS) + int(number(nanoseconds))
        if not -INT64_LIMIT <= total < INT64_LIMIT:
            raise OverflowError("Total nanoseconds value is too large to store in C duration.")
        self._nanoseconds = total

    @property
    def nanoseconds(self) -> int:
        """The whole length in nanoseconds."""
        return self._nanoseconds

    def __repr__(self) -> str:
        return f"Duration(nanoseconds={self.nanoseconds})"

    def __str__(self) -> str:
        return "Infinite" if self.nanoseconds == INT64_LIMIT - 1 else f"{self.nanoseconds} nanoseconds"

    # Comparing with a number raises: `Duration(seconds=5) == 5` would silently be False.
    def __eq__(self, other: object) -> bool:
        if isinstance(other, Duration):
            return self.nanoseconds == other.nanoseconds
        raise TypeError(f"Can't compare duration with object of type: {type(other)}")

    def __ne__(self, other: object) -> bool:
        return not self == other

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

    def to_msg(self) -> builtin_interfaces.msg.Duration:
        """Returns a `builtin_interfaces/Duration`."""
        seconds, nanoseconds = divmod(self.nanoseconds, S_TO_NS)
        return builtin_interfaces.msg.Duration(sec=seconds, nanosec=nanoseconds)

    @classmethod
    def from_msg(cls, msg: builtin_interfaces.msg.Duration) -> Duration:
        """Makes a Duration of a message.

        Raises:
            TypeError: `msg` is no `builtin_interfaces/Duration`.
        """
        if not isinstance(msg, builtin_interfaces.msg.Duration):
            raise TypeError("Must pass a builtin_interfaces.msg.Duration object")
        return cls(seconds=msg.sec, nanoseconds=msg.nanosec)


def number(value: float) -> float:
    """Returns a number as it is.

    Raises:
        TypeError: It is a text, of which `* S_TO_NS` would make a thousand million copies.
    """
    if isinstance(value, str):
        raise TypeError(f"expected a number, got the text {value!r}: float(...) reads one")
    return value


Infinite: Final = Duration(nanoseconds=INT64_LIMIT - 1)
