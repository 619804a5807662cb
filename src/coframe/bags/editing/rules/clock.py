# SPDX-License-Identifier: Apache-2.0
"""The rule ``clock`` converts all stamps to one clock."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

from coframe.analysis.clocks import SAME_CLOCK
from coframe.bags._message_fields import MAX_STAMP
from coframe.bags.editing._rule import Rule
from coframe.errors import EditError
from coframe.time import MINUTE, SECOND

if TYPE_CHECKING:
    from coframe.bags.editing._message import EditedMessage, EditedTopic
    from coframe.bags.editing._rule import Step
    from coframe.bags.editing._survey import Survey

__all__ = ["Clock"]

_TOPIC, _TYPE = "/clock", "rosgraph_msgs/msg/Clock"
_MAX_TICKS = 1000  # of the last second of /clock that are kept
_MIN_RATE = 0.01  # simulated seconds per second, for the way back


class Clock(Rule):
    """``clock wall`` or ``clock sim``: convert stamps on the other clock with the recorded ``/clock``.

    A stamp is on the system clock if it is less than an hour from the receive time of its message, and on simulated
    time if it is less than a minute from the time of ``/clock`` then.
    """

    name = "clock"
    form = "wall|sim"
    unit = "stamp"
    verb = "converted"

    def __init__(self, text: str) -> None:
        super().__init__(text)
        if text not in {"wall", "sim"}:
            raise EditError(f"{text[:60]!r} is not a clock: wall or sim")
        self._to_sim = text == "sim"
        self._ticks: deque[tuple[int, int]] = deque(maxlen=_MAX_TICKS)  # receive times and simulated times
        self._received_count = self._simulated_count = 0
        self._rate = 1.0

    def prepare(self, survey: Survey) -> None:
        """Find the first time of /clock.

        Raises:
            EditError: The recording has no /clock.
        """
        for topic, received, message in survey.messages(_is_clock):
            if topic.stamps is not None:
                self._tick(received, topic.stamps.first(message.data))
                return
        raise EditError(
            "the recording has no /clock topic, which relates the two clocks",
            hint="`coframe doctor BAG` names the offset of each clock; `coframe bag edit --shift` removes it.",
        )

    def step(self, topic: EditedTopic) -> Step | None:
        """Return the function that converts the stamps in a message, or reads the clock."""
        stamps = topic.stamps
        if stamps is None:
            return None

        def read(message: EditedMessage) -> bool:
            self._tick(message.received, stamps.first(message.data))
            return True

        def convert(message: EditedMessage) -> bool:
            received = message.received
            new, change_count = stamps.change(message.data, lambda stamp: self._convert_stamp(stamp, received))
            if change_count:
                message.data = new
                self.changes += change_count
            return True

        if _is_clock(topic):
            return read
        return self._convert_transforms if topic.has_transforms else convert

    def _convert_transforms(self, message: EditedMessage) -> bool:
        transforms, change_count = message.transforms(), 0
        for transform in transforms:
            new = self._convert_stamp(transform.stamp, message.received) if transform.stamp else 0
            change_count += new != transform.stamp
            transform.stamp = new
        if change_count:
            message.set_transforms(transforms)
            self.changes += change_count
        return True

    def _tick(self, receive_time: int, simulated: int) -> None:
        self._received_count, self._simulated_count = receive_time, simulated
        self._ticks.append((receive_time, simulated))
        while self._ticks[0][0] < receive_time - SECOND:
            self._ticks.popleft()
        first = self._ticks[0]
        if receive_time > first[0] and simulated >= first[1]:
            self._rate = (simulated - first[1]) / (receive_time - first[0])

    def _convert_stamp(self, stamp: int, receive_time: int) -> int:
        now = self._simulated_count + round((receive_time - self._received_count) * self._rate)
        is_wall, is_simulated = abs(receive_time - stamp) < SAME_CLOCK, abs(now - stamp) < MINUTE
        if is_simulated in {is_wall, self._to_sim}:
            return stamp
        if self._to_sim:
            new = now + round((stamp - receive_time) * self._rate)
        else:
            new = receive_time + round((stamp - now) / max(self._rate, _MIN_RATE))
        return new if 0 < new < MAX_STAMP else stamp


def _is_clock(topic: EditedTopic) -> bool:
    return topic.name == _TOPIC and topic.channel.type == _TYPE and topic.stamps is not None
