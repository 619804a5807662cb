# SPDX-License-Identifier: Apache-2.0
"""``coframe action``: the actions of the ROS graph, with the same names and output as ``ros2 action``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click
from click.exceptions import Exit

from coframe._output.formatting import did_you_mean
from coframe.cli.declaration import CommandGroup, argument
from coframe.cli.options import NonNegativeDuration, PositiveDuration, topic_name
from coframe.cli.output import fail, one_line, print_bounded, printable
from coframe.cli.ros2.calls import (
    MAX_WAIT_FOR_RESPONSE,
    MAX_WAIT_FOR_SERVER,
    Deadline,
    Presence,
    await_response,
    is_complete,
    timeout_option,
    wait_for_server,
)
from coframe.cli.ros2.events import echo_action
from coframe.cli.ros2.graph import (
    DISCOVERY_TIME,
    NO_WAIT,
    GraphCommand,
    graph_node,
    join_types,
    load_type,
    node_names,
    spin_time_option,
    split_node_name,
    wait_until,
)
from coframe.cli.ros2.values import read_values

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node

__all__ = ["action"]

action_argument = argument(
    "action_name", metavar="ACTION", type=topic_name, help="Name of the action, e.g. /fibonacci."
)
action = CommandGroup(
    "action",
    help="List actions and send goals, like ros2 action.\n\n"
    "Example: coframe action send_goal /fibonacci example_interfaces/action/Fibonacci '{order: 5}'",
)


action.add_command(echo_action)


@action.command(cls=GraphCommand, short_help="List the actions of a type.")
@argument("action_type", metavar="TYPE", help="Type, e.g. example_interfaces/action/Fibonacci.")
@click.option("--count-actions", "-c", "count", is_flag=True, help="Print only the number of actions.")
@spin_time_option(DISCOVERY_TIME)
def find(action_type: str, count: bool, spin_time: NonNegativeDuration) -> None:
    """List the actions of a type.

    Example: coframe action find example_interfaces/action/Fibonacci
    """
    with graph_node(spin_time) as node:
        names = [name for name, types in _actions(node) if action_type in types]
    print(len(names) if count else "\n".join(map(one_line, names)))


@action.command(cls=GraphCommand, short_help="Show the clients and servers of an action.")
@action_argument
@click.option("--show-types", "-t", is_flag=True, help="Also show the types.")
@click.option("--count", "-c", is_flag=True, help="Print only how many clients and servers there are.")
@spin_time_option(DISCOVERY_TIME)
def info(
    action_name: str,
    show_types: bool,
    count: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """Show the nodes that have clients or servers of an action.

    Example: coframe action info /fibonacci
    """
    from rclpy.action import (  # noqa: PLC0415 - slow import
        get_action_client_names_and_types_by_node,
        get_action_server_names_and_types_by_node,
    )

    with graph_node(spin_time) as node:
        print(f"Action: {one_line(action_name)}")
        for title, query in (
            ("Action clients", get_action_client_names_and_types_by_node),
            ("Action servers", get_action_server_names_and_types_by_node),
        ):
            found = _find_nodes(node, action_name, query)
            print(f"{title}: {len(found)}")
            for name, types in () if count else found:
                print(one_line(f"    {name} {join_types(types)}" if show_types else f"    {name}"))


@action.command("list", cls=GraphCommand, short_help="List the actions.")
@click.option("--show-types", "-t", is_flag=True, help="Also show the types.")
@click.option("--count-actions", "-c", "count", is_flag=True, help="Print only the number of actions.")
@spin_time_option(DISCOVERY_TIME)
def list_actions(
    show_types: bool,
    count: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """List the actions of the ROS graph.

    Example: coframe action list -t
    """
    with graph_node(spin_time) as node:
        actions = _actions(node)
    if count:
        print(len(actions))
        return
    for name, types in actions:
        print(one_line(f"{name} {join_types(types)}" if show_types else name))


@action.command("send_goal", short_help="Send a goal to an action server.")
@action_argument
@argument("action_type", metavar="TYPE", help="Type, e.g. example_interfaces/action/Fibonacci.")
@argument("goal", metavar="GOAL", help="Values of the goal as YAML, e.g. '{order: 5}'.")
@click.option("--feedback", "-f", is_flag=True, help="Print the feedback.")
@timeout_option
def send_goal(
    action_name: str,
    action_type: str,
    goal: str,
    feedback: bool,
    timeout: PositiveDuration | None,
) -> None:
    """Send a goal and print its result. Ctrl-C cancels the goal.

    Example: coframe action send_goal /fibonacci example_interfaces/action/Fibonacci '{order: 5}' --feedback
    """
    with graph_node() as node:
        from rclpy.action import ActionClient  # noqa: PLC0415 - slow import
        from rosidl_runtime_py.utilities import get_action  # noqa: PLC0415

        kind = load_type(action_type, get_action)
        message = kind.Goal()
        read_values(message, goal)(node.get_clock().now().to_msg())
        client = ActionClient(node, kind, action_name)
        try:
            print("Waiting for an action server to become available...", flush=True)
            limit = Deadline(timeout or MAX_WAIT_FOR_SERVER)
            shown = f"action server {action_name}"
            wait_for_server(
                client, client.wait_for_server, shown, limit, lambda: _similar_names_hint(node, action_name)
            )
            if timeout is None:
                limit = Deadline(MAX_WAIT_FOR_RESPONSE)
            _follow_goal(node, client, message, shown, limit, prints_feedback=feedback, is_idle_limit=timeout is None)
        finally:
            client.destroy()


class _Feedback:
    """Prints the feedback of a goal, that which arrives before the acceptance of the goal after it.

    Args:
        is_printed: Whether to print it.
        deadline: The end of the wait that each feedback extends, or None.
    """

    def __init__(self, *, is_printed: bool, deadline: Deadline | None) -> None:
        self._is_printed = is_printed
        self._deadline = deadline
        self._waiting_statuses: list[Any] | None = []  # None after the acceptance

    def receive(self, message: Any) -> None:
        """Extend the wait, and print the feedback of a message."""
        if self._deadline is not None:
            self._deadline.extend()
        if self._waiting_statuses is not None:
            self._waiting_statuses.append(message)
        elif self._is_printed:
            _print_indented("Feedback", message.feedback)

    def start(self) -> None:
        """Print the feedback that has arrived; the goal is accepted."""
        waiting, self._waiting_statuses = self._waiting_statuses or [], None
        for message in waiting:
            self.receive(message)


def _follow_goal(
    node: Node, client: Any, goal: Any, shown: str, deadline: Deadline, *, prints_feedback: bool, is_idle_limit: bool
) -> None:
    """Send the goal, and print its progress until it is finished; cancel it after the deadline.

    With `is_idle_limit`, each feedback extends the deadline.
    """
    feedback = _Feedback(is_printed=prints_feedback, deadline=deadline if is_idle_limit else None)
    _print_indented("Sending goal", goal)
    sent = client.send_goal_async(goal, feedback.receive)
    handle = await_response(node, sent, shown, deadline, client.server_is_ready)
    if not handle.accepted:
        fail("Goal was rejected.")
    print(f"Goal accepted with ID: {bytes(handle.goal_id.uuid).hex()}\n", flush=True)
    feedback.start()
    try:
        response = _await_result(node, handle.get_result_async(), deadline, Presence(client.server_is_ready, shown))
    except KeyboardInterrupt:
        _cancel(node, handle)
        raise
    if response is None:
        _cancel(node, handle)
        if is_idle_limit:
            hint = "Set --timeout to a longer time if the goal takes longer."
            fail(f"The {shown} sent no feedback and no result for {deadline.limit}.", hint)
        fail(f"The goal was not finished within {deadline.limit}.")
    _print_indented("Result", response.result)
    print(f"Goal finished with status: {_status_name(response.status)}")


def _await_result(node: Node, result: Any, deadline: Deadline, server: Presence) -> Any:
    """Return the result of a goal, which may take long, or None after the deadline."""
    while not is_complete(node, result, deadline):
        if deadline.has_passed:
            return None
        server.check()
    return result.result()


@action.command("type", cls=GraphCommand, short_help="Print the type of an action.")
@action_argument
@spin_time_option(NO_WAIT)
def type_(action_name: str, spin_time: NonNegativeDuration) -> None:
    """Print the type of an action. The exit code is 1 if the action is unknown.

    Example: coframe action type /fibonacci
    """
    with graph_node(spin_time) as node:
        types = wait_until(lambda: dict(_actions(node)).get(action_name))
    if not types:
        raise Exit(1)
    print("\n".join(map(one_line, types)))


def _actions(node: Node) -> list[tuple[str, list[str]]]:
    from rclpy.action import get_action_names_and_types  # noqa: PLC0415 - slow import

    return sorted(get_action_names_and_types(node))


def _similar_names_hint(node: Node, name: str) -> str:
    """Return similar names of actions in the graph, or how to list all."""
    names = (each for each, _ in _actions(node) if each != name)  # The client of this command has it.
    return did_you_mean(name, names, limit=2) or "coframe action list shows all actions."


def _cancel(node: Node, handle: Any) -> None:
    import rclpy  # noqa: PLC0415 - slow import

    print("Canceling goal...", flush=True)
    canceled = handle.cancel_goal_async()
    rclpy.spin_until_future_complete(node, canceled, timeout_sec=3.0)
    response = canceled.result() if canceled.done() else None
    print("Goal canceled." if response and response.goals_canceling else "Failed to cancel goal")


def _print_indented(title: str, message: Any) -> None:
    from rosidl_runtime_py import message_to_yaml  # noqa: PLC0415 - slow import

    text = "\n".join(f"    {line}" for line in message_to_yaml(message).splitlines())
    print_bounded(f"{title}:\n{printable(text)}\n")


def _status_name(status: int) -> str:
    from action_msgs.msg import GoalStatus  # noqa: PLC0415 - slow import

    names = {getattr(GoalStatus, name): name for name in dir(GoalStatus) if name.startswith("STATUS_")}
    return names.get(status, f"unknown ({status})").removeprefix("STATUS_")


def _find_nodes(
    node: Node, action_name: str, query: Callable[[Node, str, str], list[tuple[str, list[str]]]]
) -> list[tuple[str, list[str]]]:
    """Return the nodes that have the action, with its types."""
    found = []
    for full_name in node_names(node, include_hidden=True):
        namespace, name = split_node_name(full_name)
        types = dict(query(node, name, namespace)).get(action_name)
        if types:
            found.append((full_name, types))
    return found
