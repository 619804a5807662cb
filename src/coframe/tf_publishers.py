"""Who sends transforms: since when nothing came, and by which clock they are stamped."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, NamedTuple

from coframe import frame_names

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable

__all__ = ["OnceEach", "TfPublisher", "publisher_of", "state_of"]

_NS = 1_000_000_000
SILENT_AFTER = 1.0  # seconds
# Stamps that are so far from this machine's clock are not explained by the way they had.
_CLOCK_TOLERANCE = _NS // 2
# Localisation stamps map -> odom ahead on purpose, so that it can be used till the next one comes.
_AHEAD_ON_PURPOSE = 2 * _NS
_DAY = 86_400 * _NS

Heard = tuple[int, int, int, "int | None", str, str, str]


class TfPublisher(NamedTuple):
    """A publisher of transforms, as one listener hears it.

    Attributes:
        node: Its node, such as "/robot1/driver"; "an unnamed node" where the graph does not tell.
        topic: Where it publishes.
        static: Whether its transforms hold for all times.
        messages: How many came.
        age: Seconds since the last one.
        lag: By how much its stamps were behind this machine's clock when they came, in nanoseconds, the lower
            quartile of its last messages; negative: ahead. None: static, or not enough messages yet.
        present: Whether it is still there.
        oddities: What is odd about its names, a sentence each.
    """

    node: str
    topic: str
    static: bool
    messages: int
    age: float
    lag: int | None
    present: bool
    oddities: list[str]

    def silent(self) -> bool:
        """Whether nothing came for a second of what should always move."""
        return not self.static and self.age > SILENT_AFTER

    def clock_problem(self, children: Collection[str] = ()) -> str:
        """A sentence where its stamps are not of this machine's time; "" where they are.

        Args:
            children: The frames that it tells of, if they are known: a localisation may stamp odom a little ahead.
        """
        if self.lag is None or abs(self.lag) < _CLOCK_TOLERANCE:
            return ""
        only_odom = bool(children) and all(child.rpartition("/")[2] == "odom" for child in children)
        if only_odom and -_AHEAD_ON_PURPOSE <= self.lag < 0:
            return ""
        where = "behind" if self.lag > 0 else "ahead of"
        if abs(self.lag) > _DAY:
            return f"{self.node} on {self.topic} stamps by another clock than this machine's: simulated, or recorded?"
        return (
            f"the clock of {self.node} on {self.topic} is {abs(self.lag) / _NS:.2f} s {where} this machine's: "
            "synchronise both (chrony, NTP), or its transforms meet no others"
        )


def state_of(publishers: Iterable[TfPublisher]) -> str:
    """How whoever has these publishers does.

    Returns:
        "waiting" (nothing came yet), "live", "silent" (nothing that moves for a second) or "gone" (none of them is
        there any more).
    """
    everyone = list(publishers)
    present = [publisher for publisher in everyone if publisher.present]
    moving = [publisher for publisher in everyone if not publisher.static]
    if not everyone:
        return "waiting"
    if not present:
        return "gone"
    if moving and not any(publisher.present and not publisher.silent() for publisher in moving):
        return "silent"
    return "live"


def publisher_of(heard: Heard, node: str | None, topic: str, *, static: bool, present: bool) -> TfPublisher:
    """What the native reader tells of a writer, with its node."""
    _, messages, heard_at, lag, *examples = heard
    node = node or "an unnamed node"
    age = max(0, time.monotonic_ns() - heard_at) / _NS
    odd = frame_names.naming_problems(f"{node} on {topic}", *examples)
    return TfPublisher(node, topic, static, messages, age, lag, present, odd)


class OnceEach:
    """Passes each sentence on once."""

    _MOST = 1000  # names come from the network

    def __init__(self, tell: Callable[[str], None]) -> None:
        self._tell = tell
        self._told: set[str] = set()

    def __call__(self, key: str, sentence: str) -> None:
        """Tells `sentence`, unless one with the same key was told."""
        if sentence and key not in self._told and len(self._told) < self._MOST:
            self._told.add(key)
            self._tell(sentence)
