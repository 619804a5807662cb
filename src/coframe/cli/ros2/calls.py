# SPDX-License-Identifier: Apache-2.0
"""Call services of another node, with error messages for the possible failures, and a limit for each wait."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import click

from coframe.cli.options import PositiveDuration
from coframe.cli.output import fail, one_line, warn
from coframe.cli.ros2.graph import ENDPOINT_TIMEOUT, fail_once

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.cli.declaration import Declared
    from rclpy.node import Node

__all__ = [
    "Deadline",
    "await_response",
    "call_service",
    "fail_if_incompatible",
    "response_timeout_option",
    "timeout_option",
    "wait_for_server",
]

_RESPONSE_TIMEOUT = 5.0  # seconds until a missing response is reported


def _timeout_option(description: str, default: str | None = None) -> Callable[[Declared], Declared]:
    return click.option("--timeout", metavar="DURATION", type=PositiveDuration, default=default, help=description)


timeout_option = _timeout_option("Give up after this time, with exit code 1. [default: no limit]")
response_timeout_option = _timeout_option(
    "How long to wait for each response of a node.", default=f"{_RESPONSE_TIMEOUT:g}s"
)


class Deadline:
    """The end of all waits of a command; never if there is no limit.

    Args:
        limit: The value of ``--timeout``.
    """

    def __init__(self, limit: PositiveDuration | None) -> None:
        self.limit = limit
        self._end = float("inf") if limit is None else time.monotonic() + limit.seconds

    def remaining(self, most: float) -> float:
        """Return the seconds to wait: at most `most`, and not beyond the end."""
        return max(0.0, min(most, self._end - time.monotonic()))

    @property
    def has_passed(self) -> bool:
        """Whether the end is reached."""
        return time.monotonic() >= self._end


def fail_if_incompatible(client: Any) -> None:
    """End the command if the middleware of all servers would misread requests.

    Args:
        client: A service client or an action client.
    """
    reason: str = getattr(client, "_Coframe__refusal", "")  # The rclpy of a sourced ROS does not know it.
    if reason:
        fail_once(reason)


def wait_for_server(
    client: Any, wait: Callable[[float], bool], name: str, deadline: Deadline, hint: Callable[[], str]
) -> None:
    """Wait for a server, and print once that there is none yet.

    End the command after the deadline, and if the middleware of all servers would misread requests.

    Args:
        client: A service client or an action client.
        wait: Its method that waits for a server with a timeout.
        name: What is waited for, such as "service /reset".
        deadline: The end of the wait.
        hint: Returns what to do, such as similar names in the graph.
    """
    reported = False
    while not wait(deadline.remaining(ENDPOINT_TIMEOUT)):
        fail_if_incompatible(client)
        if deadline.has_passed:
            fail(f"There was no {one_line(name)} within {deadline.limit}.", hint())
        if not reported:
            reported = True
            warn(f"There is no {one_line(name)} yet: waiting for it. {hint()}".rstrip())


def await_response(node: Node, future: Any, name: str, deadline: Deadline) -> Any:
    """Return the response of a server, print once that there is none yet, or end the command after the deadline.

    Args:
        node: Node of the command.
        future: The future of the response.
        name: Who responds, such as "service /reset".
        deadline: The end of the wait.
    """
    import rclpy  # noqa: PLC0415 - slow import

    reported = False
    while not future.done():
        rclpy.spin_until_future_complete(node, future, timeout_sec=deadline.remaining(_RESPONSE_TIMEOUT))
        if future.done():
            break
        if deadline.has_passed:
            fail(f"The {one_line(name)} did not respond within {deadline.limit}.", "Check that its node is spinning.")
        if not reported:
            reported = True
            warn(f"The {one_line(name)} has not responded for {_RESPONSE_TIMEOUT:g} s. --timeout limits the wait.")
    return future.result()


def call_service(
    node: Node, service_class: Any, name: str, request: Any, *, timeout: PositiveDuration | None = None
) -> Any:
    """Call a service and return its response, and end the command if there is none.

    Args:
        node: Node of the command.
        service_class: Class of the service.
        name: Full name of the service, e.g. "/listener/get_parameters".
        request: The request to send, an instance of ``service_class.Request``.
        timeout: How long to wait for the response; 5 s if it is None.
    """
    import rclpy  # noqa: PLC0415 - slow import

    seconds = _RESPONSE_TIMEOUT if timeout is None else timeout.seconds
    client = node.create_client(service_class, name)
    try:
        if not client.wait_for_service(ENDPOINT_TIMEOUT if timeout is None else min(ENDPOINT_TIMEOUT, seconds)):
            fail_if_incompatible(client)
            fail(f"There is no service {name}.", "coframe service list shows all services.")
        future = client.call_async(request)
        rclpy.spin_until_future_complete(node, future, timeout_sec=seconds)
        if not future.done():
            fail(f"Service {name} did not respond within {seconds:g} s.", "Check that its node is spinning.")
        return future.result()
    finally:
        node.destroy_client(client)
