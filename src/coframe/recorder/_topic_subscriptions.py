# SPDX-License-Identifier: Apache-2.0
"""The subscriptions of a recorder: to each selected topic with the offered QoS, as soon as it has a publisher."""

from __future__ import annotations

import time
from contextlib import suppress
from typing import TYPE_CHECKING, NamedTuple

from coframe.errors import WireError
from coframe.recorder._message_queue import MessageSource, ReceivedMessage
from coframe.wire.qos import QoS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe import _core
    from coframe.recorder._topic_filter import TopicFilter
    from coframe.wire.endpoints import GraphNode, Subscription
    from coframe.wire.graph import EndpointInfo
    from coframe.wire.participant import Participant

__all__ = ["TopicSubscriptions"]

_DEPTH = 1000  # messages that the middleware queues while Python is busy
_BATCH = 256  # messages
_MAX_SUBSCRIPTIONS = 4000  # a typical graph has hundreds of topics
MAX_PUBLISHERS = 100_000  # limit of the publishers whose QoS is stored, and of topics that cannot be recorded


class _OfferedTopic(NamedTuple):
    """A topic with the QoS that a group of its publishers offers. There is one subscription for each."""

    topic: str
    type: str
    reliable: bool
    transient_local: bool


class TopicSubscriptions:
    """The subscriptions to the selected topics, which are created as topics appear.

    A subscription matches only publishers that offer at least what it requests. One with weak requirements matches all
    publishers, but receives no latched messages. Therefore, there is one subscription for each QoS that is offered on a
    topic. If several of them receive a message, the subscription whose request equals the publisher's offer delivers
    it.

    Args:
        participant: The participant that creates the subscriptions.
        node: The node that owns the subscriptions.
        topic_filter: The selection of topics.
        event: An event that is set when messages arrive.
    """

    def __init__(
        self, participant: Participant, node: GraphNode, topic_filter: TopicFilter, event: _core.Event
    ) -> None:
        self._participant = participant
        self._node = node
        self._filter = topic_filter
        self._event = event
        self._offers: dict[int, _OfferedTopic] = {}  # by publisher, including those that have left
        self._readers: dict[_OfferedTopic, Subscription] = {}
        self._topic_offers: dict[tuple[str, str], list[_OfferedTopic]] = {}  # by topic and type
        self._unrecordable: set[_OfferedTopic] = set()

    def refresh(self) -> list[tuple[str, str, list[QoS]]]:
        """Subscribe to new topics. Return the name, the type and the offered QoS profiles of each new topic."""
        new: dict[tuple[str, str], list[QoS]] = {}
        for topic, publishers in self._participant.published().items():
            for handle, publisher in publishers.items():
                if self._filter(topic, publisher.ros_type):
                    self._add_publisher(topic, handle, publisher, new)
        return [(topic, ros_type, offered) for (topic, ros_type), offered in new.items()]

    def topics(self) -> set[str]:
        """Return the subscribed topics."""
        return {topic for topic, _ in list(self._topic_offers)}

    def unrecordable_topics(self) -> set[str]:
        """Return the topics that cannot be recorded: their type is not a ROS type, or there are too many topics."""
        return {offer.topic for offer in list(self._unrecordable)}

    def take(self) -> Iterator[ReceivedMessage]:
        """Yield the received messages, starting with latched topics, because other messages depend on them."""
        for offer, reader in sorted(self._readers.items(), key=lambda pair: not pair[0].transient_local):
            source = MessageSource(offer.topic, offer.type, offer.transient_local)
            while reader.pending():
                for sample in reader.take(_BATCH):
                    if self._accepts(offer, sample.writer):
                        yield ReceivedMessage(
                            source, sample.data, time.time_ns(), sample.source_timestamp, sample.writer
                        )

    def close(self) -> None:
        """Close all subscriptions."""
        for reader in self._readers.values():
            reader.close()

    def _add_publisher(
        self, topic: str, handle: int, publisher: EndpointInfo, new: dict[tuple[str, str], list[QoS]]
    ) -> None:
        key = (topic, publisher.ros_type)
        offer = _OfferedTopic(*key, publisher.qos.reliable, publisher.qos.transient_local)
        self._offers[handle] = offer
        while len(self._offers) > MAX_PUBLISHERS:  # Those that exist are added again by each refresh.
            del self._offers[next(iter(self._offers))]
        if offer in self._unrecordable or (offer not in self._readers and not self._subscribe(offer)):
            return
        offers = self._topic_offers.setdefault(key, [])
        if key in new or not offers:
            new.setdefault(key, []).append(publisher.qos)
        if offer not in offers:
            offers.append(offer)

    def _subscribe(self, offer: _OfferedTopic) -> bool:
        if len(self._readers) < _MAX_SUBSCRIPTIONS and "/" in offer.type:  # all ROS types contain a slash
            qos = QoS(depth=_DEPTH, reliable=offer.reliable, transient_local=offer.transient_local)
            with suppress(WireError):
                self._readers[offer] = self._participant.raw_subscription(
                    self._node, offer.topic, offer.type, qos, on_data=self._event, adapts=True
                )
                return True
        if len(self._unrecordable) < MAX_PUBLISHERS:
            self._unrecordable.add(offer)
        return False

    def _accepts(self, offer: _OfferedTopic, publisher: int) -> bool:
        offers = self._topic_offers[offer.topic, offer.type]
        if len(offers) == 1:
            return True
        if publisher not in self._offers:
            self.refresh()
        # The publisher is not discovered yet. The subscription with the weakest request receives all its messages.
        return self._offers.get(publisher, min(offers)) == offer
