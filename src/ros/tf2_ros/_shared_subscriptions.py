# SPDX-License-Identifier: Apache-2.0
"""The subscriptions of a listener with COFRAME_SHARED=1, as entities of coframe's rclpy."""

# ruff: noqa: SLF001 - TransformSharing requires private members of rclpy's nodes and tf2's buffers.

from __future__ import annotations

import weakref
from typing import TYPE_CHECKING, Any

from coframe._core import watch
from rclpy.subscription import Subscription
from tf2_msgs.msg import TFMessage
from tf2_ros._native_subscriptions import NativeSubscriptions
from tf2_ros._sharing import SharedReader, share

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe._core import Event
    from tf2_ros._sharing import TransformSharing
    from tf2_ros._subscriptions import Request, Topic


class SharedSubscriptions:
    """Subscriptions that receive nothing: the buffer reads the shared transforms.

    Attributes:
        dynamic: The subscription to dynamic transforms.
        static: The subscription to static transforms.
    """

    def __init__(self, request: Request, sharing: TransformSharing) -> None:
        """Create the entities.

        Args:
            request: The subscriptions of the listener.
            sharing: Its share.
        """
        assert request.dynamic is not None
        self._request = request
        self._sharing = sharing
        self._own: NativeSubscriptions | None = None  # when the program has changed the buffer
        self._closed = False
        self.dynamic = self._stand_in(request.dynamic, sharing.topics[0], self._dynamic_destroyed)
        self.static = self._stand_in(request.static, sharing.topics[1], self._static_destroyed)
        self._arrivals = _SharedArrivals(sharing.buffer, request.node.context._Coframe__wakeup.event)
        request.node._Coframe__polled_subscriptions.append(self._arrivals)
        # The node refers to this object, the buffer must not refer to the node.
        open_own = weakref.WeakMethod(self._open_own)

        def receive_alone_unless_gone() -> None:
            method = open_own()
            if method is not None:
                method()

        sharing.on_local_change(receive_alone_unless_gone)

    @classmethod
    def open(cls, request: Request) -> SharedSubscriptions | None:
        """Share the transforms, or None if this system cannot."""
        sharing = share(request)
        return None if sharing is None else cls(request, sharing)

    def close(self) -> None:
        """Destroy the subscriptions. Repeated calls have no effect."""
        self._closed = True
        self._sharing.leave()
        for subscription in (self.dynamic, self.static):
            self._request.node.destroy_subscription(subscription)
        self._ignore_arrivals()
        if self._own is not None:
            self._own.close()

    def _stand_in(self, topic: Topic, name: str, destroyed: Callable[[], None]) -> Subscription:
        reader: Any = SharedReader(destroyed, lambda: self._sharing.count_publishers(self._request.node, name))
        subscription = Subscription(
            reader, TFMessage, name, name, topic.callback, self._request.group, topic.qos, raw=False
        )
        return self._request.node._Coframe__entities.add(subscription)

    def _dynamic_destroyed(self) -> None:
        own = self._own_of_the_other()
        if own is not None and own.dynamic is not None:
            self._request.node.destroy_subscription(own.dynamic)

    def _static_destroyed(self) -> None:
        own = self._own_of_the_other()
        if own is not None:
            self._request.node.destroy_subscription(own.static)

    def _own_of_the_other(self) -> NativeSubscriptions | None:
        """Return own subscriptions, of which the program destroys one, or None if it destroys both, or the node."""
        if self._closed or self._request.node._Coframe__entities.is_destroyed:
            self._sharing.leave()
            return None
        self._sharing.end()
        return self._own

    def _open_own(self) -> None:
        self._own = NativeSubscriptions(self._request)
        self._ignore_arrivals()

    def _ignore_arrivals(self) -> None:
        polled = self._request.node._Coframe__polled_subscriptions
        if self._arrivals in polled:
            polled.remove(self._arrivals)


class _SharedArrivals:
    """Polled subscription that reports the messages in the shared transforms to `spin_once`, one by one."""

    _DEPTH = 100  # of the subscription, which also limits the number of messages that an executor can take

    def __init__(self, buffer: Any, event: Event) -> None:
        self._buffer = buffer
        self._event = event
        # A late subscription receives the static transforms: one message, as far as this one can know.
        self._handled = max(self._count() - 1, 0)
        self._cancel: Callable[[], object] | None = None

    def arm(self) -> None:
        if self._cancel is None:
            start = lambda mailbox, token: watch(self._buffer, mailbox, token, "")  # noqa: E731 - one expression
            self._cancel = self._buffer._dispatcher.watch(start, self._on_arrival)

    def take_one(self) -> bool:
        count = self._count()
        self._handled = max(self._handled, count - self._DEPTH)
        if self._handled >= count:
            return False
        self._handled += 1
        return True

    def _on_arrival(self, changed: list[str]) -> None:
        del changed
        cancel, self._cancel = self._cancel, None
        if cancel is not None:
            cancel()
        self._event.set()

    def _count(self) -> int:
        changes: int = self._buffer._changes  # the messages whose transforms are stored completely
        return changes
