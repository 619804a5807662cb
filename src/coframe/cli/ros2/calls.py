# SPDX-License-Identifier: Apache-2.0
"""Call services of another node, with error messages for the possible failures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.cli.output import fail
from coframe.cli.ros2.graph import PATIENCE, fail_once

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node

__all__ = ["call_service", "fail_if_refused", "wait_for_server"]

_RESPONSE = 5.0  # seconds


def fail_if_refused(client: Any) -> None:
    """End the command if the middleware of all servers would misread requests.

    Args:
        client: A service client or an action client.
    """
    reason: str = getattr(client, "_Coframe__refusal", "")  # The rclpy of a sourced ROS does not know it.
    if reason:
        fail_once(reason)


def wait_for_server(client: Any, wait: Callable[[float], bool]) -> None:
    """Wait for a server without a limit; end the command if all servers would misread requests.

    Args:
        client: A service client or an action client.
        wait: Its method that waits for a server with a timeout.
    """
    while not wait(PATIENCE):
        fail_if_refused(client)


def call_service(node: Node, service_class: Any, name: str, request: Any) -> Any:
    """Call a service and return its response; end the command if there is none.

    Args:
        node: Node of the command.
        service_class: Class of the service.
        name: Full name of the service, e.g. "/listener/get_parameters".
        request: The request.
    """
    import rclpy  # noqa: PLC0415 - slow import

    client = node.create_client(service_class, name)
    try:
        if not client.wait_for_service(PATIENCE):
            fail_if_refused(client)
            fail(f"There is no service {name}.", "coframe service list shows all services.")
        future = client.call_async(request)
        rclpy.spin_until_future_complete(node, future, timeout_sec=_RESPONSE)
        if not future.done():
            fail(f"Service {name} did not respond within {_RESPONSE:g} s.", "Check that its node is spinning.")
        return future.result()
    finally:
        node.destroy_client(client)
