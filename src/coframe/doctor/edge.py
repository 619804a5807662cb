"""Edge: everything that was said of one link on one kind of topic, in the order in which it came."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from coframe import quaternion

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Edge"]


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
        return np.diff(self.stamp)

    @cached_property
    def intervals(self) -> NDArray[np.int64]:
        """The times between neighbouring different stamps, in the order of time."""
        return np.diff(np.unique(self.stamp))

    @cached_property
    def period(self) -> float:
        """The usual time between stamps: the median; 0 for fewer than two."""
        return float(np.median(self.intervals)) if len(self.intervals) else 0.0

    @cached_property
    def rotations(self) -> NDArray[np.float64]:
        """(N, 4) of length 1."""
        unit: NDArray[np.float64] = self.values[:, 3:] / np.linalg.norm(self.values[:, 3:], axis=1, keepdims=True)
        return unit

    @cached_property
    def distances(self) -> NDArray[np.float64]:
        """(N - 1,) metres from each row to the next."""
        moved: NDArray[np.float64] = np.linalg.norm(np.diff(self.values[:, :3], axis=0), axis=1)
        return moved

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
        return float(np.linalg.norm(self.values[-1, :3]))

    @cached_property
    def angle(self) -> float:
        """Radians between the two frames by the last row."""
        return float(angles_between(self.rotations[-1:], np.array([[0.0, 0.0, 0.0, 1.0]]))[0])


def angles_between(first: NDArray[np.float64], second: NDArray[np.float64]) -> NDArray[np.float64]:
    """Radians from rotation to rotation, (N, 4) each, of length 1."""
    between = quaternion.multiply(quaternion.inverse(first), second)
    angles: NDArray[np.float64] = 2.0 * np.arctan2(np.linalg.norm(between[:, :3], axis=1), np.abs(between[:, 3]))
    return angles
