# SPDX-License-Identifier: Apache-2.0
"""The introspection of services, which publishes requests and responses on the topic `SERVICE/_service_event`."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.

from __future__ import annotations

from enum import Enum
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from coframe.messages import codec
from coframe.messages.registry import find
from rclpy import _absent

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.wire.endpoints import Publisher
    from coframe.wire.request_header import RequestHeader
    from rclpy.clock import Clock
    from rclpy.qos import QoSProfile

__all__ = ["EVENT_TOPIC", "ServiceEvents", "ServiceIntrospectionState"]

EVENT_TOPIC: Final = "/_service_event"
# Constants of service_msgs/msg/ServiceEventInfo.
REQUEST_SENT, REQUEST_RECEIVED, RESPONSE_SENT, RESPONSE_RECEIVED = range(4)
_GID_SIZE: Final = 16


class ServiceIntrospectionState(Enum):
    """What is published about the requests and responses of a service: nothing, metadata, or also their contents."""

    OFF = 0
    METADATA = 1
    CONTENTS = 2


class ServiceEvents:
    """The events of a client or a server, which are published while the introspection is on.

    Args:
        srv_type: Class of the service.
        create_publisher: Return a publisher of the events, given their class and the QoS profile.
    """

    def __init__(self, srv_type: Any, create_publisher: Callable[[Any, QoSProfile], Publisher]) -> None:
        self._srv_type = srv_type
        self._create_publisher = create_publisher
        self._state = ServiceIntrospectionState.OFF
        self._clock: Clock | None = None
        self._publisher: Publisher | None = None

    def configure(self, clock: Clock, qos: QoSProfile, state: ServiceIntrospectionState) -> None:
        """Publish events with the stamps of a clock, or stop publishing them."""
        if not isinstance(state, ServiceIntrospectionState):
            raise TypeError(f"The introspection state must be a ServiceIntrospectionState, not {state!r}.")
        self.close()
        self._clock, self._state = clock, state
        if state is not ServiceIntrospectionState.OFF:
            self._publisher = self._create_publisher(self._srv_type.Event, qos)

    def publish(self, event_type: int, header: RequestHeader, *, request: Any = None, response: Any = None) -> None:
        """Publish an event if the introspection is on.

        Args:
            event_type: A constant of `service_msgs/msg/ServiceEventInfo`.
            header: The header of the request.
            request: The request, or None for events of responses.
            response: The response, or None for events of requests.
        """
        publisher, clock = self._publisher, self._clock
        if publisher is None or clock is None:
            return
        event = self._srv_type.Event()
        event.info = find("service_msgs/msg/ServiceEventInfo")(
            event_type=event_type,
            stamp=clock.now().to_msg(),
            client_gid=list(header.client.to_bytes(8, "little").ljust(_GID_SIZE, b"\0")),
            sequence_number=header.sequence,
        )
        if self._state is ServiceIntrospectionState.CONTENTS:
            event.request = [] if request is None else [request]
            event.response = [] if response is None else [response]
        publisher.write(codec.serialize(event))

    def close(self) -> None:
        """Stop publishing events."""
        publisher, self._publisher = self._publisher, None
        if publisher is not None:
            publisher.close()


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
