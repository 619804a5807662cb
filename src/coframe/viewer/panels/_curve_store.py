# SPDX-License-Identifier: Apache-2.0
"""The displayed curves by expression: each is evaluated once for all clients."""

from __future__ import annotations

import time
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

from coframe.errors import PlotError
from coframe.plotting.expressions import FieldExpression, PoseExpression, parse_expression
from coframe.viewer.panels._curve_table import CurveTable
from coframe.viewer.panels.curve import FailedCurve, RecordedCurve

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.connection.connection import Connection
    from coframe.plotting.expressions import Expression
    from coframe.viewer.panels._arrivals import Arrivals
    from coframe.viewer.panels.curve import Curve
    from coframe.viewer.sources.source import ViewerSource

__all__ = ["CurveStore"]

_MAX_CURVES = 64
_PERIOD = 0.09  # seconds between two polls, a little less than between two updates of a client


class CurveStore:
    """The curves of one source.

    Args:
        source: The source whose values the curves show.
    """

    def __init__(self, source: ViewerSource) -> None:
        self._source = source
        self._curves: dict[str, Curve] = {}
        self._users: dict[str, int] = {}
        self._arrivals: dict[str, Arrivals] = {}
        self._executor: ThreadPoolExecutor | None = None
        self._due = 0.0

    def open(self, text: str) -> Curve:
        """Return the curve of an expression; release it at the end."""
        if text not in self._curves:
            if len(self._curves) >= _MAX_CURVES:
                return FailedCurve(PlotError(f"the viewer shows at most {_MAX_CURVES} curves", hint="Remove a curve."))
            self._curves[text] = self._make(text)
        self._users[text] = self._users.get(text, 0) + 1
        return self._curves[text]

    def release(self, text: str, curve: Curve) -> None:
        """Release what `open` returned."""
        if self._curves.get(text) is not curve:
            return
        self._users[text] -= 1
        if self._users[text] == 0:
            del self._users[text], self._curves[text]
            curve.close()

    def poll(self) -> None:
        """Process new data, unless this was done very recently."""
        now = time.monotonic()
        if now < self._due:
            return
        self._due = now + _PERIOD
        for curve in self._curves.values():
            curve.poll()

    def table(self, texts: Iterable[str]) -> CurveTable:
        """Return all points of curves.

        Raises:
            PlotError: A curve is not shown on any page.
        """
        texts = list(dict.fromkeys(texts))
        missing = [text for text in texts if text not in self._curves]
        if missing or not texts:
            raise PlotError(f"{', '.join(missing) or 'no curve'} is not shown", hint="Add the curve to the plot first.")
        return CurveTable({text: self._curves[text].all_points() for text in texts})

    def close(self) -> None:
        """Close all curves and end the thread that evaluates them."""
        for curve in self._curves.values():
            curve.close()
        self._curves.clear()
        self._users.clear()
        if self._executor is not None:
            self._executor.shutdown(wait=True, cancel_futures=True)
            self._executor = None

    def _make(self, text: str) -> Curve:
        try:
            expression = parse_expression(text)
        except PlotError as error:
            return FailedCurve(error)
        if self._source.recording is not None:
            if self._executor is None:
                self._executor = ThreadPoolExecutor(1, "coframe-viewer-curves")
            return RecordedCurve(expression, self._source.recording, self._executor)
        return self._live_curve(expression)

    def _live_curve(self, expression: Expression) -> Curve:
        # Imported here because pages without curves do not need them.
        from coframe.viewer.panels._live_curves import (  # noqa: PLC0415
            EdgeDelayCurve,
            EdgeRateCurve,
            FieldCurve,
            PoseCurve,
            TopicTimingCurve,
        )

        connection = self._source.connection
        if isinstance(expression, PoseExpression):
            return PoseCurve(expression, self._source.buffer)
        if not isinstance(expression, FieldExpression) and expression.edge is not None:
            if expression.quantity == "rate":
                return EdgeRateCurve(expression, self._source.buffer)
            if connection is not None:
                return EdgeDelayCurve(expression, connection, self._arrivals_of(connection, connection.config.tf_topic))
        if connection is None:
            return FailedCurve(
                PlotError(f"{expression.text} has no values: a buffer contains only transforms, no messages")
            )
        if isinstance(expression, FieldExpression):
            return FieldCurve(expression, self._arrivals_of(connection, expression.topic))
        return TopicTimingCurve(expression, self._arrivals_of(connection, str(expression.topic)))

    def _arrivals_of(self, connection: Connection, topic: str) -> Arrivals:
        from coframe.viewer.panels._arrivals import Arrivals  # noqa: PLC0415 - see above

        return self._arrivals.setdefault(topic, Arrivals(connection, topic))
