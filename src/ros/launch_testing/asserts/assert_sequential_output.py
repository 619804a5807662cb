# SPDX-License-Identifier: Apache-2.0
"""The assertion about the order of output."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from launch_testing.util.proc_lookup import resolveProcesses

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from launch.actions.execute_local import ExecuteLocal

__all__ = ["SequentialTextChecker", "assertSequentialStdout"]


class SequentialTextChecker:
    """Checks that strings occur in a given order.

    Args:
        text: The parts of the output, in their order.
    """

    def __init__(self, text: Sequence[str]) -> None:
        self._text = "".join(text)
        self._position = 0

    def assertInStdout(self, msg: str) -> None:
        """Fail if a string is not in the output after the previous ones.

        Raises:
            AssertionError: It is not there.
        """
        found = self._text.find(msg, self._position)
        if found < 0:
            where = "" if self._position == 0 else " after the previous texts"
            raise AssertionError(f"'{msg}' was not found in output{where}")
        self._position = found + len(msg)


@contextmanager
def assertSequentialStdout(
    proc_output: Any, process: str | ExecuteLocal | None, cmd_args: Any = None
) -> Iterator[SequentialTextChecker]:
    """Yield a checker for strings that one process wrote to standard output in order.

    Args:
        proc_output: The output of the processes.
        process: The action, or a part of the name of the process.
        cmd_args: Arguments that the command must contain, or `NO_CMD_ARGS`.

    Raises:
        NoMatchingProcessException: No process matches, or several do.
    """
    action = resolveProcesses(proc_output, process=process, cmd_args=cmd_args, strict_proc_matching=True)[0]
    yield SequentialTextChecker(
        [event.text.decode(errors="replace") for event in proc_output[action] if event.from_stdout]
    )
