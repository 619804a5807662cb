# SPDX-License-Identifier: Apache-2.0
"""Request the history of transient-local writers on Fast DDS as soon as they are discovered.

Without this, a reader of Cyclone DDS receives it after up to 3 s. Fast DDS sends a heartbeat when it discovers a
reader, usually before Cyclone DDS has discovered the writer, and Cyclone DDS ignores heartbeats of unknown writers.
Fast DDS in turn ignores the request that Cyclone DDS sends when it discovers the writer (ACKNACK with the count 0 and
the base 1, where Fast DDS expects at least 1 and 0). The next chance is the periodic heartbeat of the writer.

Fast DDS also sends a heartbeat to every further reader. Therefore another reader of this process joins the topic for a
moment when the writer is known. All readers of the process receive the history that this reader requests.
"""

from __future__ import annotations

import time
from array import array
from typing import TYPE_CHECKING, Final

from coframe import _core
from coframe.time import MILLISECOND, SECOND
from coframe.wire import vendors
from coframe.wire.dds.topics import create_topic
from coframe.wire.rtps.user_data import REQUESTS_HISTORY

if TYPE_CHECKING:
    from coframe.wire.graph import DiscoveredEndpoint
    from coframe.wire.rtps.graph import DdsGraph

# How long each attempt lasts, unless all writers respond. They respond within 20 ms, or not at all if they have not
# written anything; their heartbeats may be lost.
_ATTEMPTS: Final = (50 * MILLISECOND, 100 * MILLISECOND, 200 * MILLISECOND)
_QOS: Final = _core.QosProfile(depth=1, reliable=True, transient_local=True, keep_all=False)
_MAX_MESSAGES: Final = 10_000  # whose writers are remembered during one attempt; without their bytes


class _Topic:
    """The writers on a topic that have not responded, with the number of attempts, and the reader that requests."""

    def __init__(self) -> None:
        self.attempts: dict[int, int] = {}
        self.reader: _core.Tap | None = None
        self.asked: set[int] = set()
        self.due = 0


class HistoryRequests:
    """Requests the history of writers for the transient-local readers of a participant.

    Args:
        participant: The participant whose readers need the history.
        graph: The graph, which knows the writers and the readers of the participant.
    """

    def __init__(self, participant: _core.DomainParticipant, graph: DdsGraph) -> None:
        self._participant = participant
        self._guid = participant.guid
        self._graph = graph
        self._version = -1
        self._known_writers: set[int] = set()  # writers on Fast DDS, whether or not a reader needs their history
        self._topics: dict[tuple[str, str], _Topic] = {}  # by name and type

    def update(self) -> int:
        """Send the requests that are due. Return the time until the next call in nanoseconds."""
        if self._graph.version != self._version:
            self._version = self._graph.version
            self._find_writers()
        for name, topic in list(self._topics.items()):
            self._end_attempt(topic)
            if topic.reader is None and not self._begin_attempt(name, topic):
                del self._topics[name]
        now = time.monotonic_ns()
        return min((max(topic.due - now, 0) for topic in self._topics.values()), default=SECOND)

    def close(self) -> None:
        """Stop."""
        for topic in self._topics.values():
            if topic.reader is not None:
                topic.reader.close()
        self._topics.clear()

    def _find_writers(self) -> None:
        """Find new writers on Fast DDS, and forget those that have left."""
        slow = {handle: writer for handle, writer in self._graph.all_writers().items() if _has_slow_history(writer)}
        for topic in self._topics.values():
            topic.attempts = {handle: number for handle, number in topic.attempts.items() if handle in slow}
        new = slow.keys() - self._known_writers
        self._known_writers = set(slow)
        if not new:
            return
        read = self._graph.read_history(self._guid)
        for handle in new:
            name = slow[handle].topic, slow[handle].type
            if name in read:
                self._topics.setdefault(name, _Topic()).attempts[handle] = 0

    def _begin_attempt(self, name: tuple[str, str], topic: _Topic) -> bool:
        """Create the reader of a topic. Return False if no writer is left to ask."""
        topic.attempts = {handle: number for handle, number in topic.attempts.items() if number < len(_ATTEMPTS)}
        if not topic.attempts:
            return False
        participant = self._participant.entity
        handle = create_topic(participant, *name)
        topic.reader = _core.Tap(participant, handle, _QOS, REQUESTS_HISTORY, 0, _MAX_MESSAGES, 1)
        topic.asked = set(topic.attempts)
        topic.due = time.monotonic_ns() + _ATTEMPTS[min(topic.attempts.values())]
        return True

    def _end_attempt(self, topic: _Topic) -> None:
        """Close the reader of a topic if all writers have responded or the attempt is over."""
        if topic.reader is None:
            return
        for handle in array("Q", topic.reader.take()[4]):
            topic.attempts.pop(handle, None)
        waiting = topic.asked & topic.attempts.keys()
        if waiting and time.monotonic_ns() < topic.due:
            return
        topic.reader.close()
        topic.reader = None
        for handle in waiting:
            topic.attempts[handle] += 1


def _has_slow_history(writer: DiscoveredEndpoint) -> bool:
    return writer.qos.transient_local and vendors.vendor(writer.guid) == vendors.FAST_DDS
