# SPDX-License-Identifier: Apache-2.0
"""Filters that pass a message if it differs enough from the last message that they passed."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from operator import attrgetter
from typing import Any

from message_filters._filters import SimpleFilter

__all__ = ["ComparisonFilter", "DeltaFilter", "PathDeltaFilter"]

Field = str | Callable[[Any], Any]


class ComparisonFilter(SimpleFilter):
    """A filter that lets the first message through, and each later one that a function accepts.

    Args:
        input_filter: The filter whose messages are compared. None: `connectInput` or `add` are called later.
        comparison: Function that is called with the last message that was let through and a new one, and returns
            whether the new one is let through.
    """

    def __init__(self, input_filter: SimpleFilter | None, comparison: Callable[[Any, Any], bool]) -> None:
        super().__init__()
        self.comparison = comparison
        self._last: Any = None
        if input_filter is not None:
            self.connectInput(input_filter)

    def connectInput(self, f: SimpleFilter) -> None:
        """Compare the messages of this filter."""
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg: Any) -> None:
        """Compare a message, and pass it if it differs enough."""
        if self._last is None or self.comparison(self._last, msg):
            self._last = msg
            self.signalMessage(msg)


class DeltaFilter(ComparisonFilter):
    """A filter that lets a message through if a number in it has changed enough.

    Args:
        input_filter: The filter whose messages are compared. None: `connectInput` or `add` are called later.
        field: The number: the name of a field such as `twist.linear.x`, or a function of the message.
        delta: The change of the number since the last message that was let through, from which on one is let through.
    """

    def __init__(self, input_filter: SimpleFilter | None, field: Field, delta: float) -> None:
        value = _getter(field)
        super().__init__(input_filter, lambda last, new: abs(value(new) - value(last)) >= delta)


class PathDeltaFilter(SimpleFilter):
    """A filter that lets a message through after each stretch of a path.

    Args:
        input_filter: The filter whose messages are compared. None: `connectInput` or `add` are called later.
        position: The position: the name of a field with `x`, `y` and optionally `z`, such as `pose.position`, or a
            function of the message that returns such an object or numbers.
        delta: The length of the path since the last message that was let through, in the unit of the position.
    """

    def __init__(self, input_filter: SimpleFilter | None, position: Field, delta: float) -> None:
        super().__init__()
        self.delta = delta
        self._position = _getter(position)
        self._last: tuple[float, ...] | None = None
        self._length = 0.0
        if input_filter is not None:
            self.connectInput(input_filter)

    def connectInput(self, f: SimpleFilter) -> None:
        """Measure the path of the messages of this filter."""
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg: Any) -> None:
        """Add the way to a message's position, and pass the message on if the path is long enough."""
        position = _numbers(self._position(msg))
        is_first = self._last is None
        if self._last is not None:
            self._length += math.dist(self._last, position)
        self._last = position
        if is_first or self._length >= self.delta:
            self._length = 0.0
            self.signalMessage(msg)


def _getter(field: Field) -> Callable[[Any], Any]:
    return attrgetter(field) if isinstance(field, str) else field


def _numbers(position: Any) -> tuple[float, ...]:
    if isinstance(position, Sequence):
        return tuple(position)
    return tuple(getattr(position, axis) for axis in "xyz" if hasattr(position, axis))
