# SPDX-License-Identifier: Apache-2.0
"""``coframe lifecycle``: the states of lifecycle nodes, with the same names and output as ``ros2 lifecycle``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from coframe.cli.declaration import CommandGroup, argument
from coframe.cli.output import fail, one_line
from coframe.cli.ros2.calls import call_service, response_timeout_option
from coframe.cli.ros2.graph import (
    DISCOVERY_TIME,
    NO_WAIT,
    GraphCommand,
    all_option,
    graph_node,
    node_argument,
    node_names,
    spin_time_option,
    wait_until,
)

if TYPE_CHECKING:
    from coframe.cli.options import NonNegativeDuration, PositiveDuration
    from rclpy.node import Node

__all__ = ["lifecycle"]

_GET_STATE = "lifecycle_msgs/srv/GetState"
lifecycle = CommandGroup(
    "lifecycle",
    help="Show and change the states of lifecycle nodes, like ros2 lifecycle.\n\n"
    "Example: coframe lifecycle set /lidar configure",
)


@lifecycle.command(cls=GraphCommand, short_help="Print the states of lifecycle nodes.")
@argument("node_name", metavar="[NODE]", required=False, help="Name of a node. [default: all lifecycle nodes]")
@all_option
@response_timeout_option
@spin_time_option(DISCOVERY_TIME)
def get(
    node_name: str | None,
    include_hidden: bool,
    timeout: PositiveDuration,
    spin_time: NonNegativeDuration,
) -> None:
    """Print the state of a lifecycle node, or of all lifecycle nodes.

    Example: coframe lifecycle get /lidar
    """
    with graph_node(NO_WAIT if node_name else spin_time) as node:
        names = (
            [_check_node_exists(node, node_name)]
            if node_name
            else _lifecycle_nodes(node, include_hidden=include_hidden)
        )
        for name in names:
            state = _call(node, name, timeout, "GetState", "get_state").current_state
            print(one_line(f"{'' if node_name else f'{name}: '}{state.label} [{state.id}]"))


@lifecycle.command("list", cls=GraphCommand, short_help="List the available transitions of a node.")
@node_argument
@click.option("--all", "-a", "show_all", is_flag=True, help="List all transitions of the node.")
@response_timeout_option
@spin_time_option(NO_WAIT)
def list_transitions(
    node_name: str,
    show_all: bool,
    timeout: PositiveDuration,
    spin_time: NonNegativeDuration,
) -> None:
    """List the available transitions of a lifecycle node in its current state.

    Example: coframe lifecycle list /lidar
    """
    service = ("GetAvailableTransitions", "get_transition_graph" if show_all else "get_available_transitions")
    with graph_node(spin_time) as node:
        for each in _call(node, _check_node_exists(node, node_name), timeout, *service).available_transitions:
            print(one_line(f"- {each.transition.label} [{each.transition.id}]"))
            print(f"\tStart: {one_line(each.start_state.label)}\n\tGoal: {one_line(each.goal_state.label)}")


@lifecycle.command(cls=GraphCommand, short_help="List the lifecycle nodes.")
@all_option
@click.option("--count-nodes", "-c", "count", is_flag=True, help="Print only the number of nodes.")
@spin_time_option(DISCOVERY_TIME)
def nodes(
    include_hidden: bool,
    count: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """List the lifecycle nodes of the ROS graph.

    Example: coframe lifecycle nodes
    """
    with graph_node(spin_time) as node:
        names = _lifecycle_nodes(node, include_hidden=include_hidden)
    print(len(names) if count else "\n".join(map(one_line, names)))


@lifecycle.command("set", cls=GraphCommand, short_help="Change the state of a lifecycle node.")
@node_argument
@argument("transition", metavar="TRANSITION", help="Name or ID of a transition, e.g. configure or activate.")
@response_timeout_option
@spin_time_option(NO_WAIT)
def set_state(
    node_name: str,
    transition: str,
    timeout: PositiveDuration,
    spin_time: NonNegativeDuration,
) -> None:
    """Change the state of a lifecycle node.

    Example: coframe lifecycle set /lidar configure
    """
    with graph_node(spin_time) as node:
        name = _check_node_exists(node, node_name)
        available = [
            each.transition
            for each in _call(
                node, name, timeout, "GetAvailableTransitions", "get_available_transitions"
            ).available_transitions
        ]
        chosen = next((each for each in available if transition in {each.label, str(each.id)}), None)
        if chosen is None:
            labels = "\n".join(f"- {one_line(each.label)} [{each.id}]" for each in available)
            fail("Unknown transition requested, available ones are:", details=labels)
        if not _call(node, name, timeout, "ChangeState", "change_state", transition=chosen).success:
            fail("Transitioning failed")
    print("Transitioning successful")


def _lifecycle_nodes(node: Node, *, include_hidden: bool) -> list[str]:
    """Return the names of all nodes with the service get_state of lifecycle nodes."""
    services = dict(node.get_service_names_and_types())
    names = node_names(node, include_hidden=include_hidden)
    return [name for name in names if _GET_STATE in services.get(f"{name}/get_state", [])]


def _check_node_exists(node: Node, name: str) -> str:
    name = name if name.startswith("/") else f"/{name}"
    if not wait_until(lambda: name in node_names(node, include_hidden=True)):
        fail(f"Node not found: {name}", "coframe lifecycle nodes shows all lifecycle nodes.")
    if not wait_until(lambda: name in _lifecycle_nodes(node, include_hidden=True)):
        fail(f"Node {name} is not a lifecycle node.", "coframe lifecycle nodes shows all lifecycle nodes.")
    return name


def _call(node: Node, target: str, timeout: PositiveDuration, kind: str, service: str, **fields: Any) -> Any:
    from lifecycle_msgs import srv  # noqa: PLC0415 - slow import

    service_class = getattr(srv, kind)
    return call_service(node, service_class, f"{target}/{service}", service_class.Request(**fields), timeout=timeout)
