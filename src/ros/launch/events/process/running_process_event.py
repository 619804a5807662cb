# SPDX-License-Identifier: Apache-2.0
"""Events of a process that was started."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.event import Event

if TYPE_CHECKING:
    from launch.actions.execute_local import ExecuteLocal

__all__ = ["ProcessExited", "ProcessStarted", "RunningProcessEvent"]


class RunningProcessEvent(Event):
    """Base class: the facts about a started process."""

    name = "launch.events.process.RunningProcessEvent"

    def __init__(
        self,
        *,
        action: ExecuteLocal,
        name: str,
        cmd: list[str],
        cwd: str | None,
        env: dict[str, str] | None,
        pid: int,
    ) -> None:
        self.__action = action
        self.__name = name
        self.__cmd = cmd
        self.__cwd = cwd
        self.__env = env
        self.__pid = pid

    @property
    def action(self) -> ExecuteLocal:
        """The action that started the process."""
        return self.__action

    @property
    def execute_process_action(self) -> ExecuteLocal:
        """The former name of `action`."""
        return self.__action

    @property
    def process_name(self) -> str:
        """The name of the process, such as ``talker-1``."""
        return self.__name

    @property
    def cmd(self) -> list[str]:
        """The words of the command."""
        return self.__cmd

    @property
    def cwd(self) -> str | None:
        """The working directory, or None for the current one."""
        return self.__cwd

    @property
    def env(self) -> dict[str, str] | None:
        """The environment."""
        return self.__env

    @property
    def pid(self) -> int:
        """The id of the process."""
        return self.__pid


class ProcessStarted(RunningProcessEvent):
    """A process was started."""

    name = "launch.events.process.ProcessStarted"


class ProcessExited(RunningProcessEvent):
    """A process has ended."""

    name = "launch.events.process.ProcessExited"

    def __init__(
        self,
        *,
        returncode: int,
        action: ExecuteLocal,
        name: str,
        cmd: list[str],
        cwd: str | None,
        env: dict[str, str] | None,
        pid: int,
    ) -> None:
        super().__init__(action=action, name=name, cmd=cmd, cwd=cwd, env=env, pid=pid)
        self.__returncode = returncode

    @property
    def returncode(self) -> int:
        """The exit code; minus the number of the signal that ended the process."""
        return self.__returncode
