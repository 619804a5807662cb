"""What a long history costs: time and memory."""

import itertools
from collections.abc import Callable, Generator
from typing import Any

import numpy as np

import coframe
from benchmarks import motion, ours, peers
from benchmarks.measuring import AtMost, Bar, Contender, GrowsAtMost, Row, number_of_bytes
from benchmarks.peers import DEBIAN, ROS2, Tf2
from benchmarks.process import OWN_PYTHON, Program, Python
from benchmarks.rows.beside_tf2 import beside_tf2
from benchmarks.statement import Statement

FEW, MANY, LARGE = 100, 100_000, 1_000_000
SAMPLE_SIZE = 72
"""A stamp, a pose and its parent, in bytes."""


def of_size(samples: int) -> coframe.Buffer:
    """One link with so many samples."""
    buffer = coframe.Buffer(None)
    values = motion.values(0, 7)
    for index in range(samples):
        ours.store(buffer, 0, motion.stamp(0, index), values)
    return buffer


def growing(name: str, code: str, times: Callable[[int], Any]) -> Row:
    """The same question to a history of a million and to one of a hundred."""

    def asked(samples: int) -> Statement:
        return Statement(code, {"buffer": of_size(samples), "times": times(samples)})

    def contenders() -> Generator[Contender]:
        yield asked(LARGE)
        yield asked(FEW)

    return Row(f"{name}, D=1, n=1e6", "the same, n=100", contenders, GrowsAtMost(2))


def in_the_middle(samples: int) -> int:
    return motion.between(samples // 2)


def in_order(samples: int) -> Any:
    """Times from sample to sample, as of who goes through a recording."""
    return itertools.cycle([motion.between(index) for index in range(1, samples - 2)])


def anywhere(samples: int) -> Any:
    """Times all over the history, in random order: more of them than a processor's cache holds samples."""
    return itertools.cycle(ours.random_times(LARGE // 8, samples).tolist())


def at_random_times() -> Row:
    """No bar: what a large history takes longer is the memory's, one read of what is in no cache."""

    def contenders() -> Generator[Contender]:
        yield Statement("buffer.lookup('f0', 'f1', next(times))", {"buffer": of_size(LARGE), "times": anywhere(LARGE)})
        numbers = np.ones(SAMPLE_SIZE // 8 * LARGE)
        places = np.random.default_rng(7).integers(0, len(numbers), LARGE // 8)
        yield Statement("numbers.item(next(places))", {"numbers": numbers, "places": itertools.cycle(places.tolist())})

    return Row("lookup at random times, D=1, n=1e6", "floor: a number out of as much memory", contenders)


def oldest(peer: Tf2) -> Row:
    time = motion.between(1)
    code = "buffer.lookup('f0', 'f1', time)"
    mine = lambda: Statement(code, {"buffer": of_size(MANY), "time": time})  # noqa: E731 - made when it is its turn
    return beside_tf2("lookup at the oldest time, D=1, n=1e5", mine, peer, "lookup", 1, time, MANY)


def memory(beside: str, who: str, python: Callable[[], Python], bar: Bar | None = None) -> Row:
    """What processes that store samples one by one grow by."""

    def contenders() -> Generator[Contender]:
        yield Program("-m", "benchmarks.memory", "coframe")
        yield Program("-m", "benchmarks.memory", who, python=python())

    return Row("memory per stored transform", beside, contenders, bar, number_of_bytes, least=3)


ROWS = [
    growing("lookup, newest", "buffer.lookup('f0', 'f1')", lambda _: None),
    growing("lookup at an old time", "buffer.lookup('f0', 'f1', times)", in_the_middle),
    growing("lookup at one time after the other", "buffer.lookup('f0', 'f1', next(times))", in_order),
    at_random_times(),
    oldest(DEBIAN),
    oldest(ROS2),
    memory("floor: arrays of numpy", "arrays", lambda: OWN_PYTHON, AtMost(80)),
    memory(DEBIAN.name, "tf2", DEBIAN.python),
    memory(ROS2.name, "tf2", ROS2.python),
    memory("tf_tree", "tf_tree", lambda: peers.own_python("tf_tree")),
]
