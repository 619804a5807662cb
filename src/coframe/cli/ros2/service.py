# SPDX-License-Identifier: Apache-2.0
"""``coframe service``: the services of the ROS graph, with the same names and output as ``ros2 service``."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import click
from click.exceptions import Exit

from coframe.cli.declaration import CommandGroup, argument
from coframe.cli.options import NonNegativeDuration, topic_name
from coframe.cli.output import fail, one_line
from coframe.cli.ros2.calls import wait_for_server
from coframe.cli.ros2.graph import (
    AT_ONCE,
    DISCOVERY,
    GraphCommand,
    graph_node,
    joined,
    load_type,
    spin_time_option,
    wait_until,
)
from coframe.cli.ros2.hidden_names import is_hidden
from coframe.cli.ros2.values import read_values

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ["service"]

hidden_services_option = click.option(
    "--include-hidden-services", "include_hidden", is_flag=True, help="Include hidden services."
)
service_argument = argument(
    "service_name", metavar="SERVICE", type=topic_name, help="Name of the service, e.g. /reset."
)
service = CommandGroup(
    "service",
    help="List and call services, like ros2 service.\n\n"
    "Example: coframe service call /reset std_srvs/srv/SetBool '{data: true}'",
)


@service.command(short_help="Call a service.")
@service_argument
@argument("service_type", metavar="TYPE", help="Type, e.g. std_srvs/srv/SetBool.")
@argument("values", metavar="[VALUES]", default="{}", help="Values of the request as YAML, e.g. '{data: true}'.")
@click.option("--rate", "-r", metavar="HZ", type=float, help="Repeat the call at this rate.")
def call(
    service_name: str,
    service_type: str,
    values: str,
    rate: float | None,
) -> None:
    """Call a service and print its response.

    Example: coframe service call /reset std_srvs/srv/SetBool '{data: true}'
    """
    if rate is not None and rate <= 0:
        fail("rate must be greater than zero", code=2)
    with graph_node() as node:
        import rclpy  # noqa: PLC0415 - help starts faster
        from rosidl_runtime_py.utilities import get_service  # noqa: PLC0415

        kind = load_type(service_type, get_service)
        request = kind.Request()
        fill_stamps = read_values(request, values)
        client = node.create_client(kind, service_name)
        if not client.service_is_ready():
            print("waiting for service to become available...", flush=True)
            wait_for_server(client, client.wait_for_service)
        while True:
            fill_stamps(node.get_clock().now().to_msg())
            print(f"requester: making request: {request!r}\n", flush=True)
            future = client.call_async(request)
            rclpy.spin_until_future_complete(node, future)
            print(f"response:\n{future.result()!r}\n", flush=True)
            if rate is None:
                return
            time.sleep(1.0 / rate)


@service.command(cls=GraphCommand, short_help="List the services of a type.")
@argument("service_type", metavar="TYPE", help="Type, e.g. std_srvs/srv/SetBool.")
@click.option("--count-services", "-c", "count", is_flag=True, help="Print only the number of services.")
@hidden_services_option
@spin_time_option(DISCOVERY)
def find(
    service_type: str,
    count: bool,
    include_hidden: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """List the services of a type.

    Example: coframe service find std_srvs/srv/SetBool
    """
    with graph_node(spin_time) as node:
        names = [name for name, types in _services(node, include_hidden=include_hidden) if service_type in types]
    print(len(names) if count else "\n".join(map(one_line, names)))


@service.command("list", cls=GraphCommand, short_help="List the services.")
@click.option("--show-types", "-t", is_flag=True, help="Also show the types.")
@click.option("--count-services", "-c", "count", is_flag=True, help="Print only the number of services.")
@hidden_services_option
@spin_time_option(DISCOVERY)
def list_services(
    show_types: bool,
    count: bool,
    include_hidden: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """List the services of the ROS graph.

    Example: coframe service list -t
    """
    with graph_node(spin_time) as node:
        services = _services(node, include_hidden=include_hidden)
    if count:
        print(len(services))
        return
    for name, types in services:
        print(one_line(f"{name} {joined(types)}" if show_types else name))


@service.command("type", cls=GraphCommand, short_help="Print the type of a service.")
@service_argument
@spin_time_option(AT_ONCE)
def type_(service_name: str, spin_time: NonNegativeDuration) -> None:
    """Print the type of a service; the exit code is 1 if the service is unknown.

    Example: coframe service type /reset
    """
    with graph_node(spin_time) as node:
        types = wait_until(lambda: dict(node.get_service_names_and_types()).get(service_name))
    if not types:
        raise Exit(1)
    print("\n".join(map(one_line, types)))


def _services(node: Node, *, include_hidden: bool) -> list[tuple[str, list[str]]]:
    return [each for each in sorted(node.get_service_names_and_types()) if include_hidden or not is_hidden(each[0])]
