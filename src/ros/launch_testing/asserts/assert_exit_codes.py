# SPDX-License-Identifier: Apache-2.0
"""The assertion about exit codes."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Final

from launch_testing.util.proc_lookup import resolveProcesses

if TYPE_CHECKING:
    from collections.abc import Sequence

    from launch.actions.execute_local import ExecuteLocal

__all__ = [
    "EXIT_FORCED",
    "EXIT_OK",
    "EXIT_SIGINT",
    "EXIT_SIGKILL",
    "EXIT_SIGQUIT",
    "EXIT_SIGSEGV",
    "assertExitCodes",
]

_WINDOWS = os.name == "nt"
EXIT_OK: Final = 0
EXIT_FORCED: Final = 1
EXIT_SIGINT: Final = 0xC000013A if _WINDOWS else 130
EXIT_SIGQUIT: Final = 131
EXIT_SIGKILL: Final = 1 if _WINDOWS else 137
EXIT_SIGSEGV: Final = 0xC0000005 if _WINDOWS else 139


def assertExitCodes(
    proc_info: Any,
    allowable_exit_codes: Sequence[int] = (EXIT_OK,),
    process: str | ExecuteLocal | None = None,
    cmd_args: Any = None,
    *,
    strict_proc_matching: bool = True,
) -> None:
    """Fail if a process ended with another exit code.

    Args:
        proc_info: The events of the processes.
        allowable_exit_codes: The expected exit codes; minus the number of a signal that ended the process.
        process: The action, a part of the name, or None for all processes.
        cmd_args: Arguments that the command must contain, or `NO_CMD_ARGS`.
        strict_proc_matching: Whether several processes that match a name are an error.

    Raises:
        AssertionError: A process has another exit code, or has not ended.
        NoMatchingProcessException: No process matches.
    """
    found = resolveProcesses(proc_info, process=process, cmd_args=cmd_args, strict_proc_matching=strict_proc_matching)
    for event in (proc_info[action] for action in found):
        code = getattr(event, "returncode", None)
        if code is None:
            raise AssertionError(f"Proc {event.process_name} has not exited yet")
        if code not in allowable_exit_codes:
            raise AssertionError(f"Proc {event.process_name} exited with code {code}")
