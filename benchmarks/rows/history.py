# SPDX-License-Identifier: Apache-2.0
"""The cost of a long history in time and memory."""

import itertools
from collections.abc import Callable, Generator
from typing import Any

import numpy as np

import coframe
from benchmarks import motion, ours, peers
from benchmarks.measuring import AtMost, Contender, GrowsAtMost, Row, Target, number_of_bytes
from benchmarks.peers import DEBIAN, ROS2, Tf2
from benchmarks.process import OWN_PYTHON, Program, Python
from benchmarks.rows.tf2_rows import versus_tf2
from benchmarks.statement import Statement

FEW, MANY, LARGE = 100, 100_000, 1_000_000
SAMPLE_SIZE = 72
"""Bytes of a stamp, a pose and its parent."""


def of_size(samples: int) -> coframe.Buffer:
    """Return a buffer with one edge and a number of samples."""
    buffer = coframe.Buffer(None)
    values = motion.values(0, 7)
    for index in range(samples):
        ours.store(buffer, 0, motion.stamp(0, index), values)
    return buffer


def growing(name: str, code: str, times: Callable[[int], Any]) -> Row:
    """Return a row for the same lookup in a history of a million samples and in one of a hundred."""

    def statement(samples: int) -> Statement:
        return Statement(code, {"buffer": of_size(samples), "times": times(samples)})

    def contenders() -> Generator[Contender]:
        yield statement(LARGE)
        yield statement(FEW)

    return Row(f"{name}, D=1, n=1e6", "the same, n=100", contenders, GrowsAtMost(2))


def in_the_middle(samples: int) -> int:
    return motion.between(samples // 2)


def in_order(samples: int) -> Any:
    """Return times from sample to sample, as for an iteration over a recording."""
    return itertools.cycle([motion.between(index) for index in range(1, samples - 2)])


def anywhere(samples: int) -> Any:
    """Return random times in the history, more than the samples that fit into the processor's cache."""
    return itertools.cycle(ours.random_times(LARGE // 8, samples).tolist())


def at_random_times() -> Row:
    """Return a row without a target: a large history takes longer because of one uncached read of memory."""

    def contenders() -> Generator[Contender]:
        yield Statement("buffer.lookup('f0', 'f1', next(times))", {"buffer": of_size(LARGE), "times": anywhere(LARGE)})
        numbers = np.ones(SAMPLE_SIZE // 8 * LARGE)
        indices = np.random.default_rng(7).integers(0, len(numbers), LARGE // 8)
        names = {"numbers": numbers, "indices": itertools.cycle(indices.tolist())}
        yield Statement("numbers.item(next(indices))", names)

    return Row("lookup at random times, D=1, n=1e6", "floor: reading one number from as much memory", contenders)


def oldest(peer: Tf2) -> Row:
    time = motion.between(1)
    code = "buffer.lookup('f0', 'f1', time)"
    mine = lambda: Statement(code, {"buffer": of_size(MANY), "time": time})  # noqa: E731 - evaluated when the row is measured
    return versus_tf2("lookup at the oldest time, D=1, n=1e5", mine, peer, "lookup", 1, time, MANY)


def memory(reference: str, name: str, python: Callable[[], Python], target: Target | None = None) -> Row:
    """Return a row for the memory of processes that store samples one by one."""

    def contenders() -> Generator[Contender]:
        yield Program("-m", "benchmarks.memory", "coframe")
        yield Program("-m", "benchmarks.memory", name, python=python())

    return Row("memory per stored transform", reference, contenders, target, number_of_bytes, least=3)


ROWS = [
    growing("lookup, newest", "buffer.lookup('f0', 'f1')", lambda _: None),
    growing("lookup at an old time", "buffer.lookup('f0', 'f1', times)", in_the_middle),
    growing("lookup at increasing times", "buffer.lookup('f0', 'f1', next(times))", in_order),
    at_random_times(),
    oldest(DEBIAN),
    oldest(ROS2),
    memory("floor: NumPy arrays", "arrays", lambda: OWN_PYTHON, AtMost(80)),
    memory(DEBIAN.name, "tf2", DEBIAN.python),
    memory(ROS2.name, "tf2", ROS2.python),
    memory("tf_tree", "tf_tree", lambda: peers.own_python("tf_tree")),
]
