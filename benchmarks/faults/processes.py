# SPDX-License-Identifier: Apache-2.0
"""The processes of a case."""

from __future__ import annotations

import contextlib
import itertools
import json
import os
import select
import signal
import socket
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path
from typing import TYPE_CHECKING, Any

from benchmarks.process import ROOT

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from benchmarks.faults.network import Host

# Shells start background jobs with Ctrl-C ignored, and the programs would inherit that.
signal.signal(signal.SIGINT, signal.default_int_handler)

PATIENCE = 60.0  # seconds; for programs that start on a busy machine
_domains = itertools.count(1)


class Program:
    """A child process. Its standard error goes to a file."""

    def __init__(self, command: list[str], environment: dict[str, str], *, quiet: bool = False) -> None:
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 - open as long as the process
        self.started = time.monotonic()
        self.process = subprocess.Popen(
            command,
            cwd=ROOT,
            env={**os.environ, **environment},
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL if quiet else subprocess.PIPE,
            stderr=self._errors,
            text=True,
        )

    def line(self) -> str:
        """Return the next line of its output."""
        assert self.process.stdout
        line = self.process.stdout.readline()
        if not line:
            raise RuntimeError(f"{self.process.args!r} ended: {self.errors()[-2000:]}")
        return line.rstrip("\n")

    def has_output(self) -> bool:
        """Return whether there is output to read."""
        assert self.process.stdout
        return bool(select.select([self.process.stdout], [], [], 0.0)[0])

    def tell(self, line: str = "") -> None:
        """Write a line to its input."""
        assert self.process.stdin
        self.process.stdin.write(f"{line}\n")
        self.process.stdin.flush()

    def ask(self, line: str = "") -> Any:
        """Write a line to its input, and return the JSON that it answers."""
        self.tell(line)
        return json.loads(self.line())

    def errors(self) -> str:
        """Return what it has written to standard error."""
        self._errors.seek(0)
        return self._errors.read().decode(errors="replace")

    def close(self) -> None:
        """Kill it if it is running."""
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()
        self._errors.close()


class Processes:
    """Starts processes in their own domain; closes them all at the end."""

    def __init__(self, environment: dict[str, str]) -> None:
        own = {"ROS_DOMAIN_ID": str(next(_domains)), "PYTHONUNBUFFERED": "1", "NO_COLOR": "1"}
        own["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
        self.environment = {**own, **environment}
        self._running: list[Program] = []

    def start(self, *command: str, host: Host | None = None, quiet: bool = False, **environment: str) -> Program:
        """Start a command, where "python" is this Python. Its output is lost if `quiet` is set."""
        words = [sys.executable if word == "python" else word for word in command]
        program = Program(host.command(*words) if host else words, {**self.environment, **environment}, quiet=quiet)
        self._running.append(program)
        return program

    def node(self, *arguments: object, host: Host | None = None, **environment: str) -> Program:
        """Start a program of `benchmarks.faults.programs`, and wait until it is ready."""
        command = ("python", "-m", "benchmarks.faults.programs", *map(str, arguments))
        program = self.start(*command, host=host, quiet=False, **environment)
        program.line()
        return program

    def forget(self, program: Program) -> None:
        """Do not close a program at the end."""
        self._running.remove(program)

    def close(self) -> None:
        """Kill what is running."""
        for program in self._running:
            program.close()


@contextlib.contextmanager
def processes(**environment: str) -> Iterator[Processes]:
    """Yield the processes of a case, which run with these environment variables."""
    started = Processes(environment)
    try:
        yield started
    finally:
        started.close()


def wait_for(condition: Callable[[], object], what: str, seconds: float = PATIENCE) -> float:
    """Wait until a condition holds, and return the duration in seconds."""
    begin = time.monotonic()
    while not condition():
        if time.monotonic() - begin > seconds:
            raise RuntimeError(f"timed out after {seconds:g} s waiting for {what}")
        time.sleep(0.01)
    return time.monotonic() - begin


def free_port() -> int:
    """Return a free TCP port."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def answers(port: int, viewer: Program) -> bool:
    """Return whether a viewer serves its page. Raise RuntimeError if the viewer has ended."""
    try:
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/", timeout=5) as page:
            return bool(page.status == 200)
    except OSError:
        if viewer.process.poll() is not None:
            raise RuntimeError(f"coframe view ended: {viewer.errors()}") from None
        return False


def descriptors(process: int) -> int:
    """Return the number of open file descriptors of a process."""
    return len(list(Path(f"/proc/{process}/fd").iterdir()))
