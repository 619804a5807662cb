# SPDX-License-Identifier: Apache-2.0
"""Images of 1 MB and clouds of 40 MB from one process to another over Fast DDS."""

from collections.abc import Callable, Generator
from typing import NamedTuple

from benchmarks.measuring import AtLeast, Contender, Row, Target, TimesAsFast, nanoseconds, plain
from benchmarks.peers import ROS_WHEELS
from benchmarks.process import PeerError, Program
from benchmarks.rows.middlewares import CYCLONE, FAST_DDS, over

MEMORY, REAL = "floor: bare shared memory", ROS_WHEELS.name
IMAGE, CLOUD, BEST_EFFORT = "image", "cloud", "cloud_best_effort"
CLOUDS = 10


class Outcome(NamedTuple):
    """What a run of `benchmarks.images` prints."""

    latency: float
    sender: float
    receiver: float
    sent: float
    received: float


class Runs:
    """The outcomes of a contender. The rows share them, because a run takes seconds."""

    def __init__(self, kind: str, make: Callable[..., Program], contender: str = "rclpy") -> None:
        self._make, self._words = make, ("-m", "benchmarks.images", contender, kind)
        self._outcomes: list[Outcome] = []

    def outcome(self, number: int) -> Outcome:
        while len(self._outcomes) <= number:
            self._outcomes.append(Outcome._make(self._make(*self._words).samples()))
        return self._outcomes[number]


class Figure:
    """A quantity of the outcomes."""

    def __init__(self, runs: Runs, quantity: str) -> None:
        self._runs, self._quantity, self._number = runs, quantity, 0
        runs.outcome(0)  # a missing peer is reported now

    def sample(self) -> float:
        outcome = self._runs.outcome(self._number)
        self._number += 1
        if not outcome.received and self._quantity != "received":
            raise PeerError("no message was received")
        return float(getattr(outcome, self._quantity))


RUNS = {
    (kind, name): Runs(kind, make)
    for kind in (IMAGE, CLOUD, BEST_EFFORT)
    for name, make in ((FAST_DDS, over("fastdds")), (CYCLONE, over("dds")), (REAL, ROS_WHEELS.program))
}
RUNS[IMAGE, MEMORY] = Runs(IMAGE, Program, "memory")


def row(
    name: str,
    quantity: str,
    reference: str,
    target: Target | None = None,
    kind: str = IMAGE,
    unit: Callable[[float], str] = nanoseconds,
) -> Row:
    def contenders() -> Generator[Contender]:
        yield Figure(RUNS[kind, FAST_DDS], quantity)
        yield Figure(RUNS[kind, reference], quantity)

    return Row(name, reference, contenders, target, unit, least=3, processors=2)


def rows() -> Generator[Row]:
    quantities = {"latency": "latency, p50", "sender": "sender, processor time", "receiver": "receiver, processor time"}
    for quantity, label in quantities.items():
        name = f"Image of 1 MB over Fast DDS, {label}"
        yield row(name, quantity, CYCLONE, TimesAsFast(2.0 if quantity == "latency" else 1.0))
        yield row(name, quantity, REAL, TimesAsFast(2.0))
        yield row(name, quantity, MEMORY)
    for kind, label in ((CLOUD, "reliable"), (BEST_EFFORT, "best effort")):
        name = f"clouds of 40 MB over Fast DDS, {label}, received of {CLOUDS}"
        for reference in (CYCLONE, REAL):
            yield row(name, "received", reference, AtLeast(CLOUDS), kind, plain)


ROWS = list(rows())
