# SPDX-License-Identifier: Apache-2.0
"""The rule ``time``: only the messages of a time span are kept."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.bags.editing._rule import Rule
from coframe.bags.time_points import parse_time_point
from coframe.errors import EditError

if TYPE_CHECKING:
    from coframe.bags.editing._message import EditedMessage, EditedTopic
    from coframe.bags.editing._rule import Step
    from coframe.bags.editing._survey import Survey

__all__ = ["TimeRange"]

_ANY_SPAN = (0, 1 << 62)  # for checking the form of a time before the recording is known


class TimeRange(Rule):
    """``time 10s..-2s``: by receive time, both ends included. Static transforms before the start move to the start."""

    name = "time"
    form = "START..END"
    verb = "removed"

    def __init__(self, text: str) -> None:
        super().__init__(text)
        start, dots, end = text.partition("..")
        if not dots or not (start.strip() or end.strip()):
            raise EditError(f"{text[:60]!r} does not have the form {self.form}, such as 10s..60s, 10s.. or ..-2s")
        self._ends = (start.strip() or "start", end.strip() or "end")
        self._points(_ANY_SPAN)
        self._first, self._last = _ANY_SPAN

    def prepare(self, survey: Survey) -> None:
        """Compute the two times.

        Raises:
            EditError: The start is after the end.
        """
        self._first, self._last = self._points(survey.span)
        if self._first > self._last:
            raise EditError(f"the start of {self.text!r} is after its end")

    def _points(self, span: tuple[int, int]) -> tuple[int, int]:
        try:
            first, last = (parse_time_point(text, span) for text in self._ends)
        except ValueError as error:
            raise EditError(f"{self.text[:60]!r}: {error}") from None
        return first, last

    def start(self, first: int) -> int:
        """Return the start of the span."""
        return max(first, self._first)

    def step(self, topic: EditedTopic) -> Step | None:
        """Return the function that drops the messages outside of the span."""
        return self._static_step if topic.is_static else self._usual_step

    def _usual_step(self, message: EditedMessage) -> bool:
        if self._first <= message.received <= self._last:
            return True
        self.changes += 1
        return False

    def _static_step(self, message: EditedMessage) -> bool:
        if message.received < self._first:
            message.received = message.published = self._first
            return True
        return self._usual_step(message)
