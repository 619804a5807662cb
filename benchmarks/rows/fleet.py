# SPDX-License-Identifier: Apache-2.0
"""Ten robots, each a process that publishes 20 frames at 50 Hz, through one relay into one buffer."""

from collections.abc import Generator

from benchmarks.measuring import AtMost, Contender, Row, percent
from benchmarks.process import Program

ROBOTS, FRAMES, HERTZ, SECONDS = "10", "20", "50", "4"
CPU, LOST = 0, 1


class Run:
    """The processor time of the relay; a lost transform is an error."""

    def __init__(self) -> None:
        self._program = Program("-m", "benchmarks.fleet", ROBOTS, FRAMES, HERTZ, SECONDS)

    def sample(self) -> float:
        cpu, lost = self._program.samples()
        if lost:
            raise RuntimeError(f"{lost:.0f} transforms were lost")
        return cpu


class Floor:
    """The processor time of a listener that subscribes to the robots itself, without a relay."""

    def __init__(self) -> None:
        self._program = Program("-m", "benchmarks.fleet", "direct", ROBOTS, FRAMES, HERTZ, SECONDS)

    def sample(self) -> float:
        return self._program.sample()


def contenders() -> Generator[Contender]:
    yield Run()
    yield Floor()


ROWS = [
    Row(
        "relay, 10 robots x 20 x 50 Hz, nothing lost, CPU of one core",
        "floor: no relay, the listener renames the frames",
        contenders,
        AtMost(10.0),
        percent,
        least=2,
        processors=2,
    )
]
