# SPDX-License-Identifier: Apache-2.0
"""The panels of one client: curves, an inspected topic, the log, and the graph of nodes and topics."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.errors import ViewerError, WireError
from coframe.viewer.panels.completion import MAX_TEXT
from coframe.viewer.protocol.requests import BadRequestError

if TYPE_CHECKING:
    from coframe.viewer._state import ViewerState
    from coframe.viewer.panels.curve import Curve, CurveSpan
    from coframe.viewer.protocol.client_messages import CurveRequest
    from coframe.viewer.sources.topic_messages import TopicMessages

__all__ = ["ClientPanels", "ShownCurve"]

_MAX_CURVES = 32


class ShownCurve:
    """A curve that a client shows.

    Attributes:
        expression: The expression as the client wrote it.
        curve: The points of the curve, which all clients share.
        version: The version of the curve whose points were sent, or None before the first ones.
        seen: The number of points that were sent since that version.
        span: The part of a recording that was sent.
    """

    def __init__(self, expression: str, curve: Curve) -> None:
        self.expression = expression
        self.curve = curve
        self.version: int | None = None
        self.seen = 0
        self.span: CurveSpan | None = None


class ClientPanels:
    """The state of one client's panels.

    Args:
        viewer: The state that all clients share.

    Attributes:
        curves: The curves by the client's id.
        span: The part of a recording that the page shows, or None before the first curve.
        topic: The inspected topic, or "" for none.
        inspected: Its messages, or None if it does not exist.
        problem: Why it could not be opened, or "".
        shows_log: Whether the log is shown.
        shows_graph: Whether the graph is shown.
        serial: A number that changes with the inspected topic.
        log_seen: The number of log messages that were sent, or None before the first ones.
    """

    def __init__(self, viewer: ViewerState) -> None:
        self._viewer = viewer
        self.curves: dict[int, ShownCurve] = {}
        self.span: CurveSpan | None = None
        self.topic = ""
        self.inspected: TopicMessages | None = None
        self.problem = ""
        self.serial = 0
        self.shows_log = self.shows_graph = False
        self.log_seen: int | None = None
        self._panels = viewer.panels  # Those of the source that is shown.

    def set_curves(self, requests: list[CurveRequest], span: CurveSpan) -> None:
        """Show exactly these curves.

        Raises:
            BadRequestError: There are too many curves, or an expression is too long.
        """
        if len(requests) > _MAX_CURVES:
            raise BadRequestError(f"a page shows at most {_MAX_CURVES} curves", "Remove a curve.")
        if any(len(request.expression) > MAX_TEXT for request in requests):
            raise BadRequestError(f"an expression has at most {MAX_TEXT} characters")
        wanted = {request.id: request.expression for request in requests}
        for number in [number for number, shown in self.curves.items() if wanted.get(number) != shown.expression]:
            shown = self.curves.pop(number)
            self._panels.curves.release(shown.expression, shown.curve)
        self.span = span
        for number, expression in wanted.items():
            if number not in self.curves:
                self.curves[number] = ShownCurve(expression, self._panels.curves.open(expression))

    def inspect(self, topic: str) -> None:
        """Inspect a topic instead of the previous one, or "" for none."""
        if self.inspected is not None:
            self._viewer.release(self.inspected)
        self.topic, self.inspected, self.problem = topic, None, ""
        self.serial += 1
        self.open_inspected()

    def open_inspected(self) -> None:
        """Open the inspected topic if it now exists."""
        if self.topic and self.inspected is None:
            try:
                self.inspected = self._viewer.open(self.topic)
            except (ViewerError, WireError) as error:
                self.problem = f"{error} {error.hint}".strip()

    def show_log(self, *, shown: bool) -> None:
        """Show or hide the log."""
        if shown != self.shows_log:
            self.shows_log, self.log_seen = shown, None
            if shown:
                self._panels.log.open()
            else:
                self._panels.log.release()

    def show_graph(self, *, shown: bool) -> None:
        """Show or hide the graph."""
        if shown != self.shows_graph:
            self.shows_graph = shown
            if shown:
                self._panels.graph.open()
            else:
                self._panels.graph.release()

    def close(self) -> None:
        """Show nothing. The page requests its panels again after each `hello`."""
        for shown in self.curves.values():
            self._panels.curves.release(shown.expression, shown.curve)
        self.curves.clear()
        self.inspect("")
        self.show_log(shown=False)
        self.show_graph(shown=False)
        self._panels = self._viewer.panels
