# SPDX-License-Identifier: Apache-2.0
"""The subscriptions of a listener with COFRAME_SHARED=1: the buffer reads what one process receives for all."""

# ruff: noqa: SLF001 - Sharing requires private members of rclpy's nodes and tf2's buffers.

from __future__ import annotations

import os
import weakref
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from coframe._core import SegmentError, watch
from coframe.shared_transforms import SharedTransforms, Source
from coframe.wire.qos import TF, TF_STATIC_READER
from rclpy.logging import get_logger
from rclpy.subscription import Subscription
from tf2_msgs.msg import TFMessage

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe._core import Event
    from coframe.wire import Sample
    from tf2_ros._subscriptions import Request, Subscriptions, Topic

_logger = get_logger("tf2_ros")


def shared_subscriptions(request: Request, receive_alone: Callable[[], Subscriptions]) -> Subscriptions | None:
    """Return subscriptions to the shared transforms; None if they are not enabled, or do not suit this listener.

    Args:
        request: What the listener subscribes to.
        receive_alone: Opens subscriptions of the listener's own, when the program changes the buffer.
    """
    if os.environ.get("COFRAME_SHARED") != "1" or not _is_usual(request):
        return None
    node, dynamic = request.node, request.dynamic
    assert dynamic is not None
    topics = node.resolve_topic_name(dynamic.name), node.resolve_topic_name(request.static.name)
    buffer = request.buffer._Coframe__buffer
    try:
        shared = SharedTransforms.join(Source(node._Coframe__participant.domain_id, *topics, cache=buffer.cache_ns))
    except SegmentError as error:
        text = f"The transforms are not shared with other processes: {error}"
        _logger.warning(text, once=True)
        return None
    if not shared.follow(buffer):
        shared.leave()
        return None
    return _SharedSubscriptions(request, shared, topics, receive_alone)


def _is_usual(request: Request) -> bool:
    """Return whether the listener subscribes like all others: to both topics, with the usual QoS, names and clock."""
    clock: Any = request.node.get_clock()
    if request.dynamic is None or request.renaming is not None or clock.ros_time_is_active:
        return False
    qos = [topic.qos._Coframe__to_wire() for topic in (request.dynamic, request.static)]
    return [replace(one, depth=100) for one in qos] == [replace(usual, depth=100) for usual in (TF, TF_STATIC_READER)]


class _SharedSubscriptions:
    def __init__(
        self,
        request: Request,
        shared: SharedTransforms,
        topics: tuple[str, str],
        receive_alone: Callable[[], Subscriptions],
    ) -> None:
        assert request.dynamic is not None
        self._request = request
        self._shared: SharedTransforms | None = shared
        self._receive_alone = receive_alone
        self._own: Subscriptions | None = None
        self.dynamic = self._stand_in(request.dynamic, topics[0])
        self.static = self._stand_in(request.static, topics[1])
        self._arrivals = _SharedArrivals(self._buffer, request.node.context._Coframe__wakeup.event)
        request.node._Coframe__polled_subscriptions.append(self._arrivals)
        reference = weakref.ref(self)

        def stop_sharing() -> None:
            subscriptions = reference()
            if subscriptions is not None:
                subscriptions._stop_sharing()

        self._buffer._on_local_change(stop_sharing)

    @property
    def _buffer(self) -> Any:
        return self._request.buffer._Coframe__buffer

    def close(self) -> None:
        for subscription in (self.dynamic, self.static):
            self._request.node.destroy_subscription(subscription)
        self._ignore_arrivals()
        if self._own is not None:
            self._own.close()

    def _stand_in(self, topic: Topic, name: str) -> Subscription:
        reader: Any = _SharedReader(self._leave)
        subscription = Subscription(
            reader, TFMessage, name, name, topic.callback, self._request.group, topic.qos, raw=False
        )
        return self._request.node._Coframe__add_entity(subscription)

    def _stop_sharing(self) -> None:
        """Continue with a buffer and subscriptions of its own, because the program changes the buffer."""
        if self._shared is not None:
            self._buffer._stop_following()
            self._own = self._receive_alone()
            self._ignore_arrivals()
            self._leave()

    def _ignore_arrivals(self) -> None:
        polled = self._request.node._Coframe__polled_subscriptions
        if self._arrivals in polled:
            polled.remove(self._arrivals)

    def _leave(self) -> None:
        shared, self._shared = self._shared, None
        if shared is not None:
            self._buffer._on_local_change(None)
            self._buffer._stop_following()
            shared.leave()


class _SharedReader:
    """What a node closes instead of a reader of its own."""

    matched = 0

    def __init__(self, leave: Callable[[], None]) -> None:
        self._leave = leave

    def pending(self) -> bool:
        return False

    def take(self, limit: int = 100) -> list[Sample]:
        del limit
        return []

    def close(self) -> None:
        self._leave()


class _SharedArrivals:
    """Polled subscription that reports the messages in the shared transforms to `spin_once`, one by one."""

    _DEPTH = 100  # of the subscription, which also limits the number of messages that an executor can take

    def __init__(self, buffer: Any, event: Event) -> None:
        self._buffer = buffer
        self._event = event
        self._handled = self._count()
        self._cancel: Callable[[], object] | None = None

    def arm(self) -> None:
        if self._cancel is None:
            start = lambda mailbox, token: watch(self._buffer, mailbox, token, "")  # noqa: E731 - one expression
            self._cancel = self._buffer._dispatcher.watch(start, self._arrived)

    def take_one(self) -> bool:
        count = self._count()
        self._handled = max(self._handled, count - self._DEPTH)
        if self._handled >= count:
            return False
        self._handled += 1
        return True

    def _arrived(self, changed: list[str]) -> None:
        del changed
        cancel, self._cancel = self._cancel, None
        if cancel is not None:
            cancel()
        self._event.set()

    def _count(self) -> int:
        messages: int = self._buffer.statistics["messages"]
        return messages
