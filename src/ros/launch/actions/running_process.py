# SPDX-License-Identifier: Apache-2.0
"""A child process in a group of its own: its start, its output, and signals to the whole group."""

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

_GRACE = 0.5  # seconds in which output may still arrive after the process has ended
_CHUNK = 65536  # bytes


class RunningProcess:
    """A child process; on POSIX it leads a process group, to which also its own children belong.

    Ctrl-C in the terminal therefore reaches only the launcher, which then sends SIGINT to all groups.
    """

    def __init__(
        self, process: asyncio.subprocess.Process, readers: dict[str, asyncio.StreamReader], transports: list[Any]
    ) -> None:
        self._process = process
        self._readers = readers
        self._transports = transports

    @classmethod
    async def start(
        cls, command: list[str] | str, *, cwd: str | None, env: dict[str, str], emulate_tty: bool
    ) -> RunningProcess:
        """Start a command; a text is run by the shell.

        Raises:
            OSError: The command cannot be started.
        """
        terminals: dict[str, tuple[int, int]] = {}
        options: dict[str, Any] = {"cwd": cwd, "env": env, "stdin": subprocess.PIPE}
        if sys.platform == "win32":
            options["creationflags"] = subprocess.CREATE_NEW_PROCESS_GROUP
        else:
            options["start_new_session"] = True
            if emulate_tty:
                terminals = {"stdout": os.openpty(), "stderr": os.openpty()}
        for stream in ("stdout", "stderr"):
            options[stream] = terminals[stream][1] if stream in terminals else subprocess.PIPE
        try:
            if isinstance(command, str):
                process = await asyncio.create_subprocess_shell(command, **options)
            else:
                process = await asyncio.create_subprocess_exec(*command, **options)
        except BaseException:
            for controller, _ in terminals.values():
                os.close(controller)
            raise
        finally:
            for _, terminal in terminals.values():
                os.close(terminal)
        readers, transports = {}, []
        for stream, (controller, _) in terminals.items():
            readers[stream], transport = await _reader(controller)
            transports.append(transport)
        if not terminals:
            assert process.stdout is not None
            assert process.stderr is not None
            readers = {"stdout": process.stdout, "stderr": process.stderr}
        return cls(process, readers, transports)

    @property
    def pid(self) -> int:
        """The id of the process, which is that of its group."""
        return self._process.pid

    @property
    def is_running(self) -> bool:
        """Whether the process has not ended."""
        return self._process.returncode is None

    async def wait(self, on_output: Callable[[str, bytes], None]) -> int:
        """Pass all output to a function, wait for the end, and return the exit code."""
        tasks = [asyncio.ensure_future(_read(reader, stream, on_output)) for stream, reader in self._readers.items()]
        try:
            code = await self._process.wait()
            # A grandchild may hold the other end of a pipe for longer.
            await asyncio.wait(tasks, timeout=_GRACE)
        finally:
            for task in tasks:
                task.cancel()
            for transport in self._transports:
                transport.close()
        return code

    def write(self, data: bytes) -> None:
        """Write to the standard input."""
        if self._process.stdin is not None:
            self._process.stdin.write(data)

    def send_signal(self, number: int) -> None:
        """Send a signal to the process and to all its children; nothing happens if they have ended."""
        with contextlib.suppress(ProcessLookupError, PermissionError):
            if sys.platform != "win32":
                os.killpg(self.pid, number)
            elif self.is_running:
                is_interrupt = number in {signal.SIGINT, signal.CTRL_BREAK_EVENT}
                self._process.send_signal(signal.CTRL_BREAK_EVENT if is_interrupt else signal.SIGTERM)

    def has_children(self) -> bool:
        """Return whether a process of the group is still there although its leader has ended."""
        if sys.platform == "win32":
            return False
        try:
            os.killpg(self.pid, 0)
        except (ProcessLookupError, PermissionError):
            return False
        return True


async def _reader(controller: int) -> tuple[asyncio.StreamReader, Any]:
    loop = asyncio.get_running_loop()
    reader = asyncio.StreamReader()
    file = os.fdopen(controller, "rb", buffering=0)
    transport, _ = await loop.connect_read_pipe(lambda: asyncio.StreamReaderProtocol(reader), file)
    return reader, transport


async def _read(reader: asyncio.StreamReader, stream: str, on_output: Callable[[str, bytes], None]) -> None:
    # Linux reports the end of a terminal as an input/output error.
    with contextlib.suppress(OSError):
        while data := await reader.read(_CHUNK):
            on_output(stream, data)
