# SPDX-License-Identifier: Apache-2.0
"""Run a student's program as a process with limits, because it is untrusted code."""

from __future__ import annotations

import contextlib
import os
import re
import signal
import subprocess
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING

from coframe._process.own_group import own_group
from coframe.course import _processes
from coframe.course._confinement import MAX_MEMORY, MAX_OUTPUT
from coframe.course._patience import FairTimeout

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.course._confinement import Confinement

__all__ = ["HOMES", "MAX_FILES", "MAX_PROCESSES", "StudentProgram"]

HOMES = "home"  # the folder for the home folders of all programs
MAX_FILES = 100 << 20  # bytes of all files it writes
MAX_PROCESSES = 8
_MAX_FILES = 10_000
_OUTPUT_VIOLATION = f"The program printed more than {MAX_OUTPUT >> 20} MB and was stopped."
_STOP_TIMEOUT = 3.0  # seconds between SIGINT and SIGKILL
_KILLED = 9  # SIGKILL, which Windows does not have
_LAST_LINES = 8
_TRACEBACK_LINE = re.compile(r'^  File "([^"\n]{1,1000})", line (\d{1,7})', re.MULTILINE)
_EXCEPTION = re.compile(r"[A-Za-z_][\w.]{0,200}(?:: |$)")  # not indented, in contrast to the lines of the code
_MAX_KILL_ATTEMPTS = 50
_SIGNAL_OFFSET = 128  # added to the number of the signal that ended a program in namespaces
_BLOCK_BYTES = 512  # bytes per block, the unit of file sizes on disk
_POLL_PERIOD = 0.01  # seconds
_CHECK_PERIOD = 0.25  # seconds between two checks of its memory and processes


class StudentProgram:
    """A program in a student's folder.

    Attributes:
        file: The program.
        violation: The limit that it exceeded, or the reason why it cannot be checked, or "" if there is none.
    """

    def __init__(self, file: Path, scratch: Path, confinement: Confinement) -> None:
        """Prepare a program.

        Args:
            file: The program.
            scratch: A folder for its output; ``home`` in it contains the home folders of all programs, the only ones in
                which they can create files.
            confinement: The restrictions of the program.
        """
        self.file = file
        self.violation = ""
        self._confinement = confinement
        self._home_folder = scratch / HOMES / file.stem
        self._log = scratch / f"{file.stem}.log"
        self._process: subprocess.Popen[bytes] | None = None
        self._main_process: int | None = None  # the process that runs the student's code
        self._checked_at = 0.0
        self._grader_processes: list[int] = []  # processes of the grader, such as the recorder
        self._exit_code: int | None = None

    def start(self, *words: str, request: bytes = b"") -> None:
        """Start the program with the simulated clock, or with other arguments of ``python``.

        Args:
            words: The arguments of ``python``; without any, the program starts with the simulated clock.
            request: The standard input.
        """
        self._home_folder.mkdir(parents=True, exist_ok=True)
        words = words or (str(self.file), "--ros-args", "-p", "use_sim_time:=true")
        self._grader_processes = _processes.children()
        with self._log.open("wb") as log, tempfile.TemporaryFile() as given:
            given.write(request)
            given.seek(0)
            self._process = subprocess.Popen(  # noqa: S603 - the purpose of the lab; _confinement.py describes what protects
                self._confinement.command(self._home_folder, *words),
                stdin=given if request else subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                cwd=self._confinement.working_folder,
                env=self._confinement.environment(self._home_folder),
                **own_group(),  # Only the grader receives Ctrl-C, and all its processes are one group.
            )

    def run(self, seconds: float, words: Sequence[str], request: bytes) -> int:
        """Run it with other arguments of ``python``, and return its exit code.

        Args:
            seconds: The time limit; see Patience.
            words: The arguments of ``python``.
            request: The standard input.
        """
        self.start(*words, request=request)
        patience = FairTimeout(seconds, self.waiting_time)
        try:
            while self.is_running():
                if patience.is_over():
                    self.violation = f"{self.file.name} takes longer than the maximum of {seconds:g} s."
                    break
                time.sleep(_POLL_PERIOD)
        finally:
            self.stop()
        return -_KILLED if self._exit_code is None else self._exit_code

    def is_running(self) -> bool:
        """Return whether the program is running, and end it if it has exceeded a limit."""
        if self._process is None or self._process.poll() is not None:
            return False
        if time.monotonic() - self._checked_at > _CHECK_PERIOD:
            self._checked_at = time.monotonic()
            self.violation = self.violation or self._exceeded_limit()
            if self.violation:
                self._kill()
                return False
        return True

    def waiting_time(self) -> float:
        """Return how long the program and the grader have waited for a processor, in seconds."""
        own = _processes.waiting_time(os.getpid())
        main = self._find_main()
        return own if main is None else own + _processes.waiting_time(main)

    def stop(self) -> None:
        """End the program and all processes that it started."""
        process = self._process
        if process is None:
            return
        self._exit_code = process.poll()
        if self._exit_code is None:
            self._interrupt(process)
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(_STOP_TIMEOUT)
        self._kill()
        self._process = None

    def _interrupt(self, process: subprocess.Popen[bytes]) -> None:
        if os.name != "posix":
            process.terminate()
        elif main := self._find_main():
            with contextlib.suppress(ProcessLookupError):
                os.kill(main, signal.SIGINT)

    def _find_main(self) -> int | None:
        """Return the process of the student's code (a grandchild if it has namespaces), or None before it exists."""
        if self._main_process is None and self._process is not None:
            if not self._confinement.has_namespaces:
                self._main_process = self._process.pid
            elif (first := self._first_process()) is not None:
                self._main_process = next(iter(_processes.children(first)), None)
        return self._main_process

    def _first_process(self) -> int | None:
        """Return the first process in the namespaces of the program, the parent of all others."""
        assert self._process is not None
        return next(iter(_processes.children(self._process.pid)), None)

    def attempt(self) -> str:
        """Return a message if the program tried to use solutions of the lab, or "" if it did not."""
        return self._confinement.attempt(self.output())

    def output(self) -> bytes:
        """Return the complete output of the program."""
        try:
            return self._log.read_bytes()
        except OSError:
            return b""

    def crash_reason(self) -> str:
        """Return why a program exited prematurely, or "" if it ran until it was stopped."""
        if self.violation:
            return self.violation
        process = self._process
        code = self._exit_code if process is None else process.poll()
        if code is None:
            return ""
        if self._log.stat().st_size >= MAX_OUTPUT:
            return _OUTPUT_VIOLATION
        last = self.last_lines()
        if code == 0:
            return "The program exited by itself. Call rclpy.spin(node)."
        error = self._exception() or next((line for line in reversed(last) if line.strip()), "")
        if code < 0 or code > _SIGNAL_OFFSET:
            return f"The program was terminated by signal {-code if code < 0 else code - _SIGNAL_OFFSET}."
        line = self._failed_line()
        place = f" in line {line} of {self.file.name}" if line else ""
        return (
            f"The program exited with an error{place}: {error[:200]}"
            if error
            else f"The program exited with exit code {code}."
        )

    def last_lines(self) -> list[str]:
        """Return the last lines of its output."""
        return self._end_of_output(4000).splitlines()[-_LAST_LINES:]

    def _failed_line(self) -> int | None:
        """Return the innermost line of the program in the last traceback, which may end in other files."""
        _, found, traceback = self._end_of_output(40_000).rpartition("Traceback (most recent call last):")
        lines = _TRACEBACK_LINE.findall(traceback) if found else []
        return next((int(line) for name, line in reversed(lines) if Path(name).name == self.file.name), None)

    def _exception(self) -> str:
        """Return the exception of the last traceback, with the first line of its message, or "" if there is none."""
        _, found, traceback = self._end_of_output(40_000).rpartition("Traceback (most recent call last):")
        lines = traceback.splitlines()[1:] if found else []
        exception_lines = (line for line in lines if _EXCEPTION.match(line))
        return next(exception_lines, "")

    def _end_of_output(self, size: int) -> str:
        try:
            with self._log.open("rb") as log:
                log.seek(0, os.SEEK_END)
                log.seek(max(0, log.tell() - size))
                return log.read().decode(errors="replace")
        except OSError:
            return ""

    def _exceeded_limit(self) -> str:
        assert self._process is not None
        if self._log.stat().st_size >= MAX_OUTPUT:
            return _OUTPUT_VIOLATION
        running = self._running_processes()
        if len(running) > MAX_PROCESSES:
            return f"The program started more than {MAX_PROCESSES} processes and was stopped."
        if sum(each.memory for each in running) + _processes.shared_memory(running) > MAX_MEMORY:
            return f"The program used more than {MAX_MEMORY >> 20} MB of memory and was stopped."
        if _processes.own_memory() > MAX_MEMORY:
            return "The program published more data than the check can store and was stopped."
        if _is_larger(self._home_folder, MAX_FILES):
            return f"The program wrote more than {MAX_FILES >> 20} MB or {_MAX_FILES} files and was stopped."
        return ""

    def _running_processes(self) -> list[_processes.Process]:
        """Return the processes of the program, except those that confine it."""
        if not self._confinement.has_namespaces:
            return _processes.descendants(without=self._grader_processes)
        first = self._first_process()
        return [] if first is None else _processes.descendants(of=first)

    def _kill(self) -> None:
        assert self._process is not None
        _processes.kill_group(self._process.pid)
        self._process.kill()
        self._process.wait()
        for _ in range(_MAX_KILL_ATTEMPTS):  # A process may start another one before it is killed.
            left = _processes.descendants(without=self._grader_processes)
            if not left:
                break
            for each in left:
                _processes.kill(each.pid)


def _is_larger(folder: Path, size: int) -> bool:
    """Return whether the files below a folder exceed a total size in bytes or a maximum number."""
    total = count = 0
    for path, _, names in os.walk(folder):
        for name in names:
            count += 1
            with contextlib.suppress(OSError):
                total += Path(path, name).lstat().st_blocks * _BLOCK_BYTES
            if total > size or count > _MAX_FILES:
                return True
    return False
