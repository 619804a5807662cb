# SPDX-License-Identifier: Apache-2.0
"""The interface of curves, and the curves of a recording, which are evaluated in another thread."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from coframe.errors import CoframeError
from coframe.plotting import evaluate
from coframe.plotting.thinning import extremes
from coframe.plotting.values import axis_title
from coframe.viewer.panels._ring import Points

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

    from coframe.bags import Recording
    from coframe.plotting import Series
    from coframe.plotting.expressions import Expression
    from coframe.viewer.protocol.common import DisplayState

__all__ = ["Curve", "CurveSpan", "CurveState", "FailedCurve", "RecordedCurve", "failure"]

_logger = logging.getLogger("coframe.viewer")


class CurveState(NamedTuple):
    """The status of a curve.

    Attributes:
        state: "waiting" while there are no points.
        text: A description of missing data or an error.
        hint: Advice for the user.
        points: The number of points that exist.
    """

    state: DisplayState
    text: str = ""
    hint: str = ""
    points: int = 0


class CurveSpan(NamedTuple):
    """The part of a curve that a page shows.

    Attributes:
        first: The first time in nanoseconds, or None for all.
        last: The last time in nanoseconds, or None for all.
        points: The maximum number of points that the page shows.
    """

    first: int | None
    last: int | None
    points: int


class Curve(Protocol):
    """A curve, shared by all clients. Use only on the server's thread.

    Attributes:
        axis: The title of its axis.
        status: The state of the curve, with a description of missing data or an error.
        version: A number that changes if points other than those after `total` have changed.
        total: The number of points since the last change of the version.
    """

    axis: str

    @property
    def status(self) -> CurveState:
        """The status."""

    @property
    def version(self) -> int:
        """A number that changes if earlier points have changed."""

    @property
    def total(self) -> int:
        """The number of points since the last change of the version."""

    def poll(self) -> None:
        """Process new data."""

    def points(self, seen: int, shown: CurveSpan) -> Points:
        """Return the points after the first `seen` ones; points of a recording are thinned."""

    def all_points(self) -> Points:
        """Return all points, without thinning."""

    def close(self) -> None:
        """Release the resources of the curve."""


class FailedCurve:
    """A curve that cannot be drawn.

    Args:
        error: The reason.
        axis: The title of its axis.
    """

    version = total = 0

    def __init__(self, error: Exception, axis: str = "") -> None:
        self.axis = axis
        self.status = failure(error)

    def poll(self) -> None:
        """Do nothing."""

    def points(self, seen: int, shown: CurveSpan) -> Points:
        """Return no points."""
        del seen, shown
        return self.all_points()

    def all_points(self) -> Points:
        """Return no points."""
        return Points(np.empty(0, dtype=np.int64), np.empty(0))

    def close(self) -> None:
        """Do nothing."""


class RecordedCurve:
    """A curve of a recording.

    Args:
        expression: The expression to plot.
        recording: The recording that contains the values.
        executor: Runs the evaluation.
    """

    def __init__(self, expression: Expression, recording: Recording, executor: Executor) -> None:
        self.axis = axis_title(expression)
        self.status = CurveState("waiting", "reading the recording")
        self.version = self.total = 0
        self._series: Series | None = None
        self._closed = False
        self._future: Future[list[Series]] | None = executor.submit(self._evaluate, expression, recording)

    def poll(self) -> None:
        """Collect the result."""
        if self._future is None or not self._future.done():
            return
        future, self._future = self._future, None
        try:
            (self._series,) = future.result()
        except CoframeError as error:
            self.status = failure(error)
        except Exception as error:  # An unexpected error in one curve must not stop the viewer.
            _logger.exception("a curve failed")
            self.status = CurveState("error", f"the curve cannot be evaluated: {type(error).__name__}: {error}")
        else:
            skipped = self._series.skipped
            text = f"{skipped} messages have no value" if skipped else ""
            self.status = CurveState("ok", text, points=len(self._series.stamps))
        self.version += 1

    def points(self, seen: int, shown: CurveSpan) -> Points:
        """Return the points of the displayed part, plus one on each side so that lines reach the edges."""
        del seen
        if self._series is None:
            return self.all_points()
        stamps, values = self._series.stamps, self._series.values
        first = 0 if shown.first is None else max(0, int(np.searchsorted(stamps, shown.first)) - 1)
        last = len(stamps) if shown.last is None else int(np.searchsorted(stamps, shown.last, "right")) + 1
        stamps, values = stamps[first:last], values[first:last]
        kept = extremes(values, shown.points)
        return Points(stamps[kept], values[kept])

    def all_points(self) -> Points:
        """Return all points."""
        if self._series is None:
            return Points(np.empty(0, dtype=np.int64), np.empty(0))
        return Points(self._series.stamps, self._series.values)

    def close(self) -> None:
        """Stop the evaluation soon."""
        self._closed = True
        if self._future is not None:
            self._future.cancel()

    def _evaluate(self, expression: Expression, recording: Recording) -> list[Series]:
        return evaluate([expression], recording, progress=self._report)

    def _report(self, _text: str, done: int, total: int) -> None:
        if self._closed:
            raise _ClosedError
        self.status = CurveState("waiting", f"reading the recording: {100 * done // max(total, 1)} %")


class _ClosedError(CoframeError):
    """The curve is no longer shown."""


def failure(error: Exception) -> CurveState:
    """Return the status of a curve that failed."""
    return CurveState("error", str(error), str(getattr(error, "hint", "") or ""))
