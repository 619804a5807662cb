# SPDX-License-Identifier: Apache-2.0
"""TransformRows: transforms that are appended at the end and removed at the beginning, in reused arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.doctor._transforms import COLUMNS, NO_TRANSFORMS, Transforms, number_names

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["TransformRows"]

_GROWTH_FACTOR = 1.5  # growth factor of the arrays when they are almost full
_MIN_GROWTH = 1.1  # with fewer, rows would be moved too often
_MAX_PUBLISHERS = 1000  # with more, unused ones are removed


class TransformRows:
    """Rows of transforms in the order in which they were appended.

    The arrays are reused for new rows. If each batch had its own arrays, they would be allocated and freed several
    times per second, and fragmentation would increase the memory of long-running processes.

    Attributes:
        forgotten_until: The arrival time of the last row removed because of the limit, or 0 if none was.
    """

    def __init__(self) -> None:
        empty = {name: getattr(NO_TRANSFORMS, name) for name in (*COLUMNS, "publisher")}
        self._columns: dict[str, NDArray[Any]] = {name: column.copy() for name, column in empty.items()}
        self._publishers: dict[str, int] = {}
        self._begin = 0
        self._end = 0
        self.forgotten_until = 0

    def __len__(self) -> int:
        return self._end - self._begin

    def append(self, batch: Transforms) -> None:
        """Append copies of all rows of a batch."""
        self._make_room(len(batch))
        rows = slice(self._end, self._end + len(batch))
        for name in COLUMNS:
            self._columns[name][rows] = getattr(batch, name)
        self._columns["publisher"][rows] = number_names(self._publishers, batch.publishers)[batch.publisher]
        self._end = rows.stop

    def forget(self, cutoff: int, limit: int) -> None:
        """Remove the rows that arrived before a time, and the oldest ones beyond a maximum number."""
        recent = self._columns["arrived"][self._begin : self._end] >= cutoff
        self._begin = self._begin + int(recent.argmax()) if recent.any() else self._end
        if len(self) > limit:
            self._begin = self._end - limit
            self.forgotten_until = int(self._columns["arrived"][self._begin - 1])
        if len(self._publishers) > _MAX_PUBLISHERS:
            self._forget_publishers()

    def table(self) -> Transforms:
        """Return the rows without copying; valid until the next change."""
        rows = slice(self._begin, self._end)
        columns: dict[str, Any] = {name: column[rows] for name, column in self._columns.items()}
        return Transforms(**columns, publishers=tuple(self._publishers))

    def publishers(self) -> set[str]:
        """Return the names of the publishers of the rows."""
        names = tuple(self._publishers)
        return {names[number] for number in np.unique(self._columns["publisher"][self._begin : self._end]).tolist()}

    def _make_room(self, count: int) -> None:
        """Make room for this number of rows at the end: move rows to the beginning, and enlarge full arrays."""
        capacity = len(self._columns["stamp"])
        if self._end + count <= capacity:
            return
        kept, length = slice(self._begin, self._end), len(self)
        larger = int(_GROWTH_FACTOR * (length + count)) if _MIN_GROWTH * (length + count) > capacity else 0
        for name, column in self._columns.items():
            target = np.empty((larger, *column.shape[1:]), column.dtype) if larger else column
            # One-dimensional, because NumPy copies all rows of other arrays if they overlap.
            target[:length].reshape(-1)[:] = column[kept].reshape(-1)
            self._columns[name] = target
        self._begin, self._end = 0, length

    def _forget_publishers(self) -> None:
        rows = slice(self._begin, self._end)
        used, numbers = np.unique(self._columns["publisher"][rows], return_inverse=True)
        names = tuple(self._publishers)
        self._publishers = {names[number]: i for i, number in enumerate(used.tolist())}
        self._columns["publisher"][rows] = numbers
