# SPDX-License-Identifier: Apache-2.0
"""QoS events of publishers and subscriptions: missed deadlines, lost publishers, incompatible QoS, matches, ..."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

import inspect
from functools import partial
from typing import TYPE_CHECKING, Any

from rclpy import _absent
from rclpy._qos_event_types import (
    INCOMPATIBLE_TYPES,
    PUBLISHER_STATUSES,
    SUBSCRIPTION_STATUSES,
    IncompatibleTypeInfo,
    QoSLivelinessChangedInfo,
    QoSLivelinessLostInfo,
    QoSMatchedInfo,
    QoSMessageLostInfo,
    QoSOfferedDeadlineMissedInfo,
    QoSOfferedIncompatibleQoSInfo,
    QoSPublisherEventType,
    QoSPublisherMatchedInfo,
    QoSRequestedDeadlineMissedInfo,
    QoSRequestedIncompatibleQoSInfo,
    QoSSubscriptionEventType,
    QoSSubscriptionMatchedInfo,
)
from rclpy._rclpy_pybind11 import UnsupportedEventTypeError
from rclpy.waitable import NumberOfEntities, Waitable, WaitSet

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from coframe.wire.endpoints import LocalEndpoint
    from rclpy.callback_groups import CallbackGroup
    from rclpy.impl.rcutils_logger import RcutilsLogger

__all__ = [
    "EventHandler",
    "IncompatibleTypeInfo",
    "PublisherEventCallbacks",
    "QoSLivelinessChangedInfo",
    "QoSLivelinessLostInfo",
    "QoSMatchedInfo",
    "QoSMessageLostInfo",
    "QoSOfferedDeadlineMissedInfo",
    "QoSOfferedIncompatibleQoSInfo",
    "QoSPublisherEventType",
    "QoSPublisherMatchedInfo",
    "QoSRequestedDeadlineMissedInfo",
    "QoSRequestedIncompatibleQoSInfo",
    "QoSSubscriptionEventType",
    "QoSSubscriptionMatchedInfo",
    "SubscriptionEventCallbacks",
    "UnsupportedEventTypeError",
]


class EventHandler(Waitable):
    """Waitable that calls a function when an event of a publisher or subscription has happened.

    Args:
        callback_group: Group of the callback.
        callback: Function or coroutine function that is called with the information on the event.
        event_type: Kind of the event.
        parent_impl: Endpoint of the publisher or subscription.
    """

    def __init__(
        self,
        *,
        callback_group: CallbackGroup,
        callback: Callable[[Any], Any],
        event_type: QoSPublisherEventType | QoSSubscriptionEventType,
        parent_impl: LocalEndpoint,
    ) -> None:
        super().__init__(callback_group)
        self.callback = callback
        self.event_type = event_type
        self.__endpoint: LocalEndpoint | None = parent_impl
        self.__type_mismatches = 0
        self.__event: Any = None

    def is_ready(self, wait_set: WaitSet) -> bool:
        """Return whether the event has happened."""
        del wait_set
        return self._Coframe__remaining_ns() is not None

    def take_data(self) -> Any:
        """Return the information on the event, or None if it has not happened."""
        self._Coframe__remaining_ns()
        event, self.__event = self.__event, None
        return event

    async def execute(self, taken_data: Any) -> None:
        """Call the callback."""
        if taken_data is not None:
            result = self.callback(taken_data)
            if inspect.iscoroutine(result):
                await result

    def get_num_entities(self) -> NumberOfEntities:
        """Return one event."""
        return NumberOfEntities(num_events=1)

    def add_to_wait_set(self, wait_set: WaitSet) -> None:
        """Add this event."""
        wait_set.add_event(self)

    def destroy(self) -> None:
        """Stop listening."""
        self.__endpoint = None

    def _Coframe__report_type_mismatch(self) -> None:
        self.__type_mismatches += 1

    def _Coframe__remaining_ns(self) -> int | None:
        if self.__event is None and self.__endpoint is not None:
            self.__event = self.__take(self.__endpoint)
        return None if self.__event is None else 0

    def _Coframe__take(self) -> Callable[[], Any] | None:
        event = self.take_data()
        return None if event is None else partial(self.callback, event)

    def __take(self, endpoint: LocalEndpoint) -> Any:
        if self.event_type in INCOMPATIBLE_TYPES:
            count, self.__type_mismatches = self.__type_mismatches, 0
            return IncompatibleTypeInfo(count, count) if count else None
        if isinstance(self.event_type, QoSPublisherEventType):
            status, as_info = PUBLISHER_STATUSES[self.event_type]
        else:
            status, as_info = SUBSCRIPTION_STATUSES[self.event_type]
        counts = endpoint.take_status(status)
        return None if counts is None else as_info(counts)


class PublisherEventCallbacks:
    """Callbacks for the events of a publisher. Each is called with an information object of this module.

    Args:
        incompatible_qos: Called when a subscription requests more than the publisher offers.
        liveliness: Called when the publisher did not assert its liveliness in time.
        deadline: Called when the publisher did not publish in time.
        incompatible_type: Called when a subscription of the topic has another message type.
        matched: Called when the number of matched subscriptions has changed.
        use_default_callbacks: Whether to log a warning about incompatible QoS if there is no callback for it.
    """

    def __init__(
        self,
        *,
        incompatible_qos: Callable[[QoSOfferedIncompatibleQoSInfo], Any] | None = None,
        liveliness: Callable[[QoSLivelinessLostInfo], Any] | None = None,
        deadline: Callable[[QoSOfferedDeadlineMissedInfo], Any] | None = None,
        incompatible_type: Callable[[IncompatibleTypeInfo], Any] | None = None,
        matched: Callable[[QoSMatchedInfo], Any] | None = None,
        use_default_callbacks: bool = True,
    ) -> None:
        self.incompatible_qos = incompatible_qos
        self.liveliness = liveliness
        self.deadline = deadline
        self.incompatible_type = incompatible_type
        self.matched = matched
        self.use_default_callbacks = use_default_callbacks

    def create_event_handlers(
        self, callback_group: CallbackGroup, publisher_impl: LocalEndpoint, topic_name: str
    ) -> list[EventHandler]:
        """Return a handler for each callback. Nodes call this."""
        del topic_name
        kinds = QoSPublisherEventType
        return _handlers(
            callback_group,
            publisher_impl,
            {
                kinds.RCL_PUBLISHER_OFFERED_DEADLINE_MISSED: self.deadline,
                kinds.RCL_PUBLISHER_LIVELINESS_LOST: self.liveliness,
                kinds.RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS: self.incompatible_qos,
                kinds.RCL_PUBLISHER_INCOMPATIBLE_TYPE: self.incompatible_type,
                kinds.RCL_PUBLISHER_MATCHED: self.matched,
            },
        )


class SubscriptionEventCallbacks:
    """Callbacks for the events of a subscription. Each is called with an information object of this module.

    Args:
        incompatible_qos: Called when a publisher offers less than the subscription requests.
        deadline: Called when a message came too late.
        liveliness: Called when the number of publishers that are alive has changed.
        message_lost: Called when messages were lost.
        incompatible_type: Called when a publisher of the topic has another message type.
        matched: Called when the number of matched publishers has changed.
        use_default_callbacks: Whether to log a warning about incompatible QoS if there is no callback for it.
    """

    def __init__(
        self,
        *,
        incompatible_qos: Callable[[QoSRequestedIncompatibleQoSInfo], Any] | None = None,
        deadline: Callable[[QoSRequestedDeadlineMissedInfo], Any] | None = None,
        liveliness: Callable[[QoSLivelinessChangedInfo], Any] | None = None,
        message_lost: Callable[[QoSMessageLostInfo], Any] | None = None,
        incompatible_type: Callable[[IncompatibleTypeInfo], Any] | None = None,
        matched: Callable[[QoSMatchedInfo], Any] | None = None,
        use_default_callbacks: bool = True,
    ) -> None:
        self.incompatible_qos = incompatible_qos
        self.deadline = deadline
        self.liveliness = liveliness
        self.message_lost = message_lost
        self.incompatible_type = incompatible_type
        self.matched = matched
        self.use_default_callbacks = use_default_callbacks

    def create_event_handlers(
        self, callback_group: CallbackGroup, subscription_impl: LocalEndpoint, topic_name: str
    ) -> list[EventHandler]:
        """Return a handler for each callback. Nodes call this."""
        del topic_name
        kinds = QoSSubscriptionEventType
        return _handlers(
            callback_group,
            subscription_impl,
            {
                kinds.RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED: self.deadline,
                kinds.RCL_SUBSCRIPTION_LIVELINESS_CHANGED: self.liveliness,
                kinds.RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS: self.incompatible_qos,
                kinds.RCL_SUBSCRIPTION_MESSAGE_LOST: self.message_lost,
                kinds.RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE: self.incompatible_type,
                kinds.RCL_SUBSCRIPTION_MATCHED: self.matched,
            },
        )


def _handlers(
    callback_group: CallbackGroup,
    endpoint: LocalEndpoint,
    callbacks: Mapping[Any, Callable[[Any], Any] | None],
) -> list[EventHandler]:
    return [
        EventHandler(callback_group=callback_group, callback=callback, event_type=kind, parent_impl=endpoint)
        for kind, callback in callbacks.items()
        if callback is not None
    ]


class MismatchReporter:
    """Reports endpoints that cannot communicate with a publisher or subscription, by default as a warning of its node.

    The thread that observes the graph calls it, so that the warning also comes if the node is not spinning.
    """

    def __init__(
        self, callbacks: PublisherEventCallbacks | SubscriptionEventCallbacks, logger: RcutilsLogger, topic: str
    ) -> None:
        self._callbacks = callbacks
        self._log = logger
        self._topic = topic
        self.handlers: list[EventHandler] = []

    def __call__(self, reason: str, text: str) -> None:
        """Report a mismatch.

        Args:
            reason: "type", or the QoS policy.
            text: Description of the mismatch with the name of the other node.
        """
        if reason == "type":
            self._report_type(text)
        elif self._callbacks.use_default_callbacks and self._callbacks.incompatible_qos is None:
            if isinstance(self._callbacks, PublisherEventCallbacks):
                peer, verb, no_messages = "subscription", "requesting", "sent to"
            else:
                peer, verb, no_messages = "publisher", "offering", "received from"
            self._log.warning(
                f"New {peer} discovered on topic '{self._topic}', {verb} incompatible QoS. "
                f"No messages will be {no_messages} it. Last incompatible policy: {reason.upper()}"
            )
            self._log.info(text)

    def _report_type(self, text: str) -> None:
        handlers = [handler for handler in self.handlers if handler.event_type in INCOMPATIBLE_TYPES]
        for handler in handlers:
            handler._Coframe__report_type_mismatch()
        if not handlers and self._callbacks.use_default_callbacks:
            self._log.warning(text)


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
