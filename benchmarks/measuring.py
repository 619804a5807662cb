# SPDX-License-Identifier: Apache-2.0
"""Rows of the table: which contenders are compared, how they are measured, and the target."""

import contextlib
import statistics
import time
from collections.abc import Callable, Generator
from dataclasses import dataclass, field
from typing import NamedTuple, Protocol

from benchmarks.processor import one_processor


class Contender(Protocol):
    """Something that can be measured repeatedly."""

    def sample(self) -> float:
        """Return one more result, in nanoseconds or in the unit of the row."""


class MissingPeerError(Exception):
    """A peer is not installed; the text says what to install."""


class Spread(NamedTuple):
    """The median and the quartiles."""

    low: float
    median: float
    high: float

    @classmethod
    def of(cls, values: list[float]) -> "Spread":
        if len(values) == 1:
            return cls(*values * 3)
        return cls(*statistics.quantiles(values, n=4, method="inclusive"))


class Target(Protocol):
    """A condition that the result of a row must meet."""

    def reached(self, result: "Result") -> bool | None:
        """Return whether the target is met; None if a contender is missing."""

    def text(self, row: "Row") -> str: ...


@dataclass(frozen=True)
class TimesAsFast:
    """The other result must be at least this many times coframe's."""

    times: float

    def reached(self, result: "Result") -> bool | None:
        return result.ratio.median >= self.times if result.theirs else None

    def text(self, row: "Row") -> str:
        del row
        return f"≥ {self.times:g}x"


@dataclass(frozen=True)
class AtMost:
    """coframe's result must not exceed a limit."""

    limit: float

    def reached(self, result: "Result") -> bool:
        return Spread.of(result.ours).median <= self.limit

    def text(self, row: "Row") -> str:
        return f"≤ {row.unit(self.limit)}"


@dataclass(frozen=True)
class AtLeast:
    """coframe's result must not be below a limit."""

    limit: float

    def reached(self, result: "Result") -> bool:
        return min(result.ours) >= self.limit

    def text(self, row: "Row") -> str:
        return f"≥ {row.unit(self.limit)}"


@dataclass(frozen=True)
class AddsAtMost:
    """coframe's result must not exceed the other one by more than a limit."""

    limit: float

    def reached(self, result: "Result") -> bool | None:
        if not result.theirs:
            return None
        return Spread.of(result.ours).median - Spread.of(result.theirs).median <= self.limit

    def text(self, row: "Row") -> str:
        return f"adds ≤ {row.unit(self.limit)}"


@dataclass(frozen=True)
class GrowsAtMost:
    """coframe's result must be at most this many times the other one."""

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


def plain(value: float) -> str:
    return f"{value:g}"


def percent(value: float) -> str:
    return f"{value:.2f} %"


def per_second(value: float) -> str:
    return f"{value:.1f} /s"


def megabytes(value: float) -> str:
    return f"{value / 1e6:.1f} MB"


def number_of_bytes(value: float) -> str:
    return f"{value:.1f} B"


@dataclass(frozen=True)
class Row:
    """A row of the table.

    Attributes:
        name: The work that is measured.
        reference: What coframe is compared with: a peer, or a floor that no implementation can go below.
        contenders: Yields coframe's contender and then the other one, and closes both. Each step raises the errors of
            its contender.
        target: The target; None: the row is for information.
        unit: Formats a result.
        least: Minimum number of samples of each contender, however long they take.
        processors: Number of processors needed; with one, all contenders use the same one.
    """

    name: str
    reference: str
    contenders: Callable[[], Generator[Contender]]
    target: Target | None = None
    unit: Callable[[float], str] = nanoseconds
    least: int = 5
    processors: int = 1


@dataclass
class Result:
    """The result of a row.

    Attributes:
        row: The row.
        ours: Samples of coframe.
        theirs: Samples of the other contender, each round_number right after one of coframe.
        missing: What to install for the other contender; "" if it is installed.
        error: The error; "" if there was none.
    """

    row: Row
    ours: list[float] = field(default_factory=list)
    theirs: list[float] = field(default_factory=list)
    missing: str = ""
    error: str = ""

    @property
    def ratio(self) -> Spread:
        """The other result divided by coframe's, over all rounds."""
        return Spread.of([their / our for our, their in zip(self.ours, self.theirs, strict=False)])

    @property
    def verdict(self) -> str:
        """`met`, `MISSED`, `skipped`, `ERROR`, or "" for a row without a target."""
        if self.error:
            return "ERROR" if self.row.target else "error"
        reached = self.row.target.reached(self) if self.row.target else None
        if reached is not None:
            return "met" if reached else "MISSED"
        return "skipped" if self.missing else ""

    @property
    def failed(self) -> bool:
        """Whether the row has a target that is missed or could not be measured; a missing peer is not a failure."""
        return self.row.target is not None and self.verdict in {"ERROR", "MISSED"}


@dataclass(frozen=True)
class Effort:
    """How long a row is measured: until one of the limits, but for at least the row's minimum of rounds."""

    rounds: int = 51
    seconds: float = 4.0
    least: int | None = None


def measure(row: Row, effort: Effort) -> Result:
    """Measure coframe and the other contender in turn."""
    result = Result(row)
    place = one_processor() if row.processors == 1 else contextlib.nullcontext()
    with place, contextlib.closing(row.contenders()) as contenders:
        try:
            try:
                ours = next(contenders)
                ours.sample()  # Warm-up: caches, imports, and the number of runs per sample.
            except MissingPeerError as missing:  # Both contenders need something of the peer.
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
        except Exception as error:  # noqa: BLE001 - the table reports all errors
            result.error = f"{type(error).__name__}: {error}"
    return result


def _take_turns(result: Result, ours: Contender, theirs: Contender | None, effort: Effort) -> None:
    least = result.row.least if effort.least is None else effort.least
    end = time.monotonic() + effort.seconds
    for round_number in range(max(effort.rounds, least)):
        if round_number >= least and time.monotonic() > end:
            break
        result.ours.append(ours.sample())
        if theirs:
            result.theirs.append(theirs.sample())
