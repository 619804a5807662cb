# SPDX-License-Identifier: Apache-2.0
"""What a listener, a node and discovery cost over Fast DDS, next to Cyclone DDS and to ROS 2's rclpy on Fast DDS."""

import importlib.util
import sys
from collections.abc import Callable, Generator

from benchmarks.measuring import Contender, MissingPeerError, Row, megabytes, nanoseconds, percent
from benchmarks.peers import ROS_WHEELS
from benchmarks.process import Program

FAST_DDS, CYCLONE = "coframe over Fast DDS", "coframe over Cyclone DDS"
PROCESSES = "50"
Make = Callable[..., Program]


def over(wire: str) -> Make:
    """Return what makes a program that uses coframe over a middleware."""

    def make(*arguments: str, time_limit: float = 120.0) -> Program:
        if wire == "fastdds" and importlib.util.find_spec("coframe_fastdds") is None:
            raise MissingPeerError("pip install ./middlewares/fastdds")
        return Program(*arguments, environment={"COFRAME_WIRE": wire}, time_limit=time_limit)

    return make


class Number:
    """One of the numbers that a program prints."""

    def __init__(self, program: Program, number: int) -> None:
        self._program, self._number = program, number

    def sample(self) -> float:
        return self._program.sample(self._number)


def rows(
    name: str, unit: Callable[[float], str], *words: str, number: int = 0, real: tuple[str, ...] = (), least: int = 3
) -> list[Row]:
    """Return the rows of a program, next to Cyclone DDS and to rclpy, which runs with the words `real` if there are."""

    def contenders(other: Make, other_words: tuple[str, ...]) -> Callable[[], Generator[Contender]]:
        def both() -> Generator[Contender]:
            yield Number(over("fastdds")("-m", *words, time_limit=300), number)
            yield Number(other("-m", *other_words, time_limit=300), number)

        return both

    references = ((CYCLONE, over("dds"), words), (ROS_WHEELS.name, ROS_WHEELS.program, real or words))
    return [
        Row(name, reference, contenders(other, other_words), None, unit, least, processors=2)
        for reference, other, other_words in references
    ]


IDLE, LISTENER = "benchmarks.idle", "benchmarks.wire_latency"
ROWS = [
    *rows(
        "listener over Fast DDS, 1 kHz x 10, CPU of one core (rclpy: a subscription that stores nothing)",
        percent,
        *(LISTENER, "cpu", "coframe", "3"),
        real=(LISTENER, "cpu", "subscription", "3", sys.executable),
    ),
    *rows("Fast DDS: rclpy.init() and a node, processor time", nanoseconds, IDLE, "node", "start_cpu"),
    *rows("Fast DDS: idle node, spin(), CPU of one core", percent, IDLE, "plain", "cpu"),
    *rows("Fast DDS: memory of a process with a node", megabytes, IDLE, "node", "memory"),
    *rows("Fast DDS: memory of a further node of a process", megabytes, IDLE, "node", "per_node"),
    *rows(
        f"Fast DDS: {PROCESSES} processes, until a new one knows all nodes",
        nanoseconds,
        *("benchmarks.discovery", PROCESSES),
        least=1,
    ),
    *rows(
        f"Fast DDS: {PROCESSES} processes, processor time of each",
        nanoseconds,
        *("benchmarks.discovery", PROCESSES),
        number=1,
        least=1,
    ),
]
