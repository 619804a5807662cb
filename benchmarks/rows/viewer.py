# SPDX-License-Identifier: Apache-2.0
"""The server of the viewer: the cost of a tab at 30 Hz, and the time until the first frame update."""

from collections.abc import Generator

from benchmarks.measuring import AtMost, Contender, Row, percent
from benchmarks.process import Program

SECONDS = "4"
LIMITS = {10: 3.0, 100: 3.0, 1000: 5.0}
"""Percent of one core in addition to the lookups, by the number of frames."""
IMPORTS = """
import time
begin = time.monotonic_ns()
import numpy, click, cyclonedds.internal
print(time.monotonic_ns() - begin)
"""


class Lookups:
    """The second result of the same program."""

    def __init__(self, frames: int) -> None:
        self._program = Program("-m", "benchmarks.viewer_load", str(frames), "1")

    def sample(self) -> float:
        return self._program.sample(1)


def row(frames: int, limit: float) -> Row:
    def contenders() -> Generator[Contender]:
        yield Program("-m", "benchmarks.viewer_load", str(frames), SECONDS)
        yield Lookups(frames)

    name = f"a tab of the viewer, {frames} frames at 30 Hz, CPU of one core"
    return Row(name, "the lookups alone", contenders, AtMost(limit), percent, least=3, processors=2)


def start() -> Row:
    def contenders() -> Generator[Contender]:
        yield Program("-m", "benchmarks.viewer_start")
        yield Program("-c", IMPORTS)

    name = "coframe view, until a tab receives its first frame update"
    return Row(name, "floor: importing numpy, click and DDS", contenders, processors=2)


ROWS = [*(row(frames, limit) for frames, limit in LIMITS.items()), start()]
