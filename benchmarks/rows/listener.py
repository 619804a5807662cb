"""A listener over DDS: messages of ten transforms at 1 kHz from another process."""

import os
import sys
from collections.abc import Callable, Generator

from benchmarks.measuring import AtMost, Bar, Contender, Row, nanoseconds, percent
from benchmarks.peers import ROS2
from benchmarks.process import OWN_PYTHON, Program, Python

SECONDS = "3"
CPU, LATENCY, AWAKE = "cpu", "latency", "awake"
NAMES: dict[str, tuple[str, Callable[[float], str]]] = {
    CPU: ("CPU of one core", percent),
    LATENCY: ("latency, p50", nanoseconds),
    AWAKE: ("latency till a thread that waits is awake, p50", nanoseconds),
}


def measured(figure: str, who: str, python: Python = OWN_PYTHON, **environment: str) -> Program:
    """The talker is in our Python whoever listens."""
    command = ("-m", "benchmarks.wire_latency", figure, who, SECONDS, sys.executable)
    return Program(*command, python=python, environment=environment)


def row(figure: str, who: str, beside: str, other: Callable[[], Program], bar: Bar | None = None) -> Row:
    def contenders() -> Generator[Contender]:
        yield measured(figure, who)
        yield other()

    name, unit = NAMES[figure]
    whose = "listener" if who == "coframe" else "tf2_ros.TransformListener"
    return Row(f"{whose}, 1 kHz x 10, {name}", beside, contenders, bar, unit, least=3, processors=2)


def udp(figure: str) -> Callable[[], Program]:
    return lambda: measured(figure, "udp")


def ros2() -> Program:
    python = ROS2.python("tf2_ros")
    if os.environ["ROS_DISTRO"] == "humble":  # its word for what later ones call ROS_AUTOMATIC_DISCOVERY_RANGE
        return measured(CPU, "tf2", python, ROS_LOCALHOST_ONLY="1")
    return measured(CPU, "tf2", python)


ROWS = [
    row(CPU, "coframe", "floor: a bare UDP socket", udp(CPU), AtMost(1.5)),
    row(LATENCY, "coframe", "floor: a bare UDP socket", udp(LATENCY), AtMost(40_000)),
    row(AWAKE, "coframe", "floor: a bare UDP socket", udp(AWAKE)),
    row(CPU, "tf2", "floor: a bare UDP socket", udp(CPU)),
    row(CPU, "tf2", ROS2.name, ros2),
]
