# SPDX-License-Identifier: Apache-2.0
"""Assertions about the output of processes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch_testing._matching import output_contains
from launch_testing.util.proc_lookup import resolveProcesses

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.actions.execute_local import ExecuteLocal

__all__ = ["assertInStderr", "assertInStdout"]


def assertInStdout(
    proc_output: Any,
    expected_output: Any,
    process: str | ExecuteLocal | None,
    cmd_args: Any = None,
    *,
    output_filter: Callable[[str], str] | None = None,
    strict_proc_matching: bool = True,
    strip_ansi_escape_sequences: bool = True,
) -> None:
    """Fail if no matching process has written something to standard output.

    Args:
        proc_output: The output of the processes.
        expected_output: A text, a compiled regular expression, a list of them, or a function of the output.
        process: The action, a part of the name, or None for all processes.
        cmd_args: Arguments that the command must contain, or `NO_CMD_ARGS`.
        output_filter: Function that returns the part of the output to search in.
        strict_proc_matching: Whether several processes that match a name are an error.
        strip_ansi_escape_sequences: Remove colors from the output.

    Raises:
        AssertionError: The output of no matching process contains it.
        NoMatchingProcessException: No process matches.
    """
    found = resolveProcesses(proc_output, process=process, cmd_args=cmd_args, strict_proc_matching=strict_proc_matching)
    _assert_in(proc_output, found, expected_output, "stdout", output_filter, strip_ansi_escape_sequences)


def assertInStderr(
    proc_output: Any,
    expected_output: Any,
    process: str | ExecuteLocal | None,
    cmd_args: Any = None,
    *,
    output_filter: Callable[[str], str] | None = None,
    strict_proc_matching: bool = True,
    strip_ansi_escape_sequences: bool = True,
) -> None:
    """Fail if no matching process has written something to standard error, as `assertInStdout`."""
    found = resolveProcesses(proc_output, process=process, cmd_args=cmd_args, strict_proc_matching=strict_proc_matching)
    _assert_in(proc_output, found, expected_output, "stderr", output_filter, strip_ansi_escape_sequences)


def _assert_in(
    proc_output: Any,
    processes: list[ExecuteLocal],
    expected_output: Any,
    stream: str,
    output_filter: Callable[[str], str] | None,
    strip_ansi_escape_sequences: bool,
) -> None:
    if not output_contains(
        proc_output,
        processes,
        expected_output,
        stream,
        output_filter=output_filter,
        strip_ansi_escape_sequences=strip_ansi_escape_sequences,
    ):
        names = ", ".join(sorted(str(each.name) for each in processes))
        raise AssertionError(f"Did not find '{expected_output}' in output for any of the matching processes: {names}")
