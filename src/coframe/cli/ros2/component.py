# SPDX-License-Identifier: Apache-2.0
"""``coframe component``: composable nodes in containers, with the same names and output as ``ros2 component``."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import TYPE_CHECKING, Any, NamedTuple

import click
from click.exceptions import Exit

from coframe.cli.declaration import CommandGroup, argument
from coframe.cli.output import fail, one_line
from coframe.cli.ros2.calls import call_service, response_timeout_option
from coframe.cli.ros2.graph import (
    DISCOVERY_TIME,
    NO_WAIT,
    GraphCommand,
    graph_node,
    node_names,
    spin_time_option,
    wait_until,
)
from coframe.cli.ros2.values import yaml_value
from coframe.errors import PackageError
from coframe.workspace.packages.components import component_types
from coframe.workspace.packages.executables import find_executable

if TYPE_CHECKING:
    from collections.abc import Iterable

    from coframe.cli.declaration import Declared
    from coframe.cli.options import NonNegativeDuration, PositiveDuration
    from rclpy.node import Node

__all__ = ["component"]

_LIST_NODES = "composition_interfaces/srv/ListNodes"
_START_TIMEOUT = 30.0  # seconds until a container has started, also on a slow machine
_LOG_LEVELS = {"debug": 10, "info": 20, "warn": 30, "error": 40, "fatal": 50}
component = CommandGroup(
    "component",
    help="Load composable nodes in Python into one process, like ros2 component.\n\n"
    "Example: coframe component load /ComponentManager demo_nodes_py demo_nodes_py::Talker",
)
container_argument = argument(
    "container", metavar="CONTAINER", help="Name of the container's node, e.g. /ComponentManager."
)
package_argument = argument("package", metavar="PACKAGE", help="Name of the package with the composable node.")
plugin_argument = argument(
    "plugin", metavar="PLUGIN", help="Name of the composable node, e.g. demo_nodes_py::Talker, or MODULE:CLASS."
)


class _NodeWords(NamedTuple):
    """The words of a command line about the node that is loaded."""

    package: str
    plugin: str
    name: str
    namespace: str
    log_level: str | None
    rules: tuple[str, ...]
    parameters: tuple[str, ...]
    extra: tuple[str, ...]


def _node_options(function: Declared) -> Declared:
    """Declare the options of the node that is loaded."""
    for option in (
        click.option(
            "--extra-argument",
            "-e",
            "extra",
            metavar="NAME:=VALUE",
            multiple=True,
            help="Argument of the container, such as use_intra_process_comms:=true.",
        ),
        click.option(
            "--parameter",
            "-p",
            "parameters",
            metavar="NAME:=VALUE",
            multiple=True,
            help="Parameter of the node, such as rate:=10.",
        ),
        click.option(
            "--remap-rule",
            "-r",
            "rules",
            metavar="FROM:=TO",
            multiple=True,
            help="Remapping of the node, such as chatter:=/news.",
        ),
        click.option(
            "--log-level",
            metavar="LEVEL",
            type=click.Choice([*_LOG_LEVELS], case_sensitive=False),
            help="Log level of the node: debug, info, warn, error or fatal.",
        ),
        click.option("--node-namespace", metavar="NAMESPACE", default="", help="Namespace of the node."),
        click.option("--node-name", "-n", metavar="NAME", default="", help="Name of the node."),
    ):
        function = option(function)
    return function


@component.command(short_help="List the composable nodes of packages.")
@argument("package", metavar="[PACKAGE]", required=False, help="Name of a package. [default: all packages]")
def types(package: str | None) -> None:
    """List the composable nodes in Python that packages declare as entry points of the group rclpy_components.

    Example: coframe component types demo_nodes_py
    """
    found = component_types()
    if package is not None:
        if package not in found:
            fail(f"The package {package!r} has no composable nodes in Python.", "coframe component types lists all.")
        print("\n".join(map(one_line, found[package])))
        return
    for name, plugins in found.items():
        print("\n".join([one_line(name), *(f"  {one_line(plugin)}" for plugin in plugins)]))


@component.command("list", cls=GraphCommand, short_help="List containers and their nodes.")
@argument("container", metavar="[CONTAINER]", required=False, help="Name of a container. [default: all containers]")
@click.option("--containers-only", is_flag=True, help="List only the containers.")
@response_timeout_option
@spin_time_option(DISCOVERY_TIME)
def list_components(
    container: str | None, containers_only: bool, timeout: PositiveDuration, spin_time: NonNegativeDuration
) -> None:
    """List the running containers, and the nodes in them with their IDs.

    Example: coframe component list
    """
    with graph_node(NO_WAIT if container else spin_time) as node:
        names = _containers(node) if container is None else [_check_container(node, container)]
        for name in names:
            if container is None:
                print(one_line(name))
            if not containers_only:
                indent = "  " if container is None else ""
                _print_components(node, name, timeout, indent)


def _print_components(node: Node, container: str, timeout: PositiveDuration, indent: str) -> None:
    found = _call(node, container, timeout, "ListNodes", "list_nodes")
    for number, name in zip(found.unique_ids, found.full_node_names, strict=False):
        print(f"{indent}{number}  {one_line(name)}")


@component.command(cls=GraphCommand, short_help="Load a composable node into a container.")
@container_argument
@package_argument
@plugin_argument
@_node_options
@click.option("--quiet", "-q", is_flag=True, help="Print only the ID of the node.")
@response_timeout_option
@spin_time_option(NO_WAIT)
def load(
    container: str,
    package: str,
    plugin: str,
    quiet: bool,
    timeout: PositiveDuration,
    spin_time: NonNegativeDuration,
    node_name: str,
    node_namespace: str,
    log_level: str | None,
    rules: tuple[str, ...],
    parameters: tuple[str, ...],
    extra: tuple[str, ...],
) -> None:
    """Load a composable node into a running container.

    Start a container with: coframe run rclpy_components component_container

    Example: coframe component load /ComponentManager demo_nodes_py demo_nodes_py::Talker --node-name speaker
    """
    with graph_node(spin_time) as node:
        words = _NodeWords(package, plugin, node_name, node_namespace, log_level, rules, parameters, extra)
        _load(node, _check_container(node, container), words, timeout, is_quiet=quiet)


@component.command(cls=GraphCommand, short_help="Unload composable nodes from a container.")
@container_argument
@argument("numbers", metavar="ID...", nargs=-1, required=True, type=click.IntRange(min=0), help="IDs of the nodes.")
@response_timeout_option
@spin_time_option(NO_WAIT)
def unload(container: str, numbers: tuple[int, ...], timeout: PositiveDuration, spin_time: NonNegativeDuration) -> None:
    """Unload composable nodes from a running container.

    Example: coframe component unload /ComponentManager 1
    """
    has_failed = False
    with graph_node(spin_time) as node:
        name = _check_container(node, container)
        for number in numbers:
            response = _call(node, name, timeout, "UnloadNode", "unload_node", unique_id=number)
            if response.success:
                print(f"Unloaded component {number} from '{one_line(name)}' container node")
            else:
                has_failed = True
                reason = one_line(response.error_message)
                text = f"Failed to unload component {number} from '{one_line(name)}' container node"
                print(text, f"    {reason}", sep="\n", file=sys.stderr)
    if has_failed:
        raise Exit(1)


@component.command(cls=GraphCommand, short_help="Run a composable node in its own container.")
@package_argument
@plugin_argument
@_node_options
@click.option(
    "--container-node-name", "-c", "container_name", metavar="NAME", default="", help="Name of the container's node."
)
@response_timeout_option
@spin_time_option(NO_WAIT)
def standalone(
    package: str,
    plugin: str,
    container_name: str,
    timeout: PositiveDuration,
    spin_time: NonNegativeDuration,
    node_name: str,
    node_namespace: str,
    log_level: str | None,
    rules: tuple[str, ...],
    parameters: tuple[str, ...],
    extra: tuple[str, ...],
) -> None:
    """Run a composable node in its own container, until Ctrl-C.

    Example: coframe component standalone demo_nodes_py demo_nodes_py::Talker
    """
    name = container_name or f"standalone_container_{os.getpid()}"
    try:
        executable = find_executable("rclpy_components", "component_container")
    except PackageError as error:
        fail(str(error), error.hint)
    command = [*executable.command, "--ros-args", "-r", f"__node:={name}"]
    with subprocess.Popen(command, env=executable.environment()) as process:  # noqa: S603
        try:
            with graph_node(spin_time) as node:
                words = _NodeWords(package, plugin, node_name, node_namespace, log_level, rules, parameters, extra)
                wait_until(lambda: process.poll() is not None or _is_container(node, name), _START_TIMEOUT)
                _load(node, _check_container(node, name), words, timeout, is_quiet=False)
            process.wait()
        finally:
            process.terminate()


def _load(node: Node, container: str, words: _NodeWords, timeout: PositiveDuration, *, is_quiet: bool) -> None:
    response = _call(
        node,
        container,
        timeout,
        "LoadNode",
        "load_node",
        package_name=words.package,
        plugin_name=words.plugin,
        node_name=words.name,
        node_namespace=words.namespace,
        log_level=_LOG_LEVELS.get((words.log_level or "").lower(), 0),
        remap_rules=list(words.rules),
        parameters=list(_parameters(words.parameters, "--parameter")),
        extra_arguments=list(_parameters(words.extra, "--extra-argument")),
    )
    if not response.success:
        fail(f"Failed to load component: {one_line(response.error_message).rstrip('.')}.")
    if is_quiet:
        print(response.unique_id)
        return
    print(
        f"Loaded component {response.unique_id} into '{one_line(container)}' container node as "
        f"'{one_line(response.full_node_name)}'"
    )


def _parameters(words: Iterable[str], option: str) -> Iterable[Any]:
    from rclpy.parameter import Parameter  # noqa: PLC0415 - slow import

    for word in words:
        name, separator, text = word.partition(":=")
        if not (name and separator):
            fail(f"{option} {word!r} is not NAME:=VALUE.", code=2)
        try:
            yield Parameter(name, value=yaml_value(text, option)).to_parameter_msg()
        except (TypeError, ValueError) as error:
            fail(f"{option} {word!r} is not a parameter: {error}", code=2)


def _containers(node: Node) -> list[str]:
    """Return the names of all nodes with the service list_nodes of containers."""
    services = dict(node.get_service_names_and_types())
    names = node_names(node, include_hidden=True)
    return [name for name in names if _LIST_NODES in services.get(f"{name}/_container/list_nodes", [])]


def _full_name(name: str) -> str:
    return name if name.startswith("/") else f"/{name}"


def _is_container(node: Node, name: str) -> bool:
    return _full_name(name) in _containers(node)


def _check_container(node: Node, name: str) -> str:
    name = _full_name(name)
    if not wait_until(lambda: _is_container(node, name)):
        fail(
            f"Unable to find container node '{one_line(name)}'",
            "coframe component list shows all containers. Start one with: coframe run rclpy_components "
            "component_container",
        )
    return name


def _call(node: Node, container: str, timeout: PositiveDuration, kind: str, service: str, **fields: Any) -> Any:
    from composition_interfaces import srv  # noqa: PLC0415 - slow import

    service_class = getattr(srv, kind)
    request = service_class.Request(**fields)
    return call_service(node, service_class, f"{container}/_container/{service}", request, timeout=timeout)
