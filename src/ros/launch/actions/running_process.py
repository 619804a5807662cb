# SPDX-License-Identifier: Apache-2.0
"""A child process in its own group: its start, its output, and signals to the whole group."""

from __future__ import annotations

import asyncio
import contextlib
import os
import signal
import subprocess
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["RunningProcess"]

_REST_OF_LINE = 0.02  # seconds in which the rest of a line may arrive
_GRACE = 0.5  # seconds in which output may still arrive after the process has ended
_STREAMS = {1: "stdout", 2: "stderr"}


class RunningProcess(asyncio.SubprocessProtocol):
    """A child process. On POSIX it leads a process group, which also contains its own children.

    Ctrl-C in the terminal therefore reaches only the launcher, which then sends SIGINT to all groups.
    """

    def __init__(self) -> None:
        self._on_output: Callable[[str, bytes], None] | None = None
        self._early_output: list[tuple[str, bytes]] = []
        self._pending: dict[int, bytes] = {}
        self._timers: dict[int, asyncio.TimerHandle] = {}
        self._transport: Any = None
        self._terminals: list[asyncio.ReadTransport] = []
        self._open_streams = set(_STREAMS)
        self._exited = asyncio.Event()
        self._all_read = asyncio.Event()

    @classmethod
    async def start(
        cls, command: list[str] | str, *, cwd: str | None, env: dict[str, str], emulate_tty: bool
    ) -> RunningProcess:
        """Start a command. A string is run by the shell.

        Args:
            command: The words, or the text.
            cwd: Working directory.
            env: Environment.
            emulate_tty: Let its output be a terminal.

        Raises:
            OSError: The command cannot be started.
        """
        loop = asyncio.get_running_loop()
        options: dict[str, Any] = {"cwd": cwd, "env": env, "stdin": subprocess.PIPE}
        terminals: dict[int, tuple[int, int]] = {}
        if sys.platform == "win32":
            options["creationflags"] = subprocess.CREATE_NEW_PROCESS_GROUP
        else:
            options["start_new_session"] = True
            if emulate_tty:
                terminals = {fd: os.openpty() for fd in _STREAMS}
        for fd, stream in _STREAMS.items():
            options[stream] = terminals[fd][1] if terminals else subprocess.PIPE
        process = cls()
        try:
            if isinstance(command, str):
                process._transport, _ = await loop.subprocess_shell(lambda: process, command, **options)
            else:
                process._transport, _ = await loop.subprocess_exec(lambda: process, *command, **options)
        except BaseException:
            for controller, _ in terminals.values():
                os.close(controller)
            raise
        finally:
            for _, terminal in terminals.values():
                os.close(terminal)
        for fd, (controller, _) in terminals.items():
            await process._read_terminal(fd, controller)
        return process

    async def _read_terminal(self, fd: int, controller: int) -> None:
        loop = asyncio.get_running_loop()
        file = os.fdopen(controller, "rb", buffering=0)
        transport, _ = await loop.connect_read_pipe(lambda: _TerminalProtocol(self, fd), file)
        self._terminals.append(transport)

    def pipe_data_received(self, fd: int, data: bytes) -> None:
        """Forward output. If an unbuffered program writes a line and its end separately, join them."""
        self._pending[fd] = self._pending.get(fd, b"") + data
        if data.endswith(b"\n"):
            self._pass_on(fd)
        elif fd not in self._timers:
            self._timers[fd] = asyncio.get_running_loop().call_later(_REST_OF_LINE, self._pass_on, fd)

    def _pass_on(self, fd: int) -> None:
        """Pass pending output on, or keep it until :meth:`wait` is called."""
        if fd in self._timers:
            self._timers.pop(fd).cancel()
        data = self._pending.pop(fd, b"")
        if not data:
            return
        if self._on_output is None:
            self._early_output.append((_STREAMS[fd], data))
        else:
            self._on_output(_STREAMS[fd], data)

    def pipe_connection_lost(self, fd: int, exc: Exception | None) -> None:
        """Take note that a stream has ended."""
        del exc
        self._pass_on(fd)
        self._open_streams.discard(fd)
        if not self._open_streams:
            self._all_read.set()

    def process_exited(self) -> None:
        """Take note that the process has ended. Its streams may still be open in its children."""
        self._exited.set()

    @property
    def pid(self) -> int:
        """The ID of the process, which is also the ID of its group."""
        pid: int = self._transport.get_pid()
        return pid

    @property
    def is_running(self) -> bool:
        """Whether the process has not ended."""
        return not self._exited.is_set()

    async def wait(self, on_output: Callable[[str, bytes], None]) -> int:
        """Wait for the end of the process and of its output, and return the exit code.

        Args:
            on_output: Function that is called with the name of a stream and its bytes.
        """
        self._on_output = on_output
        for stream, data in self._early_output:
            on_output(stream, data)
        try:
            await self._exited.wait()
            # A child of the process may hold the other end of a pipe for longer.
            with contextlib.suppress(asyncio.TimeoutError):
                await asyncio.wait_for(self._all_read.wait(), _GRACE)
            for fd in _STREAMS:
                self._pass_on(fd)
            code: int = self._transport.get_returncode()
            return code
        finally:
            if self.is_running:  # The launch was cancelled.
                self.send_signal(getattr(signal, "SIGKILL", signal.SIGTERM))
            self._transport.close()
            for transport in self._terminals:
                transport.close()

    def write(self, data: bytes) -> None:
        """Write to the standard input."""
        pipe = self._transport.get_pipe_transport(0)
        if pipe is not None:
            pipe.write(data)

    def send_signal(self, number: int) -> None:
        """Send a signal to the process and to all its children, unless they have ended."""
        with contextlib.suppress(ProcessLookupError, PermissionError):
            if sys.platform != "win32":
                os.killpg(self.pid, number)
            elif self.is_running:
                is_interrupt = number in {signal.SIGINT, signal.CTRL_BREAK_EVENT}
                self._transport.send_signal(signal.CTRL_BREAK_EVENT if is_interrupt else signal.SIGTERM)

    def has_children(self) -> bool:
        """Return whether a process of the group is still there although its leader has ended."""
        if sys.platform == "win32":
            return False
        try:
            os.killpg(self.pid, 0)
        except (ProcessLookupError, PermissionError):
            return False
        return True


class _TerminalProtocol(asyncio.Protocol):
    """Forwards the terminal output of a process; Linux reports its end as an input/output error."""

    def __init__(self, process: RunningProcess, fd: int) -> None:
        self._process = process
        self._fd = fd

    def data_received(self, data: bytes) -> None:
        self._process.pipe_data_received(self._fd, data)

    def connection_lost(self, exc: Exception | None) -> None:
        self._process.pipe_connection_lost(self._fd, exc)
