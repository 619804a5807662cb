# SPDX-License-Identifier: Apache-2.0
"""100 simulated robots, each with 20 transforms at 50 Hz, through one Zenoh router to one listener."""

import importlib.util
from collections.abc import Callable, Generator
from functools import partial

from benchmarks.measuring import Contender, GrowsAtMost, MissingPeerError, Row, nanoseconds, percent
from benchmarks.process import Program
from benchmarks.router_load import Outcome

FEW, MANY = 10, 100
FRAMES, HERTZ, SECONDS = "20", "50", "5"
SAMPLES = 2
# rmw_zenoh_cpp drops messages of /tf if a connection is congested, which happens if other programs use the processors.
MAX_LOST = 0.01


class Runs:
    """The outcomes for a number of robots. The rows below share them, because a run takes seconds."""

    def __init__(self, robots: int) -> None:
        self._robots = robots
        self._program = Program("-m", "benchmarks.router_load", str(robots), FRAMES, HERTZ, SECONDS)
        self._outcomes: list[Outcome] = []

    def outcome(self, number: int) -> Outcome:
        """Return one of the outcomes, in any order."""
        if importlib.util.find_spec("zenoh") is None:
            raise MissingPeerError("pip install 'coframe[zenoh]'")
        while len(self._outcomes) <= number:
            outcome = Outcome._make(self._program.samples())
            if outcome.lost > MAX_LOST * self._robots * int(HERTZ) * int(SECONDS):
                raise RuntimeError(f"{outcome.lost:.0f} messages were lost")
            self._outcomes.append(outcome)
        return self._outcomes[number]


RUNS = {robots: Runs(robots) for robots in (FEW, MANY)}


class Measured:
    """A value of each outcome, times a factor. After `SAMPLES` outcomes, they are repeated."""

    def __init__(self, robots: int, value: Callable[[Outcome], float], factor: float) -> None:
        self._runs, self._value, self._factor = RUNS[robots], value, factor
        self._number = 0

    def sample(self) -> float:
        outcome = self._runs.outcome(self._number % SAMPLES)
        self._number += 1
        return self._factor * self._value(outcome)


def contenders(value: Callable[[Outcome], float], factor: float = 1.0) -> Generator[Contender]:
    yield Measured(MANY, value, 1.0)
    yield Measured(FEW, value, factor)


def _cpu(outcome: Outcome) -> float:
    return outcome.router + outcome.listener


def _row(name: str, value: Callable[[Outcome], float], unit: Callable[[float], str]) -> Row:
    return Row(
        f"Zenoh router, {MANY} robots x {FRAMES} x {HERTZ} Hz: {name}",
        f"{FEW} robots",
        partial(contenders, value),
        None,
        unit,
        least=SAMPLES,
        processors=2,
    )


def per_second(value: float) -> str:
    return f"{value:.0f} /s"


ROWS = [
    Row(
        f"Zenoh router, {MANY} robots x {FRAMES} x {HERTZ} Hz: CPU of router and listener",
        f"{MANY // FEW} times that of {FEW} robots",
        partial(contenders, _cpu, MANY / FEW),
        GrowsAtMost(1.2),
        percent,
        least=SAMPLES,
        processors=2,
    ),
    _row("CPU of the router", lambda outcome: outcome.router, percent),
    _row("messages", lambda outcome: outcome.messages_per_second, per_second),
    _row("latency p50", lambda outcome: outcome.median, nanoseconds),
    _row("latency p99", lambda outcome: outcome.p99, nanoseconds),
]
