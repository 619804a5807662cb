# SPDX-License-Identifier: Apache-2.0
"""The options of the commands that print messages: YAML or CSV, and what to do with long values."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any, NamedTuple

import click

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["TextFormat", "text_options"]

_TRUNCATE_LENGTH = 128  # ros2cli's default: elements of an array, characters of a string


class TextFormat(NamedTuple):
    """How messages are printed.

    Attributes:
        csv: Whether a message is one line of comma-separated values, instead of YAML.
        truncate_length: Maximum number of elements of an array and of characters of a string, or None for all.
        no_arr: Whether the types of arrays are printed instead of their elements.
        no_str: Whether the lengths of strings are printed instead of the strings.
        flow_style: Whether collections are printed on one line.
    """

    csv: bool
    truncate_length: int | None
    no_arr: bool
    no_str: bool
    flow_style: bool

    @property
    def limits(self) -> dict[str, Any]:
        """The arguments of the functions of rosidl_runtime_py about long values."""
        return {"truncate_length": self.truncate_length, "no_arr": self.no_arr, "no_str": self.no_str}


def text_options(function: Callable[..., None]) -> Callable[..., None]:
    """Declare the options that format messages. The function receives them as ``text_format``."""

    @functools.wraps(function)
    def command(
        *,
        csv: bool,
        full_length: bool,
        truncate_length: int,
        no_arr: bool,
        no_str: bool,
        flow_style: bool,
        **others: Any,
    ) -> None:
        length = None if full_length else truncate_length
        function(text_format=TextFormat(csv, length, no_arr, no_str, flow_style), **others)

    options = (
        click.option("--csv", is_flag=True, help="Print each message as one line of comma-separated values."),
        click.option("--full-length", "-f", is_flag=True, help="Do not truncate arrays and strings."),
        click.option(
            "--truncate-length",
            "-l",
            metavar="N",
            type=click.IntRange(min=1),
            default=_TRUNCATE_LENGTH,
            help="Truncate arrays and strings to N elements.",
        ),
        click.option("--no-arr", is_flag=True, help="Print the types of arrays instead of their elements."),
        click.option("--no-str", is_flag=True, help="Print the lengths of strings instead of the strings."),
        click.option("--flow-style", is_flag=True, help="Print collections on one line."),
    )
    for option in reversed(options):
        command = option(command)
    return command
