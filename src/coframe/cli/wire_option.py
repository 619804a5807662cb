# SPDX-License-Identifier: Apache-2.0
"""The option `--wire` of all commands that join the ROS graph."""

from __future__ import annotations

from typing import Any, Final

from coframe.wire import selection

__all__ = ["HELP", "joins_graph", "take_wire"]

# For the help of each of these commands.
HELP: Final = (
    f"--wire [{'|'.join(selection.WIRES)}]",
    f"Middleware to use. [default: ${selection.VARIABLE}, or {selection.DEFAULT.title}]",
)

_NAME: Final = "--wire"
_COMMANDS: Final = frozenset(
    ["demo", "lab", "view", "doctor", "why", "frames", "monitor", "echo", "static", "robot", "joints", "launch", "run"]
).union(["relay", "record", "play", "lookup", "topic", "node", "service", "action", "param", "lifecycle"])
_BAG_COMMANDS: Final = frozenset(("record", "play"))


def joins_graph(context: Any) -> bool:
    """Return whether the command of a context of click joins the ROS graph."""
    names: list[str] = []
    while context.parent is not None:
        names.insert(0, context.info_name)
        context = context.parent
    return bool(names) and (names[0] in _COMMANDS or (names[0] == "bag" and names[-1] in _BAG_COMMANDS))


def take_wire(args: list[str], *, leading_only: bool) -> list[str]:
    """Return the words of a command line without `--wire VALUE`, which chooses the middleware of this process.

    Args:
        args: The words. Those after "--" and "--ros-args" belong to a node.
        leading_only: Whether the words after the first one that is not an option belong to another program.

    Raises:
        ValueError: The value is not a middleware, or there is none.
    """
    end = next((index for index, word in enumerate(args) if word in ("--", "--ros-args")), len(args))
    for index, word in enumerate(args[:end]):
        if word == _NAME:
            value, rest = "".join(args[index + 1 : index + 2]), args[index + 2 :]
        elif word.startswith(f"{_NAME}="):
            value, rest = word.partition("=")[2], args[index + 1 :]
        elif leading_only and not word.startswith("-"):
            break
        else:
            continue
        if value not in selection.WIRES:
            raise ValueError(f"Invalid value for '{_NAME}': {value!r} is not {selection.alternatives()}.")
        selection.choose(value)
        return args[:index] + rest
    return args
