# SPDX-License-Identifier: Apache-2.0
"""Predicates for the processes that an event is for."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.actions.execute_local import ExecuteLocal

__all__ = ["for_all_processes", "matches_executable", "matches_name", "matches_pid"]


def matches_pid(pid: int) -> Callable[[ExecuteLocal], bool]:
    """Return a predicate for the process with this id."""
    return lambda action: (action.process_details or {}).get("pid") == pid


def matches_name(name: str) -> Callable[[ExecuteLocal], bool]:
    """Return a predicate for processes with this name, with or without the number at its end."""
    return lambda action: action.name is not None and name in {action.name, action.name.rpartition("-")[0]}


def matches_executable(executable: str) -> Callable[[ExecuteLocal], bool]:
    """Return a predicate for processes of this executable."""

    def matches(action: ExecuteLocal) -> bool:
        command = (action.process_details or {}).get("cmd") or [""]
        return executable in {command[0], Path(command[0]).name}

    return matches


def for_all_processes() -> Callable[[ExecuteLocal], bool]:
    """Return a predicate that holds for every process."""
    return lambda _: True
