# SPDX-License-Identifier: Apache-2.0
"""A single call of a service from the viewer's node."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from coframe.messages import codec
from coframe.wire import request_header
from coframe.wire.qos import QoS
from coframe.wire.request_header import RequestHeader
from coframe.wire.rtps.clients import client_user_data
from coframe.wire.service_endpoints import RejectedRequestError

if TYPE_CHECKING:
    from coframe.connection.connection import Connection

__all__ = ["call_service"]

_STEP = 0.01  # seconds between checks for a server and its response


def call_service(connection: Connection, service: str, service_type: Any, request: Any, timeout: float) -> Any:
    """Send a request and return the response, or None if there is no server, or no response in time.

    Args:
        connection: The connection whose node calls the service.
        service: The fully qualified name of the service.
        service_type: The class of the service.
        request: The request.
        timeout: The time to wait, in seconds. The calling thread blocks.

    Raises:
        WireError: The middleware cannot create the client.
        DecodeError: The response is invalid.
    """
    participant, node, identity = connection.participant, connection.node, client_user_data()
    deadline = time.monotonic() + timeout
    replies = participant.service_subscription(node, service, service_type.Response, QoS(), "reply", user_data=identity)
    try:
        requests = participant.service_publisher(
            node, service, service_type.Request, QoS(), "request", user_data=identity
        )
        try:
            while not (requests.matched and replies.matched):
                if time.monotonic() > deadline:
                    return None
                time.sleep(_STEP)
            header = RequestHeader(requests.client_id, 1)
            try:
                requests.write(request_header.join(header, codec.serialize(request)))
            except RejectedRequestError:
                return None
            while time.monotonic() < deadline:
                for found, cdr, _ in replies.take_messages():
                    if found == header:
                        return codec.deserialize(cdr, service_type.Response)
                time.sleep(_STEP)
            return None
        finally:
            requests.close()
    finally:
        replies.close()
