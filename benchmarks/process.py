# SPDX-License-Identifier: Apache-2.0
"""Contenders that run in other processes and other Pythons."""

import contextlib
import functools
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

ROOT = Path(__file__).parents[1]
Python = tuple[str, ...]
"""The command that starts a Python."""
OWN_PYTHON: Python = (sys.executable, "-E")
"""Ignores PYTHONPATH, because a sourced ROS sets it for another Python."""


class PeerError(Exception):
    """An installed peer failed."""


TIME_LIMIT_S = 120.0
"""The time that a sample of another program may take."""


class Worker:
    """A process that times the statements of a module."""

    def __init__(self, python: Python, module: str, time_limit: float = TIME_LIMIT_S) -> None:
        self._time_limit = time_limit
        command = [*python, "-m", "benchmarks.worker", module]
        self._errors = tempfile.TemporaryFile("w+")  # noqa: SIM115 - closed by close()
        self._process = subprocess.Popen(
            command, cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._errors, text=True
        )

    def sample(self, request: str) -> float:
        """Request one more sample of a statement: JSON, `[function, argument, ...]`."""
        assert self._process.stdin
        assert self._process.stdout
        with contextlib.suppress(BrokenPipeError):  # If the process has ended, the read below reports it.
            self._process.stdin.write(request + "\n")
            self._process.stdin.flush()
        # A program that does not answer is ended, and its output with it.
        limit = threading.Timer(self._time_limit, self._process.kill)
        limit.start()
        answer = self._process.stdout.readline()
        limit.cancel()
        if not answer and self._process.wait() == -signal.SIGKILL:
            raise PeerError(f"ended after {self._time_limit:g} s, waiting for the result of {request[:200]}")
        if not answer:
            self._errors.seek(0)
            raise PeerError(last_line(self._errors.read()) or f"exit status {self._process.wait()}")
        result: dict[str, Any] = json.loads(answer)
        if "error" in result:
            raise PeerError(result["error"])
        return float(result["sample"])

    def close(self) -> None:
        self._process.communicate()
        self._errors.close()


class RemoteStatement:
    """A statement of the module of a worker."""

    def __init__(self, worker: Worker, function: str, *arguments: Any) -> None:
        self._worker = worker
        self._request = json.dumps([function, *arguments])

    def sample(self) -> float:
        return self._worker.sample(self._request)


class Program:
    """A program that prints numbers; a sample is one of the numbers of a run, by default the first."""

    def __init__(
        self,
        *arguments: str,
        python: Python = OWN_PYTHON,
        environment: Mapping[str, str] = MappingProxyType({}),
        time_limit: float = TIME_LIMIT_S,
    ) -> None:
        self._command = [*python, *arguments]
        self._environment = {**os.environ, **environment}
        self._time_limit = time_limit

    def sample(self, number: int = 0) -> float:
        return self.samples()[number]

    def samples(self) -> list[float]:
        """Return all numbers of one run."""
        try:
            done = subprocess.run(
                self._command,
                cwd=ROOT,
                env=self._environment,
                capture_output=True,
                text=True,
                check=False,
                timeout=self._time_limit,
            )
        except subprocess.TimeoutExpired as error:
            waiting_for = last_line(_text(error.stderr)) or "the end of the program"
            raise PeerError(
                f"ended after {self._time_limit:g} s, waiting for {waiting_for}: {' '.join(self._command)[:200]}"
            ) from None
        if done.returncode:
            raise PeerError(last_line(done.stderr) or f"exit status {done.returncode}")
        return [float(word) for word in done.stdout.split()]


@functools.lru_cache
def can_import(python: Python, *modules: str) -> bool:
    """Return whether a Python exists and has these modules."""
    if not Path(python[0]).exists():
        return False
    probe = subprocess.run([*python, "-c", f"import {', '.join(modules)}"], capture_output=True, check=False)
    return probe.returncode == 0


def _text(output: bytes | str | None) -> str:
    return output.decode(errors="replace") if isinstance(output, bytes) else output or ""


def last_line(text: str) -> str:
    """Return the last line of a text, such as a traceback; "" if it is empty."""
    return text.strip().rpartition("\n")[2]
