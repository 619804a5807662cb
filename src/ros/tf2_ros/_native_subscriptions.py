# SPDX-License-Identifier: Apache-2.0
"""The subscriptions of a listener that inserts transforms natively, as entities of coframe's rclpy."""

# ruff: noqa: SLF001 - Native ingestion requires private members of rclpy's nodes and tf2's buffers.

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.subscription import Subscription
from tf2_msgs.msg import TFMessage
from tf2_ros._rclpy_side import reporter, to_wire
from tf2_ros._subscriptions import AUTHORITY

if TYPE_CHECKING:
    from coframe.wire.tf_reader import TfReader
    from tf2_ros._subscriptions import Request, Topic


class NativeSubscriptions:
    """Readers of the node's participant, which insert transforms without Python code.

    Attributes:
        dynamic: The subscription to dynamic transforms, or None if there is none.
        static: The subscription to static transforms.
    """

    def __init__(self, request: Request) -> None:
        self._node = request.node
        self._readers: list[TfReader] = []
        self.dynamic = None if request.dynamic is None else self._open(request, request.dynamic, static=False)
        self.static = self._open(request, request.static, static=True)
        self._arrivals = _Arrivals(self._readers)
        self._node._Coframe__polled_subscriptions.append(self._arrivals)

    def _open(self, request: Request, topic: Topic, *, static: bool) -> Subscription:
        node, qos = request.node, topic.qos
        name = node.resolve_topic_name(topic.name)
        reader = node._Coframe__participant.tf_reader(
            node._Coframe__graph_node,
            name,
            request.buffer._Coframe__buffer,
            static=static,
            qos=to_wire(qos),
            authority=AUTHORITY,
            renaming=request.renaming,
            on_data=node.context._Coframe__wakeup.event,
            on_mismatch=reporter(node, topic.name),
        )
        self._readers.append(reader)
        return node._Coframe__entities.add(
            Subscription(reader, TFMessage, name, name, topic.callback, request.group, qos, raw=False)
        )

    def close(self) -> None:
        """Destroy the subscriptions. Repeated calls have no effect."""
        for subscription in (self.dynamic, self.static):
            if subscription is not None:
                self._node.destroy_subscription(subscription)
        if self._arrivals in self._node._Coframe__polled_subscriptions:
            self._node._Coframe__polled_subscriptions.remove(self._arrivals)


class _Arrivals:
    """Polled subscription that reports natively inserted messages to `spin_once`, one by one."""

    # The depth of the subscription, which also limits the number of messages that an executor can take.
    _DEPTH = 100

    def __init__(self, readers: list[TfReader]) -> None:
        self._readers = readers
        self._handled = 0

    def arm(self) -> None:
        for reader in self._readers:
            reader.arm()

    def take_one(self) -> bool:
        count = self._count()
        self._handled = max(self._handled, count - self._DEPTH)
        if self._handled == count:
            return False
        self._handled += 1
        return True

    def _count(self) -> int:
        return sum(reader.received for reader in self._readers)
