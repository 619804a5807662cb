# SPDX-License-Identifier: Apache-2.0
"""State, clocks and frame names of transform publishers, from the messages that a subscription received."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, NamedTuple

from coframe import frame_names
from coframe.analysis.clocks import clock_of
from coframe.analysis.liveness import is_stale
from coframe.time import MILLISECOND, SECOND
from coframe.wire.names import any_ros_name

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable

    from coframe.wire.participant import Participant
    from coframe.wire.tf_reader import TfReader, WriterStatistics

__all__ = ["TfPublisher", "publisher_state", "publishers_of", "tf_publisher"]

# A larger difference between stamps and the clock of this machine cannot be explained by transport delay.
_CLOCK_TOLERANCE = 500 * MILLISECOND
# Localization nodes stamp map -> odom ahead of time, so that the transform is valid until the next one.
_INTENTIONAL_LEAD = 2 * SECOND


class TfPublisher(NamedTuple):
    """A publisher of transforms, as seen by one subscription.

    Attributes:
        node: The full name of its node, such as "/robot1/driver"; "an unnamed node" if it is unknown.
        topic: The topic on which it publishes, such as "/tf".
        static: Whether its transforms are static.
        messages: The number of messages received.
        age: The time since the last message arrived, in seconds.
        period: The median interval between the arrivals of the last messages, in seconds; 0.0 with fewer than two.
        lag: The delay of its stamps relative to the clock of this machine on arrival, in nanoseconds: the lower
            quartile of the last messages. Negative if the stamps are ahead. None if it is static or there are too
            few messages.
        is_present: Whether the publisher is still on the graph.
        naming_problems: Warnings about its frame names.
    """

    node: str
    topic: str
    static: bool
    messages: int
    age: float
    period: float
    lag: int | None
    is_present: bool
    naming_problems: list[str]

    def stale(self) -> bool:
        """Return whether the publisher is stale, by the rule for edges (see :mod:`coframe.analysis.liveness`)."""
        return is_stale(self.age * SECOND, self.period * SECOND, static=self.static)

    def clock_problem(self, children: Collection[str] = ()) -> str:
        """Return a warning if the stamps do not match the clock of this machine, else "".

        Args:
            children: The child frames of its transforms, if known. A localization node may stamp the transform to odom
                up to 2 s ahead.
        """
        if self.lag is None or abs(self.lag) < _CLOCK_TOLERANCE:
            return ""
        only_odom = bool(children) and all(child.rpartition("/")[2] == "odom" for child in children)
        if only_odom and -_INTENTIONAL_LEAD <= self.lag < 0:
            return ""
        if clock_of(self.lag) == "other":
            return (
                f"{self.node} on {self.topic} uses a different clock for its stamps than this machine, such as a "
                "simulated or recorded one: check use_sim_time"
            )
        where = "behind" if self.lag > 0 else "ahead of"
        return (
            f"the clock of {self.node} on {self.topic} is {abs(self.lag) / SECOND:.2f} s {where} the clock of this "
            "machine: synchronize the clocks (chrony, NTP), or lookups with its transforms will fail"
        )


def publisher_state(publishers: Iterable[TfPublisher]) -> str:
    """Return the state of a robot from its publishers.

    Returns:
        "waiting" (no message has arrived), "live", "stale" (no dynamic transform has arrived recently) or "gone" (all
        publishers have left).
    """
    received = list(publishers)
    dynamic = [publisher for publisher in received if not publisher.static]
    if not received:
        return "waiting"
    if not any(publisher.is_present for publisher in received):
        return "gone"
    if dynamic and not any(publisher.is_present and not publisher.stale() for publisher in dynamic):
        return "stale"
    return "live"


def publishers_of(participant: Participant, reader: TfReader) -> list[TfPublisher]:
    """Return the publishers from which a reader has received transforms, including those that have left."""
    received = reader.writer_statistics()
    if not received:
        return []
    topic = any_ros_name(reader.topic)
    is_present = participant.writers(topic)
    return [
        tf_publisher(
            statistics,
            participant.writer_node(statistics.writer),
            topic,
            static=reader.static,
            is_present=statistics.writer in is_present,
        )
        for statistics in received
    ]


def tf_publisher(
    statistics: WriterStatistics, node: str | None, topic: str, *, static: bool, is_present: bool
) -> TfPublisher:
    """Return a publisher from the statistics of its writer.

    Args:
        statistics: Statistics of the messages received from the writer.
        node: The full name of its node, or None if it is unknown.
        topic: The topic on which the writer publishes.
        static: Whether its transforms are static.
        is_present: Whether the writer is still on the graph.
    """
    node = node or "an unnamed node"
    age = max(0, time.monotonic_ns() - statistics.received_at) / SECOND
    problems = frame_names.naming_problems(
        f"{node} on {topic}", statistics.slashed, statistics.prefixed, statistics.plain
    )
    period = statistics.period / SECOND
    return TfPublisher(node, topic, static, statistics.messages, age, period, statistics.lag, is_present, problems)
