"""Publishers."""

# The modules of rclpy share what its users do not see.
# ruff: noqa: SLF001

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.messages import codec
from rclpy.exceptions import InvalidHandle, RCLError

if TYPE_CHECKING:
    from coframe.wire import Publisher as WirePublisher
    from coframe.wire import StaticBroadcaster
    from rclpy.context import Context
    from rclpy.qos import QoSProfile


class Publisher:
    """Sends messages to a topic; made by `Node.create_publisher`."""

    def __init__(
        self,
        wire: WirePublisher | StaticBroadcaster,
        msg_type: type[Any],
        topic: str,
        qos_profile: QoSProfile,
        context: Context,
    ) -> None:
        self._wire: WirePublisher | StaticBroadcaster | None = wire
        self._context = context
        self.msg_type = msg_type
        self.topic = topic
        self.qos_profile = qos_profile

    @property
    def topic_name(self) -> str:
        """The fully qualified name of the topic."""
        return self.topic

    def publish(self, msg: Any) -> None:
        """Sends a message.

        Args:
            msg: A message of the publisher's type, or its serialised bytes.

        Raises:
            TypeError: It is another type's.
            RCLError: The context was shut down.
            InvalidHandle: The publisher was destroyed.
        """
        if isinstance(msg, self.msg_type):
            data = codec.serialize(msg)
        elif isinstance(msg, bytes):
            data = msg
        else:
            raise TypeError(f"Expected {self.msg_type}, got {type(msg)}")
        # After a signal a program may still say its last words: stop the robot, ...
        if not self._context.ok() and not self._context._was_ended_by_signal:
            raise RCLError("Failed to publish: publisher's context is invalid")
        self._alive().write(data)

    def get_subscription_count(self) -> int:
        """Returns the number of subscriptions that receive what is published."""
        return self._alive().matched

    def assert_liveliness(self) -> None:
        """Shows that the publisher is alive, which DDS does by itself here."""
        self._alive()

    def destroy(self) -> None:
        """Ends it; better use `Node.destroy_publisher`."""
        if self._wire is not None:
            self._wire.close()
            self._wire = None

    def _alive(self) -> WirePublisher | StaticBroadcaster:
        if self._wire is None:
            raise InvalidHandle(f"cannot use Publisher of '{self.topic}' because destruction was requested")
        return self._wire
