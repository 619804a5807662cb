# SPDX-License-Identifier: Apache-2.0
"""The feeds of the panels that show several messages of a topic: the table, and the states of fields over time."""

from __future__ import annotations

import logging
from functools import partial
from typing import TYPE_CHECKING

from coframe._output.formatting import count, error_text
from coframe.errors import CoframeError
from coframe.viewer.clients._panel_feeds import PanelFeed
from coframe.viewer.clients._update import Update
from coframe.viewer.protocol.encoding import encode
from coframe.viewer.protocol.panel_messages import FieldStates, StateChange, TableColumn, TableRow, TopicTable

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from concurrent.futures import Future

    from coframe.viewer.clients._panels import ShownStates, WatchedTopic
    from coframe.viewer.clients._state import ClientState
    from coframe.viewer.panels.states import StateHistory
    from coframe.viewer.panels.table import Column, TableMessage
    from coframe.viewer.protocol.common import DisplayState

__all__ = ["StatesFeed", "TableFeed"]

_logger = logging.getLogger("coframe.viewer")

# Seconds between updates.
_TABLE_PERIOD, _STATES_PERIOD, _CLOSED_PERIOD, _READING_PERIOD, _LATE_PERIOD = 0.2, 0.2, 0.25, 0.03, 1.0

_MAX_COLUMNS = 40


class TableFeed(PanelFeed):
    """The last messages of a topic at the displayed time, which another thread reads."""

    def __init__(self, client: ClientState) -> None:
        super().__init__(client)
        self._late_due = 0.0
        self._watched: WatchedTopic | None = None
        self._columns: list[Column] = []
        self._omits_fields = False
        self._sent: set[int] = set()
        self._reading: Future[list[TableMessage]] | None = None

    def updates(self, now: float) -> Iterator[Update]:
        """Yield new rows, and the keys of all rows."""
        watched = self._panels.table
        self.due = now + (_TABLE_PERIOD if watched else _CLOSED_PERIOD)
        if watched is not self._watched:
            self._watched, self._columns, self._sent, self._reading = watched, [], set(), None
            self._omits_fields = False
        if watched is None:
            return
        if watched.messages is None and now >= self._late_due:
            self._late_due = now + _LATE_PERIOD
            watched.open_topic()
        if watched.messages is None:
            why = watched.missing_reason()
            yield Update("table", (watched.serial, why), partial(self._encode, watched, "waiting", why, [], []))
            return
        shown = watched.messages.before(self._client.at, self._panels.table_rows)
        keys = [one.key for one in shown]
        new = [one for one in shown if one.key not in self._sent]
        if self._reading is not None:
            if not self._reading.done():
                self.due = now + _READING_PERIOD
                return
            rows, self._reading = self._reading.result(), None
            self._sent = (self._sent | {row.key for row in rows}).intersection(keys)
            self._add_columns(rows)
            yield Update(None, None, partial(self._encode, watched, "ok", self._note, keys, rows))
        elif new:
            from coframe.viewer.panels.table import read_rows  # noqa: PLC0415 - needs the message classes

            self._reading = self._client.viewer.executor.submit(read_rows, new, _MAX_COLUMNS + 1)
            self.due = now + _READING_PERIOD
        else:
            self._sent.intersection_update(keys)
            text = self._note if keys else "no message yet"
            span = (watched.serial, keys[:1], keys[-1:])
            yield Update("table", span, partial(self._encode, watched, "ok" if keys else "waiting", text, keys, []))

    @property
    def _note(self) -> str:
        return f"only the first {_MAX_COLUMNS} fields are shown" if self._omits_fields else ""

    def _add_columns(self, rows: Sequence[TableMessage]) -> None:
        """Add the fields that no earlier message has: those of JSON may differ from message to message."""
        for row in rows:
            new = [column for column in row.cells if column not in self._columns]
            room = _MAX_COLUMNS - len(self._columns)
            self._columns += new[:room]
            self._omits_fields |= len(new) > room

    def _encode(
        self, watched: WatchedTopic, state: DisplayState, text: str, keys: list[int], rows: Sequence[TableMessage]
    ) -> str:
        origin = self._client.origin
        return encode(
            TopicTable(
                type="table",
                topic=watched.topic,
                message_type=watched.messages.type if watched.messages else "",
                state=state,
                text=text,
                columns=[TableColumn(path=path, type=type_) for path, type_ in self._columns],
                first=keys[0] if keys else 0,
                last=keys[-1] if keys else 0,
                rows=[
                    TableRow(
                        key=row.key,
                        stamp=float(row.time - origin),
                        cells=[row.cells.get(column, "") for column in self._columns],
                        problem=row.problem,
                    )
                    for row in rows
                ],
            )
        )


class StatesFeed(PanelFeed):
    """The states of fields, which another thread reads one topic after the other."""

    def __init__(self, client: ClientState) -> None:
        super().__init__(client)
        self._late_due = 0.0
        self._reading: tuple[list[ShownStates], Future[dict[StateHistory, Exception]]] | None = None
        self._last = -1

    def updates(self, now: float) -> Iterator[Update]:
        """Yield the new changes of all fields."""
        shown = self._panels.states
        self.due = now + (_STATES_PERIOD if shown else _CLOSED_PERIOD)
        if not shown:
            return
        if now >= self._late_due:
            self._late_due = now + _LATE_PERIOD
            for one in shown.values():
                one.open_topic()
        if self._reading is not None and self._reading[1].done():
            fields, future = self._reading
            self._reading = None
            _note_errors(fields, future.result())
        busy = self._reading[0] if self._reading is not None else ()
        for number, one in shown.items():
            if one not in busy:
                yield from self._changes(number, one)
        if self._reading is None:
            self._read_next()
        if self._reading is not None:
            self.due = now + _READING_PERIOD

    def _read_next(self) -> None:
        """Read the next messages of the next topic that has new ones, for all fields that need the same messages."""
        waiting = {number: one for number, one in self._panels.states.items() if one.history and not one.problem}
        for number in sorted(waiting, key=lambda number: (number <= self._last, number)):
            history = waiting[number].history
            if history is not None and history.done < 1.0:
                from coframe.viewer.panels.states import read_histories  # noqa: PLC0415 - needs the message classes

                fields = [one for one in waiting.values() if _needs_same_messages(one, waiting[number])]
                histories = [one.history for one in fields if one.history is not None]
                # The fields that are read with it have had their turn, too.
                self._last = max(key for key, one in waiting.items() if one in fields)
                self._reading = (fields, self._client.viewer.executor.submit(read_histories, histories))
                return

    def _changes(self, number: int, one: ShownStates) -> Iterator[Update]:
        history = one.history
        state, text = self._status(one, history)
        if history is not None and history.edition != one.edition:
            one.edition, one.seen = history.edition, None
        total = history.total if history else 0
        until = history.until if history else None
        is_new = one.seen is None or total > one.seen
        if is_new and history is not None:
            changes = history.since(one.seen or 0)
            reset, one.seen = one.seen is None, total
            yield Update(None, None, partial(self._encode, number, (state, text), until, changes, reset=reset))
        version = (one.serial, state, text, until)
        yield Update(("states", number), version, partial(self._encode, number, (state, text), until, (), reset=False))

    def _status(self, one: ShownStates, history: StateHistory | None) -> tuple[DisplayState, str]:
        if one.problem:
            return "error", one.problem
        if history is None:
            return "waiting", one.watched.missing_reason() if one.watched else ""
        if history.problem:
            return "error", error_text(history.problem)
        if history.until is None:
            return "waiting", "no message has this element" if history.skipped else "no message yet"
        if history.done < 1.0 and self._client.viewer.source.recording is not None:
            return "waiting", f"reading the recording: {100 * history.done:.0f} %"
        return "ok", _note_of(history)

    def _encode(
        self,
        number: int,
        status: tuple[DisplayState, str],
        until: int | None,
        changes: Sequence[tuple[int, str]],
        *,
        reset: bool,
    ) -> str:
        origin = self._client.origin
        return encode(
            FieldStates(
                type="states",
                id=number,
                state=status[0],
                text=status[1],
                reset=reset,
                until=None if until is None else float(until - origin),
                changes=[StateChange(stamp=float(time - origin), text=text) for time, text in changes],
            )
        )


def _needs_same_messages(one: ShownStates, other: ShownStates) -> bool:
    if one.history is None or other.history is None or one.watched is None or other.watched is None:
        return False
    return one.watched.messages is other.watched.messages and one.history.key == other.history.key


def _note_errors(fields: Sequence[ShownStates], failed: Mapping[StateHistory, Exception]) -> None:
    for one in fields:
        error = failed.get(one.history) if one.history is not None else None
        if isinstance(error, CoframeError):
            one.problem = error_text(error)
        elif error is not None:
            _logger.error("the states of a field could not be read", exc_info=error)
            one.problem = f"The states cannot be read: {type(error).__name__}: {error}."


def _note_of(history: StateHistory) -> str:
    """Return what is not shown of a field, or ""."""
    from coframe.viewer.panels.states import MAX_CHANGES  # noqa: PLC0415 - needs the message classes

    notes = []
    if history.total > MAX_CHANGES:
        notes.append(f"only the last {MAX_CHANGES} of {count(history.total, 'change')} are shown")
    if history.skipped:
        notes.append(f"{count(history.skipped, 'message')} without a value")
    return "; ".join(notes)
