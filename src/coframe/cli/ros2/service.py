# SPDX-License-Identifier: Apache-2.0
"""``coframe service``: the services of the ROS graph, with the words and the output of ``ros2 service``."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Annotated

import typer

from coframe.cli.help_format import PlainCommand, PlainGroup
from coframe.cli.options import with_leading_slash
from coframe.cli.output import fail, one_line
from coframe.cli.ros2.calls import wait_for_server
from coframe.cli.ros2.graph import (
    AT_ONCE,
    DISCOVERY,
    GraphCommand,
    SpinTimeOption,
    graph_node,
    is_hidden,
    joined,
    load_type,
    wait_until,
)
from coframe.cli.ros2.values import read_values

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ["service"]

HiddenServicesOption = Annotated[
    bool, typer.Option("--include-hidden-services", help="Consider hidden services as well.")
]
ServiceArgument = Annotated[
    str, typer.Argument(metavar="SERVICE", help="Name of the service, e.g. /reset.", callback=with_leading_slash)
]
service = typer.Typer(
    cls=PlainGroup,
    help="List and call services, like ros2 service.\n\n"
    "Example: coframe service call /reset std_srvs/srv/SetBool '{data: true}'",
    no_args_is_help=True,
    rich_markup_mode=None,
)


@service.command(cls=PlainCommand, short_help="Call a service.")
def call(
    service_name: ServiceArgument,
    service_type: Annotated[str, typer.Argument(metavar="TYPE", help="Type, e.g. std_srvs/srv/SetBool.")],
    values: Annotated[
        str, typer.Argument(metavar="[VALUES]", help="Values of the request as YAML, e.g. '{data: true}'.")
    ] = "{}",
    rate: Annotated[
        float | None, typer.Option("--rate", "-r", metavar="HZ", help="Repeat the call at this rate.")
    ] = None,
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
def find(
    service_type: Annotated[str, typer.Argument(metavar="TYPE", help="Type, e.g. std_srvs/srv/SetBool.")],
    count: Annotated[bool, typer.Option("--count-services", "-c", help="Print the number of services only.")] = False,
    include_hidden: HiddenServicesOption = False,
    spin_time: SpinTimeOption = DISCOVERY,
) -> None:
    """List the services that have a type.

    Example: coframe service find std_srvs/srv/SetBool
    """
    with graph_node(spin_time) as node:
        names = [name for name, types in _services(node, include_hidden=include_hidden) if service_type in types]
    print(len(names) if count else "\n".join(map(one_line, names)))


@service.command("list", cls=GraphCommand, short_help="List the services.")
def list_services(
    show_types: Annotated[bool, typer.Option("--show-types", "-t", help="Show the types as well.")] = False,
    count: Annotated[bool, typer.Option("--count-services", "-c", help="Print the number of services only.")] = False,
    include_hidden: HiddenServicesOption = False,
    spin_time: SpinTimeOption = DISCOVERY,
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
def type_(service_name: ServiceArgument, spin_time: SpinTimeOption = AT_ONCE) -> None:
    """Print the type of a service; the exit code is 1 if the service is unknown.

    Example: coframe service type /reset
    """
    with graph_node(spin_time) as node:
        types = wait_until(lambda: dict(node.get_service_names_and_types()).get(service_name))
    if not types:
        raise typer.Exit(1)
    print("\n".join(map(one_line, types)))


def _services(node: Node, *, include_hidden: bool) -> list[tuple[str, list[str]]]:
    return [each for each in sorted(node.get_service_names_and_types()) if include_hidden or not is_hidden(each[0])]
