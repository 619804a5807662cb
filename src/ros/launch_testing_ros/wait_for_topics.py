# SPDX-License-Identifier: Apache-2.0
"""Waits until messages of several topics have been received."""

from __future__ import annotations

import collections
import threading
import uuid
from typing import TYPE_CHECKING, Any

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from types import TracebackType

    from typing_extensions import Self

__all__ = ["WaitForTopics"]


class WaitForTopics:
    """Waits until at least one message of each topic has been received.

    As a context manager, it raises an error if messages of a topic do not arrive in time.

    Args:
        topic_tuples: Pairs of the name and the type of each topic; a third element is its QoS, 10 by default.
        timeout: Seconds to wait.
        messages_received_buffer_length: The number of messages of each topic to keep.
        trigger: Function that is called with the node, and with the arguments of `wait`, after the subscriptions
            have been created.
        node_namespace: Namespace of the node.
    """

    def __init__(
        self,
        topic_tuples: Iterable[tuple[Any, ...]],
        timeout: float = 5.0,
        messages_received_buffer_length: int = 10,
        trigger: Callable[..., object] | None = None,
        node_namespace: str | None = None,
    ) -> None:
        if trigger is not None and not callable(trigger):
            raise TypeError(f"The passed callback is not callable: {trigger!r}")
        self.topic_tuples = list(topic_tuples)
        self.timeout = timeout
        self.messages_received_buffer_length = messages_received_buffer_length
        self.trigger = trigger
        self._received: dict[str, collections.deque[Any]] = {
            topic[0]: collections.deque(maxlen=messages_received_buffer_length) for topic in self.topic_tuples
        }
        self._all_received = threading.Event()
        self._context = rclpy.context.Context()
        rclpy.init(context=self._context)
        self._node = Node(f"_test_node_{uuid.uuid4().hex[:10]}", namespace=node_namespace, context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._thread = threading.Thread(target=self._executor.spin, daemon=True)
        self._is_started = self._is_shut_down = False

    def wait(self, *args: Any, **kwargs: Any) -> bool:
        """Wait for the messages, and return whether at least one of each topic has been received.

        Args:
            args: Arguments of the trigger.
            kwargs: Keyword arguments of the trigger.
        """
        if not self._is_started:
            self._is_started = True
            for name, kind, *qos in self.topic_tuples:
                self._node.create_subscription(kind, name, self._callback(name), qos[0] if qos else 10)
            self._thread.start()
        if self.trigger is not None:
            self.trigger(self._node, *args, **kwargs)
        return self._all_received.wait(self.timeout) if self.topic_tuples else True

    def shutdown(self) -> None:
        """Destroy the node and its context."""
        if self._is_shut_down:
            return
        self._is_shut_down = True
        rclpy.shutdown(context=self._context)
        if self._is_started:
            self._thread.join()
        self._node.destroy_node()

    def topics_received(self) -> set[str]:
        """Return the topics on which messages have been received."""
        return {name for name, messages in self._received.items() if messages}

    def topics_not_received(self) -> set[str]:
        """Return the topics on which no message has been received."""
        return {name for name, messages in self._received.items() if not messages}

    def received_messages(self, topic_name: str) -> list[Any]:
        """Return the last messages of a topic, the oldest first.

        Args:
            topic_name: The topic.

        Raises:
            KeyError: It is not one of the topics.
        """
        if topic_name not in self._received:
            known = ", ".join(self._received) or "none"
            raise KeyError(f"No messages of '{topic_name}' are received. Topics: {known}")
        return list(self._received[topic_name])

    def __enter__(self) -> Self:
        """Wait for the messages.

        Raises:
            RuntimeError: Messages of a topic were not received in time.
        """
        if not self.wait():
            missing = sorted(self.topics_not_received())
            self.shutdown()
            raise RuntimeError(f"Did not receive messages on these topics: {missing}")
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.shutdown()

    def _callback(self, name: str) -> Callable[[Any], None]:
        def on_message(message: Any) -> None:
            self._received[name].append(message)
            if not self.topics_not_received():
                self._all_received.set()

        return on_message
