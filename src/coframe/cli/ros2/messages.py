# SPDX-License-Identifier: Apache-2.0
"""Receive messages on a topic for a command, and evaluate Python expressions about them."""

from __future__ import annotations

import functools
import re
import time
from collections import deque
from typing import TYPE_CHECKING, Any

from coframe.cli.output import fail, print_bounded

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rclpy.node import Node
    from rclpy.qos import QoSProfile

__all__ = ["MessageStream", "field_of", "message_filter"]

_ELEMENT = re.compile(r"(.+)\[(-?\d{1,9})\]")
_MAX_WAIT = 1.0  # seconds; short, so that Ctrl-C is handled promptly on every system


class MessageStream:
    """The messages of one or more subscriptions, in the order of arrival.

    Args:
        node: Node of the command.
        topic: Full name of the first topic. None if all are added by `subscribe`.
        message_class: Class of its messages.
        qos: QoS of the subscription.
        raw: Whether to return serialized messages.
        report_lost: Whether to print a warning when messages were lost.
    """

    def __init__(
        self,
        node: Node,
        topic: str | None = None,
        message_class: Any = None,
        qos: QoSProfile | int = 10,
        *,
        raw: bool = False,
        report_lost: bool = False,
    ) -> None:

        from rclpy.executors import SingleThreadedExecutor  # noqa: PLC0415 - slow import

        self._node = node
        self._arrived_messages: deque[tuple[str, Any]] = deque()
        self._executor = SingleThreadedExecutor(context=node.context)
        self._executor.add_node(node)
        if topic is not None:
            self.subscribe(topic, message_class, qos, raw=raw, report_lost=report_lost)

    def subscribe(
        self,
        topic: str,
        message_class: Any,
        qos: QoSProfile | int,
        *,
        raw: bool = False,
        report_lost: bool = False,
        label: str | None = None,
    ) -> None:
        """Add a subscription. Its messages have a label, the name of the topic by default."""
        name = label or topic
        self._node.create_subscription(
            message_class,
            topic,
            lambda message: self._arrived_messages.append((name, message)),
            qos,
            raw=raw,
            event_callbacks=_lost_events() if report_lost else None,
        )

    def take_labeled(self, seconds: float) -> tuple[str, Any] | None:
        """Return the label of the next message and the message, or None after the timeout."""
        deadline = time.monotonic() + seconds
        while not self._arrived_messages:
            left = deadline - time.monotonic()
            if left <= 0:
                return None
            self._executor.spin_once(timeout_sec=min(left, _MAX_WAIT))
        return self._arrived_messages.popleft()

    def labeled_messages(self) -> Iterator[tuple[str, Any]]:
        """Yield messages with their labels, forever."""
        while True:
            pair = self.take_labeled(_MAX_WAIT)
            if pair is not None:
                yield pair

    def messages(self, timeout: float | None = None) -> Iterator[Any]:
        """Yield messages until none arrives within `timeout` seconds; forever if it is None."""
        while True:
            pair = self.take_labeled(_MAX_WAIT if timeout is None else timeout)
            if pair is not None:
                yield pair[1]
            elif timeout is not None:
                return


def message_filter(expression: str | None) -> Callable[[Any], bool]:
    """Return the function that evaluates a Python expression about a message `m`; by default, all messages pass.

    End the command if the expression cannot be compiled, or if it fails for a message.
    """
    if expression is None:
        return lambda _message: True
    try:
        code = compile(expression, "<filter>", "eval")
    except SyntaxError as error:
        fail(f"--filter: {expression!r} is not a Python expression: {error.msg}", "Example: 'm.range_max > 3'", code=2)

    def accepts(message: Any) -> bool:
        try:
            return bool(eval(code, {"m": message}))  # noqa: S307 - the user's own expression
        except Exception as error:  # noqa: BLE001 - any error of the expression
            fail(f"--filter: {expression!r} failed for a message: {error}", code=2)

    return accepts


def field_of(message: Any, path: str) -> Any:
    """Return the field of a message with a path such as "pose.position.x" or "ranges[0]"; end the command if none."""
    try:
        return functools.reduce(_select_part, path.split("."), message)
    except (AttributeError, IndexError, TypeError) as error:
        fail(f"Invalid field '{path}': {error}", f"Fields: {', '.join(message.get_fields_and_field_types())}.", code=2)


def _select_part(value: Any, step: str) -> Any:
    """Return a field of a message, or an element of one: "ranges[0]"."""
    match = _ELEMENT.fullmatch(step)
    return getattr(value, step) if match is None else _select_part(value, match[1])[int(match[2])]


def _lost_events() -> Any:
    """Return the event callbacks that report lost messages."""
    try:
        from rclpy.event_handler import SubscriptionEventCallbacks  # noqa: PLC0415 - slow import
    except ImportError:  # Humble has it in another module.
        from rclpy.qos_event import SubscriptionEventCallbacks  # noqa: PLC0415
    return SubscriptionEventCallbacks(message_lost=_report_lost)


def _report_lost(status: Any) -> None:
    changed, total = status.total_count_change, status.total_count
    print_bounded(f"A message was lost!!!\n\ttotal count change:{changed}\n\ttotal count: {total}", error=True)
