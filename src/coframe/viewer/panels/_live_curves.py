# SPDX-License-Identifier: Apache-2.0
"""Curves of a buffer and of the ROS graph, to which points are added as they arrive."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np

from coframe.analysis.clocks import clock_of
from coframe.errors import DecodeError, PlotError, TransformException
from coframe.messages.tf_columns import tf_columns
from coframe.plotting.evaluation import check_edge
from coframe.plotting.values import NoElementError, axis_title, field_value, rates
from coframe.time import SECOND
from coframe.transform.quantities import coordinate
from coframe.viewer.panels._ring import Points, Ring
from coframe.viewer.panels.curve import CurveState, failure

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.buffer.buffer import Buffer
    from coframe.connection.connection import Connection
    from coframe.plotting.expressions import Expression, FieldExpression, PoseExpression, TimingExpression
    from coframe.viewer.panels._arrivals import Arrivals, ArrivedMessages
    from coframe.viewer.panels.curve import CurveSpan

__all__ = ["EdgeDelayCurve", "EdgeRateCurve", "FieldCurve", "LiveCurve", "PoseCurve", "TopicTimingCurve"]

# Points per second for static edges, whose horizontal line must reach the newest time.
_STATIC_PERIOD = SECOND


class LiveCurve:
    """Base class of all live curves.

    Args:
        expression: The expression to plot.
    """

    def __init__(self, expression: Expression) -> None:
        self.axis = axis_title(expression)
        self.ring = Ring()
        self._problem: CurveState | None = None

    @property
    def status(self) -> CurveState:
        """The status."""
        if self._problem is not None:
            return self._problem
        return CurveState("ok" if self.ring.total else "waiting", "" if self.ring.total else "no data yet")

    @property
    def version(self) -> int:
        """A number that changes when time restarts."""
        return self.ring.restarts

    @property
    def total(self) -> int:
        """The number of points since the last change of the version."""
        return self.ring.total

    def poll(self) -> None:
        """Process new data."""
        raise NotImplementedError

    def points(self, seen: int, shown: CurveSpan) -> Points:
        """Return the points after the first `seen` ones."""
        del shown
        return self.ring.since(seen)

    def all_points(self) -> Points:
        """Return all points that are kept."""
        return self.ring.since(0)

    def close(self) -> None:
        """Release the resources of the curve."""


class PoseCurve(LiveCurve):
    """A quantity of the pose of a frame relative to another one, at each sample of the edges between them."""

    def __init__(self, expression: PoseExpression, buffer: Buffer) -> None:
        super().__init__(expression)
        self._expression = expression
        self._buffer = buffer

    def poll(self) -> None:
        """Look up the poses at the new samples."""
        target, source = self._expression.target, self._expression.source
        try:
            first, last = self._buffer.span(target, source)
            if (first, last) == (0, 0):
                self._add_static()
            elif self.ring.last is None or last < self.ring.last - SECOND:
                self._add(first, last, is_first=True)
            elif last > self.ring.last:
                self._add(self.ring.last, last, is_first=False)
            self._problem = None
        except TransformException as error:
            self._problem = failure(error)

    def _add(self, first: int, last: int, *, is_first: bool) -> None:
        poses = self._buffer.trajectory(self._expression.target, self._expression.source, first, last)
        stamps, values = np.asarray(poses.stamps, dtype=np.int64), coordinate(poses, self._expression.quantity)
        # The pose at the last known time has already been added.
        new = slice(None) if is_first or stamps[0] != first else slice(1, None)
        self.ring.add(stamps[new], values[new])

    def _add_static(self) -> None:
        now = max((info.newest for info in self._buffer.frames() if not info.static), default=0) or time.time_ns()
        if self.ring.last is not None and now < self.ring.last + _STATIC_PERIOD:
            return
        poses = self._buffer.trajectory(self._expression.target, self._expression.source)
        self.ring.add(np.array([now]), coordinate(poses, self._expression.quantity)[:1])


class EdgeRateCurve(LiveCurve):
    """The rate of an edge by its stamps."""

    def __init__(self, expression: TimingExpression, buffer: Buffer) -> None:
        super().__init__(expression)
        self._expression = expression
        self._buffer = buffer
        self._rate = _RateMeter()

    def poll(self) -> None:
        """Count the new samples."""
        parent, child = self._expression.edge or ("", "")
        try:
            check_edge(self._expression, self._buffer)
            first, last = self._buffer.span(parent, child)
        except (PlotError, TransformException) as error:
            self._problem = failure(error)
            return
        self._problem = None
        if self.ring.last is not None:
            first = self.ring.last + 1 if last > self.ring.last - SECOND else first
        stamps = np.unique(np.frombuffer(self._buffer._stamps_between(parent, child, first, last), dtype=np.int64))
        self.ring.add(stamps, self._rate.rates(stamps))


class TopicCurve(LiveCurve):
    """Base class of curves of the messages on a topic."""

    def __init__(self, expression: Expression, arrivals: Arrivals) -> None:
        super().__init__(expression)
        self._arrivals = arrivals
        self._error: CurveState | None = None
        self._is_open = True
        arrivals.add(self._receive)

    @property
    def status(self) -> CurveState:
        """The status. The error of a message remains until another message has a value."""
        return self._error or super().status

    def poll(self) -> None:
        """Process new messages for all curves of the topic."""
        self._problem = None if self._arrivals.problem is None else CurveState("waiting", self._arrivals.problem)
        self._arrivals.poll()

    def close(self) -> None:
        """Unsubscribe if no other curve uses the topic."""
        if self._is_open:
            self._is_open = False
            self._arrivals.remove(self._receive)

    def _receive(self, messages: ArrivedMessages) -> None:
        raise NotImplementedError


class FieldCurve(TopicCurve):
    """A numeric field of the messages on a topic."""

    def __init__(self, expression: FieldExpression, arrivals: Arrivals) -> None:
        super().__init__(expression, arrivals)
        self._expression = expression

    def _receive(self, messages: ArrivedMessages) -> None:
        values = np.full(len(messages.stamps), np.nan)
        for i, message in enumerate(messages.decoded()):
            try:
                if isinstance(message, DecodeError):
                    raise message
                values[i] = field_value(message, self._expression, messages.type)
            except NoElementError:
                pass
            except (PlotError, DecodeError) as error:
                self._error = failure(error)
                continue
            else:
                self._error = None
        if self._error is None:
            self.ring.add(messages.stamps, values)


class TopicTimingCurve(TopicCurve):
    """The rate or the delay of the messages on a topic."""

    def __init__(self, expression: TimingExpression, arrivals: Arrivals) -> None:
        super().__init__(expression, arrivals)
        self._expression = expression
        self._rate = _RateMeter()

    def _receive(self, messages: ArrivedMessages) -> None:
        if self._expression.quantity == "rate":
            self.ring.add(messages.stamps, self._rate.rates(messages.arrived))
        elif not messages.have_stamps:
            text = f"{self._expression.text}: the messages of type {messages.type} have no stamp and therefore no delay"
            self._error = CurveState("error", text, f"Their rate can be plotted: {self._expression.topic}.rate.")
        else:
            self._error = _other_clock(self._expression, messages.stamps, messages.arrived)
            if self._error is None:
                self.ring.add(messages.stamps, (messages.arrived - messages.stamps) / SECOND)


class EdgeDelayCurve(TopicCurve):
    """The delay of the transforms of an edge: receive time minus stamp."""

    def __init__(self, expression: TimingExpression, connection: Connection, arrivals: Arrivals) -> None:
        super().__init__(expression, arrivals)
        self._expression = expression
        self._connection = connection

    def poll(self) -> None:
        """Process new messages for all curves of the topic."""
        super().poll()
        try:
            check_edge(self._expression, self._connection.buffer)
        except (PlotError, TransformException) as error:
            self._problem = failure(error)

    def _receive(self, messages: ArrivedMessages) -> None:
        columns = tf_columns(messages.slices)
        names = [self._connection.frame(name) for name in columns.names]
        is_edge = _named(names, columns.parent, 0, self._expression) & _named(names, columns.child, 1, self._expression)
        stamps, arrived = columns.stamp[is_edge], messages.arrived[columns.message[is_edge]]
        if not len(stamps):
            return
        self._error = _other_clock(self._expression, stamps, arrived)
        if self._error is None:
            self.ring.add(stamps, (arrived - stamps) / SECOND)


class _RateMeter:
    """Computes the mean rate over the previous second for times that arrive in batches."""

    def __init__(self) -> None:
        self._recent_times: NDArray[np.int64] = np.empty(0, dtype=np.int64)

    def rates(self, times: NDArray[np.int64]) -> NDArray[np.float64]:
        """Return the rate at each of the new times; NaN until enough time has passed."""
        if not len(times):
            return np.empty(0)
        if len(self._recent_times) and times[-1] < self._recent_times[-1] - SECOND:
            self._recent_times = self._recent_times[:0]
        known = np.sort(np.concatenate([self._recent_times, times]))
        # The mean begins at the last message that is at least a second older.
        keep_from = max(0, int(np.searchsorted(known, known[-1] - SECOND, side="right")) - 1)
        found = rates(known)[-len(times) :]
        self._recent_times = known[keep_from:]
        return found


def _named(names: list[str], numbers: NDArray[np.int64], side: int, expression: TimingExpression) -> NDArray[np.bool_]:
    wanted = (expression.edge or ("", ""))[side]
    return np.array([name == wanted for name in names], dtype=bool)[numbers]


def _other_clock(
    expression: TimingExpression, stamps: NDArray[np.int64], arrived: NDArray[np.int64]
) -> CurveState | None:
    """Return an error if the stamps are not on the clock of this machine."""
    if clock_of(float(np.median(arrived - stamps))) == "wall":
        return None
    return CurveState(
        "error",
        f"{expression.text}: the stamps and the receive times are on different clocks, so there is no delay",
        "For a simulation, record it with /clock and plot the recording.",
    )
