# SPDX-License-Identifier: Apache-2.0
"""A student's program as a process with limits: it is someone else's code, and may do anything."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import time
from typing import TYPE_CHECKING

from coframe.course import processes

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["MAX_MEMORY", "MAX_OUTPUT", "MAX_PROCESSES", "Program"]

MAX_MEMORY = 1 << 30  # bytes of one process
MAX_OUTPUT = 10 << 20  # bytes of the output, and of each file that it writes
MAX_PROCESSES = 8
_TOO_MUCH_OUTPUT = f"The program printed more than {MAX_OUTPUT >> 20} MB and was ended."
MAX_CPU = 120  # seconds of processor time
_STOP_PATIENCE = 3.0  # seconds between SIGINT and SIGKILL
_LAST_LINES = 8
_CHECK_PERIOD = 0.25  # seconds between two looks at its memory and processes
# Variables of this process that a submission may see. All others may contain secrets of the teacher.
_PASSED = (
    "AMENT_PREFIX_PATH",
    "COFRAME_ISOLATED",
    "CYCLONEDDS_URI",
    "LANG",
    "LD_LIBRARY_PATH",
    "PATH",
    "PYTHONPATH",
    "RMW_IMPLEMENTATION",
    "ROS_AUTOMATIC_DISCOVERY_RANGE",
    "ROS_DISTRO",
    "ROS_DOMAIN_ID",
    "ROS_LOCALHOST_ONLY",
    "SYSTEMROOT",
    "VIRTUAL_ENV",
)


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
            scratch: A folder for its output and its temporary files.
        """
        self.file = file
        self.violation = ""
        self._scratch = scratch
        self._log = scratch / f"{file.stem}.log"
        self._process: subprocess.Popen[bytes] | None = None
        self._checked = 0.0
        self._exit_code: int | None = None

    def start(self) -> None:
        """Start the program with the simulated clock."""
        environment = {name: os.environ[name] for name in _PASSED if name in os.environ}
        home = str(self._scratch)
        environment |= {
            "HOME": home,
            "TMPDIR": home,
            "PYTHONUNBUFFERED": "1",
            "PYTHONDONTWRITEBYTECODE": "1",
            "ROS_LOG_DIR": home,
        }
        limits = (str(MAX_MEMORY), str(MAX_OUTPUT), str(MAX_CPU))
        with self._log.open("wb") as log:
            self._process = subprocess.Popen(  # noqa: S603 - the purpose of the lab; limits.py describes what protects
                [
                    sys.executable,
                    "-m",
                    "coframe.course.limits",
                    *limits,
                    str(self.file),
                    "--ros-args",
                    "-p",
                    "use_sim_time:=true",
                ],
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                cwd=self.file.parent,
                env=environment,
                start_new_session=True,  # Ctrl-C reaches the grader only, and all its processes are one group.
            )

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
        return (
            f"The program ended with an error: {error[:200]}" if error else f"The program ended with exit code {code}."
        )

    def last_lines(self) -> list[str]:
        """Return the last lines of its output."""
        try:
            with self._log.open("rb") as log:
                log.seek(0, os.SEEK_END)
                log.seek(max(0, log.tell() - 4000))
                return log.read().decode(errors="replace").splitlines()[-_LAST_LINES:]
        except OSError:
            return []

    def _exceeded(self) -> str:
        assert self._process is not None
        if self._log.stat().st_size >= MAX_OUTPUT:
            return _TOO_MUCH_OUTPUT
        group = processes.in_session(self._process.pid)
        if len(group) > MAX_PROCESSES:
            return f"The program started more than {MAX_PROCESSES} processes and was ended."
        if sum(each.memory for each in group) > MAX_MEMORY:
            return f"The program used more than {MAX_MEMORY >> 20} MB of memory and was ended."
        return ""

    def _kill(self) -> None:
        assert self._process is not None
        for each in processes.in_session(self._process.pid):
            processes.kill(each.pid)
        processes.kill_group(self._process.pid)
        self._process.kill()
        self._process.wait()
