# SPDX-License-Identifier: Apache-2.0
"""Publishers."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from coframe.errors import WireError
from coframe.messages import codec
from coframe.messages.native_codec import native_codec
from rclpy import _absent
from rclpy._absent import Handle
from rclpy._destroyable import LoggingEntity, destroyed_error
from rclpy.duration import Duration, Infinite
from rclpy.exceptions import RCLError

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe._core import MessageCodec
    from coframe.wire.endpoints import Publisher as WirePublisher
    from coframe.wire.static_broadcaster import StaticBroadcaster
    from rclpy.context import Context
    from rclpy.event_handler import EventHandler
    from rclpy.qos import QoSProfile


class Publisher(LoggingEntity):
    """Publisher of a topic. Create it with `Node.create_publisher`."""

    handle = Handle()

    def __init__(
        self,
        wire: WirePublisher | StaticBroadcaster,
        msg_type: type[Any],
        topic: str,
        topic_name: str,
        qos_profile: QoSProfile,
        context: Context,
        *,
        event_handlers: list[EventHandler] | None = None,
    ) -> None:
        self.__wire: WirePublisher | StaticBroadcaster | None = wire
        self.__context = context
        self.__direct: Callable[[Any], bool] = _leave
        self.msg_type = msg_type
        self.topic = topic
        self.__topic_name = topic_name
        self.qos_profile = qos_profile
        self.event_handlers = event_handlers or []

    @property
    def topic_name(self) -> str:
        """The fully qualified name of the topic. `topic` is the name that was given."""
        return self.__topic_name

    def publish(self, msg: Any) -> None:
        """Publish a message.

        Args:
            msg: Message of the publisher's type, or its serialized bytes.

        Raises:
            TypeError: The message has another type.
            RCLError: The context was shut down, or the bytes are not a message of the publisher's type.
            InvalidHandle: The publisher was destroyed.
        """
        if not self.__direct(msg):
            self.__publish(msg)

    def __publish(self, msg: Any) -> None:
        """Publish a message that native code does not publish, or report why it cannot be published."""
        if not isinstance(msg, (self.msg_type, bytes)):
            raise TypeError(f"Expected {self.msg_type}, got {type(msg)}")
        if not self.__context.ok() and not self.__context._Coframe__was_shut_down_by_signal:
            raise RCLError("Failed to publish: publisher's context is invalid")
        wire = self.__require_wire()
        try:
            native = None if isinstance(msg, bytes) else native_codec(type(msg))
            if native is None or not wire.publish(native, msg):
                wire.write(msg if isinstance(msg, bytes) else codec.serialize(msg))
            elif type(msg) is self.msg_type:  # The next one is published by a single call.
                self.__direct = self.__direct_function(native)
        except WireError as error:
            raise _failure(error) from error

    def __direct_function(self, native: MessageCodec, *, of_items: bool = False) -> Callable[[Any], bool]:
        """Return a function that publishes a message and returns True, or returns False if `__publish` must do it."""
        wire, closed = self.__require_wire(), self.__context._Coframe__closed
        return wire.direct(native, closed, _failure, of_items=of_items) or _leave

    def _Coframe__publish_items(self) -> Callable[[Any], bool]:
        """Return the same function for the items of a message with one field, or for a single item."""
        native = native_codec(self.msg_type)
        return _leave if native is None else self.__direct_function(native, of_items=True)

    def get_subscription_count(self) -> int:
        """Return the number of matched subscriptions."""
        return self.__require_wire().matched

    def assert_liveliness(self) -> None:
        """Assert that the publisher is alive, which the liveliness policy MANUAL_BY_TOPIC requires periodically."""
        self.__require_wire().assert_liveliness()

    def wait_for_all_acked(self, timeout: Duration = Infinite) -> bool:
        """Wait until all reliable subscriptions have received all messages.

        Args:
            timeout: Maximum time to wait. Negative or infinite: no limit.

        Returns:
            Whether they have received all messages in time.
        """
        limit = timeout.nanoseconds
        return self.__require_wire().wait_for_acks(limit if limit >= 0 else Infinite.nanoseconds)

    def destroy(self) -> None:
        """Destroy the publisher. Prefer `Node.destroy_publisher`."""
        if self.__wire is not None:
            for handler in self.event_handlers:
                handler.destroy()
            self.__direct = _leave
            self.__wire.close()
            self.__wire = None

    def __require_wire(self) -> WirePublisher | StaticBroadcaster:
        if self.__wire is None:
            raise destroyed_error(f"The publisher of '{self.topic_name}'")
        return self.__wire


def _leave(_: Any) -> bool:
    """Leave a message to `Publisher.__publish`."""
    return False


def _failure(error: WireError) -> RCLError:
    failure = RCLError(f"Failed to publish: {error}")
    failure.__cause__ = error
    return failure


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
