# SPDX-License-Identifier: Apache-2.0
"""Import times."""

import tempfile
from collections.abc import Callable, Generator
from pathlib import Path

from benchmarks import installed, peers
from benchmarks.measuring import AddsAtMost, AtMost, Contender, Row, Target
from benchmarks.peers import DEBIAN
from benchmarks.process import OWN_PYTHON, Program, Python

LIMIT_NS = 60_000_000
ADDED_NS = 500_000
# What a program without coframe does: its imports succeed and fail. Printed is the processor time of the whole process.
OTHER_PROGRAM = """
import copy, json, time
for name in ("simplejson", "apport_python_hook", "absent_msgs"):
    try:
        __import__(name)
    except ImportError:
        pass
print(time.process_time_ns())
"""


def importing(module: str, after: str = "time", python: Python = OWN_PYTHON) -> Program:
    """Return a program that measures the processor time of an import after another import.

    Args:
        module: The module, and after a colon what of it is used: coframe imports its core on first use.
        after: What is imported before, without being measured.
        python: The interpreter.
    """
    name, _, attribute = module.partition(":")
    use = f"{name}.{attribute}" if attribute else name
    code = f"import {after}, time; begin = time.process_time_ns(); import {name}; {use}; "
    return Program("-c", code + "print(time.process_time_ns() - begin)", python=python)


def row(name: str, mine: Program, reference: str, other: Callable[[], Program], target: Target | None = None) -> Row:
    def contenders() -> Generator[Contender]:
        yield mine
        yield other()

    return Row(name, reference, contenders, target)


def starts() -> Generator[Contender]:
    """Start Python in an environment with coframe, and in one without it."""
    with tempfile.TemporaryDirectory(prefix="coframe-bench-") as folder:
        for name in ("with", "without"):
            environment = installed.create(Path(folder, name), with_coframe=name == "with")
            yield Program("-c", OTHER_PROGRAM, python=(str(environment.python), "-E"))


COFRAME = "import coframe after numpy, use Buffer", importing("coframe:Buffer", "numpy")

ROWS = [
    Row("start a program that does not use coframe", "without coframe", starts, AddsAtMost(ADDED_NS), least=30),
    row(*COFRAME, "floor: import numpy", lambda: importing("numpy"), AtMost(LIMIT_NS)),
    row(*COFRAME, "import tf_tree", lambda: importing("tf_tree", "numpy", peers.own_python("tf_tree"))),
    row(
        "import tf2_ros",
        importing("tf2_ros"),
        DEBIAN.name,
        lambda: importing("tf2_ros", python=DEBIAN.python("tf2_ros")),
    ),
]
