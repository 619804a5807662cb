# SPDX-License-Identifier: Apache-2.0
"""Service servers."""

from __future__ import annotations

import inspect
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from coframe.errors import DecodeError
from coframe.messages import codec
from rclpy import _absent
from rclpy._absent import Handle
from rclpy._destroyable import LoggingEntity
from rclpy.service_introspection import REQUEST_RECEIVED, RESPONSE_SENT

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.wire.request_header import RequestHeader
    from coframe.wire.service_endpoints import ServicePublisher, ServiceSubscription
    from rclpy.callback_groups import CallbackGroup
    from rclpy.clock import Clock
    from rclpy.qos import QoSProfile
    from rclpy.service_introspection import ServiceEvents, ServiceIntrospectionState

_MAX_CLIENTS: Final = 1000  # whose writers are remembered


class Service(LoggingEntity):
    """Server of a service. Create it with `Node.create_service`."""

    handle = Handle()

    def __init__(
        self,
        requests: ServiceSubscription,
        replies: ServicePublisher,
        srv_type: Any,
        srv_name: str,
        service_name: str,
        callback: Callable[[Any, Any], Any],
        callback_group: CallbackGroup,
        qos_profile: QoSProfile,
        events: ServiceEvents,
    ) -> None:
        self.__events = events
        self.__requests: ServiceSubscription | None = requests
        self.__replies = replies
        self.srv_type = srv_type
        self.srv_name = srv_name
        self.__service_name = service_name
        self.callback = callback
        self.callback_group = callback_group
        self.__writers: dict[int, int] = {}  # the handles of the writers of requests, by client ID
        self.qos_profile = qos_profile

    @property
    def service_name(self) -> str:
        """The fully qualified name of the service. `srv_name` is the name that was given."""
        return self.__service_name

    def configure_introspection(
        self, clock: Clock, service_event_qos_profile: QoSProfile, introspection_state: ServiceIntrospectionState
    ) -> None:
        """Publish events of the requests and responses of this server on the topic `SERVICE/_service_event`, or stop.

        Args:
            clock: Clock of the stamps.
            service_event_qos_profile: QoS profile of the topic.
            introspection_state: What is published.
        """
        self.__events.configure(clock, service_event_qos_profile, introspection_state)

    def send_response(self, response: Any, header: RequestHeader) -> None:
        """Send the response to a request.

        Args:
            response: The response to send, an instance of ``srv_type.Response``.
            header: Header of the request.

        Raises:
            TypeError: `response` is not a response of the service's type.
        """
        if not isinstance(response, self.srv_type.Response):
            raise TypeError(f"Expected {self.srv_type.Response}, got {type(response)}")
        if self.__requests is None:
            return
        self.__replies.reply(header, codec.serialize(response), self.__writers.get(header[0], 0))
        self.__events.publish(RESPONSE_SENT, header, response=response)

    def destroy(self) -> None:
        """Destroy the service. Prefer `Node.destroy_service`."""
        if self.__requests is not None:
            self.__events.close()
            self.__requests.close()
            self.__replies.close()
            self.__requests = None

    def _Coframe__remaining_ns(self) -> int | None:
        requests = self.__requests
        return 0 if requests is not None and requests.pending() else None

    def _Coframe__take(self) -> Callable[[], Any] | None:
        requests = self.__requests
        if requests is None:
            return None
        for message in requests.take_messages(limit=1):
            try:
                request = codec.deserialize_whole(message.cdr, self.srv_type.Request)
            except DecodeError as error:
                requests.ignore_request(message, f"is invalid ({error})")
                continue
            self.__events.publish(REQUEST_RECEIVED, message.header, request=request)
            self.__writers[message.header.client] = message.writer
            if len(self.__writers) > _MAX_CLIENTS:
                self.__writers.pop(next(iter(self.__writers)), None)
            return partial(self._Coframe__answer, message.header, request)
        return None

    async def _Coframe__answer(self, header: RequestHeader, request: Any) -> None:
        response = self.callback(request, self.srv_type.Response())
        if inspect.iscoroutine(response):
            response = await response
        self.send_response(response, header)


class DeferredResponseService(Service):
    """Internal service whose responses may be sent later than the end of the callback.

    The callback is called with the request and its header, and responds with `send_response`. Several requests may be
    pending at the same time.
    """

    def _Coframe__answer(self, header: RequestHeader, request: Any) -> Any:
        return self.callback(request, header)


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
