# SPDX-License-Identifier: Apache-2.0
"""The feeds of the panels next to the scene; closed panels cost nothing."""

from __future__ import annotations

import logging
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.errors import CoframeError
from coframe.viewer.clients._update import Feed, Update
from coframe.viewer.protocol.encoding import CurvePoints, encode, encode_curves
from coframe.viewer.protocol.panel_messages import CurveStatus, Inspection, LogEntries, LogEntry

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from concurrent.futures import Future

    from coframe.viewer.clients._panels import ClientPanels, ShownCurve, WatchedTopic
    from coframe.viewer.clients._state import ClientState
    from coframe.viewer.panels.own_messages import LogLine
    from coframe.viewer.protocol.common import DisplayState
    from coframe.viewer.protocol.panel_messages import InspectedField
    from coframe.viewer.sources.topic_messages import StampedMessage, TopicMessages

__all__ = ["PanelFeed", "panel_feeds"]

_logger = logging.getLogger("coframe.viewer")

# Seconds between updates.
_CURVES_PERIOD, _INSPECTION_PERIOD, _LOG_PERIOD, _GRAPH_PERIOD, _CLOSED_PERIOD = 0.1, 0.2, 0.2, 0.5, 0.25
_READING_PERIOD = 0.03
_LATE_PERIOD = 1.0  # seconds between attempts to open a topic that does not exist
_MAX_LINES = 1000  # maximum number of log messages per update
_RATE_MESSAGES = 200  # number of messages from which the rate is computed


class PanelFeed:
    """A feed that does nothing while its panel is closed."""

    def __init__(self, client: ClientState) -> None:
        self.due = 0.0
        self._client = client

    @property
    def _panels(self) -> ClientPanels:
        return self._client.panels


class CurvesFeed(PanelFeed):
    """The points and statuses of all curves."""

    def updates(self, now: float) -> Iterator[Update]:
        """Yield the statuses, and new points of all curves in one message."""
        shown = self._panels.curves
        self.due = now + (_CURVES_PERIOD if shown else _CLOSED_PERIOD)
        if not shown:
            return
        parts = []
        for number, one in shown.items():
            status = one.curve.status
            version = (one.expression, status, one.curve.axis)
            yield Update(("curve", number), version, partial(self._encode_status, number, one))
            points = self._new_points(number, one)
            if points is not None:
                parts.append(points)
        if parts:
            yield Update(None, None, partial(encode_curves, parts, self._client.origin))

    def _encode_status(self, number: int, one: ShownCurve) -> str:
        state, text, hint, points = one.curve.status
        axis = one.curve.axis
        return encode(CurveStatus(type="curve", id=number, state=state, text=text, hint=hint, axis=axis, points=points))

    def _new_points(self, number: int, one: ShownCurve) -> CurvePoints | None:
        """Return the points that the client does not have, or None if there are none."""
        curve, span = one.curve, self._panels.span
        is_recorded = self._client.viewer.source.recording is not None
        reset = one.version != curve.version or (is_recorded and one.span != span)
        if span is None or not (reset or curve.total > one.seen):
            return None
        points = curve.points(0 if reset else one.seen, span)
        one.version, one.seen, one.span = curve.version, curve.total, span
        return CurvePoints(number, reset, points.times, points.values)


class _InspectedMessage(NamedTuple):
    """An inspected message, or why there is none; `key` identifies it."""

    topic: WatchedTopic | None
    key: object
    state: DisplayState
    text: str
    message_type: str = ""
    stamp: int | None = None
    rate: float | None = None
    fields: Sequence[InspectedField] = ()


class InspectionFeed(PanelFeed):
    """The newest message of the inspected topic at the displayed time, which another thread reads."""

    def __init__(self, client: ClientState) -> None:
        super().__init__(client)
        self._late_due = 0.0
        self._inspection: Future[_InspectedMessage] | None = None
        self._shown_message = _InspectedMessage(None, None, "waiting", "")

    def updates(self, now: float) -> Iterator[Update]:
        """Yield the last message that was read."""
        watched = self._panels.inspected
        self.due = now + (_INSPECTION_PERIOD if watched else _CLOSED_PERIOD)
        if watched is None:
            return
        if watched.messages is None and now >= self._late_due:
            self._late_due = now + _LATE_PERIOD
            watched.open_topic()
        self._read(watched)
        if self._inspection is not None and self._inspection.done():
            found, self._inspection = self._inspection.result(), None
            if found.topic is watched:
                self._shown_message = found
        elif self._inspection is not None:
            self.due = now + _READING_PERIOD
        publishers = self._publishers(watched.topic)
        if self._shown_message.topic is watched:
            version = (watched.serial, self._shown_message.key, publishers)
            yield Update("inspection", version, partial(self._encode, publishers))

    def _read(self, watched: WatchedTopic) -> None:
        """Start to read the message at the displayed time, unless it is already shown."""
        messages, at = watched.messages, self._client.at
        if messages is None:
            why = watched.missing_reason()
            self._shown_message = _InspectedMessage(watched, why, "waiting", why)
            return
        found = messages.at(at)
        key = None if found is None else found.key
        if found is None:
            when = "yet" if at == 0 else "before this time"
            self._shown_message = _InspectedMessage(watched, key, "waiting", f"no message {when}", messages.type)
        elif (watched, key) != (self._shown_message.topic, self._shown_message.key) and self._inspection is None:
            executor = self._client.viewer.executor
            self._inspection = executor.submit(_read_message, watched, messages, found, at)

    def _encode(self, publishers: Sequence[str]) -> str:
        shown = self._shown_message
        return encode(
            Inspection(
                type="inspection",
                topic=shown.topic.topic if shown.topic else "",
                message_type=shown.message_type,
                state=shown.state,
                text=shown.text,
                stamp=None if shown.stamp is None else float(shown.stamp - self._client.origin),
                rate=shown.rate,
                publishers=list(publishers),
                fields=list(shown.fields),
            )
        )

    def _publishers(self, topic: str) -> tuple[str, ...]:
        connection = self._client.viewer.source.connection
        if connection is None:
            return ()
        publishers = connection.participant.publishers(topic)
        return tuple(sorted({f"{one.namespace.rstrip('/')}/{one.node}" for one in publishers}))


def _read_message(
    watched: WatchedTopic, messages: TopicMessages, message: StampedMessage, at: int
) -> _InspectedMessage:
    """Return the content of a message, or an error message, because a message may contain anything."""
    from coframe.viewer.panels.message_fields import message_rows  # noqa: PLC0415 - needs the message classes

    rate = _rate(messages, at)
    failed = _InspectedMessage(watched, message.key, "error", "", messages.type, message.time, rate)
    try:
        content: Any = message.read()
        if isinstance(content, bytes):
            return failed._replace(text=f"{len(content)} bytes; the definition of {messages.type} is unknown")
        return failed._replace(state="ok", fields=message_rows(watched.topic, content))
    except (CoframeError, ValueError) as error:
        return failed._replace(text=f"the message cannot be read: {error}")
    except Exception as error:
        _logger.exception("a message could not be inspected")
        return failed._replace(text=f"the message cannot be read: {type(error).__name__}: {error}")


class LogFeed(PanelFeed):
    """The log messages that the client does not have."""

    def updates(self, now: float) -> Iterator[Update]:
        """Yield new messages."""
        panels = self._panels
        self.due = now + (_LOG_PERIOD if panels.shows_log else _CLOSED_PERIOD)
        if not panels.shows_log:
            return
        log = self._client.viewer.panels.log
        yield Update("log text", log.text, partial(self._encode, 0))
        if log.total > (panels.log_seen or 0):
            yield Update(None, None, partial(self._encode, _MAX_LINES))

    def _encode(self, most: int) -> str:
        panels, log, origin = self._panels, self._client.viewer.panels.log, self._client.origin
        reset = panels.log_seen is None
        seen = panels.log_seen or 0
        omitted = max(0, log.total - seen - len(log.lines)) if most else 0
        lines = log.since(seen, most)
        panels.log_seen = seen + omitted + len(lines)
        return encode(
            LogEntries(
                type="log",
                reset=reset,
                text=log.text,
                omitted=omitted,
                entries=[_entry(line, origin) for line in lines],
            )
        )


class GraphFeed(PanelFeed):
    """The graph of nodes and topics."""

    def updates(self, now: float) -> Iterator[Update]:
        """Yield the graph."""
        shown = self._panels.shows_graph
        self.due = now + (_GRAPH_PERIOD if shown else _CLOSED_PERIOD)
        if shown:
            graph = self._client.viewer.panels.graph
            yield Update("graph", (id(graph), graph.version), lambda: encode(graph.graph))


def panel_feeds(client: ClientState) -> list[Feed]:
    """Return the feeds of the panels of a client."""
    return [CurvesFeed(client), InspectionFeed(client), LogFeed(client), GraphFeed(client)]


def _entry(line: LogLine, origin: int) -> LogEntry:
    stamp = float(line.stamp - origin)
    return LogEntry(stamp=stamp, level=line.level, node=line.node, text=line.text, place=line.place)


def _rate(messages: TopicMessages, at: int) -> float | None:
    """Return the mean rate in the second before a time; None with fewer than two messages."""
    from coframe.plotting.values import rates  # noqa: PLC0415 - only an inspected topic needs it

    times = messages.times()
    end = len(times) if at == 0 else int(times.searchsorted(at, side="right"))
    found = rates(times[max(0, end - _RATE_MESSAGES) : end])
    return float(found[-1]) if len(found) and found[-1] == found[-1] else None
