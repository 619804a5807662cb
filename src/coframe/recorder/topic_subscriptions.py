"""A recorder's subscriptions: to every topic that is wanted, as soon as somebody publishes there, as it is offered."""

from __future__ import annotations

import re
import time
from contextlib import suppress
from typing import TYPE_CHECKING, NamedTuple

from coframe.errors import WireError
from coframe.recorder.message_queue import ReceivedMessage, Source
from coframe.wire.qos import QoS

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from coframe import _core
    from coframe.wire import EndpointInfo, GraphNode, Participant, Subscription

__all__ = ["Subscriptions", "Wanted"]

_DEPTH = 1000  # messages that wait in DDS while Python is busy
_TAKE = 256
_MOST = 4000  # subscriptions; a graph has hundreds
_HIDDEN = "/_"  # ROS's own topics, those of actions for example, have a part of the name that begins so


class Wanted:
    """Which topics are to be recorded.

    Args:
        topics: By name; None: all that are not hidden.
        regex: Besides those, if names are given, else only: topics whose whole name this matches.
        exclude: But none whose whole name this matches.

    Raises:
        ValueError: One of them is no regular expression.
    """

    def __init__(self, topics: Iterable[str] | None, regex: str | None, exclude: str | None) -> None:
        self._names = None if topics is None else {name if name.startswith("/") else f"/{name}" for name in topics}
        self._regex, self._exclude = _compiled(regex), _compiled(exclude)

    def __call__(self, topic: str) -> bool:
        """Whether this topic is."""
        if self._exclude is not None and self._exclude.fullmatch(topic):
            return False
        if self._names is None and self._regex is None:
            return _HIDDEN not in topic
        return topic in (self._names or ()) or bool(self._regex and self._regex.fullmatch(topic))

    def missing(self, there: Iterable[str]) -> list[str]:
        """The names that were given and are not among those."""
        return sorted((self._names or set()) - set(there))


class _Offer(NamedTuple):
    """Publishers of one topic that one subscription hears."""

    topic: str
    type: str
    reliable: bool
    transient_local: bool


class Subscriptions:
    """Joins topics as they appear.

    A subscription hears those only who offer as much as it asks for; one that asks for little hears everybody, but late
    joiners' messages from nobody. So there is one for each quality that is offered on a topic, and of what several
    of them hear, the one that the publisher's offer fits is believed.

    Args:
        participant: Of the graph.
        node: Whose subscriptions they are.
        wanted: Which topics.
        event: Is set when messages arrive.
    """

    def __init__(self, participant: Participant, node: GraphNode, wanted: Wanted, event: _core.Event) -> None:
        self._participant = participant
        self._node = node
        self._wanted = wanted
        self._event = event
        self._offers: dict[int, _Offer] = {}  # by publisher, also of those that have gone
        self._readers: dict[_Offer, Subscription] = {}
        self._rivals: dict[tuple[str, str], list[_Offer]] = {}  # by topic and type
        self._refused: set[_Offer] = set()

    def refresh(self) -> list[tuple[str, str, list[QoS]]]:
        """Joins what has appeared since: each new topic, its type, and what its publishers offer."""
        new: dict[tuple[str, str], list[QoS]] = {}
        for topic, publishers in self._participant.published().items():
            if self._wanted(topic):
                for handle, publisher in publishers.items():
                    self._join(topic, handle, publisher, new)
        return [(topic, ros_type, offered) for (topic, ros_type), offered in new.items()]

    def topics(self) -> set[str]:
        """Those that were joined."""
        return {topic for topic, _ in list(self._rivals)}

    def refused(self) -> set[str]:
        """Those that cannot be joined: their type is not ROS's, or there are too many."""
        return {offer.topic for offer in list(self._refused)}

    def take(self) -> Iterator[ReceivedMessage]:
        """What has arrived, first that of latched topics, which others build upon."""
        for offer, reader in sorted(self._readers.items(), key=lambda pair: not pair[0].transient_local):
            source = Source(offer.topic, offer.type, offer.transient_local)
            while reader.pending():
                for sample in reader.take(_TAKE):
                    if self._is_for(offer, sample.writer):
                        yield ReceivedMessage(
                            source, sample.data, time.time_ns(), sample.source_timestamp, sample.writer
                        )

    def close(self) -> None:
        """Leaves all topics."""
        for reader in self._readers.values():
            reader.close()

    def _join(self, topic: str, handle: int, publisher: EndpointInfo, new: dict[tuple[str, str], list[QoS]]) -> None:
        key = (topic, publisher.ros_type)
        offer = _Offer(*key, publisher.qos.reliable, publisher.qos.transient_local)
        self._offers[handle] = offer
        if offer in self._refused or (offer not in self._readers and not self._subscribe(offer)):
            return
        rivals = self._rivals.setdefault(key, [])
        if key in new or not rivals:
            new.setdefault(key, []).append(publisher.qos)
        if offer not in rivals:
            rivals.append(offer)

    def _subscribe(self, offer: _Offer) -> bool:
        if len(self._readers) < _MOST and "/" in offer.type:  # as all types of ROS have
            qos = QoS(depth=_DEPTH, reliable=offer.reliable, transient_local=offer.transient_local)
            with suppress(WireError):
                self._readers[offer] = self._participant.raw_subscription(
                    self._node, offer.topic, offer.type, qos, on_data=self._event, adapts=True
                )
                return True
        self._refused.add(offer)
        return False

    def _is_for(self, offer: _Offer, publisher: int) -> bool:
        rivals = self._rivals[offer.topic, offer.type]
        if len(rivals) == 1:
            return True
        if publisher not in self._offers:
            self.refresh()
        # Of a publisher that nobody has told of, the least demanding subscription hears all that anybody does.
        return self._offers.get(publisher, min(rivals)) == offer


def _compiled(regex: str | None) -> re.Pattern[str] | None:
    try:
        return None if regex is None else re.compile(regex)
    except re.error as error:
        raise ValueError(f"{regex!r} is no regular expression: {error}") from None
