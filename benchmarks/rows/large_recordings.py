# SPDX-License-Identifier: Apache-2.0
"""Ten million transforms in memory and in a frozen file."""

import functools
import itertools
import tempfile
import time
from collections.abc import Callable, Generator
from pathlib import Path

import coframe
from benchmarks import large, ours
from benchmarks.measuring import AtMost, Contender, GrowsAtMost, Row
from benchmarks.process import Program
from benchmarks.statement import Statement

LOOKUPS = 100_000
GIGABYTE = 1e9


@functools.cache
def in_memory() -> coframe.Buffer:
    return large.buffer()


@functools.cache
def _folder() -> tempfile.TemporaryDirectory[str]:
    return tempfile.TemporaryDirectory()


@functools.cache
def frozen() -> Path:
    path = Path(_folder().name) / "run.cfz"
    in_memory().save(path)
    return path


def loading() -> Row:
    def contenders() -> Generator[Contender]:
        yield Statement("load(path)", {"load": coframe.load, "path": frozen()}, clock=time.perf_counter_ns)
        code = "with open(path, 'rb') as file: file.read(4096)"
        yield Statement(code, {"path": frozen()}, clock=time.perf_counter_ns)

    return Row("load of a frozen file, 1e7 transforms", "floor: open it and read a page", contenders, AtMost(5e6))


def many() -> Row:
    def contenders() -> Generator[Contender]:
        code = "buffer.lookup_many('f0', 'f5', stamps)"
        for in_order in (False, True):
            stamps = ours.random_times(LOOKUPS, large.SAMPLES, in_order=in_order)
            yield Statement(code, {"buffer": in_memory(), "stamps": stamps})

    return Row("lookup_many at 1e5 random times, all, D=5, n=2e6", "the same, in order", contenders, AtMost(1e8))


def as_in_memory(name: str, code: str, names: Callable[[], dict[str, object]], times: float) -> Row:
    def contenders() -> Generator[Contender]:
        yield Statement(code, {"buffer": coframe.load(frozen()), **names()})
        yield Statement(code, {"buffer": in_memory(), **names()})

    return Row(f"{name}, frozen, D=5, n=2e6", "the same in memory", contenders, GrowsAtMost(times), least=9)


def random_stamps() -> dict[str, object]:
    return {"stamps": ours.random_times(LOOKUPS, large.SAMPLES)}


def one_after_the_other() -> dict[str, object]:
    return {"times": itertools.cycle(ours.random_times(LOOKUPS, large.SAMPLES, in_order=True).tolist())}


class Once:
    """The output of a program that runs once, because it is slow and its results hardly vary."""

    def __init__(self, what: str) -> None:
        self._result = functools.cache(Program("-m", "benchmarks.large", what).sample)

    def sample(self) -> float:
        return self._result()


def memory(name: str, what: str) -> Row:
    def contenders() -> Generator[Contender]:
        yield Once(what)
        yield Once("arrays")

    reference = "floor: NumPy arrays"
    return Row(f"peak memory of a process, {name}", reference, contenders, AtMost(GIGABYTE), megabytes, least=1)


def megabytes(value: float) -> str:
    return f"{value / 1e6:.0f} MB"


ROWS = [
    loading(),
    many(),
    as_in_memory("lookup_many at 1e5 random times", "buffer.lookup_many('f0', 'f5', stamps)", random_stamps, 1.5),
    as_in_memory("lookup at 1e5 times in order", "buffer.lookup('f0', 'f5', next(times))", one_after_the_other, 1.5),
    memory("1e7 transforms set", "buffer"),
    memory("1e7 transforms from an MCAP", "mcap"),
]
