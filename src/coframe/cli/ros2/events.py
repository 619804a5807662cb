# SPDX-License-Identifier: Apache-2.0
"""``coframe service echo`` and ``coframe action echo``: the introspection events of services and actions, as YAML."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import click

from coframe.cli.declaration import argument
from coframe.cli.options import NonNegativeDuration, topic_name
from coframe.cli.output import fail, print_bounded, printable, warn
from coframe.cli.ros2.graph import (
    NO_WAIT,
    GraphCommand,
    graph_node,
    load_type,
    sim_time_option,
    spin_time_option,
    wait_until,
)
from coframe.cli.ros2.messages import MessageStream
from coframe.cli.ros2.text_format import text_options

if TYPE_CHECKING:
    from coframe.cli.ros2.text_format import TextFormat
    from rclpy.node import Node

__all__ = ["echo_action", "echo_service"]

_SERVICE_EVENT = "_service_event"
_EVENT_TYPES = {0: "REQUEST_SENT", 1: "REQUEST_RECEIVED", 2: "RESPONSE_SENT", 3: "RESPONSE_RECEIVED"}
_ENABLE_HINT = "Its node enables them: configure_introspection(clock, qos, ServiceIntrospectionState.CONTENTS)."


@click.command("echo", cls=GraphCommand, short_help="Print the requests and responses of a service.")
@argument("service_name", metavar="SERVICE", type=topic_name, help="Name of the service, e.g. /reset.")
@argument("service_type", metavar="[TYPE]", required=False, help="Type, e.g. std_srvs/srv/SetBool.")
@text_options
@sim_time_option
@spin_time_option(NO_WAIT)
def echo_service(
    service_name: str,
    service_type: str | None,
    text_format: TextFormat,
    use_sim_time: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """Print the requests and responses of a service whose client or server has introspection enabled.

    Example: coframe service echo /reset
    """
    with graph_node(spin_time, use_sim_time=use_sim_time) as node:
        from rosidl_runtime_py.utilities import get_service  # noqa: PLC0415 - slow import

        kind = service_type or _type(node.get_service_names_and_types, service_name, "service")
        event = _event_class(load_type(kind, get_service), kind)
        stream = MessageStream(node, f"{service_name}/{_SERVICE_EVENT}", event, _event_qos())
        _warn_if_not_published(node, [f"{service_name}/{_SERVICE_EVENT}"], f"service {service_name}")
        for message in stream.messages():
            print_bounded(_text(message, text_format))


@click.command("echo", cls=GraphCommand, short_help="Print the goals, feedback, status and results of an action.")
@argument("action_name", metavar="ACTION", type=topic_name, help="Name of the action, e.g. /fibonacci.")
@argument("action_type", metavar="[TYPE]", required=False, help="Type, e.g. example_interfaces/action/Fibonacci.")
@text_options
@sim_time_option
@spin_time_option(NO_WAIT)
def echo_action(
    action_name: str,
    action_type: str | None,
    text_format: TextFormat,
    use_sim_time: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """Print the feedback and status of an action, and its requests if introspection is enabled.

    Example: coframe action echo /fibonacci
    """
    with graph_node(spin_time, use_sim_time=use_sim_time) as node:
        from rclpy.action import get_action_names_and_types  # noqa: PLC0415 - slow import
        from rosidl_runtime_py.utilities import get_action  # noqa: PLC0415

        kind = action_type or _type(lambda: get_action_names_and_types(node), action_name, "action")
        stream = MessageStream(node)
        for interface, topic, message_class, qos in _interfaces(action_name, load_type(kind, get_action)):
            stream.subscribe(topic, message_class, qos, label=interface)
        for interface, message in stream.labeled_messages():
            text = _text(message, text_format)
            print_bounded(f"{interface},{text}" if text_format.csv else f"interface: {interface}\n{text}")


def _type(names_and_types: Any, name: str, what: str) -> str:
    """Return the type of a service or an action in the graph, or end the command if it is unknown or not unique."""
    found = wait_until(lambda: dict(names_and_types()).get(name))
    if not found:
        fail(f"Could not determine the type for the passed {what}", f"coframe {what} list shows all {what}s.")
    if len(found) > 1:
        fail(f"Cannot echo {what} '{name}', as it contains more than one type: [{', '.join(found)}]")
    kind: str = found[0]
    return kind


def _event_class(service_class: Any, kind: str) -> Any:
    event = getattr(service_class, "Event", None)
    if event is None:
        fail(f"{kind} has no event messages: the ROS distribution in use has no service introspection.")
    return event


def _event_qos() -> Any:
    from rclpy.qos import qos_profile_services_default  # noqa: PLC0415 - slow import

    return qos_profile_services_default


def _interfaces(name: str, action_class: Any) -> list[tuple[str, str, Any, Any]]:
    """Return the name, topic, message class and QoS of everything an action publishes."""
    from action_msgs.msg import GoalStatusArray  # noqa: PLC0415 - slow import
    from action_msgs.srv import CancelGoal  # noqa: PLC0415
    from rclpy.qos import qos_profile_action_status_default  # noqa: PLC0415

    implementation = action_class.Impl
    found: list[tuple[str, str, Any, Any]] = [
        ("FEEDBACK_TOPIC", f"{name}/_action/feedback", implementation.FeedbackMessage, 10),
        ("STATUS_TOPIC", f"{name}/_action/status", GoalStatusArray, qos_profile_action_status_default),
    ]
    for interface, service, service_class in (
        ("GOAL_SERVICE", "send_goal", implementation.SendGoalService),
        ("CANCEL_SERVICE", "cancel_goal", CancelGoal),
        ("RESULT_SERVICE", "get_result", implementation.GetResultService),
    ):
        event = getattr(service_class, "Event", None)
        if event is not None:
            found.append((interface, f"{name}/_action/{service}/{_SERVICE_EVENT}", event, _event_qos()))
    return found


def _warn_if_not_published(node: Node, topics: list[str], what: str) -> None:
    """Print a warning if no events are published."""
    if not wait_until(lambda: any(node.count_publishers(topic) for topic in topics)):
        warn(f"The {what} publishes no events yet: waiting for them. {_ENABLE_HINT}")


def _text(message: Any, text_format: TextFormat) -> str:
    """Return a message as ros2 prints it: YAML with names instead of numbers of event types."""
    from rosidl_runtime_py import message_to_csv  # noqa: PLC0415 - slow import
    from rosidl_runtime_py.convert import message_to_ordereddict  # noqa: PLC0415

    if text_format.csv:
        return printable(message_to_csv(message, **text_format.limits).replace("\n", r"\n"))
    values = _to_plain_data(message_to_ordereddict(message, **text_format.limits))
    info = values.get("info")
    if isinstance(info, dict) and "event_type" in info:
        info["event_type"] = _EVENT_TYPES.get(info["event_type"], info["event_type"])
    import yaml  # noqa: PLC0415 - an optional package

    text = yaml.safe_dump(
        values, allow_unicode=True, width=sys.maxsize, default_flow_style=text_format.flow_style, sort_keys=False
    )
    return printable(f"{text}---")


def _to_plain_data(value: Any) -> Any:
    """Return ordered dictionaries as plain ones, including inside lists."""
    if isinstance(value, dict):
        return {name: _to_plain_data(each) for name, each in value.items()}
    return [_to_plain_data(each) for each in value] if isinstance(value, list | tuple) else value
