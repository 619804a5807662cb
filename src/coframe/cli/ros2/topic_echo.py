# SPDX-License-Identifier: Apache-2.0
"""``coframe topic echo``: prints the messages of a topic as YAML or CSV, like ``ros2 topic echo``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from coframe.cli.declaration import argument
from coframe.cli.options import NonNegativeDuration
from coframe.cli.output import fail, print_bounded, printable
from coframe.cli.ros2.graph import (
    NO_WAIT,
    GraphCommand,
    graph_node,
    hidden_topics_option,
    load_type,
    sim_time_option,
    spin_time_option,
    topic_argument,
    topic_type,
    wait_until,
)
from coframe.cli.ros2.messages import MessageStream, field_of, message_filter
from coframe.cli.ros2.qos import (
    QoSWords,
    depth_option,
    durability_option,
    history_option,
    profile_option,
    reliability_option,
)
from coframe.cli.ros2.text_format import text_options

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.cli.ros2.text_format import TextFormat

__all__ = ["echo"]

_CLEAR = "\x1b[H\x1b[2J"  # moves the cursor home and clears the terminal


@click.command(cls=GraphCommand, short_help="Print the messages of a topic as YAML.")
@topic_argument
@argument(
    "message_type",
    metavar="[TYPE]",
    required=False,
    help="Type, e.g. std_msgs/msg/String. [default: the type of the topic]",
)
@click.option(
    "--field",
    "fields",
    metavar="FIELD",
    multiple=True,
    help="Print only this field, e.g. pose.position.x or ranges[0]; repeatable.",
)
@click.option("--once", is_flag=True, help="Print the first message and exit.")
@click.option(
    "--timeout",
    metavar="DURATION",
    type=NonNegativeDuration,
    help="Exit with code 1 if no message arrives within this time.",
)
@text_options
@click.option("--raw", is_flag=True, help="Print the serialized bytes.")
@click.option("--clear", "-c", is_flag=True, help="Clear the terminal before each message.")
@click.option(
    "--filter",
    "filter_expression",
    metavar="EXPR",
    help="Print only messages m for which this Python expression is true.",
)
@click.option(
    "--lost-messages", is_flag=True, hidden=True, help="Accepted for compatibility: lost messages are always reported."
)
@click.option("--no-lost-messages", is_flag=True, help="Do not report lost messages.")
@profile_option
@depth_option
@history_option
@reliability_option
@durability_option
@hidden_topics_option
@sim_time_option
@spin_time_option(NO_WAIT)
def echo(
    topic_name: str,
    message_type: str | None,
    fields: tuple[str, ...],
    once: bool,
    timeout: NonNegativeDuration | None,
    text_format: TextFormat,
    raw: bool,
    clear: bool,
    filter_expression: str | None,
    lost_messages: bool,
    no_lost_messages: bool,
    qos_profile: str | None,
    qos_depth: int | None,
    qos_history: str | None,
    qos_reliability: str | None,
    qos_durability: str | None,
    include_hidden: bool,
    use_sim_time: bool,
    spin_time: NonNegativeDuration,
) -> None:
    """Print the messages of a topic. Unless specified, the QoS is chosen to match all publishers.

    Example: coframe topic echo /scan --once --field header
    """
    del lost_messages
    write = _writer(fields, text_format, raw=raw)
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
                print_bounded(f"{_CLEAR}{write(message)}" if clear else write(message))
                if once:
                    return
        fail(f"No message arrived on {topic_name} within {timeout}.", "coframe topic info shows its publishers.")


def _writer(fields: tuple[str, ...], text_format: TextFormat, *, raw: bool) -> Callable[[Any], str]:
    """Return the function that formats a message, or some of its fields."""
    if raw:
        return lambda data: f"{data}\n---"
    from rosidl_runtime_py import message_to_csv, message_to_yaml  # noqa: PLC0415 - slow import

    def has_fields(value: Any) -> bool:
        return hasattr(value, "get_fields_and_field_types")

    def to_csv(value: Any) -> str:
        return message_to_csv(value, **text_format.limits) if has_fields(value) else str(value)

    def to_yaml(value: Any) -> str:
        if not has_fields(value):
            return f"{value}\n"
        return message_to_yaml(value, flow_style=text_format.flow_style, **text_format.limits)

    def write(message: Any) -> str:
        values = [field_of(message, field) for field in fields] or [message]
        if text_format.csv:
            text = ",".join(to_csv(value) for value in values)
            return printable(text.replace("\n", r"\n"))  # one line for each message, unlike in ROS
        text = "".join(to_yaml(value) for value in values)
        return printable(f"{text}---")

    return write
