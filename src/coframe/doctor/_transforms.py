# SPDX-License-Identifier: Apache-2.0
"""The table of all transforms as published, one row each, from which all statistics are derived."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

__all__ = ["COLUMNS", "NORM_TOLERANCE", "NO_TRANSFORMS", "Transforms", "number_names", "without_slash"]

# tf2 rejects a quaternion whose squared length differs from 1 by this much or more.
NORM_TOLERANCE = 0.01
_MAX_COUNTED_KEY = 1_000_000  # keys up to this value are counted, which is faster than sorting
# All except the publishers, whose numbers depend on their names.
COLUMNS = ("arrived", "stamp", "parent", "child", "static", "values")


@dataclass(frozen=True, eq=False)
class Transforms:
    """Transforms as published, one row each, in the order of arrival.

    Attributes:
        arrived: (N,) arrival time of the message on the clock of the listener.
        stamp: (N,) stamp of the header.
        parent: (N,) number of the name of the parent.
        child: (N,) number of the name of the child.
        publisher: (N,) number of the publisher.
        static: (N,) whether it was published on a topic of static transforms.
        values: (N, 7) x, y, z in meters and qx, qy, qz, qw.
        names: The names of the frames, with the prefix if one was given; a name that was published with and without a
            leading slash occurs twice.
        sent: The names as published; empty if they are the same.
        publishers: Full names of nodes, or "" for an unknown publisher.
    """

    arrived: NDArray[np.int64]
    stamp: NDArray[np.int64]
    parent: NDArray[np.int64]
    child: NDArray[np.int64]
    publisher: NDArray[np.int64]
    static: NDArray[np.bool_]
    values: NDArray[np.float64]
    names: tuple[str, ...] = ()
    publishers: tuple[str, ...] = ()
    sent: tuple[str, ...] = ()

    @staticmethod
    def join_batches(batches: Sequence[Transforms], names: tuple[str, ...], sent: tuple[str, ...] = ()) -> Transforms:
        """Return the rows of all batches in the order of arrival, with frame numbers that refer to `names`."""
        columns: dict[str, Any] = {
            name: np.concatenate([getattr(batch, name) for batch in (NO_TRANSFORMS, *batches)]) for name in COLUMNS
        }
        publishers: dict[str, int] = {}
        columns["publisher"] = np.concatenate(
            [_NO_NUMBERS, *(number_names(publishers, batch.publishers)[batch.publisher] for batch in batches)]
        )
        arrival_times = columns["arrived"]
        if (arrival_times[1:] < arrival_times[:-1]).any():
            order = np.argsort(arrival_times, kind="stable")
            columns = {name: column[order] for name, column in columns.items()}
        return Transforms(**columns, names=names, publishers=tuple(publishers), sent=sent)

    def __len__(self) -> int:
        return len(self.stamp)

    @cached_property
    def finite(self) -> NDArray[np.bool_]:
        """(N,) whether all values are finite."""
        return np.asarray(np.isfinite(self.values).all(axis=1))

    @cached_property
    def squared_norms(self) -> NDArray[np.float64]:
        """(N,) squared lengths of the quaternions."""
        squares: NDArray[np.float64] = np.einsum("ij,ij->i", self.values[:, 3:], self.values[:, 3:])
        return squares

    @cached_property
    def accepted(self) -> NDArray[np.bool_]:
        """(N,) whether tf2 accepts the transform."""
        with np.errstate(invalid="ignore", over="ignore"):
            unit = np.abs(self.squared_norms - 1.0) < NORM_TOLERANCE
        named = np.array([_is_edge(self.pair(number)) for number in range(len(self.pairs))], dtype=bool)
        return np.asarray(self.finite & unit & (named[self.edge] if len(self) else np.zeros(0, dtype=bool)))

    @cached_property
    def _number_pairs(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        keys = self.child * len(self.names) + self.parent
        if not len(keys) or keys.max() > _MAX_COUNTED_KEY:
            pairs, edge = np.unique(keys, return_inverse=True)
            return pairs, edge
        pairs = np.flatnonzero(np.bincount(keys))  # ten times as fast as np.unique
        number = np.zeros(int(pairs[-1]) + 1, dtype=np.int64)
        number[pairs] = np.arange(len(pairs))
        return pairs, number[keys]

    @property
    def pairs(self) -> NDArray[np.int64]:
        """The pairs of names that occur, as numbers. See :meth:`pair`."""
        return self._number_pairs[0]

    @property
    def edge(self) -> NDArray[np.int64]:
        """(N,) position of the pair of each row in :attr:`pairs`."""
        return self._number_pairs[1]

    def pair(self, number: int) -> tuple[str, str]:
        """Return the names of parent and child of a pair."""
        child, parent = divmod(int(self.pairs[number]), len(self.names))
        return self.names[parent], self.names[child]

    def publishers_of(self, rows: NDArray[np.intp]) -> tuple[str, ...]:
        """Return the names of the publishers of given rows, as far as they are known."""
        numbers = np.unique(self.publisher[rows]).tolist()
        return tuple(self.publishers[number] for number in numbers if self.publishers[number])


def number_names(known: dict[str, int], names: Iterable[str]) -> NDArray[np.int64]:
    """Return the numbers of names. New names are added to `known` with the next number."""
    return np.array([known.setdefault(name, len(known)) for name in names], dtype=np.int64)


def without_slash(names: tuple[str, str]) -> tuple[str, str]:
    """Return parent and child as tf2 stores them, without a leading slash."""
    parent, child = names
    return parent.lstrip("/"), child.lstrip("/")


def _is_edge(names: tuple[str, str]) -> bool:
    parent, child = without_slash(names)
    return bool(parent and child) and parent != child


_NO_NUMBERS = np.zeros(0, dtype=np.int64)
NO_TRANSFORMS = Transforms(
    arrived=_NO_NUMBERS,
    stamp=_NO_NUMBERS,
    parent=_NO_NUMBERS,
    child=_NO_NUMBERS,
    publisher=_NO_NUMBERS,
    static=np.zeros(0, dtype=bool),
    values=np.zeros((0, 7)),
)
