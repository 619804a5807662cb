# SPDX-License-Identifier: Apache-2.0
"""Subscriptions."""

from __future__ import annotations

import inspect
import time
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from coframe.errors import DecodeError
from coframe.messages import codec
from coframe.messages.native_codec import native_codec
from coframe.wire.tf_reader import TfReader
from rclpy._absent import Handle
from rclpy.logging import get_logger

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.wire.endpoints import Sample
    from coframe.wire.endpoints import Subscription as WireSubscription
    from rclpy.callback_groups import CallbackGroup
    from rclpy.event_handler import EventHandler
    from rclpy.qos import QoSProfile

_WARNING_PERIOD_S: Final = 10.0
_log = get_logger("rclpy")


class Subscription:
    """Subscription to a topic. Create it with `Node.create_subscription`.

    The middleware queues messages, up to the depth of the QoS profile, until an executor takes them.
    """

    handle = Handle()

    def __init__(
        self,
        wire: WireSubscription | TfReader,
        msg_type: type[Any],
        topic: str,
        topic_name: str,
        callback: Callable[..., Any],
        callback_group: CallbackGroup,
        qos_profile: QoSProfile,
        raw: bool,
        *,
        event_handlers: list[EventHandler] | None = None,
    ) -> None:
        self.__wire: WireSubscription | TfReader | None = wire
        self.__accepts_info = _accepts_message_info(callback)
        self.msg_type = msg_type
        self.topic = topic
        self.__topic_name = topic_name
        self.callback = callback
        self.callback_group = callback_group
        self.qos_profile = qos_profile
        self.raw = raw
        self.event_handlers = event_handlers or []

    @property
    def topic_name(self) -> str:
        """The fully qualified name of the topic. `topic` is the name that was given."""
        return self.__topic_name

    def get_publisher_count(self) -> int:
        """Return the number of matched publishers."""
        return 0 if self.__wire is None else self.__wire.matched

    def destroy(self) -> None:
        """Destroy the subscription. Prefer `Node.destroy_subscription`."""
        if self.__wire is not None:
            for handler in self.event_handlers:
                handler.destroy()
            self.__wire.close()
            self.__wire = None

    def _Coframe__remaining_ns(self) -> int | None:
        wire = self.__wire
        return 0 if wire is not None and wire.pending() else None

    def _Coframe__take(self) -> Callable[[], Any] | None:
        wire = self.__wire
        if wire is None:
            return None
        native = None if self.raw else native_codec(self.msg_type)
        if native is None or isinstance(wire, TfReader):
            samples = wire.take(limit=1)
        else:
            samples = wire.take_decoded(native, limit=1)
        return partial(self.__deliver, samples[0], time.time_ns()) if samples else None

    def __deliver(self, sample: Sample, received: int) -> Any:
        try:
            is_done = self.raw or not isinstance(sample.data, bytes)
            message = sample.data if is_done else codec.deserialize(sample.data, self.msg_type)
        except DecodeError as error:  # A damaged message of another program must not end this one.
            _log.warning(f"Dropped a message on {self.topic_name}: {error}", throttle_duration_sec=_WARNING_PERIOD_S)
            return None
        if not self.__accepts_info:
            return self.callback(message)
        return self.callback(message, {"source_timestamp": sample.source_timestamp, "received_timestamp": received})


def _accepts_message_info(callback: Callable[..., Any]) -> bool:
    """Return whether a callback accepts (message, info) rather than (message)."""
    try:
        signature = inspect.signature(callback)
    except ValueError:  # Some built-in functions have no signature.
        return False
    for count in (1, 2):
        try:
            signature.bind(*[None] * count)
        except TypeError:
            continue
        return count == 2
    raise RuntimeError(
        "Subscription.__init__(): callback should be either be callable with one argument (to get only the message) "
        "or two (to get message and message info)"
    )
