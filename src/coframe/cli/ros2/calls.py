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
    "MAX_WAIT_FOR_RESPONSE",
    "MAX_WAIT_FOR_SERVER",
    "Deadline",
    "Presence",
    "await_response",
    "call_service",
    "fail_if_incompatible",
    "is_complete",
    "response_timeout_option",
    "timeout_option",
    "wait_for_server",
]

_RESPONSE_TIMEOUT = 5.0  # seconds until a missing response is reported
_PERIOD = 0.5  # seconds between two checks of whether the server still exists
_MAX_ABSENCE = 5.0  # seconds: a server that was discovered and is not there for longer has ended

# What ends a wait without --timeout. Responses and results may take long, as long as their server exists.
MAX_WAIT_FOR_SERVER = PositiveDuration("60s")
MAX_WAIT_FOR_RESPONSE = PositiveDuration("10min")


def _timeout_option(description: str, default: str | None = None) -> Callable[[Declared], Declared]:
    return click.option("--timeout", metavar="DURATION", type=PositiveDuration, default=default, help=description)


timeout_option = _timeout_option(
    f"Give up after this time, with exit code 1. [default: {MAX_WAIT_FOR_SERVER} without a server, "
    f"{MAX_WAIT_FOR_RESPONSE} without a response of the server]"
)
response_timeout_option = _timeout_option(
    "How long to wait for each response of a node.", default=f"{_RESPONSE_TIMEOUT:g}s"
)


class Deadline:
    """The end of a wait.

    Args:
        limit: How long to wait.
    """

    def __init__(self, limit: PositiveDuration) -> None:
        self.limit = limit
        self.extend()

    def extend(self) -> None:
        """Start the wait again, because the server has sent something."""
        self._end = time.monotonic() + self.limit.seconds

    def remaining(self, most: float) -> float:
        """Return the seconds to wait: at most `most`, and not beyond the end."""
        return max(0.0, min(most, self._end - time.monotonic()))

    @property
    def has_passed(self) -> bool:
        """Whether the end is reached."""
        return time.monotonic() >= self._end


class Presence:
    """Whether a server that was discovered still exists.

    Args:
        is_ready: Returns whether the client has a server.
        name: What it is, such as "service /reset".
    """

    def __init__(self, is_ready: Callable[[], bool], name: str) -> None:
        self._is_ready = is_ready
        self._name = name
        self._last_seen = time.monotonic()

    def check(self) -> None:
        """End the command if the server has been absent for too long."""
        if self._is_ready():
            self._last_seen = time.monotonic()
        elif time.monotonic() > self._last_seen + _MAX_ABSENCE:
            fail(f"The {one_line(self._name)} no longer exists: its node ended before it responded.")


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
            warn(f"There is no {one_line(name)} yet: waiting for it for at most {deadline.limit}. {hint()}".rstrip())


def await_response(node: Node, future: Any, name: str, deadline: Deadline, is_ready: Callable[[], bool]) -> Any:
    """Return the response of a server, and print once that there is none yet.

    End the command after the deadline, and if the server no longer exists.

    Args:
        node: Node of the command.
        future: The future of the response.
        name: Who responds, such as "service /reset".
        deadline: The end of the wait.
        is_ready: Returns whether the client has a server.
    """
    report_time = time.monotonic() + _RESPONSE_TIMEOUT
    presence = Presence(is_ready, name)
    while not is_complete(node, future, deadline):
        presence.check()
        if deadline.has_passed:
            fail(f"The {one_line(name)} did not respond within {deadline.limit}.", "Check that its node is spinning.")
        if time.monotonic() > report_time:
            report_time = float("inf")
            warn(
                f"The {one_line(name)} has not responded for {_RESPONSE_TIMEOUT:g} s. The command waits for at most "
                f"{deadline.limit}, which --timeout changes."
            )
    return future.result()


def is_complete(node: Node, future: Any, deadline: Deadline) -> bool:
    """Spin the node for a short time, and return whether the future is complete."""
    import rclpy  # noqa: PLC0415 - slow import

    if not future.done():
        rclpy.spin_until_future_complete(node, future, timeout_sec=deadline.remaining(_PERIOD))
    done: bool = future.done()
    return done


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
