"""What a long history costs: time and memory."""

import itertools
from collections.abc import Callable, Generator
from typing import Any

import coframe
from benchmarks import motion, ours, peers
from benchmarks.measuring import AtMost, Bar, Contender, GrowsAtMost, Row, number_of_bytes
from benchmarks.peers import DEBIAN, ROS2, Tf2
from benchmarks.process import OWN_PYTHON, Program, Python
from benchmarks.rows.beside_tf2 import beside_tf2
from benchmarks.statement import Statement

FEW, MANY, LARGE = 100, 100_000, 1_000_000


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


def anywhere(samples: int) -> Any:
    """Times all over the history, in random order: more of them than a processor's cache holds samples."""
    return itertools.cycle(ours.random_times(LARGE // 8, samples).tolist())


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
    growing("lookup at random times", "buffer.lookup('f0', 'f1', next(times))", anywhere),
    oldest(DEBIAN),
    oldest(ROS2),
    memory("floor: arrays of numpy", "arrays", lambda: OWN_PYTHON, AtMost(80)),
    memory(DEBIAN.name, "tf2", DEBIAN.python),
    memory(ROS2.name, "tf2", ROS2.python),
    memory("tf_tree", "tf_tree", lambda: peers.own_python("tf_tree")),
]
