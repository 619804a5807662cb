# SPDX-License-Identifier: Apache-2.0
"""Parameter services of nodes without parameters, so that `ros2 param` receives a response from them.

The services of a node are created when the first client is discovered. Until then, they cost nothing.
"""

from __future__ import annotations

import logging
import threading
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe import _core
from coframe.errors import CoframeError, DecodeError
from coframe.time import SECOND
from coframe.wire import names
from coframe.wire.qos import QoS

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable

    from coframe.wire.endpoints import GraphNode
    from coframe.wire.participant import Participant
    from coframe.wire.service_endpoints import ServicePublisher, ServiceSubscription

_logger = logging.getLogger("coframe.wire")

_TYPES = {
    "describe_parameters": "DescribeParameters",
    "get_parameter_types": "GetParameterTypes",
    "get_parameters": "GetParameters",
    "list_parameters": "ListParameters",
    "set_parameters": "SetParameters",
    "set_parameters_atomically": "SetParametersAtomically",
}
_QOS = QoS(depth=1000)  # rmw_qos_profile_parameters


class _Service(NamedTuple):
    """A service of one node."""

    srv_type: Any
    requests: ServiceSubscription
    replies: ServicePublisher


class ParameterServices:
    """Answers the parameter services of the nodes of a participant that have no parameters."""

    def __init__(self, participant: Participant) -> None:
        self._participant = participant
        self._served_nodes: set[GraphNode] = set()
        self._services: list[_Service] = []
        self._lock = threading.Lock()
        self._event = _core.Event()
        self._thread: threading.Thread | None = None
        self._closing = False

    def serve(self, nodes: Iterable[GraphNode], requested: Collection[str]) -> None:
        """Create the services of the nodes for which a client has been discovered.

        Args:
            nodes: Nodes without parameters.
            requested: The DDS topics that have publishers.
        """
        for node in nodes:
            topics = {names.dds_topic(f"{node.full_name}/{service}", "request") for service in _TYPES}
            if node not in self._served_nodes and not topics.isdisjoint(requested):
                self._served_nodes.add(node)
                self._create(node)

    def close(self) -> None:
        """End the thread that answers requests."""
        self._closing = True
        self._event.set()
        if self._thread is not None:
            self._thread.join()

    def _create(self, node: GraphNode) -> None:
        from coframe.messages.registry import find  # noqa: PLC0415 - importing coframe.wire must be cheap

        for service, type_name in _TYPES.items():
            srv_type, topic = find(f"rcl_interfaces/srv/{type_name}"), f"{node.full_name}/{service}"
            replies = self._participant.service_publisher(node, topic, srv_type.Response, _QOS, "reply")
            requests = self._participant.service_subscription(
                node, topic, srv_type.Request, _QOS, "request", self._event
            )
            with self._lock:
                self._services.append(_Service(srv_type, requests, replies))
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name="coframe-parameters", daemon=True)
            self._thread.start()

    def _run(self) -> None:
        while not self._closing:
            with self._lock:
                self._services = [service for service in self._services if not service.requests.closed]
                services = list(self._services)
            for service in services:
                try:
                    _answer(service)
                except CoframeError as error:
                    if not service.requests.closed:
                        _logger.warning("A request about parameters was not answered: %s", error)
            self._event.wait(SECOND)


def _answer(service: _Service) -> None:
    # Imported here because importing coframe.wire must be cheap.
    from coframe.messages.codec import deserialize_whole, serialize  # noqa: PLC0415

    for message in service.requests.take_messages() if service.requests.pending() else ():
        try:
            request = deserialize_whole(message.cdr, service.srv_type.Request)
        except DecodeError as error:
            service.requests.ignore_request(message, f"is invalid ({error})")
            continue
        service.replies.reply(message.header, serialize(_response(service.srv_type, request)), message.writer)


def _response(srv_type: Any, request: Any) -> Any:
    """Return the response of a node without parameters: it has none, and none can be set."""
    response = srv_type.Response()
    if not hasattr(request, "parameters"):
        return response
    from coframe.messages.registry import find  # noqa: PLC0415 - importing coframe.wire must be cheap

    result_type = find("rcl_interfaces/msg/SetParametersResult")
    reasons = [f"parameter '{each.name}' cannot be set because it was not declared" for each in request.parameters]
    if hasattr(response, "results"):
        response.results = [result_type(successful=False, reason=reason) for reason in reasons]
    else:
        response.result = result_type(successful=not reasons, reason="; ".join(reasons))
    return response
