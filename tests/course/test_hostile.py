# SPDX-License-Identifier: Apache-2.0
"""Submissions that loop, crash, fork, print or publish without end: each ends in a grade with a sentence."""

import pytest

NODE = """
import rclpy
from rclpy.node import Node
rclpy.init()
node = Node('static_tf_broadcaster')
"""
HOSTILE = {
    "crash": ("1 / 0", "division by zero"),
    "ends": (NODE, "ended by itself"),
    "not Python": ("def", "invalid syntax"),
}
SLOW = {
    "endless loop": ("while True: pass", "does not join the ROS graph"),
    "busy node": (NODE + "while True: pass", ""),
    "forks": ("import os\nwhile True:\n    os.fork()", "processes and was ended"),
    "output": ("while True: print('x' * 1_000_000)", "printed more than|File too large"),
    "memory": (NODE + "data = []\nwhile True: data.append(bytearray(50_000_000))", "memory|MemoryError|signal"),
    "clock": (
        NODE + "from rosgraph_msgs.msg import Clock\np = node.create_publisher(Clock, '/clock', 10)\nrclpy.spin(node)",
        "publishes on /clock",
    ),
}


def grade_of(folder, grade, program, sentence):
    import re

    (folder / "static_tf_broadcaster.py").write_text(program)
    criterion = grade("static")["static_tf_broadcaster.py"]
    assert criterion["earned"] == 0
    assert re.search(sentence, criterion["problem"])


@pytest.mark.parametrize("name", HOSTILE)
def test_programs_that_fail(name, folder, grade):
    grade_of(folder, grade, *HOSTILE[name])


@pytest.mark.slow
@pytest.mark.parametrize("name", SLOW)
def test_programs_without_limits(name, folder, grade):
    grade_of(folder, grade, *SLOW[name])
