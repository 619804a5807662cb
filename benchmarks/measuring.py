"""Rows of the table: who is measured beside whom, in turn, and what must come out."""

import contextlib
import statistics
import time
from collections.abc import Callable, Generator
from dataclasses import dataclass, field
from typing import NamedTuple, Protocol

from benchmarks.processor import one_processor


class Contender(Protocol):
    """Something that can be measured again and again."""

    def sample(self) -> float:
        """One more figure: nanoseconds, unless the row's unit is another."""


class MissingPeerError(Exception):
    """A peer is not on this machine; the text says what to install."""


class Spread(NamedTuple):
    """The median and the middle half around it."""

    low: float
    median: float
    high: float

    @classmethod
    def of(cls, values: list[float]) -> "Spread":
        if len(values) == 1:
            return cls(*values * 3)
        return cls(*statistics.quantiles(values, n=4, method="inclusive"))


class Bar(Protocol):
    """What a row must reach."""

    def reached(self, result: "Result") -> bool | None:
        """None: what it takes to tell is not there."""

    def text(self, row: "Row") -> str: ...


@dataclass(frozen=True)
class TimesAsFast:
    """The other's figure must be so many times ours."""

    times: float

    def reached(self, result: "Result") -> bool | None:
        return result.ratio.median >= self.times if result.theirs else None

    def text(self, row: "Row") -> str:
        del row
        return f"≥ {self.times:g}x"


@dataclass(frozen=True)
class AtMost:
    """Our figure itself must not be larger."""

    limit: float

    def reached(self, result: "Result") -> bool:
        return Spread.of(result.ours).median <= self.limit

    def text(self, row: "Row") -> str:
        return f"≤ {row.unit(self.limit)}"


@dataclass(frozen=True)
class GrowsAtMost:
    """Our figure must not be more than so many times the other's."""

    times: float

    def reached(self, result: "Result") -> bool | None:
        return result.ratio.median >= 1 / self.times if result.theirs else None

    def text(self, row: "Row") -> str:
        del row
        return f"grows ≤ {self.times:g}x"


def nanoseconds(value: float) -> str:
    for unit, size in (("s", 1e9), ("ms", 1e6), ("us", 1e3)):
        if value >= 10 * size:
            return f"{value / size:.{0 if value >= 100 * size else 1}f} {unit}"
    return f"{value:.{0 if value >= 100 else 1}f} ns"


def percent(value: float) -> str:
    return f"{value:.2f} %"


def number_of_bytes(value: float) -> str:
    return f"{value:.1f} B"


@dataclass(frozen=True)
class Row:
    """A row of the table.

    Attributes:
        name: What is done.
        beside: Who or what our figure stands beside: a peer, or a floor below which it cannot be.
        contenders: Makes ours and then the other one, and ends them. What is wrong with ours is raised by the first
            step, what is wrong with the other by the second.
        bar: What must be reached; None: it is told for information.
        unit: How a figure is written.
        least: So many samples of each are taken whatever time they take.
        processors: How many they need at once; with one, all contenders have the same one.
    """

    name: str
    beside: str
    contenders: Callable[[], Generator[Contender]]
    bar: Bar | None = None
    unit: Callable[[float], str] = nanoseconds
    least: int = 5
    processors: int = 1


@dataclass
class Result:
    """What came out for a row.

    Attributes:
        row: The row.
        ours: Our samples.
        theirs: The other's, each taken right after ours.
        missing: What to install for the other; "" if it is there.
        error: What went wrong; "" if nothing did.
    """

    row: Row
    ours: list[float] = field(default_factory=list)
    theirs: list[float] = field(default_factory=list)
    missing: str = ""
    error: str = ""

    @property
    def ratio(self) -> Spread:
        """The other's figure by ours, round by round."""
        return Spread.of([their / our for our, their in zip(self.ours, self.theirs, strict=False)])

    @property
    def verdict(self) -> str:
        """`met`, `FALLS SHORT`, `skipped` or, where there is no bar, nothing."""
        if self.error:
            return "FAILS" if self.row.bar else "fails"
        reached = self.row.bar.reached(self) if self.row.bar else None
        if reached is not None:
            return "met" if reached else "FALLS SHORT"
        return "skipped" if self.missing else ""

    @property
    def failed(self) -> bool:
        """Whether it has a bar that is not known to be reached, for another reason than a peer that is missing."""
        return self.row.bar is not None and self.verdict in {"FAILS", "FALLS SHORT"}


@dataclass(frozen=True)
class Effort:
    """How long a row is measured: so many rounds, or what fits into the time, but not fewer than the row's least."""

    rounds: int = 51
    seconds: float = 4.0
    least: int | None = None


def measure(row: Row, effort: Effort) -> Result:
    """Measures ours and the other in turn."""
    result = Result(row)
    place = one_processor() if row.processors == 1 else contextlib.nullcontext()
    with place, contextlib.closing(row.contenders()) as contenders:
        try:
            try:
                ours = next(contenders)
                ours.sample()  # it warms up: caches, imports, and how many runs make a sample
            except MissingPeerError as missing:  # what both work on is the peer's
                result.missing = str(missing)
                return result
            theirs: Contender | None = None
            try:
                theirs = next(contenders)
            except MissingPeerError as missing:
                result.missing = str(missing)
            else:
                theirs.sample()
            _take_turns(result, ours, theirs, effort)
        except Exception as error:  # noqa: BLE001 - a row that cannot be measured is told of as such
            result.error = f"{type(error).__name__}: {error}"
    return result


def _take_turns(result: Result, ours: Contender, theirs: Contender | None, effort: Effort) -> None:
    least = result.row.least if effort.least is None else effort.least
    end = time.monotonic() + effort.seconds
    for taken in range(max(effort.rounds, least)):
        if taken >= least and time.monotonic() > end:
            break
        result.ours.append(ours.sample())
        if theirs:
            result.theirs.append(theirs.sample())
