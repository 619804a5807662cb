# SPDX-License-Identifier: Apache-2.0
"""The base class of all filters, and the filter that receives messages from a topic."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node


class SimpleFilter:
    """A filter that calls its callbacks with each message that it passes.

    Attributes:
        callbacks: The callbacks and their additional arguments, by the number that `registerCallback` returned.
    """

    def __init__(self) -> None:
        self.callbacks: dict[int, tuple[Callable[..., Any], tuple[Any, ...]]] = {}

    def registerCallback(self, cb: Callable[..., Any], *args: Any) -> int:
        """Add a callback.

        Args:
            cb: Function that is called with the messages.
            args: Arguments that follow the messages in each call.

        Returns:
            The number of the callback.
        """
        number = len(self.callbacks)
        self.callbacks[number] = (cb, args)
        return number

    def signalMessage(self, *msg: Any) -> None:
        """Call all callbacks with these messages."""
        for callback, args in list(self.callbacks.values()):
            callback(*msg, *args)


class Subscriber(SimpleFilter):
    """A filter that lets all messages on a topic through.

    Attributes of the subscription, such as `topic_name`, are also attributes of the filter.

    Args:
        node: Node that subscribes.
        msg_type: Class of the messages.
        topic: Name of the topic.
        options: Keyword arguments of `Node.create_subscription`; `qos_profile` is 10 by default.

    Attributes:
        node: Node that subscribes.
        topic: Name of the topic, as passed.
        sub: The subscription.
    """

    def __init__(self, node: Node, msg_type: type[Any], topic: str, /, **options: Any) -> None:
        super().__init__()
        self.node = node
        self.topic = topic
        options.setdefault("qos_profile", 10)
        self.sub = node.create_subscription(msg_type, topic, self.callback, **options)

    def callback(self, msg: Any) -> None:
        """Pass on a message of the topic."""
        self.signalMessage(msg)

    def getTopic(self) -> str:
        """Return the name of the topic, as passed to the constructor."""
        return self.topic

    def __getattr__(self, key: str) -> Any:
        if key == "sub":  # The subscription does not exist yet.
            raise AttributeError(f"{type(self).__name__!r} object has no attribute 'sub'")
        return getattr(self.sub, key)
