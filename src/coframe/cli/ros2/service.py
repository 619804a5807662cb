# SPDX-License-Identifier: Apache-2.0
"""``coframe service``: the services of the ROS graph, with the same names and output as ``ros2 service``."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import click
from click.exceptions import Exit

from coframe._output.formatting import did_you_mean
from coframe.cli.declaration import CommandGroup, argument
from coframe.cli.options import NonNegativeDuration, PositiveDuration, topic_name
from coframe.cli.output import fail, one_line, printable
from coframe.cli.ros2.calls import (
    MAX_WAIT_FOR_RESPONSE,
    MAX_WAIT_FOR_SERVER,
    Deadline,
    await_response,
    timeout_option,
    wait_for_server,
)
from coframe.cli.ros2.events import echo_service
from coframe.cli.ros2.graph import (
    DISCOVERY_TIME,
    NO_WAIT,
    GraphCommand,
    graph_node,
    join_types,
    load_type,
    spin_time_option,
    wait_until,
)
from coframe.cli.ros2.hidden_names import is_hidden
from coframe.cli.ros2.qos import (
    QoSWords,
    depth_option,
    durability_option,
    history_option,
    profile_option,
    reliability_option,
)
from coframe.cli.ros2.values import read_values
from coframe.messages.message import complete_repr

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
@timeout_option
@profile_option
@depth_option
@history_option
@reliability_option
@durability_option
def call(
    service_name: str,
    service_type: str,
    values: str,
    rate: float | None,
    timeout: PositiveDuration | None,
    qos_profile: str | None,
    qos_depth: int | None,
    qos_history: str | None,
    qos_reliability: str | None,
    qos_durability: str | None,
) -> None:
    """Call a service and print its response.

    Example: coframe service call /reset std_srvs/srv/SetBool '{data: true}'
    """
    if rate is not None and rate <= 0:
        fail("rate must be greater than zero", code=2)
    with graph_node() as node:
        from rclpy.qos import qos_profile_services_default  # noqa: PLC0415 - help starts faster
        from rosidl_runtime_py.utilities import get_service  # noqa: PLC0415

        kind = load_type(_complete_type(service_type), get_service)
        request = kind.Request()
        fill_stamps = read_values(request, values)
        words = QoSWords(qos_profile, qos_depth, qos_history, qos_reliability, qos_durability)
        client = node.create_client(kind, service_name, qos_profile=words.to_profile(qos_profile_services_default))
        shown = f"service {service_name}"
        if not client.service_is_ready():
            print("waiting for service to become available...", flush=True)
            limit = Deadline(timeout or MAX_WAIT_FOR_SERVER)
            wait_for_server(
                client, client.wait_for_service, shown, limit, lambda: _similar_services_hint(node, service_name)
            )
        while True:
            fill_stamps(node.get_clock().now().to_msg())
            print(f"requester: making request: {complete_repr(request)}\n", flush=True)
            limit = Deadline(timeout or MAX_WAIT_FOR_RESPONSE)
            response = await_response(node, client.call_async(request), shown, limit, client.service_is_ready)
            print(f"response:\n{complete_repr(response)}\n", flush=True)
            if rate is None:
                return
            time.sleep(1.0 / rate)


service.add_command(echo_service)


@service.command(cls=GraphCommand, short_help="List the services of a type.")
@argument("service_type", metavar="TYPE", help="Type, e.g. std_srvs/srv/SetBool.")
@click.option("--count-services", "-c", "count", is_flag=True, help="Print only the number of services.")
@hidden_services_option
@spin_time_option(DISCOVERY_TIME)
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


@service.command(cls=GraphCommand, short_help="Show the type, clients and servers of a service.")
@service_argument
@click.option("--verbose", "-v", is_flag=True, help="Show the node, type, GIDs and QoS of each client and server.")
@spin_time_option(DISCOVERY_TIME)
def info(service_name: str, verbose: bool, spin_time: NonNegativeDuration) -> None:
    """Show the type of a service, and how many clients and servers it has.

    Example: coframe service info /reset --verbose
    """
    end = "\n\n" if verbose else "\n"
    with graph_node(spin_time) as node:
        types = wait_until(lambda: dict(node.get_service_names_and_types()).get(service_name))
        if not types:
            fail(f"Unknown service '{service_name}'", _similar_services_hint(node, service_name))
        print(f"Type: {one_line(types[0] if len(types) == 1 else str(types))}", end=end)
        print(f"Clients count: {node.count_clients(service_name)}", end=end)
        for endpoint in _endpoints(node, "get_clients_info_by_service", service_name) if verbose else ():
            print(printable(str(endpoint)), end=end)
        print(f"Services count: {node.count_services(service_name)}", end=end)
        for endpoint in _endpoints(node, "get_servers_info_by_service", service_name) if verbose else ():
            print(printable(str(endpoint)), end=end)


@service.command("list", cls=GraphCommand, short_help="List the services.")
@click.option("--show-types", "-t", is_flag=True, help="Also show the types.")
@click.option("--count-services", "-c", "count", is_flag=True, help="Print only the number of services.")
@hidden_services_option
@spin_time_option(DISCOVERY_TIME)
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
        print(one_line(f"{name} {join_types(types)}" if show_types else name))


@service.command("type", cls=GraphCommand, short_help="Print the type of a service.")
@service_argument
@spin_time_option(NO_WAIT)
def type_(service_name: str, spin_time: NonNegativeDuration) -> None:
    """Print the type of a service. The exit code is 1 if the service is unknown.

    Example: coframe service type /reset
    """
    with graph_node(spin_time) as node:
        types = wait_until(lambda: dict(node.get_service_names_and_types()).get(service_name))
    if not types:
        raise Exit(1)
    print("\n".join(map(one_line, types)))


def _services(node: Node, *, include_hidden: bool) -> list[tuple[str, list[str]]]:
    return [each for each in sorted(node.get_service_names_and_types()) if include_hidden or not is_hidden(each[0])]


def _complete_type(name: str) -> str:
    """Return the full name of a service type; as in ros2, "std_srvs/Empty" is "std_srvs/srv/Empty"."""
    package, _, last = name.partition("/")
    return f"{package}/srv/{last}" if last and "/" not in last else name


def _similar_services_hint(node: Node, name: str) -> str:
    """Return similar names of services in the graph, or how to list all."""
    # The client of this command has the same name.
    names = (each for each, _ in _services(node, include_hidden=False) if each != name)
    return did_you_mean(name, names, limit=2) or "coframe service list shows all services."


def _endpoints(node: Node, query: str, name: str) -> list[Any]:
    """Return the clients or servers of a service. The rclpy of a ROS before Lyrical has no such query."""
    function = getattr(node, query, None)
    if function is None:
        fail("The rclpy of this ROS does not show the clients and servers of a service.", "Omit --verbose.")
    return list(function(name))
