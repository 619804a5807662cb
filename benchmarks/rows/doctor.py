# SPDX-License-Identifier: Apache-2.0
"""The doctor, on a recording of a million transforms, and live with ten thousand transforms per second."""

import functools
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Generator
from pathlib import Path

from benchmarks import large
from benchmarks.measuring import AtMost, Contender, Row, percent
from benchmarks.process import OWN_PYTHON, ROOT, PeerError, Program

TRANSFORMS = 1_000_000
SECONDS = "10"
LIMIT = 3e9  # nanoseconds


@functools.cache
def _folder() -> tempfile.TemporaryDirectory[str]:
    return tempfile.TemporaryDirectory()


@functools.cache
def recording() -> str:
    return str(large.mcap(Path(_folder().name) / "run.mcap", TRANSFORMS))


class Run:
    """The wall time or the processor time of a command, in nanoseconds."""

    def __init__(self, *arguments: str, of_processor: bool) -> None:
        self._command = [*OWN_PYTHON, *arguments]
        self._of_processor = of_processor

    def sample(self) -> float:
        begin = time.perf_counter_ns()
        process = subprocess.Popen(self._command, cwd=ROOT, stdout=subprocess.DEVNULL)
        _, status, used = os.wait4(process.pid, 0)
        wall = time.perf_counter_ns() - begin
        if os.waitstatus_to_exitcode(status) not in {0, 1}:  # 1: the doctor has findings
            raise PeerError(f"exit status {status}")
        return 1e9 * (used.ru_utime + used.ru_stime) if self._of_processor else wall


def recorded(clock: str) -> Row:
    def contenders() -> Generator[Contender]:
        doctor = ("-m", "coframe.cli", "doctor", recording())
        yield Run(*doctor, of_processor=clock == "processor")
        opening = "import coframe, sys; coframe.open_bag(sys.argv[1])"
        yield Run("-c", opening, recording(), of_processor=clock == "processor")

    name = f"coframe doctor, MCAP of 1e6 transforms, {clock}"
    return Row(name, "floor: open_bag only", contenders, AtMost(LIMIT), least=3, processors=2)


def live() -> Row:
    def contenders() -> Generator[Contender]:
        yield Program("-m", "benchmarks.doctor", SECONDS)
        yield Program("-m", "benchmarks.wire_latency", "cpu", "coframe", "3", sys.executable)

    name = "coframe doctor --watch, 1 kHz x 10, CPU of one core"
    return Row(name, "floor: a listening buffer", contenders, AtMost(5.0), percent, least=2, processors=2)


ROWS = [recorded("wall clock"), recorded("processor"), live()]
