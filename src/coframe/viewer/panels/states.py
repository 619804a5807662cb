# SPDX-License-Identifier: Apache-2.0
"""The states of a field over time: strings, flags, and numbers with the names of their constants."""

from __future__ import annotations

from collections import deque
from dataclasses import replace
from itertools import islice
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.errors import PlotError
from coframe.plotting.expressions import FieldExpression, parse_expression
from coframe.plotting.values import NoElementError, field_content, field_names

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.viewer.sources.topic_messages import StampedMessage, TopicMessages

__all__ = ["MAX_CHANGES", "StateHistory", "StateSpan", "parse_state_field", "read_histories", "state_text"]

MAX_CHANGES = 5000
_MAX_TEXT = 100
_BATCH = 500  # messages per call, so that a long recording can be interrupted


class StateSpan(NamedTuple):
    """The value of a field from a time in nanoseconds until the next change."""

    time: int
    text: str


def parse_state_field(text: str) -> FieldExpression:
    """Return a field of a topic.

    Raises:
        PlotError: The text is not a field of a topic.
    """
    expression = parse_expression(text)
    if not isinstance(expression, FieldExpression):
        raise PlotError(f"{text!r} is not a field of a topic", hint="Write, for example: /state.data")
    return expression


def read_histories(histories: Sequence[StateHistory]) -> dict[StateHistory, Exception]:
    """Read the next messages of a topic for several fields, and return the errors of fields that cannot be read.

    Args:
        histories: Histories of the same messages, which have been read up to the same one.
    """
    failed: dict[StateHistory, Exception] = {}
    for message in histories[0].next_messages():
        try:
            content = message.read()
        except ValueError:  # The bytes do not match the type.
            content = None
        for history in histories:
            if history in failed:
                continue
            try:
                history.add(message, content)
            except Exception as error:  # noqa: BLE001 - one field must not stop the others
                failed[history] = error
    return failed


class StateHistory:
    """The changes of a field, which another thread reads batch by batch with `read_histories`.

    Args:
        field: The field.
        messages: The messages of its topic.

    Attributes:
        key: The key of the last message that was read.
        total: The number of changes that were found.
        edition: A number that changes if changes were removed, because the time of the topic jumped back.
        until: The time of the last message that was read in nanoseconds, or None before the first one.
        skipped: The number of messages without a value.
        problem: Why no message has had a value yet, or None.
    """

    def __init__(self, field: FieldExpression, messages: TopicMessages) -> None:
        self._field, self._messages = field, messages
        self._changes: deque[StateSpan] = deque(maxlen=MAX_CHANGES)
        self.key = self.edition = 0
        self.total = self.skipped = 0
        self.until: int | None = None
        self.problem: PlotError | None = None
        self._last_text = ""  # in full: two long texts may begin with the same characters

    @property
    def done(self) -> float:
        """The part of the messages that was read, from 0 to 1."""
        newest = self._messages.at(0)
        return 1.0 if newest is None else min(1.0, self.key / newest.key)

    def next_messages(self) -> list[StampedMessage]:
        """Return the next messages to read."""
        newest = self._messages.at(0)
        if newest is None or newest.key <= self.key:
            return []
        # Keys of a live topic begin late when old messages were dropped; the first known one is the next.
        return self._messages.after(self.key, self._next_key(newest))

    def since(self, total: int) -> list[StateSpan]:
        """Return the changes after the first `total` ones, as far as they are kept."""
        first = max(0, len(self._changes) - (self.total - total))
        return list(islice(self._changes, first, None))

    def _next_key(self, newest: StampedMessage) -> int:
        known = self._messages.times()
        oldest = newest.key - len(known) + 1
        return min(newest.key, max(self.key, oldest - 1) + _BATCH)

    def add(self, message: StampedMessage, content: Any) -> None:
        """Add the value in a message.

        Args:
            message: The message.
            content: Its content, or None if it cannot be read.

        Raises:
            PlotError: The type has no such field.
        """
        self.key = message.key
        if content is None:
            self.skipped += 1
            return
        try:
            text = state_text(content, self._field, self._messages.type)
        except NoElementError:
            self.skipped += 1
            return
        except PlotError as error:
            if not isinstance(content, dict):
                raise
            self.skipped += 1  # Other objects of JSON may have the field.
            self.problem = error if self.until is None else None
            return
        if self.until is not None and message.time < self.until:
            self._forget_after(message.time)
        if self.until is None or self._last_text != text:
            self._changes.append(StateSpan(message.time, _shorten(text)))
            self._last_text = text
            self.total += 1
        self.until, self.problem = message.time, None

    def _forget_after(self, time: int) -> None:
        """Remove the changes at and after a time to which the topic has jumped back."""
        self.edition += 1
        self.until = None  # The state at the new time is a change.
        while self._changes and self._changes[-1].time >= time:
            self._changes.pop()
            self.total -= 1


def state_text(message: Any, field: FieldExpression, type_: str) -> str:
    """Return the value of a field as text; numbers are followed by the name of their constant.

    Raises:
        PlotError: The field does not exist, or has no value of its own.
        NoElementError: A sequence is too short for an index.
    """
    value = field_content(message, field, type_)
    if isinstance(value, str):
        return value
    if isinstance(value, bool | np.bool_):
        return "true" if value else "false"
    is_octet = isinstance(value, bytes) and len(value) == 1
    if isinstance(value, int | np.integer) or is_octet:
        number = value[0] if isinstance(value, bytes) else int(value)
        return f"{number} {_constant(message, field, type_, value)}".rstrip()
    if isinstance(value, float | np.floating):
        return f"{float(value):.6g}"
    names = field_names(value)
    if names:
        hint = f"Choose a field, such as {field.text}.{names[0]}."
        raise PlotError(f"{field.text} is a message, not a state", hint=hint)
    raise PlotError(f"{field.text} is a sequence, not a state", hint=f"Choose an element, such as {field.text}[0].")


def _shorten(text: str) -> str:
    """Return a text with at most 100 characters, and an ellipsis if it is longer."""
    return text if len(text) <= _MAX_TEXT else f"{text[:_MAX_TEXT]}…"


def _constant(message: Any, field: FieldExpression, type_: str, value: Any) -> str:
    """Return the name of the constant with a value, or "" if none or several have it."""
    name = field.path[-1]
    parent = field_content(message, replace(field, path=field.path[:-1]), type_)
    constants = [key for key, constant in vars(type(parent)).items() if key.isupper() and _is_same(constant, value)]
    if len(constants) > 1:
        constants = [key for key in constants if key.startswith(f"{name}_".upper())]
    return constants[0] if len(constants) == 1 else ""


def _is_same(constant: Any, value: Any) -> bool:
    return type(constant) is type(value) and bool(constant == value)
