# SPDX-License-Identifier: Apache-2.0
"""Finds the processes that an assertion is about."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from launch.actions import ExecuteProcess
from launch.actions.execute_local import ExecuteLocal

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["NO_CMD_ARGS", "NoMatchingProcessException", "resolveProcesses"]

NO_CMD_ARGS: Final = object()
"""The value of `cmd_args` for processes without arguments."""


class NoMatchingProcessException(Exception):
    """No process, or more than one, matches the arguments of an assertion."""


def resolveProcesses(
    info_obj: Any,
    *,
    process: str | ExecuteLocal | None = None,
    cmd_args: str | Sequence[str] | object | None = None,
    strict_proc_matching: bool = True,
) -> list[ExecuteLocal]:
    """Return the actions of the processes that match.

    Args:
        info_obj: `proc_info` or `proc_output`.
        process: The action, a part of the name of the process, or None for all processes.
        cmd_args: An argument that the command must contain, a list of them, `NO_CMD_ARGS`, or None for any arguments.
        strict_proc_matching: Whether several processes that match a name are an error.

    Raises:
        NoMatchingProcessException: No process matches, or several do and `strict_proc_matching` is set.
        TypeError: `process` is not an action, a name or None.
    """
    known: list[ExecuteLocal] = list(info_obj.processes())
    if process is None:
        found = [each for each in known if _has_arguments(each, cmd_args)]
    elif isinstance(process, ExecuteLocal):
        found = [each for each in known if each is process]
    elif isinstance(process, str):
        found = [each for each in known if process in _name(each) and _has_arguments(each, cmd_args)]
    else:
        raise TypeError(
            f"process must be an action such as {ExecuteProcess.__name__}, a name or None, not "
            f"{type(process).__name__}: {process!r}."
        )
    if not found:
        raise NoMatchingProcessException(
            f"Did not find any process matching {_describe_process(process, cmd_args)}. "
            f"Processes: {_list_processes(known)}"
        )
    if isinstance(process, str) and strict_proc_matching and len(found) > 1:
        raise NoMatchingProcessException(
            f"Found several processes matching {_describe_process(process, cmd_args)}: {_list_processes(found)}. "
            "Pass the action, a longer part of the name, cmd_args, or strict_proc_matching=False."
        )
    return found


def _name(process: ExecuteLocal) -> str:
    return str((process.process_details or {}).get("name", process.name))


def _arguments(process: ExecuteLocal) -> list[str]:
    command = (process.process_details or {}).get("cmd") or [""]
    return list(command[1:])


def _has_arguments(process: ExecuteLocal, wanted: Any) -> bool:
    if wanted is None:
        return True
    arguments = _arguments(process)
    if wanted is NO_CMD_ARGS:
        return not arguments
    words = [wanted] if isinstance(wanted, str) else list(wanted)
    return all(word in arguments for word in words)


def _describe_process(process: Any, arguments: Any) -> str:
    name = _name(process) if isinstance(process, ExecuteLocal) else process
    text = "any name" if name is None else f"name {name!r}"
    if arguments is NO_CMD_ARGS:
        return f"{text} without arguments"
    return text if arguments is None else f"{text} and arguments {arguments!r}"


def _list_processes(processes: list[ExecuteLocal]) -> str:
    return ", ".join(" ".join([_name(each), *_arguments(each)]) for each in processes) or "none"
