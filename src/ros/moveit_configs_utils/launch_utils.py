# SPDX-License-Identifier: Apache-2.0
"""Parts of launch descriptions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

if TYPE_CHECKING:
    from launch import LaunchDescription

__all__ = ["DeclareBooleanLaunchArg", "add_debuggable_node"]


class DeclareBooleanLaunchArg(DeclareLaunchArgument):
    """Declare an argument that is true or false.

    Args:
        name: Name of the argument.
        default_value: Its default value.
        description: Its description.
        options: Keyword arguments of DeclareLaunchArgument.
    """

    def __init__(
        self, name: str, *, default_value: bool | str = False, description: str | None = None, **options: Any
    ) -> None:
        super().__init__(name, default_value=str(default_value), description=description, **options)


def add_debuggable_node(
    ld: LaunchDescription,
    package: str,
    executable: str,
    condition_name: str = "debug",
    commands_file: str | None = None,
    extra_debug_args: list[str] | None = None,
    **options: Any,
) -> None:
    """Add a node that runs in a debugger if a launch configuration is true.

    Args:
        ld: The launch description.
        package: Package of the node.
        executable: Its executable.
        condition_name: Name of the launch configuration.
        commands_file: File with commands of gdb.
        extra_debug_args: Arguments of the node in the debugger.
        options: Keyword arguments of Node.
    """
    debug = LaunchConfiguration(condition_name)
    ld.add_action(Node(package=package, executable=executable, condition=UnlessCondition(debug), **options))
    commands = f"-x {commands_file} " if commands_file else ""
    arguments = [*options.pop("arguments", []), *(extra_debug_args or [])]
    ld.add_action(
        Node(
            package=package,
            executable=executable,
            condition=IfCondition(debug),
            prefix=[f"gdb {commands}--ex run --args"],
            arguments=arguments,
            **options,
        )
    )
