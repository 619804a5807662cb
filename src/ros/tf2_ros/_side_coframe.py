# SPDX-License-Identifier: Apache-2.0
"""What tf2_ros needs from coframe's rclpy beyond the public API."""

# ruff: noqa: SLF001 - Native ingestion requires private members of rclpy's nodes and tf2's buffers.

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.event_handler import MismatchReporter, SubscriptionEventCallbacks
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile, as_qos_profile
from rclpy.subscription import Subscription
from tf2_msgs.msg import TFMessage
from tf2_ros._shared_subscriptions import SharedSubscriptions
from tf2_ros._sharing import share
from tf2_ros._subscriptions import AUTHORITY, CallbackSubscriptions, Request, Subscriptions, Topic

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.wire import TfReader
    from rclpy.node import Node
    from rclpy.task import Future

profile = as_qos_profile

_PUBLISH = Publisher.publish


def open_subscriptions(request: Request) -> Subscriptions:
    """Subscribe, and insert transforms into the buffer without Python code unless the request says otherwise."""
    if request.wire == "rclpy":
        return CallbackSubscriptions(request)

    def receive_alone() -> Subscriptions:
        return _NativeSubscriptions(request)

    domain = request.node._Coframe__participant.domain_id
    sharing = share(request, domain, lambda qos: qos._Coframe__to_wire(), lambda topic: _reporter(request.node, topic))
    return receive_alone() if sharing is None else SharedSubscriptions(request, sharing, receive_alone)


def static_publisher(node: Node, topic: str, qos: QoSProfile) -> Any:
    """Return a publisher of static transforms that all broadcasters of the process share."""
    name = node.resolve_topic_name(topic)
    writer = node._Coframe__participant.static_broadcaster(node._Coframe__graph_node, name)
    return node._Coframe__entities.add(Publisher(writer, TFMessage, topic, name, qos, node.context))


def direct_sender(publisher: Any) -> tuple[Callable[[Any], bool], object]:
    """Return a function that publishes transforms without a message object, and what `publisher.publish` must equal.

    The function accepts a TransformStamped or a list of them. It returns False if it has published nothing, in which
    case a message must be published. Programs may replace `publish` in order to receive messages.
    """
    if type(publisher).publish is _PUBLISH:
        return publisher._Coframe__publish_items(), publisher.publish
    return (lambda _: False), None


def wait_for(action_client: Any, future: Future[Any], timeout: float) -> None:
    """Wait until an executor has completed a future of an action client, up to a timeout in seconds."""
    action_client._Coframe__wait_for(future, timeout)


def refusal(action_client: Any) -> str:
    """Return why no goal can be sent although there is a server; "" if there is no reason."""
    reason: str = action_client._Coframe__refusal
    return reason


def on_cancel(goal_handle: Any, callback: Callable[[], object]) -> None:
    """Call a function when the client cancels a goal."""
    goal_handle._Coframe__cancel_request.add_done_callback(lambda _: callback())


def wake_executors() -> None:
    """Do nothing: a future of coframe's rclpy wakes the executor of a coroutine that awaits it."""


def _reporter(node: Node, topic: Topic) -> MismatchReporter:
    return MismatchReporter(SubscriptionEventCallbacks(), node.get_logger(), topic.name)


class _NativeSubscriptions:
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
            qos=qos._Coframe__to_wire(),
            authority=AUTHORITY,
            renaming=request.renaming,
            on_data=node.context._Coframe__wakeup.event,
            on_mismatch=_reporter(node, topic),
        )
        self._readers.append(reader)
        return node._Coframe__entities.add(
            Subscription(reader, TFMessage, name, name, topic.callback, request.group, qos, raw=False)
        )

    def close(self) -> None:
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
