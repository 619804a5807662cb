# SPDX-License-Identifier: Apache-2.0
"""A subscription that receives from every publisher of a topic, regardless of the offered QoS.

It requests as much as the publishers offer, unless the user requests less: best effort, or volatile.

A subscription is not matched if it requests more than a publisher offers, so reliable delivery is requested only if
all publishers offer it. For durability, this is not enough: a subscription that requests less does not receive earlier
messages. Publishers that keep their last messages (only reliable ones do) therefore get a separate subscription,
and the other subscription ignores their messages.
"""

from __future__ import annotations

import contextlib
import threading
from typing import TYPE_CHECKING

from coframe.errors import WireError
from coframe.viewer.sources.requested_quality import AUTOMATIC, RequestedQuality
from coframe.wire.qos import QoS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from coframe.wire.endpoints import Sample, Subscription

__all__ = ["AdaptiveSubscription"]


class AdaptiveSubscription:
    """A subscription to all publishers of a topic. Thread-safe.

    Args:
        offers: Returns what the publishers of the topic currently offer.
        subscribe: Subscribe to the topic with a quality of service.
        quality: What the user requests.

    Raises:
        WireError: The middleware cannot create the subscription.
    """

    def __init__(
        self,
        offers: Callable[[], Iterable[QoS]],
        subscribe: Callable[[QoS], Subscription],
        quality: RequestedQuality = AUTOMATIC,
    ) -> None:
        self._quality = quality
        self._offers = offers
        self._subscribe = subscribe
        self._open: dict[bool, Subscription] = {}  # Keyed by whether it requests earlier messages.
        self._remaining_samples: list[Sample] = []  # Samples of a replaced subscription.
        self._lock = threading.Lock()
        self._closed = False
        self._shortfall = ""
        self._follow()

    def follow(self) -> None:
        """Adapt to new publishers that offer less than the subscription requests."""
        # If a new subscription cannot be created, the existing ones continue and the next call tries again.
        with self._lock, contextlib.suppress(WireError):
            if not self._closed:
                self._follow()

    def pending(self) -> bool:
        """Return whether messages may be waiting; may be True although `take` returns none."""
        return bool(self._remaining_samples) or any(
            subscription.pending() for subscription in list(self._open.values())
        )

    def take(self) -> list[Sample]:
        """Return the waiting messages. The messages of each publisher are in order."""
        with self._lock:
            left, self._remaining_samples = self._remaining_samples, []
            return [*left, *self._take(transient_local=True), *self._take(transient_local=False)]

    @property
    def shortfall(self) -> str:
        """What the user requests and a publisher does not offer, or ""; its messages are received nevertheless."""
        return self._shortfall

    @property
    def guids(self) -> set[bytes]:
        """The identifiers of its endpoints."""
        return {subscription.guid for subscription in list(self._open.values())}

    def close(self) -> None:
        """Unsubscribe from the topic."""
        with self._lock:
            self._closed = True
            for subscription in self._open.values():
                subscription.close()

    def _follow(self) -> None:
        quality, offers = self._quality, list(self._offers())

        def keeps(offer: QoS) -> bool:
            return quality.wants_earlier_messages and offer.reliable and offer.transient_local

        others = [offer for offer in offers if not keeps(offer)]
        if len(others) < len(offers):
            self._request(QoS(quality.depth, transient_local=True))
        if others:
            reliable = quality.reliability != "best_effort" and all(offer.reliable for offer in others)
            self._request(QoS(quality.depth, reliable=reliable))
        self._shortfall = _shortfall(quality, offers)

    def _request(self, request: QoS) -> None:
        previous = self._open.get(request.transient_local)
        if previous is not None and (request.reliable or not previous.qos.reliable):
            return  # All publishers offer what the existing subscription requests.
        if previous is not None:
            self._remaining_samples += self._take(transient_local=request.transient_local)
        self._open[request.transient_local] = self._subscribe(request)
        if previous is not None:
            previous.close()

    def _take(self, *, transient_local: bool) -> list[Sample]:
        subscription = self._open.get(transient_local)
        if subscription is None or not subscription.pending():
            return []
        samples = subscription.take()
        other = self._open.get(True)
        if transient_local or other is None:
            return samples
        received_there = other.matched_handles()
        return [sample for sample in samples if sample.writer not in received_there]


def _shortfall(quality: RequestedQuality, offers: Iterable[QoS]) -> str:
    offers = list(offers)
    if quality.reliability == "reliable" and not all(offer.reliable for offer in offers):
        return "a publisher offers only best effort: RViz would receive nothing from it with this reliability"
    if quality.durability == "transient_local" and not all(offer.transient_local for offer in offers):
        return "a publisher offers only volatile: RViz would receive nothing from it with this durability"
    return ""
