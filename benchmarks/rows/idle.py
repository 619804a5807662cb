# SPDX-License-Identifier: Apache-2.0
"""What an idle node costs, and how long `rclpy.init()` and a node take."""

from collections.abc import Callable, Generator

from benchmarks import peers
from benchmarks.measuring import AtMost, Contender, Row, Target, megabytes, nanoseconds, per_second, percent
from benchmarks.peers import ROS2
from benchmarks.process import OWN_PYTHON, Program, Python

START_LIMIT_NS = 60_000_000
CPU_LIMIT_PERCENT = 0.5


def measured(kind: str, quantity: str, python: Python = OWN_PYTHON) -> Program:
    return Program("-m", "benchmarks.idle", kind, quantity, python=python)


def participant(quantity: str) -> Program:
    return measured("participant", quantity, peers.own_python("cyclonedds"))


def rows(
    name: str, kind: str, quantity: str, unit: Callable[[float], str], target: Target | None = None
) -> tuple[Row, Row]:
    """Return two rows: next to a bare participant, and next to ROS 2's rclpy."""

    def with_participant() -> Generator[Contender]:
        yield measured(kind, quantity)
        yield participant(quantity)

    def with_ros2() -> Generator[Contender]:
        yield measured(kind, quantity)
        yield measured(kind, quantity, ROS2.python("tf2_ros"))

    return (
        Row(name, "floor: a bare DDS participant", with_participant, target, unit, least=3),
        Row(name, "ROS 2's rclpy", with_ros2, None, unit, least=3),
    )


ROWS = [
    *rows("rclpy.init() and a node", "node", "start", nanoseconds, AtMost(START_LIMIT_NS)),
    *rows(
        "idle node with a TransformListener, spin(), CPU of one core", "node", "cpu", percent, AtMost(CPU_LIMIT_PERCENT)
    ),
    *rows("idle node with a TransformListener, spin(), wake-ups", "node", "wakes", per_second),
    *rows(
        "idle node, spin_once(timeout_sec=0.5) in a loop, CPU of one core",
        "loop",
        "cpu",
        percent,
        AtMost(CPU_LIMIT_PERCENT),
    ),
    *rows("idle node, memory of the process", "node", "memory", megabytes),
]
