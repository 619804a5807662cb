# SPDX-License-Identifier: Apache-2.0
"""The node of a command, hidden names, and the options shared by all graph commands."""

from __future__ import annotations

import contextlib
import os
import sys
import time
from typing import TYPE_CHECKING, Any, NoReturn

import click
from click.exceptions import Exit

from coframe._output.formatting import did_you_mean
from coframe.cli.completion import complete_live_topics
from coframe.cli.declaration import Command, Declared, argument
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import NonNegativeDuration, topic_name
from coframe.cli.output import fail, warn
from coframe.cli.ros2.hidden_names import is_hidden
from coframe.cli.ros2.near_names import similar_types_hint
from coframe.errors import CoframeError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from coframe.wire.participant import Participant
    from rclpy.node import Node

__all__ = [
    "NO_WAIT",
    "GraphCommand",
    "all_option",
    "fail_once",
    "fail_without_node",
    "graph_node",
    "hidden_topics_option",
    "join_types",
    "load_type",
    "node_argument",
    "node_names",
    "sim_time_option",
    "spin_time_option",
    "split_node_name",
    "topic_argument",
    "topic_type",
    "wait_until",
]

DISCOVERY_TIME = NonNegativeDuration("0.4s")  # ros2cli waits 0.5 s without its daemon
NO_WAIT = NonNegativeDuration("0s")
# Fast DDS may take seconds to announce an endpoint, so commands wait longer for a specific name than for a list.
ENDPOINT_TIMEOUT = 3.0  # seconds
_PERIOD = 0.02  # seconds between two checks of the graph

_printed_warnings: set[str] = set()  # the warnings that were printed


def spin_time_option(default: NonNegativeDuration) -> Callable[[Declared], Declared]:
    """Declare the option `--spin-time`: DISCOVERY_TIME for lists, NO_WAIT for commands that wait for a name."""
    return click.option(
        "--spin-time",
        metavar="DURATION",
        type=NonNegativeDuration,
        default=default,
        help="How long to wait for other nodes to be discovered.",
    )


sim_time_option = click.option(
    "--use-sim-time", "-s", is_flag=True, help="Use the time of /clock instead of the system time."
)
hidden_topics_option = click.option(
    "--include-hidden-topics",
    "include_hidden",
    is_flag=True,
    help="Include hidden topics, such as those of actions.",
)
all_option = click.option("--all", "-a", "include_hidden", is_flag=True, help="Include hidden nodes.")
topic_argument = argument(
    "topic_name",
    metavar="TOPIC",
    type=topic_name,
    shell_complete=complete_live_topics,
    help="Name of the topic, e.g. /scan.",
)
node_argument = argument("node_name", metavar="NODE", type=topic_name, help="Name of the node, e.g. /robot1/arm.")


class GraphCommand(Command):
    """A command about the graph, which accepts ``--no-daemon`` as in ros2cli: coframe has no daemon."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.params.append(click.Option(["--no-daemon"], is_flag=True, hidden=True, expose_value=False))


@contextlib.contextmanager
def graph_node(
    spin_time: NonNegativeDuration = NO_WAIT, *, use_sim_time: bool = False, name: str = ""
) -> Iterator[Node]:
    """Run a hidden node for the duration of a command, and wait for the discovery of other nodes.

    Args:
        spin_time: How long to wait for discovery. Unless it is 0, the command then waits for the nodes of processes
            that have been discovered without them.
        use_sim_time: Whether the clock of the node follows ``/clock``.
        name: Name of the node; a hidden name with the process ID by default.
    """
    import rclpy  # noqa: PLC0415 - help and completion start faster
    from rclpy.exceptions import NameValidationException  # noqa: PLC0415
    from rclpy.parameter import Parameter  # noqa: PLC0415
    from rclpy.signals import SignalHandlerOptions  # noqa: PLC0415

    with run_to_completion():
        node = None
        try:
            # Ctrl-C raises KeyboardInterrupt in this thread, as in all commands.
            rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
            node = rclpy.create_node(
                name or f"_coframe_{os.getpid()}",
                use_global_arguments=False,
                enable_rosout=bool(name),
                start_parameter_services=False,
                parameter_overrides=[Parameter("use_sim_time", value=use_sim_time)],
            )
            participant = getattr(node, "_Coframe__participant", None)  # None in a sourced ROS
            if participant is not None:
                participant.on_warning(_warn)
            time.sleep(spin_time.seconds)
            if participant is not None and spin_time.seconds > 0:
                _wait_for_nodes(participant)
            yield node
        except (RuntimeError, ValueError) as error:
            if isinstance(error, (CoframeError, Exit)):
                raise
            fail(str(error))
        except NameValidationException as error:
            fail(f"{error.name!r} cannot be a {error.name_type}: {error.error_msg}", code=2)
        finally:
            if node is not None:
                node.destroy_node()
            rclpy.try_shutdown()


def _wait_for_nodes(participant: Participant) -> None:
    """Wait for the nodes of processes that have been discovered, at most for ENDPOINT_TIMEOUT."""
    if not (unnamed := participant.unnamed_participants()):
        return
    print(f"Waiting for the nodes of {_processes_text(unnamed)}.", file=sys.stderr)
    if not wait_until(lambda: not participant.unnamed_participants()):
        unnamed = participant.unnamed_participants()
        warn(
            f"The nodes of {_processes_text(unnamed)} are still unknown after {ENDPOINT_TIMEOUT:g} s, so they are "
            f"not listed."
        )


def _processes_text(middlewares: list[str]) -> str:
    count = "1 process" if len(middlewares) == 1 else f"{len(middlewares)} processes"
    return f"{count} ({', '.join(sorted(set(middlewares)))})"


def _warn(text: str) -> None:
    _printed_warnings.add(text)
    warn(text)


def fail_once(text: str) -> NoReturn:
    """End the command with an error of the middleware, printed unless it was already printed as a warning."""
    if text in _printed_warnings:
        raise Exit(1)
    fail(text)


def wait_until(condition: Callable[[], Any], timeout: float = ENDPOINT_TIMEOUT) -> Any:
    """Return the first true result of a function, or its last result after the timeout in seconds."""
    deadline = time.monotonic() + timeout
    while not (result := condition()) and time.monotonic() < deadline:
        time.sleep(_PERIOD)
    return result


def node_names(node: Node, *, include_hidden: bool) -> list[str]:
    """Return the full names of the nodes in the graph, sorted."""
    names = (f"{space.rstrip('/')}/{name}" for name, space in node.get_node_names_and_namespaces())
    return sorted(name for name in names if include_hidden or not is_hidden(name))


def split_node_name(name: str) -> tuple[str, str]:
    """Return the namespace and the name of a full node name."""
    namespace, _, base = name.rpartition("/")
    return namespace or "/", base


def topic_type(node: Node, topic: str, *, include_hidden: bool = True, wait: bool = False) -> str:
    """Return the type of a topic in the graph, or end the command if there is none or if there are several.

    The messages are those of ros2cli.

    Args:
        node: A node in the graph.
        topic: Full name of the topic.
        include_hidden: Whether to accept a topic with a part that begins with an underscore.
        wait: Print a warning and wait for a topic that does not exist yet, as ``ros2 topic hz`` does. End the command
            if this is not a valid topic name.
    """

    def types() -> list[str]:
        return dict(node.get_topic_names_and_types()).get(topic, [])

    if is_hidden(topic) and not include_hidden:
        fail(f"The topic {topic} is hidden.", "Add --include-hidden-topics.")
    found = wait_until(types)
    if not found:
        unpublished = f"topic [{topic}] does not appear to be published yet"
        hint = did_you_mean(topic, (name for name, _ in node.get_topic_names_and_types()), limit=2)
        if not wait:
            hint = hint or "coframe topic list shows all topics."
            fail(f"{unpublished}. Could not determine the type for the passed topic", hint)
        _check_name(node, topic)
        warn(f"{unpublished}: waiting for it. {hint}".rstrip())
        while not (found := types()):
            time.sleep(_PERIOD)
    if len(found) > 1:
        fail(f"Cannot echo topic '{topic}', as it contains more than one type: [{', '.join(found)}]")
    kind: str = found[0]
    return kind


def _check_name(node: Node, topic: str) -> None:
    """End the command if this is not a valid topic name."""
    try:
        node.resolve_topic_name(topic)
    except RuntimeError as error:
        reason = str(error).removeprefix("failed to resolve name: ")
        fail(f"'{topic}' is not a valid topic name: {reason}", "coframe topic list shows all topics.")


def load_type(kind: str, load: Callable[[str], Any]) -> Any:
    """Return the class of a ROS type, or end the command with an error message if there is none.

    Args:
        kind: Name of the type, e.g. "std_msgs/msg/String".
        load: One of the functions of ``rosidl_runtime_py.utilities``.
    """
    try:
        return load(kind)
    except (AttributeError, ImportError, LookupError, TypeError, ValueError) as error:
        fail(
            f"The passed type '{kind}' is invalid: {error}",
            similar_types_hint(kind)
            or "coframe interface list shows all types. COFRAME_INTERFACES adds your own packages.",
        )


def join_types(types: Iterable[str]) -> str:
    """Return types as ros2 prints them after a name."""
    return f"[{', '.join(types)}]"


def fail_without_node(node: Node, message: str, name: str) -> NoReturn:
    """End the command because there is no node with this name; suggest similar names.

    Args:
        node: Node of the command.
        message: The message of ros2cli.
        name: Full name of the missing node.
    """
    fail(
        message,
        did_you_mean(name, node_names(node, include_hidden=True), limit=2) or "coframe node list shows all nodes.",
    )
