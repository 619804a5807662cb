# SPDX-License-Identifier: Apache-2.0
"""Prints the arguments of a launch description."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from launch import LaunchDescription

__all__ = ["print_arguments_of_launch_description"]


def print_arguments_of_launch_description(*, launch_description: LaunchDescription) -> None:
    """Print the arguments with their descriptions and default values."""
    print("Arguments (pass arguments as '<name>:=<value>'):")
    arguments = launch_description.get_launch_arguments()
    if not arguments:
        print("\n  No arguments.")
    for each in arguments:
        print(f"\n    '{each.name}':\n        {each.description}")
        if each.default_value is not None:
            print(f"        (default: {' + '.join(part.describe() for part in each.default_value)})")
