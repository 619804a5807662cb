# SPDX-License-Identifier: Apache-2.0
"""A student's program as a process with limits: it is someone else's code, and may do anything."""

from __future__ import annotations

import contextlib
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

from coframe.course import processes
from coframe.course.isolation import PASSED
from coframe.course.readable import readable_paths

__all__ = ["HOMES", "MAX_FILES", "MAX_MEMORY", "MAX_OUTPUT", "MAX_PROCESSES", "Program"]

HOMES = "home"  # the folder for the home folders of all programs
MAX_MEMORY = 1 << 30  # bytes of all its processes
MAX_OUTPUT = 10 << 20  # bytes of the output, and of each file that it writes
MAX_FILES = 100 << 20  # bytes of all files that it writes
MAX_PROCESSES = 8
_MOST_FILES = 10_000
_ADDRESS_SPACE = 8 * MAX_MEMORY  # threads and libraries reserve more than they use
_TOO_MUCH_OUTPUT = f"The program printed more than {MAX_OUTPUT >> 20} MB and was ended."
MAX_CPU = 120  # seconds of processor time
_STOP_PATIENCE = 3.0  # seconds between SIGINT and SIGKILL
_LAST_LINES = 8
_TRACEBACK_LINE = re.compile(r'^  File "([^"\n]{1,1000})", line (\d{1,7})', re.MULTILINE)
_LIMITS = Path(__file__).with_name("limits.py")
_KILL_ROUNDS = 50
_BLOCK = 512  # bytes of a block, in which the system counts the size of a file
_CHECK_PERIOD = 0.25  # seconds between two looks at its memory and processes


class Program:
    """A program in a student's folder.

    Attributes:
        file: The program.
        violation: A sentence about the limit that it has exceeded, or about why it cannot be checked; "" if there is
            none.
    """

    def __init__(self, file: Path, scratch: Path) -> None:
        """Prepare a program.

        Args:
            file: The program.
            scratch: A folder for its output; its folder ``home`` is for the home folders of all programs, the only ones
                in which they can create files.
        """
        self.file = file
        self.violation = ""
        self._home = scratch / HOMES / file.stem
        self._log = scratch / f"{file.stem}.log"
        self._process: subprocess.Popen[bytes] | None = None
        self._checked = 0.0
        self._others: set[int] = set()  # processes of the grader, such as that of the recording
        self._exit_code: int | None = None

    def start(self) -> None:
        """Start the program with the simulated clock."""
        self._home.mkdir(parents=True, exist_ok=True)
        home = str(self._home)
        environment = {name: os.environ[name] for name in PASSED if name in os.environ}
        environment |= {
            "HOME": home,
            "TMPDIR": home,
            "PYTHONUNBUFFERED": "1",
            "PYTHONDONTWRITEBYTECODE": "1",
            "ROS_LOG_DIR": home,
        }
        self._others = processes.children()
        with self._log.open("wb") as log:
            self._process = subprocess.Popen(  # noqa: S603 - the purpose of the lab; limits.py describes what protects
                [*self._limited_python(), str(self.file), "--ros-args", "-p", "use_sim_time:=true"],
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                cwd=self.file.parent,
                env=environment,
                start_new_session=True,  # Ctrl-C reaches the grader only, and all its processes are one group.
            )

    def _limited_python(self) -> list[str]:
        """Return the words that start Python with limits; without limits on Windows, which has none of them."""
        if os.name != "posix":
            return [sys.executable]
        numbers = (str(MAX_OUTPUT), str(MAX_CPU), str(_ADDRESS_SPACE))
        readable = os.pathsep.join(readable_paths(self.file.parent))
        return [sys.executable, "-I", "-S", str(_LIMITS), *numbers, str(self._home), readable]

    def is_running(self) -> bool:
        """Return whether the program runs; a program that has exceeded a limit is ended here."""
        if self._process is None or self._process.poll() is not None:
            return False
        if time.monotonic() - self._checked > _CHECK_PERIOD:
            self._checked = time.monotonic()
            self.violation = self.violation or self._exceeded()
            if self.violation:
                self._kill()
                return False
        return True

    def waiting_time(self) -> float:
        """Return how long the program and the grader have waited for a processor, in seconds."""
        own = processes.waiting_time(os.getpid())
        return own if self._process is None else own + processes.waiting_time(self._process.pid)

    def stop(self) -> None:
        """End the program and all processes that it has started."""
        process = self._process
        if process is None:
            return
        self._exit_code = process.poll()
        if self._exit_code is None:
            process.send_signal(signal.SIGINT if os.name == "posix" else signal.SIGTERM)
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(_STOP_PATIENCE)
        self._kill()
        self._process = None

    def crash(self) -> str:
        """Return a sentence about a program that ended by itself or was ended; "" if it ran until it was stopped."""
        if self.violation:
            return self.violation
        process = self._process
        code = self._exit_code if process is None else process.poll()
        if code is None:
            return ""
        if self._log.stat().st_size >= MAX_OUTPUT:
            return _TOO_MUCH_OUTPUT
        last = self.last_lines()
        if code == 0:
            return "The program ended by itself: it needs rclpy.spin(node)."
        error = next((line for line in reversed(last) if line.strip()), "")
        if code < 0:
            return f"The program was ended by signal {-code}."
        line = self._failed_line()
        place = f" in line {line} of {self.file.name}" if line else ""
        return (
            f"The program ended with an error{place}: {error[:200]}"
            if error
            else f"The program ended with exit code {code}."
        )

    def last_lines(self) -> list[str]:
        """Return the last lines of its output."""
        return self._end_of_output(4000).splitlines()[-_LAST_LINES:]

    def _failed_line(self) -> int | None:
        """Return the innermost line of the program in the last traceback: its end may be in other files."""
        _, found, traceback = self._end_of_output(40_000).rpartition("Traceback (most recent call last):")
        lines = _TRACEBACK_LINE.findall(traceback) if found else []
        return next((int(line) for name, line in reversed(lines) if Path(name).name == self.file.name), None)

    def _end_of_output(self, size: int) -> str:
        try:
            with self._log.open("rb") as log:
                log.seek(0, os.SEEK_END)
                log.seek(max(0, log.tell() - size))
                return log.read().decode(errors="replace")
        except OSError:
            return ""

    def _exceeded(self) -> str:
        assert self._process is not None
        if self._log.stat().st_size >= MAX_OUTPUT:
            return _TOO_MUCH_OUTPUT
        running = processes.descendants(without=self._others)
        if len(running) > MAX_PROCESSES:
            return f"The program started more than {MAX_PROCESSES} processes and was ended."
        if sum(each.memory for each in running) > MAX_MEMORY:
            return f"The program used more than {MAX_MEMORY >> 20} MB of memory and was ended."
        if processes.own_memory() > MAX_MEMORY:
            return "The program published more data than the check can store and was ended."
        if _is_larger(self._home, MAX_FILES):
            return f"The program wrote more than {MAX_FILES >> 20} MB or {_MOST_FILES} files and was ended."
        return ""

    def _kill(self) -> None:
        assert self._process is not None
        processes.kill_group(self._process.pid)
        self._process.kill()
        self._process.wait()
        for _ in range(_KILL_ROUNDS):  # One of them may start another one before it is killed.
            left = processes.descendants(without=self._others)
            if not left:
                break
            for each in left:
                processes.kill(each.pid)


def _is_larger(folder: Path, size: int) -> bool:
    """Return whether the files below a folder are larger than a size in bytes, or too many."""
    total = count = 0
    for path, _, names in os.walk(folder):
        for name in names:
            count += 1
            with contextlib.suppress(OSError):
                total += Path(path, name).lstat().st_blocks * _BLOCK
            if total > size or count > _MOST_FILES:
                return True
    return False
