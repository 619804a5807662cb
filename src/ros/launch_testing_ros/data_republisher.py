# SPDX-License-Identifier: Apache-2.0
"""Changes messages on their way from one topic to another."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node

__all__ = ["DataRepublisher"]

_DEPTH = 10


class DataRepublisher:
    """Receives messages of one topic and publishes them on another one.

    Args:
        node: The node.
        listen_topic: The topic of the messages.
        publish_topic: The topic on which they are published.
        msg_type: Their type.
        transform_fn: Function from a message to the one that is published; None instead of a message drops it.
    """

    def __init__(
        self,
        node: Node,
        listen_topic: str,
        publish_topic: str,
        msg_type: Any,
        transform_fn: Callable[[Any], Any] | None = None,
    ) -> None:
        self.__node = node
        self.__transform = transform_fn
        self.__received: list[Any] = []
        self.__republished: list[Any] = []
        self.__publisher = node.create_publisher(msg_type, publish_topic, _DEPTH)
        self.__subscription = node.create_subscription(msg_type, listen_topic, self.__on_message, _DEPTH)

    def shutdown(self) -> None:
        """Destroy the publisher and the subscription."""
        self.__node.destroy_subscription(self.__subscription)
        self.__node.destroy_publisher(self.__publisher)

    def get_num_received(self) -> int:
        """Return the number of received messages."""
        return len(self.__received)

    def get_num_republished(self) -> int:
        """Return the number of published messages."""
        return len(self.__republished)

    def get_received(self) -> list[Any]:
        """Return the received messages."""
        return list(self.__received)

    def get_republished(self) -> list[Any]:
        """Return the published messages."""
        return list(self.__republished)

    def __on_message(self, message: Any) -> None:
        self.__received.append(message)
        changed = message if self.__transform is None else self.__transform(message)
        if changed is not None:
            self.__republished.append(changed)
            self.__publisher.publish(changed)
