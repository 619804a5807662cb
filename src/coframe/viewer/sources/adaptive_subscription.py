"""A subscription that hears every publisher of a topic, whatever quality of service each of them offers.

A request that asks for more than a publisher offers is not matched, so reliability is asked for only where all offer
it. Durability cannot be settled like that: who asks for less does not get what was published before. So publishers that
keep their last messages, which only reliable ones do, have a subscription of their own, and the other one leaves out
what these say.
"""

from __future__ import annotations

import contextlib
import threading
from typing import TYPE_CHECKING

from coframe.errors import WireError
from coframe.wire.qos import QoS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from coframe.wire.endpoints import Sample, Subscription

__all__ = ["AdaptiveSubscription"]

_DEPTH = 10


class AdaptiveSubscription:
    """Hears all publishers of a topic; may be used by any thread.

    Args:
        offers: What the publishers of the topic offer now.
        subscribe: Subscribes to it.

    Raises:
        WireError: DDS refuses.
    """

    def __init__(self, offers: Callable[[], Iterable[QoS]], subscribe: Callable[[QoS], Subscription]) -> None:
        self._offers = offers
        self._subscribe = subscribe
        self._open: dict[bool, Subscription] = {}  # by whether it asks for what was published before
        self._left: list[Sample] = []  # of one that was replaced
        self._lock = threading.Lock()
        self._closed = False
        self._follow()

    def follow(self) -> None:
        """Asks for what publishers offer that have come meanwhile, where that is less than what is asked for."""
        # Refused this time, it is tried again the next time; what is open goes on.
        with self._lock, contextlib.suppress(WireError):
            if not self._closed:
                self._follow()

    def pending(self) -> bool:
        """Whether messages may be waiting: cheap, and now and then true although `take` finds none."""
        return bool(self._left) or any(subscription.pending() for subscription in list(self._open.values()))

    def take(self) -> list[Sample]:
        """The messages that wait, of each publisher the oldest first."""
        with self._lock:
            left, self._left = self._left, []
            return [*left, *self._take(transient_local=True), *self._take(transient_local=False)]

    def close(self) -> None:
        """Leaves the topic."""
        with self._lock:
            self._closed = True
            for subscription in self._open.values():
                subscription.close()

    def _follow(self) -> None:
        offers = list(self._offers())
        keeping = [offer for offer in offers if offer.reliable and offer.transient_local]
        others = [offer for offer in offers if not (offer.reliable and offer.transient_local)]
        if keeping:
            self._ask(QoS(_DEPTH, transient_local=True))
        if others:
            self._ask(QoS(_DEPTH, reliable=all(offer.reliable for offer in others)))

    def _ask(self, request: QoS) -> None:
        before = self._open.get(request.transient_local)
        if before is not None and (request.reliable or not before.qos.reliable):
            return  # what is asked for already is offered by all
        if before is not None:
            self._left += self._take(transient_local=request.transient_local)
        self._open[request.transient_local] = self._subscribe(request)
        if before is not None:
            before.close()

    def _take(self, *, transient_local: bool) -> list[Sample]:
        subscription = self._open.get(transient_local)
        if subscription is None or not subscription.pending():
            return []
        samples = subscription.take()
        other = self._open.get(True)
        if transient_local or other is None:
            return samples
        heard_there = other.matched_handles()
        return [sample for sample in samples if sample.writer not in heard_there]
