# SPDX-License-Identifier: Apache-2.0
"""Import times."""

from collections.abc import Callable, Generator

from benchmarks import peers
from benchmarks.measuring import AtMost, Contender, Row, Target
from benchmarks.peers import DEBIAN
from benchmarks.process import OWN_PYTHON, Program, Python

LIMIT_NS = 60_000_000


def importing(module: str, after: str = "time", python: Python = OWN_PYTHON) -> Program:
    """Return a program that measures the processor time of an import after another import."""
    code = (
        f"import {after}, time; begin = time.process_time_ns(); import {module}; print(time.process_time_ns() - begin)"
    )
    return Program("-c", code, python=python)


def row(name: str, mine: Program, reference: str, other: Callable[[], Program], target: Target | None = None) -> Row:
    def contenders() -> Generator[Contender]:
        yield mine
        yield other()

    return Row(name, reference, contenders, target)


COFRAME = "import coframe after numpy", importing("coframe", "numpy")

ROWS = [
    row(*COFRAME, "floor: import numpy", lambda: importing("numpy"), AtMost(LIMIT_NS)),
    row(*COFRAME, "import tf_tree", lambda: importing("tf_tree", "numpy", peers.own_python("tf_tree"))),
    row(
        "import tf2_ros",
        importing("tf2_ros"),
        DEBIAN.name,
        lambda: importing("tf2_ros", python=DEBIAN.python("tf2_ros")),
    ),
]
