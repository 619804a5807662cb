# SPDX-License-Identifier: Apache-2.0
"""Warnings about received messages that could not be passed on."""

from __future__ import annotations

import time
from collections import Counter
from typing import TYPE_CHECKING, Final

from coframe.wire import names

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

REPEAT_AFTER: Final = 10.0  # seconds


class IgnoredMessages:
    """Warns about ignored messages with their number, at most every 10 s per topic.

    Args:
        warn: Called with each warning.
        clock: Returns the time in seconds.
    """

    def __init__(self, warn: Callable[[str], object], clock: Callable[[], float] = time.monotonic) -> None:
        self._warn = warn
        self._clock = clock
        self._counts: Counter[str] = Counter()
        self._due: dict[str, float] = {}

    def add(self, found: Iterable[tuple[str, int]]) -> None:
        """Count messages, given DDS topics and numbers, and warn where it is due."""
        self._counts.update(dict(found))
        now = self._clock()
        for topic in [topic for topic in self._counts if now >= self._due.get(topic, now)]:
            self._due[topic] = now + REPEAT_AFTER
            self._warn(_text(topic, self._counts.pop(topic)))


def _text(topic: str, count: int) -> str:
    messages = "1 message" if count == 1 else f"{count} messages"
    return (
        f"Ignored {messages} of {names.any_ros_name(topic)}: shorter than 4 bytes, or there was no memory. Check for a "
        "program that publishes on the topic without ROS 2."
    )
