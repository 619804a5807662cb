# SPDX-License-Identifier: Apache-2.0
"""Service clients."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

import threading
import time
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from coframe._core import Event
from coframe.distributions import since
from coframe.messages import codec
from coframe.time import MILLISECOND
from coframe.wire import request_header
from coframe.wire.request_header import RequestHeader
from coframe.wire.service_endpoints import RejectedRequestError
from rclpy import _absent
from rclpy._absent import Handle
from rclpy._destroyable import LoggingEntity, destroyed_error
from rclpy.constants import S_TO_NS
from rclpy.service_introspection import REQUEST_SENT, RESPONSE_RECEIVED
from rclpy.task import Future

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from coframe.wire.participant import Participant
    from coframe.wire.service_endpoints import ServicePublisher, ServiceSubscription
    from rclpy.callback_groups import CallbackGroup
    from rclpy.clock import Clock
    from rclpy.context import Context
    from rclpy.executors import Executor
    from rclpy.qos import QoSProfile
    from rclpy.service_introspection import ServiceEvents, ServiceIntrospectionState

# Endpoints appear in the graph shortly before they match, so the condition is checked again after this time.
_MATCH_CHECK_PERIOD_NS: Final = 20 * MILLISECOND


class Client(LoggingEntity):
    """Client that sends requests to a service. Create it with `Node.create_client`."""

    handle = Handle()

    def __init__(
        self,
        context: Context,
        participant: Participant,
        requests: ServicePublisher,
        replies: ServiceSubscription,
        executor: Callable[[], Executor | None],
        srv_type: Any,
        srv_name: str,
        service_name: str,
        qos_profile: QoSProfile,
        callback_group: CallbackGroup,
        events: ServiceEvents,
    ) -> None:
        self.__events = events
        self.context = context
        self.srv_type = srv_type
        self.srv_name = srv_name
        self.__service_name = service_name
        self.qos_profile = qos_profile
        self.callback_group = callback_group
        self._Coframe__participant = participant
        self.__requests = requests
        self.__replies: ServiceSubscription | None = replies
        self.__executor = executor
        self.__identity = requests.client_id
        self.__lock = threading.Lock()
        self.__sequence = 0
        self.__pending: dict[int, tuple[Future[Any], Callable[[Any], Any]]] = {}
        self.__unreachable = ""  # why no server understands the pending requests
        requests.on_unreachable = self.__on_unreachable

    @property
    def service_name(self) -> str:
        """The fully qualified name of the service. `srv_name` is the name that was given."""
        return self.__service_name

    def call(self, request: Any, timeout_sec: float | None = None) -> Any:
        """Send a request and wait for the response.

        The node does not need to be spinning. This works in any callback, as long as another executor runs the service.

        Args:
            request: The request to send, an instance of ``srv_type.Request``.
            timeout_sec: Maximum time to wait in seconds. None: until the response or the shutdown of the context.

        Returns:
            The response. None if the context was shut down, and up to Jazzy also if it did not arrive in time.

        Raises:
            TypeError: `request` is not a request of the service's type.
            TimeoutError: The response did not arrive in time, from Kilted on.
            WireError: The request was not sent, because the middleware of the servers sends requests in another form.
            DecodeError: The response is invalid.
        """
        future = self.call_async(request)
        take_responses_until([self], future, timeout_sec)
        if not future.done():
            self.remove_pending_request(future)
            if timeout_sec is not None and self.context.ok() and since("call_timeout"):
                raise TimeoutError(f"no response from the service '{self.service_name}' within {timeout_sec:g} s")
            return None
        return future.result()

    def call_async(self, request: Any) -> Future[Any]:
        """Send a request without waiting for the response.

        Args:
            request: The request to send, an instance of ``srv_type.Request``.

        Returns:
            A future of the response. Its exception is a WireError if the request was not sent because the middleware of
            the servers sends requests in another form, and a DecodeError if the response is invalid.

        Raises:
            TypeError: `request` is not a request of the service's type.
        """
        if not isinstance(request, self.srv_type.Request):
            raise TypeError(f"Expected {self.srv_type.Request}, got {type(request)}")
        return self._Coframe__send(request, _return_unchanged)

    def _Coframe__send(self, request: Any, convert: Callable[[Any], Any]) -> Future[Any]:
        """Send a request and return a future whose result is `convert(response)`."""
        self.__require_replies()
        cdr = codec.serialize(request)
        future: Future[Any] = Future()
        with self.__lock:
            self.__sequence += 1
            header = RequestHeader(self.__identity, self.__sequence)
            self.__pending[header.sequence] = future, convert
        future._Coframe__add_waiter(partial(self.__forget, header.sequence))
        try:
            self.__requests.write(request_header.join(header, cdr))
            self.__events.publish(REQUEST_SENT, header, request=request)
        except RejectedRequestError as error:
            future.set_exception(error)
        return future

    def get_pending_request(self, sequence_number: int) -> Future[Any]:
        """Return the future of a pending request.

        Raises:
            KeyError: No request with this number is pending.
        """
        with self.__lock:
            return self.__pending[sequence_number][0]

    def configure_introspection(
        self, clock: Clock, service_event_qos_profile: QoSProfile, introspection_state: ServiceIntrospectionState
    ) -> None:
        """Publish events of the requests and responses of this client on the topic `SERVICE/_service_event`, or stop.

        Args:
            clock: Clock of the stamps.
            service_event_qos_profile: QoS profile of the topic.
            introspection_state: What is published.
        """
        self.__events.configure(clock, service_event_qos_profile, introspection_state)

    def remove_pending_request(self, future: Future[Any]) -> None:
        """Remove a pending request. Its response will be dropped."""
        with self.__lock:
            for sequence, (pending, _) in list(self.__pending.items()):
                if pending is future:
                    del self.__pending[sequence]

    def __forget(self, sequence: int) -> None:
        """Remove the request of a completed or cancelled future, whose response may never arrive."""
        with self.__lock:
            self.__pending.pop(sequence, None)

    def service_is_ready(self) -> bool:
        """Return whether a server of this service is available."""
        replies = self.__require_replies()
        return self.__requests.matched > 0 and replies.matched > 0

    @property
    def _Coframe__refusal(self) -> str:
        """Why no request can be sent although there is a server, or "" if there is no reason."""
        self.__require_replies()
        return self.__requests.refusal

    def wait_for_service(self, timeout_sec: float | None = None) -> bool:
        """Wait until a server of this service is available.

        Args:
            timeout_sec: Maximum time to wait in seconds. None: no limit.

        Returns:
            Whether a server is available. False if the context was shut down.
        """
        return wait_until_ready(self.context, self._Coframe__participant, self.service_is_ready, timeout_sec)

    def destroy(self) -> None:
        """Destroy the client. Prefer `Node.destroy_client`."""
        if self.__replies is not None:
            self.__events.close()
            self.__replies.close()
            self.__requests.close()
            self.__replies = None

    def __require_replies(self) -> ServiceSubscription:
        if self.__replies is None:
            raise destroyed_error(f"The client of '{self.service_name}'")
        return self.__replies

    def _Coframe__remaining_ns(self) -> int | None:
        replies = self.__replies
        return 0 if self.__unreachable or (replies is not None and replies.pending()) else None

    def _Coframe__take(self) -> Callable[[], Any] | None:
        """Take one reply. A client receives the replies to all clients and skips replies to other clients."""
        if self.__unreachable:
            return self.__fail_pending
        replies = self.__replies
        for header, cdr, _ in [] if replies is None else replies.take_messages(limit=1):
            if header.client != self.__identity:
                continue
            with self.__lock:
                pending = self.__pending.pop(header.sequence, None)
            if pending is not None:
                return partial(self.__deliver, header, *pending, cdr)
        return None

    def _Coframe__take_all(self) -> None:
        while self._Coframe__remaining_ns() is not None:
            if (deliver := self._Coframe__take()) is not None:
                deliver()

    def __deliver(self, header: RequestHeader, future: Future[Any], convert: Callable[[Any], Any], cdr: bytes) -> None:
        future._set_executor(self.__executor())
        try:
            response = codec.deserialize_whole(cdr, self.srv_type.Response)
            self.__events.publish(RESPONSE_RECEIVED, header, response=response)
            result = convert(response)
        except ValueError as error:
            future.set_exception(error)
        else:
            future.set_result(result)

    def __on_unreachable(self, reason: str) -> None:
        """Wake the executor to fail the requests that were sent before the server was discovered."""
        if self.__pending and self.__replies is not None:
            self.__unreachable = reason
            self.context._Coframe__wakeup.set()

    def __fail_pending(self) -> None:
        with self.__lock:
            reason, self.__unreachable = self.__unreachable, ""
            if not reason:  # Another thread has done it.
                return
            pending, self.__pending = self.__pending, {}
        for future, _ in pending.values():
            future._set_executor(self.__executor())
            future.set_exception(RejectedRequestError(reason))


def take_responses_until(clients: Sequence[Client], future: Future[Any], timeout_sec: float | None) -> None:
    """Take the responses of clients in this thread until a future is complete, without an executor.

    Args:
        clients: The clients, which belong to one context.
        future: Future to wait for.
        timeout_sec: Maximum time to wait in seconds. None: until the shutdown of the context.
    """
    context = clients[0].context
    deadline = _deadline(timeout_sec)
    future._Coframe__add_waiter(context._Coframe__wakeup.set)
    while context.ok():
        seen = context._Coframe__wakeup.count
        for client in clients:
            client._Coframe__take_all()
        remaining = None if deadline is None else deadline - time.monotonic_ns()
        if future._Coframe__is_complete() or (remaining is not None and remaining <= 0):
            return
        context._Coframe__wakeup.wait(seen, remaining)


def wait_until_ready(
    context: Context, participant: Participant, is_ready: Callable[[], bool], timeout_sec: float | None
) -> bool:
    """Wait until the remote side of some endpoints is available.

    Args:
        context: Context whose shutdown ends the wait.
        participant: Participant whose graph changes wake the wait.
        is_ready: Function that returns whether the remote side is available.
        timeout_sec: Maximum time to wait in seconds. None: no limit.

    Returns:
        Whether the remote side is available. False if the context was shut down.
    """
    deadline = _deadline(timeout_sec)
    event = Event()
    participant.watch_graph(event)
    try:
        with context._Coframe__shutdown.wakes(event):
            while context.ok() and not is_ready():
                remaining = _MATCH_CHECK_PERIOD_NS if deadline is None else deadline - time.monotonic_ns()
                if remaining <= 0:
                    return False
                event.wait(min(remaining, _MATCH_CHECK_PERIOD_NS))
    finally:
        participant.unwatch_graph(event)
    return context.ok()


def _deadline(timeout_sec: float | None) -> int | None:
    if not isinstance(timeout_sec, int | float | None):
        raise TypeError(f"timeout_sec must be a number of seconds or None, got {timeout_sec!r}.")
    return None if timeout_sec is None else time.monotonic_ns() + int(timeout_sec * S_TO_NS)


def _return_unchanged(response: Any) -> Any:
    return response


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
