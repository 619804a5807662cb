# SPDX-License-Identifier: Apache-2.0
"""``coframe interface``: message, service and action types, with the same names and output as ``ros2 interface``.

The commands about the user's own packages go beyond ``ros2 interface``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from coframe.cli.declaration import CommandGroup, argument
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.output import fail, printable
from coframe.cli.ros2.definition_text import definition_lines, origin_lines
from coframe.cli.ros2.graph import load_type
from coframe.cli.ros2.interface_packages import add, check, remove, stubs

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["interface"]

_TITLES = {"msg": "Messages", "srv": "Services", "action": "Actions"}
type_argument = argument(
    "type_name", metavar="TYPE", help="Name of a type, e.g. geometry_msgs/msg/Pose or std_srvs/srv/SetBool."
)
messages_option = click.option("--only-msgs", "-m", "only_messages", is_flag=True, help="List only messages.")
services_option = click.option("--only-srvs", "-s", "only_services", is_flag=True, help="List only services.")
actions_option = click.option("--only-actions", "-a", is_flag=True, help="List only actions.")
interface = CommandGroup(
    "interface",
    help="Show message, service and action types, like ros2 interface; find, check and add your own packages.\n\n"
    "Example: coframe interface show sensor_msgs/msg/LaserScan",
)


@interface.command("list", short_help="List all types.")
@messages_option
@services_option
@actions_option
def list_interfaces(
    only_messages: bool,
    only_services: bool,
    only_actions: bool,
) -> None:
    """List the messages, services and actions of all packages.

    Example: coframe interface list --only-srvs
    """
    with run_to_completion():
        from rosidl_runtime_py import get_interfaces  # noqa: PLC0415 - slow import

        found = get_interfaces()
        for kind in _kinds(only_messages, only_services, only_actions):
            print(f"{_TITLES[kind]}:")
            for package, names in sorted(found.items()):
                _print_all(f"    {package}/{name}" for name in names if name.startswith(f"{kind}/"))


@interface.command(short_help="List the types of a package.")
@argument("package_name", metavar="PACKAGE", help="Name of the package.")
def package(package_name: str) -> None:
    """List the messages, services and actions of a package.

    Example: coframe interface package sensor_msgs
    """
    with run_to_completion():
        from rosidl_runtime_py import get_interfaces  # noqa: PLC0415 - slow import

        try:
            names = get_interfaces([package_name])[package_name]
        except LookupError:
            fail(f"Unknown package '{package_name}'", "coframe interface packages shows all packages with types.")
        _print_all(f"{package_name}/{name}" for name in names)


@interface.command(short_help="List the packages that have types.")
@messages_option
@services_option
@actions_option
def packages(
    only_messages: bool,
    only_services: bool,
    only_actions: bool,
) -> None:
    """List the packages that have messages, services or actions.

    Example: coframe interface packages --only-actions
    """
    with run_to_completion():
        from rosidl_runtime_py import get_interfaces  # noqa: PLC0415 - slow import

        kinds = tuple(f"{kind}/" for kind in _kinds(only_messages, only_services, only_actions))
        found = get_interfaces()
        _print_all(name for name in sorted(found) if any(each.startswith(kinds) for each in found[name]))


@interface.command(short_help="Print a type with its default values, for topic pub.")
@type_argument
@click.option("--no-quotes", is_flag=True, help="Print the YAML without quotes.")
def proto(type_name: str, no_quotes: bool) -> None:
    """Print the YAML of a message, request or goal with its default values.

    Example: coframe interface proto geometry_msgs/msg/Twist
    """
    with run_to_completion():
        from rosidl_runtime_py import message_to_yaml  # noqa: PLC0415 - slow import
        from rosidl_runtime_py.utilities import get_interface  # noqa: PLC0415

        found = load_type(type_name, get_interface)
        message = next((getattr(found, part) for part in ("Request", "Goal") if hasattr(found, part)), found)
        text = message_to_yaml(message())
        print(text if no_quotes else f'"{text}"')


@interface.command(short_help="Print the definition of a type.")
@type_argument
@click.option("--all-comments", is_flag=True, help="Also show the comments of nested types.")
@click.option("--no-comments", is_flag=True, help="Omit comments.")
@click.option("--origin", "with_origin", is_flag=True, help="Also show the file of the definition and its type hash.")
def show(type_name: str, all_comments: bool, no_comments: bool, with_origin: bool) -> None:
    """Print the definition of a type, with the fields of nested types below it.

    Example: coframe interface show sensor_msgs/msg/LaserScan
    """
    with run_to_completion():
        if with_origin:
            _print_all(origin_lines(type_name))
        _print_all(definition_lines(type_name, comments=not no_comments, nested_comments=all_comments))


for _command in (add, check, remove, stubs):
    interface.add_command(_command)


def _kinds(messages: bool, services: bool, actions: bool) -> list[str]:
    """Return the requested kinds, or all if none was requested."""
    chosen = [kind for kind, is_requested in zip(_TITLES, (messages, services, actions), strict=True) if is_requested]
    return chosen or list(_TITLES)


def _print_all(lines: Iterable[str]) -> None:
    for line in lines:
        print(printable(line))
