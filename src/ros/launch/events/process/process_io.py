# SPDX-License-Identifier: Apache-2.0
"""Events of the input and output of processes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.events.process.process_targeted_event import ProcessTargetedEvent
from launch.events.process.running_process_event import RunningProcessEvent

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.actions.execute_local import ExecuteLocal

__all__ = ["ProcessIO", "ProcessStderr", "ProcessStdin", "ProcessStdout"]


class ProcessIO(RunningProcessEvent):
    """A process has written something."""

    name = "launch.events.process.ProcessIO"

    def __init__(
        self,
        *,
        text: bytes,
        fd: int,
        action: ExecuteLocal,
        name: str,
        cmd: list[str],
        cwd: str | None,
        env: dict[str, str] | None,
        pid: int,
    ) -> None:
        super().__init__(action=action, name=name, cmd=cmd, cwd=cwd, env=env, pid=pid)
        self.__text = text
        self.__fd = fd

    @property
    def text(self) -> bytes:
        """The written text."""
        return self.__text

    @property
    def fd(self) -> int:
        """The stream: 1 for standard output, 2 for standard error."""
        return self.__fd

    @property
    def from_stdin(self) -> bool:
        """Whether this is input of the process."""
        return self.__fd == 0

    @property
    def from_stdout(self) -> bool:
        """Whether the process wrote to standard output."""
        return self.__fd == 1

    @property
    def from_stderr(self) -> bool:
        """Whether the process wrote to standard error."""
        return self.__fd == 2


class ProcessStdout(ProcessIO):
    """A process has written to standard output."""

    name = "launch.events.process.ProcessStdout"


class ProcessStderr(ProcessIO):
    """A process has written to standard error."""

    name = "launch.events.process.ProcessStderr"


class ProcessStdin(ProcessTargetedEvent):
    """A request to write to the standard input of a process."""

    name = "launch.events.process.ProcessStdin"

    def __init__(self, *, text: bytes, process_matcher: Callable[[ExecuteLocal], bool]) -> None:
        super().__init__(process_matcher=process_matcher)
        self.__text = text

    @property
    def text(self) -> bytes:
        """The text to write."""
        return self.__text

    @property
    def fd(self) -> int:
        """The stream: 0 for standard input."""
        return 0
