"""Edge: everything that was said of one link on one kind of topic, in the order in which it came."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Edge", "angles_between"]

_LATE = 1_000_000_000


@dataclass(frozen=True, eq=False)
class Edge:
    """What a buffer would take of one link. Times are nanoseconds; rows are in the order in which they came.

    Attributes:
        parent: Without a leading slash, as tf2 reads it.
        child: Likewise.
        static: Whether it came on a topic of static transforms.
        arrived: (N,) when it came.
        stamp: (N,) of the header.
        publisher: (N,) number of who sent it.
        values: (N, 7) x, y, z in metres and qx, qy, qz, qw as they were sent.
        publishers: The names behind the numbers that occur, in the order in which they came up.
    """

    parent: str
    child: str
    static: bool
    arrived: NDArray[np.int64]
    stamp: NDArray[np.int64]
    publisher: NDArray[np.int64]
    values: NDArray[np.float64]
    publishers: tuple[str, ...]

    @property
    def key(self) -> tuple[str, str]:
        """(parent, child)."""
        return self.parent, self.child

    @property
    def count(self) -> int:
        """How often it was told of."""
        return len(self.stamp)

    @property
    def first_stamp(self) -> int:
        """Of the first row."""
        return int(self.stamp[0])

    @cached_property
    def steps(self) -> NDArray[np.int64]:
        """(N - 1,) from each stamp to the one that came next; negative where time went back."""
        return np.asarray(self.stamp[1:] - self.stamp[:-1])

    @cached_property
    def current(self) -> Edge:
        """Without the rows that were more than a second late: what a time that jumped back tells again is left out."""
        kept = self.stamp >= np.maximum.accumulate(self.stamp) - _LATE
        if kept.all():
            return self
        columns = (self.arrived[kept], self.stamp[kept], self.publisher[kept], self.values[kept])
        return Edge(self.parent, self.child, self.static, *columns, self.publishers)

    @cached_property
    def intervals(self) -> NDArray[np.int64]:
        """The times between neighbouring different stamps, in the order of time."""
        steps = self.steps
        if (steps > 0).all():
            return steps
        stamps = np.unique(self.stamp)
        return np.asarray(stamps[1:] - stamps[:-1])

    @cached_property
    def period(self) -> float:
        """The usual time between stamps: the median; 0 for fewer than two."""
        return float(np.median(self.intervals)) if len(self.intervals) else 0.0

    @cached_property
    def rotations(self) -> NDArray[np.float64]:
        """(N, 4) of length 1."""
        turns = self.values[:, 3:]
        return np.asarray(turns / _lengths(turns)[:, None])

    @cached_property
    def distances(self) -> NDArray[np.float64]:
        """(N - 1,) metres from each row to the next."""
        return _lengths(np.diff(self.values[:, :3], axis=0))

    @cached_property
    def turns(self) -> NDArray[np.float64]:
        """(N - 1,) radians from each row's rotation to the next one's."""
        return angles_between(self.rotations[:-1], self.rotations[1:])

    @cached_property
    def constant(self) -> bool:
        """Whether every row says exactly the same."""
        return bool((self.values == self.values[0]).all())

    @cached_property
    def length(self) -> float:
        """Metres between the two frames by the last row."""
        return float(_lengths(self.values[-1:, :3])[0])

    @cached_property
    def angle(self) -> float:
        """Radians between the two frames by the last row."""
        return float(angles_between(self.rotations[-1:], np.array([[0.0, 0.0, 0.0, 1.0]]))[0])


def angles_between(first: NDArray[np.float64], second: NDArray[np.float64]) -> NDArray[np.float64]:
    """Radians from rotation to rotation, (N, 4) each, of length 1."""
    cosines = np.minimum(np.abs(np.einsum("ij,ij->i", first, second)), 1.0)
    return np.asarray(2.0 * np.arccos(cosines))


def _lengths(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(np.sqrt(np.einsum("ij,ij->i", vectors, vectors)))
