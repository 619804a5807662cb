# SPDX-License-Identifier: Apache-2.0
"""Command-line arguments for a node (``--ros-args``) or a xacro file (``NAME:=VALUE``)."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING

from coframe.cli.output import fail

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["reported_node_errors", "ros_arguments", "xacro_arguments"]


@contextlib.contextmanager
def reported_node_errors() -> Iterator[None]:
    """Report invalid ROS arguments, names and parameters of a node with exit code 2."""
    from coframe.nodes.program import NODE_ERRORS  # noqa: PLC0415 - slow import

    try:
        yield
    except NODE_ERRORS as error:
        fail(str(error), code=2)


def ros_arguments(words: list[str]) -> list[str]:
    """Return the parts ``--ros-args ... --`` of arguments. The node would take others for remapping rules."""
    found: list[str] = []
    inside = False
    for word in words:
        inside = inside or word == "--ros-args"
        if inside:
            found.append(word)
        inside = inside and word != "--"
    return found


def xacro_arguments(words: list[str]) -> dict[str, str]:
    """Return the xacro arguments NAME:=VALUE among unknown arguments; skip ``--ros-args``.

    Any other argument, such as a misspelled option, is an error.
    """
    from rclpy.utilities import remove_ros_args  # noqa: PLC0415 - slow import

    own = remove_ros_args(["coframe", *words])[1:]
    for word in own:
        if ":=" not in word or word.startswith("-"):
            fail(
                f"No option or argument {word!r}.",
                "Write xacro arguments as NAME:=VALUE, and node arguments after --ros-args.",
                code=2,
            )
    return dict(word.split(":=", 1) for word in own)
