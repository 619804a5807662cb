"""Contenders in Pythons of their own."""

import contextlib
import functools
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

ROOT = Path(__file__).parents[1]
Python = tuple[str, ...]
"""A command that starts one."""
OWN_PYTHON: Python = (sys.executable, "-E")
"""Without PYTHONPATH: what a sourced ROS puts there is for another Python."""


class PeerError(Exception):
    """A peer that is there did not do its work."""


class Worker:
    """A process that times the statements of a module; its statements go when it goes."""

    def __init__(self, python: Python, module: str) -> None:
        command = [*python, "-m", "benchmarks.worker", module]
        self._complaints = tempfile.TemporaryFile("w+")  # noqa: SIM115 - closed by close()
        self._process = subprocess.Popen(
            command, cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._complaints, text=True
        )

    def sample(self, question: str) -> float:
        """Asks for one more sample of a statement: JSON, `[function, argument, ...]`."""
        assert self._process.stdin
        assert self._process.stdout
        with contextlib.suppress(BrokenPipeError):  # it has ended: there is no answer either
            self._process.stdin.write(question + "\n")
            self._process.stdin.flush()
        answer = self._process.stdout.readline()
        if not answer:
            self._complaints.seek(0)
            raise PeerError(last_line(self._complaints.read()) or f"exit status {self._process.wait()}")
        told: dict[str, Any] = json.loads(answer)
        if "error" in told:
            raise PeerError(told["error"])
        return float(told["sample"])

    def close(self) -> None:
        self._process.communicate()
        self._complaints.close()


class RemoteStatement:
    """A statement of a worker's module."""

    def __init__(self, worker: Worker, function: str, *arguments: Any) -> None:
        self._worker = worker
        self._question = json.dumps([function, *arguments])

    def sample(self) -> float:
        return self._worker.sample(self._question)


class Program:
    """A program that prints numbers: in each run the first one, unless told otherwise, is a sample."""

    def __init__(
        self, *arguments: str, python: Python = OWN_PYTHON, environment: Mapping[str, str] = MappingProxyType({})
    ) -> None:
        self._command = [*python, *arguments]
        self._environment = {**os.environ, **environment}

    def sample(self, number: int = 0) -> float:
        return self.samples()[number]

    def samples(self) -> list[float]:
        """All of one run."""
        done = subprocess.run(
            self._command, cwd=ROOT, env=self._environment, capture_output=True, text=True, check=False
        )
        if done.returncode:
            raise PeerError(last_line(done.stderr) or f"exit status {done.returncode}")
        return [float(word) for word in done.stdout.split()]


@functools.lru_cache
def can_import(python: Python, *modules: str) -> bool:
    """Whether a Python is there and has these modules."""
    if not Path(python[0]).exists():
        return False
    probe = subprocess.run([*python, "-c", f"import {', '.join(modules)}"], capture_output=True, check=False)
    return probe.returncode == 0


def last_line(text: str) -> str:
    """What a traceback ends with; "" if there is nothing."""
    return text.strip().rpartition("\n")[2]
