# SPDX-License-Identifier: Apache-2.0
"""Subscriptions."""

from __future__ import annotations

import inspect
import time
from functools import partial
from typing import TYPE_CHECKING, Any, Final, TypedDict

from coframe.distributions import since
from coframe.errors import DecodeError
from coframe.messages import codec
from coframe.messages.native_codec import native_codec
from coframe.messages.other_forms import has_other_form, other_form
from coframe.messages.type_hash import type_hash
from coframe.wire.tf_reader import TfReader
from rclpy import _absent
from rclpy._absent import Handle
from rclpy._destroyable import LoggingEntity
from rclpy.exceptions import RCLError
from rclpy.logging import get_logger
from rclpy.subscription_content_filter_options import ContentFilterOptions
from rclpy.utilities import get_rmw_implementation_identifier

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.wire.endpoints import Sample
    from coframe.wire.endpoints import Subscription as WireSubscription
    from rclpy._content_filter import ContentFilter
    from rclpy.callback_groups import CallbackGroup
    from rclpy.event_handler import EventHandler
    from rclpy.qos import QoSProfile

_WARNING_PERIOD_S: Final = 10.0
_log = get_logger("rclpy")


class MessageInfo(TypedDict):
    """Information on a received message, which a callback with two arguments gets.

    Attributes:
        source_timestamp: The time at which it was published, in nanoseconds since 1970 on the publisher's clock.
        received_timestamp: The time at which it was received, in nanoseconds since 1970.
        publication_sequence_number: Its number among the messages of the publisher; None, as with most middlewares.
        reception_sequence_number: Its number among the received messages; None, as with most middlewares.
        publisher_gid: The identifier of the publisher, in `data`, or None if it has left.
    """

    source_timestamp: int
    received_timestamp: int
    publication_sequence_number: int | None
    reception_sequence_number: int | None
    publisher_gid: dict[str, Any] | None


class Subscription(LoggingEntity):
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
        self.__filter: ContentFilter | None = None
        self.__other_hash = ""  # of the definition that another distribution has
        if has_other_form(msg_type):
            self.__other_hash = type_hash(other_form(msg_type.ROS_TYPE))

    @property
    def topic_name(self) -> str:
        """The fully qualified name of the topic. `topic` is the name that was given."""
        return self.__topic_name

    @property
    def is_cft_enabled(self) -> bool:
        """Whether a content filter is set."""
        return self.__filter is not None

    def set_content_filter(self, filter_expression: str, expression_parameters: list[str]) -> None:
        """Let only messages through that meet a condition. See `ContentFilterOptions`. An empty condition removes it.

        Raises:
            RCLError: The condition is invalid.
        """
        from rclpy._content_filter import ContentFilter  # noqa: PLC0415 - few programs filter messages

        new = ContentFilter(self.msg_type, filter_expression, expression_parameters)
        self.__filter = new if filter_expression else None

    def get_content_filter(self) -> ContentFilterOptions:
        """Return the content filter.

        Raises:
            RCLError: There is none.
        """
        if self.__filter is None:
            raise RCLError("failed to get content filter: the subscription has none")
        return ContentFilterOptions(self.__filter.expression, list(self.__filter.parameters))

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
        # Messages of another definition are recognized before they are read.
        native = None if self.raw or self.__other_hash else native_codec(self.msg_type)
        if native is None or isinstance(wire, TfReader):
            samples = wire.take(limit=1)
        else:
            samples = wire.take_decoded(native, limit=1)
        return partial(self.__deliver, samples[0], time.time_ns()) if samples else None

    def __deliver(self, sample: Sample, received: int) -> Any:
        try:
            is_done = self.raw or not isinstance(sample.data, bytes)
            message = sample.data if is_done else self.__read(sample)
            if self.__filter is not None and not self.__is_let_through(message):
                return None
        except DecodeError as error:  # A damaged message of another program must not end this one.
            _log.warning(f"Dropped a message on {self.topic_name}: {error}", throttle_duration_sec=_WARNING_PERIOD_S)
            return None
        if not self.__accepts_info:
            return self.callback(message)
        return self.callback(message, self.__info(sample, received))

    def __read(self, sample: Sample) -> Any:
        if self.__other_hash and self.__wire is not None:
            writer = self.__wire.writer(sample.writer)
            if writer is not None and writer.type_hash == self.__other_hash:
                message = codec.deserialize_other_form(sample.data, self.msg_type)
                if message is not None:
                    return message
        return codec.deserialize(sample.data, self.msg_type)

    def __is_let_through(self, message: Any) -> bool:
        whole = codec.deserialize(message, self.msg_type) if self.raw else message
        return self.__filter is None or self.__filter.accepts(whole)

    def __info(self, sample: Sample, received: int) -> dict[str, Any]:
        info: dict[str, Any] = {"source_timestamp": sample.source_timestamp, "received_timestamp": received}
        if since("message_numbers"):
            info |= {"publication_sequence_number": None, "reception_sequence_number": None}
        if since("message_publisher"):
            info["publisher_gid"] = self.__publisher_gid(sample)
        return info

    def __publisher_gid(self, sample: Sample) -> dict[str, Any] | None:
        writer = None if self.__wire is None else self.__wire.writer(sample.writer)
        if writer is None:
            return None
        return {"implementation_identifier": get_rmw_implementation_identifier(), "data": writer.guid}


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


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
