# SPDX-License-Identifier: Apache-2.0
"""The panels of one client: curves, an inspected topic, the log, and the graph of nodes and topics."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

from coframe._output.formatting import error_text
from coframe.errors import PlotError, ViewerError, WireError
from coframe.viewer.panels.completion import MAX_TEXT
from coframe.viewer.protocol.requests import BadRequestError

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.viewer._state import ViewerState
    from coframe.viewer.panels.curve import Curve, CurveSpan
    from coframe.viewer.panels.states import StateHistory
    from coframe.viewer.protocol.client_messages import CurveRequest, StateRequest
    from coframe.viewer.sources.topic_messages import TopicMessages

__all__ = ["ClientPanels", "ShownCurve", "ShownStates", "WatchedTopic"]

_MAX_CURVES = 32
_MAX_STATES = 16
_serials = itertools.count(1)


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


class WatchedTopic:
    """A topic that a panel shows, which may not exist yet.

    Args:
        viewer: The state that all clients share.
        topic: The name of the topic.

    Attributes:
        messages: The messages, or None if the topic does not exist.
        problem: Why it cannot be opened, or "".
        serial: A number that no other topic has. The identity of an object may be that of an earlier one.
    """

    def __init__(self, viewer: ViewerState, topic: str) -> None:
        self.topic = topic
        self.serial = next(_serials)
        self.messages: TopicMessages | None = None
        self.problem = ""
        self._viewer = viewer
        self.open_topic()

    def open_topic(self) -> None:
        """Open the topic if it now exists."""
        if self.messages is None:
            try:
                self.messages = self._viewer.open(self.topic)
            except (ViewerError, WireError) as error:
                self.problem = error_text(error)

    def release(self) -> None:
        """Release the messages."""
        if self.messages is not None:
            self._viewer.release(self.messages)
            self.messages = None

    def missing_reason(self) -> str:
        """Return why there are no messages."""
        connection = self._viewer.source.connection
        if self.problem:
            return self.problem
        if connection is None:
            return f"there are no messages on {self.topic}"
        types = [one.ros_type for one in connection.participant.publishers(self.topic)]
        return f"the definition of {types[0]} is unknown" if types else f"no node publishes {self.topic}"


class ShownStates:
    """A field whose states a client shows.

    Args:
        viewer: The state that all clients share.
        expression: The field as the client wrote it.

    Attributes:
        watched: The topic of the field, or None if the expression is not a field of a topic.
        problem: Why there are no states, or "".
        history: The states, or None while the topic does not exist.
        seen: The number of changes that were sent, or None before the first message.
        edition: The edition of the changes that were sent.
        serial: A number that no other field has.
    """

    def __init__(self, viewer: ViewerState, expression: str) -> None:
        from coframe.viewer.panels.states import parse_state_field  # noqa: PLC0415 - needs the message classes

        self.expression = expression
        self.serial = next(_serials)
        self.watched: WatchedTopic | None = None
        self.history: StateHistory | None = None
        self.problem = ""
        self.seen: int | None = None
        self.edition = 0
        try:
            self._field = parse_state_field(expression)
        except PlotError as error:
            self.problem = error_text(error)
        else:
            self.watched = WatchedTopic(viewer, self._field.topic)
            self.open_topic()

    def open_topic(self) -> None:
        """Begin to read the topic if it now exists."""
        from coframe.viewer.panels.states import StateHistory  # noqa: PLC0415 - see above

        if self.watched is None or self.history is not None:
            return
        self.watched.open_topic()
        if self.watched.messages is not None:
            self.history = StateHistory(self._field, self.watched.messages)

    def release(self) -> None:
        """Release the topic."""
        if self.watched is not None:
            self.watched.release()


class ClientPanels:
    """The state of one client's panels.

    Args:
        viewer: The state that all clients share.

    Attributes:
        curves: The curves by the client's id.
        span: The part of a recording that the page shows, or None before the first curve.
        inspected: The inspected topic, or None.
        table: The topic of the table, or None.
        table_rows: The number of messages that the table shows.
        states: The fields whose states are shown, by the client's id.
        shows_log: Whether the log is shown.
        shows_graph: Whether the graph is shown.
        log_seen: The number of log messages that were sent, or None before the first ones.
    """

    def __init__(self, viewer: ViewerState) -> None:
        self._viewer = viewer
        self.curves: dict[int, ShownCurve] = {}
        self.span: CurveSpan | None = None
        self.inspected: WatchedTopic | None = None
        self.table: WatchedTopic | None = None
        self.table_rows = 0
        self.states: dict[int, ShownStates] = {}
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
        _check_lengths(request.expression for request in requests)
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
        self.inspected = self._replace(self.inspected, topic)

    def show_table(self, topic: str, rows: int) -> None:
        """Show the last messages of a topic instead of the previous one, or "" for none."""
        self.table, self.table_rows = self._replace(self.table, topic), rows

    def set_states(self, requests: list[StateRequest]) -> None:
        """Show the states of exactly these fields.

        Raises:
            BadRequestError: There are too many fields, or an expression is too long.
        """
        if len(requests) > _MAX_STATES:
            raise BadRequestError(f"a page shows the states of at most {_MAX_STATES} fields", "Remove a field.")
        _check_lengths(request.expression for request in requests)
        wanted = {request.id: request.expression for request in requests}
        for number in [number for number, shown in self.states.items() if wanted.get(number) != shown.expression]:
            self.states.pop(number).release()
        for number, expression in wanted.items():
            if number not in self.states:
                self.states[number] = ShownStates(self._viewer, expression)

    def _replace(self, watched: WatchedTopic | None, topic: str) -> WatchedTopic | None:
        if watched is not None:
            watched.release()
        return WatchedTopic(self._viewer, topic) if topic else None

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
        self.show_table("", 0)
        self.set_states([])
        self.show_log(shown=False)
        self.show_graph(shown=False)
        self._panels = self._viewer.panels


def _check_lengths(expressions: Iterable[str]) -> None:
    if any(len(expression) > MAX_TEXT for expression in expressions):
        raise BadRequestError(f"an expression has at most {MAX_TEXT} characters")
