# SPDX-License-Identifier: Apache-2.0
"""Edge: all transforms of one edge on one kind of topic, in the order of arrival."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from coframe.analysis.liveness import median_interval, stamp_intervals
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

__all__ = ["Edge", "angles_between", "publishers_of"]

_MAX_LATENESS = SECOND
_MIN_UNSET_STAMPS = 5  # transforms with the stamp 0


@dataclass(frozen=True, eq=False)
class Edge:
    """The transforms of one edge that a buffer would store. Times are nanoseconds. Rows are in the order of arrival.

    Attributes:
        parent: The parent frame, without a leading slash, as tf2 reads it.
        child: The child frame, without a leading slash.
        static: Whether the transforms were published on a topic of static transforms.
        arrived: (N,) time of arrival.
        stamp: (N,) stamp of the header.
        publisher: (N,) number of the publisher.
        values: (N, 7) x, y, z in meters and qx, qy, qz, qw as published.
        publishers: The names of the publishers that occur, in the order of their first transform.
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
    def name(self) -> str:
        """The edge as ``parent -> child``."""
        return f"{self.parent} -> {self.child}"

    @property
    def count(self) -> int:
        """The number of transforms."""
        return len(self.stamp)

    @property
    def first_stamp(self) -> int:
        """The stamp of the first row."""
        return int(self.stamp[0])

    @cached_property
    def steps(self) -> NDArray[np.int64]:
        """(N - 1,) difference of consecutive stamps in the order of arrival; negative where time goes back."""
        return np.asarray(self.stamp[1:] - self.stamp[:-1])

    @property
    def current(self) -> Edge:
        """The edge without the rows that were more than a second late, such as those repeated after time went back."""
        # An edge that referred to itself would be freed only by the cyclic garbage collector, which does not take array
        # sizes into account: the memory of `doctor --watch` would grow with each report.
        return self if self._remove_late is None else self._remove_late

    @cached_property
    def _remove_late(self) -> Edge | None:
        kept = self.stamp >= np.maximum.accumulate(self.stamp) - _MAX_LATENESS
        if kept.all():
            return None
        columns = (self.arrived[kept], self.stamp[kept], self.publisher[kept], self.values[kept])
        return Edge(self.parent, self.child, self.static, *columns, self.publishers)

    @cached_property
    def unset_count(self) -> int:
        """The number of transforms whose stamp is 0, because it was never set."""
        return int(np.count_nonzero(self.stamp == 0))

    @property
    def is_unset(self) -> bool:
        """Whether the stamps count as never set: more than 5 % are 0. A simulation may begin with a few."""
        return self.unset_count == self.count or (
            self.unset_count >= _MIN_UNSET_STAMPS and self.unset_count > 0.05 * self.count
        )

    @cached_property
    def intervals(self) -> NDArray[np.int64]:
        """The intervals between consecutive different stamps, sorted by time, without stamps of 0."""
        return stamp_intervals(self.stamp[self.stamp != 0] if self.unset_count else self.stamp)

    @cached_property
    def period(self) -> float:
        """The usual period (see :func:`coframe.analysis.liveness.usual_period`), or 0 for fewer than two stamps."""
        return median_interval(self.intervals)

    @cached_property
    def rotations(self) -> NDArray[np.float64]:
        """(N, 4) unit quaternions."""
        quaternions = self.values[:, 3:]
        return np.asarray(quaternions / _lengths(quaternions)[:, None])

    def poses(self, rows: NDArray[np.intp]) -> NDArray[np.float64]:
        """Return the poses of given rows, (N, 7), with unit quaternions."""
        return np.concatenate([self.values[rows, :3], self.rotations[rows]], axis=1)

    @property
    def last_pose(self) -> NDArray[np.float64]:
        """The pose of the last row, (1, 7), with a unit quaternion."""
        return self.poses(np.array([-1]))

    @cached_property
    def distances(self) -> NDArray[np.float64]:
        """(N - 1,) meters from each position to the next one."""
        return _lengths(np.diff(self.values[:, :3], axis=0))

    @cached_property
    def rotation_steps(self) -> NDArray[np.float64]:
        """(N - 1,) radians from each rotation to the next one."""
        return angles_between(self.rotations[:-1], self.rotations[1:])

    @cached_property
    def constant(self) -> bool:
        """Whether all rows have the same values."""
        return bool((self.values == self.values[0]).all())

    @cached_property
    def length(self) -> float:
        """The distance between the two frames in the last row, in meters."""
        return math.hypot(*self.values[-1, :3].tolist())  # avoids overflow of squares

    @cached_property
    def angle(self) -> float:
        """The angle of the rotation between the two frames in the last row, in radians."""
        return float(angles_between(self.rotations[-1:], np.array([[0.0, 0.0, 0.0, 1.0]]))[0])


def publishers_of(edges: Iterable[Edge]) -> tuple[str, ...]:
    """Return the names of all publishers of some edges, each once."""
    return tuple(dict.fromkeys(name for edge in edges for name in edge.publishers))


def angles_between(first: NDArray[np.float64], second: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the angles in radians between rotations, (N, 4) unit quaternions each."""
    cosines = np.minimum(np.abs(np.einsum("ij,ij->i", first, second)), 1.0)
    return np.asarray(2.0 * np.arccos(cosines))


def _lengths(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(np.sqrt(np.einsum("ij,ij->i", vectors, vectors)))
