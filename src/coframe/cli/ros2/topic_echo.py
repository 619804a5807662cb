# SPDX-License-Identifier: Apache-2.0
"""``coframe topic echo``: prints the messages of a topic as YAML or CSV, like ``ros2 topic echo``."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Annotated, Any

import typer

from coframe.cli.options import NonNegativeDuration
from coframe.cli.output import fail, print_bounded, printable
from coframe.cli.ros2.graph import (
    AT_ONCE,
    HiddenTopicsOption,
    SimTimeOption,
    SpinTimeOption,
    TopicArgument,
    graph_node,
    load_type,
    topic_type,
    wait_until,
)
from coframe.cli.ros2.messages import MessageStream, field_of, message_filter
from coframe.cli.ros2.qos import (
    DepthOption,
    DurabilityOption,
    HistoryOption,
    ProfileOption,
    QoSWords,
    ReliabilityOption,
)

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["echo"]

_TRUNCATE_LENGTH = 128  # ros2cli's default: elements of an array, characters of a text


def echo(
    topic_name: TopicArgument,
    message_type: Annotated[
        str | None, typer.Argument(metavar="[TYPE]", help="Type, e.g. std_msgs/msg/String. [default: the topic's]")
    ] = None,
    field: Annotated[
        str | None, typer.Option("--field", metavar="FIELD", help="Print only this field, e.g. pose.position.x.")
    ] = None,
    once: Annotated[bool, typer.Option("--once", help="Print the first message and exit.")] = False,
    timeout: Annotated[
        NonNegativeDuration | None,
        typer.Option(
            "--timeout",
            metavar="DURATION",
            parser=NonNegativeDuration,
            help="Exit with 1 if no message arrives in time.",
        ),
    ] = None,
    csv: Annotated[
        bool, typer.Option("--csv", help="Print each message as one line of comma-separated values.")
    ] = False,
    full_length: Annotated[
        bool, typer.Option("--full-length", "-f", help="Print all elements of arrays and all characters of texts.")
    ] = False,
    truncate_length: Annotated[
        int,
        typer.Option("--truncate-length", "-l", metavar="N", min=1, help="Print N elements of arrays and texts."),
    ] = _TRUNCATE_LENGTH,
    no_arr: Annotated[
        bool, typer.Option("--no-arr", help="Print the types of arrays instead of their elements.")
    ] = False,
    no_str: Annotated[bool, typer.Option("--no-str", help="Print the lengths of texts instead of the texts.")] = False,
    flow_style: Annotated[bool, typer.Option("--flow-style", help="Print collections on one line.")] = False,
    raw: Annotated[bool, typer.Option("--raw", help="Print the serialized bytes.")] = False,
    filter_expression: Annotated[
        str | None,
        typer.Option("--filter", metavar="EXPR", help="Print messages m for which this Python expression is true."),
    ] = None,
    lost_messages: Annotated[
        bool,
        typer.Option(
            "--lost-messages", help="Accepted for compatibility: lost messages are always reported.", hidden=True
        ),
    ] = False,
    no_lost_messages: Annotated[bool, typer.Option("--no-lost-messages", help="Do not report lost messages.")] = False,
    qos_profile: ProfileOption = None,
    qos_depth: DepthOption = None,
    qos_history: HistoryOption = None,
    qos_reliability: ReliabilityOption = None,
    qos_durability: DurabilityOption = None,
    include_hidden: HiddenTopicsOption = False,
    use_sim_time: SimTimeOption = False,
    spin_time: SpinTimeOption = AT_ONCE,
) -> None:
    """Print the messages of a topic. The QoS is chosen so that every publisher matches, unless it is given.

    Example: coframe topic echo /scan --once --field header
    """
    del lost_messages
    length = None if full_length else truncate_length
    write = _writer(field, csv=csv, length=length, no_arr=no_arr, no_str=no_str, flow_style=flow_style, raw=raw)
    accepts = message_filter(filter_expression)
    words = QoSWords(qos_profile, qos_depth, qos_history, qos_reliability, qos_durability)
    with graph_node(spin_time, use_sim_time=use_sim_time) as node:
        kind = message_type or topic_type(node, topic_name, include_hidden=include_hidden)
        from rosidl_runtime_py.utilities import get_message  # noqa: PLC0415 - slow import

        wait_until(lambda: node.get_publishers_info_by_topic(topic_name))
        stream = MessageStream(
            node,
            topic_name,
            load_type(kind, get_message),
            words.for_subscription(node, topic_name),
            raw=raw,
            report_lost=not no_lost_messages,
        )
        for message in stream.messages(None if timeout is None else timeout.seconds):
            if raw or accepts(message):
                print_bounded(write(message))
                if once:
                    return
        fail(f"No message arrived on {topic_name} within {timeout}.", "coframe topic info shows its publishers.")


def _writer(
    field: str | None, *, csv: bool, length: int | None, no_arr: bool, no_str: bool, flow_style: bool, raw: bool
) -> Callable[[Any], str]:
    """Return the function that formats a message, or one of its fields."""
    if raw:
        return lambda data: f"{data}\n---"
    from rosidl_runtime_py import message_to_csv, message_to_yaml  # noqa: PLC0415 - slow import

    def has_fields(value: Any) -> bool:
        return hasattr(value, "get_fields_and_field_types")

    def write(message: Any) -> str:
        value = message if field is None else field_of(message, field)
        if csv:
            to_csv = functools.partial(message_to_csv, truncate_length=length, no_arr=no_arr, no_str=no_str)
            text = to_csv(value) if has_fields(value) else str(value)
            return printable(text.replace("\n", r"\n"))  # one line for each message, unlike in ROS
        if not has_fields(value):
            return printable(f"{value}\n---")
        text = message_to_yaml(value, truncate_length=length, no_arr=no_arr, no_str=no_str, flow_style=flow_style)
        return printable(f"{text}---")

    return write
