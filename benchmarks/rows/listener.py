# SPDX-License-Identifier: Apache-2.0
"""A listener over DDS and over Zenoh: messages of ten transforms at 1 kHz from another process."""

import os
import sys
from collections.abc import Callable, Generator

from benchmarks.measuring import Contender, GrowsAtMost, Row, Target, nanoseconds, percent
from benchmarks.peers import ROS2
from benchmarks.process import OWN_PYTHON, Program, Python

SECONDS = "3"
CPU, LATENCY, AWAKE = "cpu", "latency", "awake"
NAMES: dict[str, tuple[str, Callable[[float], str]]] = {
    CPU: ("CPU of one core", percent),
    LATENCY: ("latency, p50", nanoseconds),
    AWAKE: ("latency until a waiting thread is awake, p50", nanoseconds),
}


def measured(quantity: str, listener: str, python: Python = OWN_PYTHON, **environment: str) -> Program:
    """Return a program that measures a listener; the talker always runs in coframe's Python."""
    command = ("-m", "benchmarks.wire_latency", quantity, listener, SECONDS, sys.executable)
    return Program(*command, python=python, environment=environment)


def row(
    quantity: str, listener: str, reference: str, other: Callable[[], Program], target: Target | None = None
) -> Row:
    def contenders() -> Generator[Contender]:
        yield measured(quantity, listener)
        yield other()

    label, unit = NAMES[quantity]
    subjects = {"coframe": "listener", "zenoh": "listener over Zenoh", "tf2": "tf2_ros.TransformListener"}
    subject = subjects[listener]
    return Row(f"{subject}, 1 kHz x 10, {label}", reference, contenders, target, unit, least=3, processors=2)


def udp(quantity: str) -> Callable[[], Program]:
    return lambda: measured(quantity, "udp")


def ros2() -> Program:
    python = ROS2.python("tf2_ros")
    if os.environ["ROS_DISTRO"] == "humble":  # Later distributions use ROS_AUTOMATIC_DISCOVERY_RANGE.
        return measured(CPU, "tf2", python, ROS_LOCALHOST_ONLY="1")
    return measured(CPU, "tf2", python)


ROWS = [
    row(CPU, "coframe", "floor: a bare UDP socket", udp(CPU), GrowsAtMost(1.25)),
    row(LATENCY, "coframe", "floor: a bare UDP socket", udp(LATENCY), GrowsAtMost(1.3)),
    row(AWAKE, "coframe", "floor: a bare UDP socket", udp(AWAKE)),
    row(CPU, "zenoh", "floor: a bare UDP socket", udp(CPU)),
    row(LATENCY, "zenoh", "floor: a bare UDP socket", udp(LATENCY)),
    row(CPU, "tf2", "floor: a bare UDP socket", udp(CPU)),
    row(CPU, "tf2", ROS2.name, ros2),
]
