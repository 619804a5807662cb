# SPDX-License-Identifier: Apache-2.0
"""The rule ``rate``: a topic is thinned to a rate."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from coframe._output.formatting import did_you_mean
from coframe.bags.editing._rule import Rule, split_pair
from coframe.errors import EditError
from coframe.frame_names import absolute
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Hashable

    from coframe.bags.editing._message import EditedMessage, EditedTopic
    from coframe.bags.editing._rule import Step
    from coframe.bags.editing._survey import Survey

__all__ = ["Rate"]

_PERIOD_TOLERANCE = 0.1  # of a period by which a message may come early: recorded periods vary
_MAX_EDGES = 100_000


class Rate(Rule):
    """``rate /imu=10``: at most 10 messages per second by receive time.

    For transforms, the rate is that of each child frame.
    """

    name = "rate"
    form = "TOPIC=HZ"
    verb = "removed"

    def __init__(self, text: str) -> None:
        super().__init__(text)
        topic, rate = split_pair(text, self.form)
        self._topic = absolute(topic)
        try:
            hertz = float(rate.lower().removesuffix("hz"))
        except ValueError:
            hertz = math.nan
        if not 1e-6 < hertz < 1e9:
            raise EditError(f"{text[:60]!r}: {rate[:30]!r} is not a rate in Hz, such as 10 or 0.5")
        self._period = SECOND / hertz
        self._next_due: dict[Hashable, float] = {}

    def step(self, topic: EditedTopic) -> Step | None:
        """Return the function that drops messages that come too early."""
        if absolute(topic.name) != self._topic:
            return None
        return self._thin_transforms if topic.has_transforms else self._thin

    def _is_due(self, key: Hashable, now: int) -> bool:
        due = self._next_due.get(key)
        if due is not None and due - 2.0 * self._period < now < due - _PERIOD_TOLERANCE * self._period:
            return False
        is_regular = due is not None and abs(now - due) < self._period
        if len(self._next_due) < _MAX_EDGES or due is not None:
            self._next_due[key] = (due if is_regular and due is not None else now) + self._period
        return True

    def _thin(self, message: EditedMessage) -> bool:
        if self._is_due(None, message.received):
            return True
        self.changes += 1
        return False

    def _thin_transforms(self, message: EditedMessage) -> bool:
        transforms = message.transforms()
        kept_transforms = [transform for transform in transforms if self._is_due(transform.child, message.received)]
        if len(kept_transforms) == len(transforms):
            return True
        if not kept_transforms:
            self.changes += 1
            return False
        message.set_transforms(kept_transforms)
        return True

    def nearest(self, survey: Survey) -> str:
        """Return a hint with similar topics."""
        return did_you_mean(self._topic, survey.input_topics)
