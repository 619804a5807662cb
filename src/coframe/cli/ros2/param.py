# SPDX-License-Identifier: Apache-2.0
"""``coframe param``: the parameters of other nodes, with the same names and output as ``ros2 param``."""

from __future__ import annotations

import re
import sys
from typing import TYPE_CHECKING

import click
from click.exceptions import Exit

from coframe._files.complete_files import write_complete
from coframe.cli.declaration import PATH, CommandGroup, argument
from coframe.cli.options import topic_name
from coframe.cli.output import fail, fail_to_write, one_line, printable, warn
from coframe.cli.ros2.calls import response_timeout_option
from coframe.cli.ros2.graph import (
    DISCOVERY_TIME,
    NO_WAIT,
    GraphCommand,
    graph_node,
    node_argument,
    node_names,
    spin_time_option,
)
from coframe.cli.ros2.parameter_client import ParameterClient
from coframe.cli.ros2.parameter_text import (
    TYPE_NAMES,
    as_yaml_file,
    description_lines,
    parameters_of_file,
    python_value,
    value_line,
)

if TYPE_CHECKING:
    from pathlib import Path

    from coframe.cli.options import NonNegativeDuration, PositiveDuration

__all__ = ["param"]

parameter_argument = argument("name", metavar="NAME", help="Name of the parameter, e.g. use_sim_time.")
hidden_nodes_option = click.option(
    "--include-hidden-nodes", "include_hidden", is_flag=True, help="Include hidden nodes."
)
param = CommandGroup(
    "param",
    help="Read and set the parameters of nodes, like ros2 param.\n\n"
    "Example: coframe param set /dynamic_tf_broadcaster rate 100.0",
)


@param.command(cls=GraphCommand, short_help="Delete a parameter of a node.")
@node_argument
@parameter_argument
@response_timeout_option
@spin_time_option(NO_WAIT)
def delete(
    node_name: str,
    name: str,
    timeout: PositiveDuration,
    spin_time: NonNegativeDuration,
) -> None:
    """Delete a parameter of a node.

    Example: coframe param delete /listener speed
    """
    with graph_node(spin_time) as node:
        result = ParameterClient(node, node_name, timeout=timeout).set({name: None})[0]
    if not result.successful:
        fail("Deleting parameter failed" + (f": {result.reason}" if result.reason else ""))
    print("Deleted parameter successfully")


@param.command(cls=GraphCommand, short_help="Show the type, description and limits of parameters.")
@node_argument
@argument("names", metavar="NAME...", nargs=-1, required=True, help="Names of parameters.")
@response_timeout_option
@spin_time_option(NO_WAIT)
def describe(
    node_name: str,
    names: tuple[str, ...],
    timeout: PositiveDuration,
    spin_time: NonNegativeDuration,
) -> None:
    """Show the type, the description and the limits of parameters of a node.

    Example: coframe param describe /listener use_sim_time
    """
    with graph_node(spin_time) as node:
        descriptors = ParameterClient(node, node_name, timeout=timeout).describe(names)
    if len(descriptors) < len(names):
        fail("Failed to get parameter descriptions", f"coframe param list {node_name} shows all parameters.")
    for descriptor in descriptors:
        print(printable("\n".join(description_lines(descriptor))))


@param.command(cls=GraphCommand, short_help="Print all parameters of a node as a YAML file.")
@node_argument
@click.option(
    "--output-dir",
    metavar="FOLDER",
    type=PATH,
    help="Write the parameters to a file in this folder, named after the node, instead of printing them.",
)
@click.option(
    "--print", "prints", is_flag=True, hidden=True, help="Accepted for compatibility: printing is the default."
)
@response_timeout_option
@spin_time_option(NO_WAIT)
def dump(
    node_name: str, output_dir: Path | None, prints: bool, timeout: PositiveDuration, spin_time: NonNegativeDuration
) -> None:
    """Print all parameters of a node in the format of --params-file.

    Example: coframe param dump /listener > listener.yaml
    """
    del prints
    with graph_node(spin_time) as node:
        client = ParameterClient(node, node_name, timeout=timeout)
        names = client.names()
        values = dict(zip(names, client.get(names), strict=False))
    text = as_yaml_file(node_name, {name: python_value(value) for name, value in values.items()})
    if output_dir is None:
        print(text, end="")
        return
    path = output_dir / f"{node_name.strip('/').replace('/', '__')}.yaml"
    try:
        write_complete(path, text.encode())
    except OSError as error:
        fail_to_write(path, error)
    print(f"Saving to:  {printable(str(path))}")


@param.command(cls=GraphCommand, short_help="Print parameters of a node, or a parameter of all nodes.")
@argument(
    "words",
    metavar="[NODE] NAME...",
    nargs=-1,
    required=True,
    help="Node and names of its parameters; or one parameter name, to print it for all nodes.",
)
@click.option("--hide-type", is_flag=True, help="Print only the values.")
@hidden_nodes_option
@response_timeout_option
@spin_time_option(DISCOVERY_TIME)
def get(
    words: tuple[str, ...],
    hide_type: bool,
    include_hidden: bool,
    timeout: PositiveDuration,
    spin_time: NonNegativeDuration,
) -> None:
    """Print parameters of a node, or one parameter of all nodes that have it.

    Example: coframe param get /listener use_sim_time
    """
    if len(words) == 1:
        if words[0].startswith("/"):
            fail(f"give the name of a parameter of {words[0]}", f"coframe param list {words[0]} shows them.", code=2)
        _get_of_all_nodes(words[0], timeout, spin_time, hide_type=hide_type, include_hidden=include_hidden)
        return
    node_name, names = topic_name(words[0]), words[1:]
    with graph_node() as node:
        client = ParameterClient(node, node_name, timeout=timeout)
        # One request for each name, because a node may omit unknown ones from a response to several.
        lines = [_value(client, name, hide_type=hide_type) for name in names]
    for name, line in zip(names, lines, strict=True):
        if line is not None:
            print(printable(line if len(names) == 1 else f"{name}:\n  {line}"))
    missing = [name for name, line in zip(names, lines, strict=True) if line is None]
    if missing:
        which = "" if len(names) == 1 else f": {', '.join(missing)}"
        fail(f"Parameter not set{which}", f"coframe param list {node_name} shows all parameters.")


def _get_of_all_nodes(
    name: str, timeout: PositiveDuration, spin_time: NonNegativeDuration, *, hide_type: bool, include_hidden: bool
) -> None:
    """Print a parameter of each node that has it."""
    found = False
    with graph_node(spin_time) as node:
        for each in node_names(node, include_hidden=include_hidden):
            client = ParameterClient(node, each, is_required=False, timeout=timeout)
            line = _value(client, name, hide_type=hide_type) if client.is_available else None
            if line is not None:
                found = True
                print(printable(f"{each}: {line}"))
    if not found:
        fail(f"No node has a parameter {name!r}.", "coframe param list shows the parameters of all nodes.")


def _value(client: ParameterClient, name: str, *, hide_type: bool) -> str | None:
    values = client.get([name])
    return value_line(values[0], hide_type=hide_type) if values else None


@param.command("list", cls=GraphCommand, short_help="List the parameters of nodes.")
@argument("node_name", metavar="[NODE]", required=False, help="Name of a node. [default: all nodes]")
@click.option(
    "--param-prefixes",
    "prefixes",
    metavar="PREFIX",
    multiple=True,
    help="List only parameters with this prefix; repeatable.",
)
@click.option("--param-type", is_flag=True, help="Also show the types.")
@click.option(
    "--filter", "expression", metavar="REGEX", help="List only parameters that match this regular expression."
)
@hidden_nodes_option
@response_timeout_option
@spin_time_option(DISCOVERY_TIME)
def list_parameters(
    node_name: str | None,
    prefixes: tuple[str, ...],
    param_type: bool,
    expression: str | None,
    include_hidden: bool,
    timeout: PositiveDuration,
    spin_time: NonNegativeDuration,
) -> None:
    """List the parameters of one node or of all nodes.

    Example: coframe param list /listener
    """
    try:
        pattern = re.compile(expression or "")
    except re.error as error:
        fail(f"--filter: {expression!r} is not a regular expression: {error}", code=2)
    with graph_node(NO_WAIT if node_name else spin_time) as node:
        for each in [node_name] if node_name else node_names(node, include_hidden=include_hidden):
            client = ParameterClient(node, each, is_required=node_name is not None, timeout=timeout)
            if not client.is_available:
                continue
            names = sorted(name for name in client.names(prefixes) if pattern.search(name))
            if not node_name:
                print(f"{one_line(each)}:")
            types = client.types(names) if param_type else []
            for index, name in enumerate(names):
                suffix = f" (type: {TYPE_NAMES.get(types[index], 'unknown')})" if index < len(types) else ""
                print(one_line(f"  {name}{suffix}"))


@param.command(cls=GraphCommand, short_help="Set the parameters of a node from a YAML file.")
@node_argument
@argument("file", metavar="FILE", type=PATH, help="A YAML file in the format of --params-file.")
@click.option("--no-use-wildcard", is_flag=True, help="Do not use the parameters under /**.")
@response_timeout_option
@spin_time_option(NO_WAIT)
def load(
    node_name: str,
    file: Path,
    no_use_wildcard: bool,
    timeout: PositiveDuration,
    spin_time: NonNegativeDuration,
) -> None:
    """Set the parameters of a node from a YAML file.

    Example: coframe param load /listener listener.yaml
    """
    values = parameters_of_file(file, node_name, use_wildcard=not no_use_wildcard)
    with graph_node(spin_time) as node:
        client = ParameterClient(node, node_name, timeout=timeout)
        results = client.set(values)
        rejected = [name for name, result in zip(values, results, strict=True) if not result.successful]
        # A dumped file contains read-only parameters as well, whose values are those of the node.
        unchanged = [name for name in rejected if client.get([name]) == [values[name]]]
    failed = False
    for name, result in zip(values, results, strict=True):
        if name in unchanged:
            print(one_line(f"Parameter {name} has this value already"))
            continue
        reason = f": {result.reason}" if result.reason else ""
        outcome = f"Set parameter {name} successful" if result.successful else f"Set parameter {name} failed"
        print(one_line(outcome + reason), file=sys.stdout if result.successful else sys.stderr)
        failed |= not result.successful
    if failed:
        raise Exit(1)


@param.command("set", cls=GraphCommand, short_help="Set parameters of a node.")
@node_argument
@argument(
    "words",
    metavar="NAME VALUE...",
    nargs=-1,
    required=True,
    help="Names and values of parameters; values are YAML, e.g. 1.5, true or '[1, 2]'.",
)
@response_timeout_option
@spin_time_option(NO_WAIT)
def set_parameters(
    node_name: str,
    words: tuple[str, ...],
    timeout: PositiveDuration,
    spin_time: NonNegativeDuration,
) -> None:
    """Set parameters of a node.

    Example: coframe param set /dynamic_tf_broadcaster rate 100.0
    """
    from rclpy.parameter import get_parameter_value  # noqa: PLC0415 - slow import

    if len(words) % 2:
        example = f"coframe param set {node_name} {' '.join(words)} VALUE"
        fail(f"there is no value for the parameter {words[-1]!r}", f"Example: {example}", code=2)
    values = dict(zip(words[::2], words[1::2], strict=True))
    with graph_node(spin_time) as node:
        client = ParameterClient(node, node_name, timeout=timeout)
        results = client.set({name: get_parameter_value(value) for name, value in values.items()})
    failed = False
    for name, result in zip(values, results, strict=True):
        prefix = "" if len(values) == 1 else f"{name}: "
        reason = f": {result.reason}" if result.reason else ""
        failed |= not result.successful
        if not result.successful:
            warn(f"{prefix}Setting parameter failed{reason}")
        else:
            print(one_line(f"{prefix}Set parameter successful{reason}"))
    if failed:
        raise Exit(1)
