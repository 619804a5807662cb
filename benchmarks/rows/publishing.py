# SPDX-License-Identifier: Apache-2.0
"""Publishing messages to another process, and receiving them there."""

import os
from collections.abc import Callable, Generator

from benchmarks.measuring import Contender, GrowsAtMost, Row, Target, TimesAsFast
from benchmarks.peers import own_python, sourced
from benchmarks.process import OWN_PYTHON, Program, Python

SECONDS = "1"
PUBLISH, RECEIVE = "publish", "receive"
LABELS = {"tf": "1 transform", "joints": "JointState of 30 joints", "cloud": "PointCloud2 of 1 MB"}
FLOOR, CYCLONE, RCLPY = "floor: bare UDP sockets", "the cyclonedds package", "ROS 2's rclpy"
BYTES, COPYING = "coframe's publisher of bytes", "bare UDP sockets that send a copy"


def measured(quantity: str, contender: str, kind: str, python: Python = OWN_PYTHON, **environment: str) -> Program:
    command = ("-m", "benchmarks.publishing", quantity, contender, kind, SECONDS)
    return Program(*command, python=python, environment=environment)


def row(quantity: str, kind: str, reference: str, target: Target | None = None) -> Row:
    peers: dict[str, Callable[[], Program]] = {
        FLOOR: lambda: measured(quantity, "socket", kind),
        BYTES: lambda: measured(quantity, "bytes", kind),
        COPYING: lambda: measured(quantity, "copying", kind),
        CYCLONE: lambda: measured(quantity, "cyclonedds", kind, own_python("cyclonedds")),
        RCLPY: lambda: ros2(quantity, kind),
    }

    def contenders() -> Generator[Contender]:
        yield measured(quantity, "rclpy", kind)
        yield peers[reference]()

    subject = "sendTransform" if (quantity, kind) == (PUBLISH, "tf") else quantity
    unit = "time of a call" if quantity == PUBLISH else "processor time"
    name = f"{subject}, {LABELS[kind]}, {unit}"
    return Row(name, reference, contenders, target, least=3, processors=2)


def ros2(quantity: str, kind: str) -> Program:
    python = sourced("tf2_ros") if kind == "tf" else sourced("sensor_msgs.msg")
    if os.environ["ROS_DISTRO"] == "humble":  # Later distributions use ROS_AUTOMATIC_DISCOVERY_RANGE.
        return measured(quantity, "rclpy", kind, python, ROS_LOCALHOST_ONLY="1")
    return measured(quantity, "rclpy", kind, python)


ROWS = [
    row(PUBLISH, "tf", FLOOR, GrowsAtMost(1.5)),
    row(PUBLISH, "tf", BYTES),
    row(PUBLISH, "tf", CYCLONE),
    row(PUBLISH, "tf", RCLPY),
    row(PUBLISH, "joints", FLOOR),
    row(PUBLISH, "joints", CYCLONE),
    row(PUBLISH, "joints", RCLPY),
    row(PUBLISH, "cloud", FLOOR),
    row(PUBLISH, "cloud", COPYING),
    row(PUBLISH, "cloud", CYCLONE),
    row(PUBLISH, "cloud", RCLPY, TimesAsFast(2)),
    row(RECEIVE, "joints", FLOOR),
    row(RECEIVE, "joints", RCLPY),
    row(RECEIVE, "cloud", FLOOR),
    row(RECEIVE, "cloud", CYCLONE),
    row(RECEIVE, "cloud", RCLPY, TimesAsFast(3)),
]
