# SPDX-License-Identifier: Apache-2.0
"""The subscriptions of a transform listener."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

from tf2_msgs.msg import TFMessage

if TYPE_CHECKING:
    from collections.abc import Callable

    import tf2_py as tf2
    from coframe._core import Renaming
    from rclpy.callback_groups import CallbackGroup
    from rclpy.node import Node
    from rclpy.qos import QoSProfile

AUTHORITY = "default_authority"
WIRES = ("native", "rclpy")


@dataclass(frozen=True)
class Topic:
    """A topic of transforms.

    Attributes:
        name: The name, which is expanded and remapped.
        qos: The requested quality of service.
        callback: The method of the listener that inserts the transforms of a message.
    """

    name: str
    qos: QoSProfile
    callback: Callable[[TFMessage], None]


@dataclass(frozen=True)
class Request:
    """The subscriptions that a listener requests.

    Attributes:
        node: The node of the subscriptions.
        buffer: The buffer to fill.
        group: The callback group of the subscriptions.
        renaming: The renaming of frames, or None for none.
        dynamic: The topic of dynamic transforms; None to subscribe only to static transforms.
        static: The topic of static transforms.
        shared: Whether the buffer may read shared transforms.
        wire: How the transforms are received, "native" or "rclpy", or None for the value of the environment variable.
        overridden: Whether a method on the path of the transforms into the buffer is overridden.
    """

    node: Node
    buffer: tf2.BufferCore
    group: CallbackGroup
    renaming: Renaming | None
    dynamic: Topic | None
    static: Topic
    shared: bool = True
    wire: str | None = None
    overridden: bool = False


class Subscriptions(Protocol):
    """Open subscriptions to dynamic and static transforms."""

    @property
    def dynamic(self) -> Any:
        """The subscription to dynamic transforms, or None if there is none."""

    @property
    def static(self) -> Any:
        """The subscription to static transforms."""

    def close(self) -> None:
        """Destroy the subscriptions. Repeated calls have no effect."""


class CallbackSubscriptions:
    """Subscriptions of the node whose callbacks insert the transforms, as in tf2_ros.

    Attributes:
        dynamic: The subscription to dynamic transforms, or None if there is none.
        static: The subscription to static transforms.
    """

    def __init__(self, request: Request) -> None:
        self._node = request.node
        self.dynamic = None if request.dynamic is None else self._open(request.dynamic, request.group)
        self.static = self._open(request.static, request.group)

    def _open(self, topic: Topic, group: CallbackGroup) -> Any:
        return self._node.create_subscription(TFMessage, topic.name, topic.callback, topic.qos, callback_group=group)

    def close(self) -> None:
        """Destroy the subscriptions. Repeated calls have no effect."""
        for subscription in (self.dynamic, self.static):
            if subscription is not None:
                self._node.destroy_subscription(subscription)
