"""Collector: messages with transforms, as they come in batches, into the rows of an observation."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.transforms import Transforms, numbered

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from coframe import _core
    from coframe.messages.tf_columns import TransformColumns

__all__ = ["Collector"]

# Names come from the wire: a million of them are somebody's mistake, and would cost as much memory as they like.
_MOST_NAMES = 100_000


class Collector:
    """Gathers transforms; names become numbers.

    Args:
        renaming: What the frames are called from here on; None: as they come.

    Attributes:
        empty: How many messages held no transform.
        damaged: How many were no TFMessage.
        left_out: How many came after too many names, and were not looked at.
        messages: How many there were, by topic.
    """

    def __init__(self, renaming: _core.Renaming | None = None) -> None:
        self._renamed = renaming or str
        self.empty = 0
        self.damaged = 0
        self.left_out = 0
        self.messages: dict[str, int] = {}
        self._names: dict[str, int] = {}
        self._static: deque[Transforms] = deque()
        self._moving: deque[Transforms] = deque()

    def add(
        self,
        topic: str,
        static: bool,
        columns: TransformColumns,
        arrived: NDArray[np.int64],
        publisher: NDArray[np.int64],
        publishers: Sequence[str],
    ) -> None:
        """Takes in the transforms of some messages.

        Args:
            topic: Where they came.
            static: Valid for all time.
            columns: The transforms.
            arrived: (M,) when each message came.
            publisher: (M,) number of who sent it.
            publishers: Their names, "" for one that is not known.
        """
        self.messages[topic] = self.messages.get(topic, 0) + len(arrived)
        self.damaged += columns.damaged
        self.empty += len(arrived) - columns.damaged - len(np.unique(columns.message))
        if len(self._names) > _MOST_NAMES:
            self.left_out += len(arrived)
            return
        if not len(columns.stamp):
            return
        names = numbered(self._names, columns.names)
        batch = Transforms(
            arrived=arrived[columns.message],
            stamp=columns.stamp,
            parent=names[columns.parent],
            child=names[columns.child],
            publisher=publisher[columns.message],
            static=np.full(len(columns.stamp), static),
            values=columns.values,
            publishers=tuple(publishers),
        )
        (self._static if static else self._moving).append(batch)

    def forget(self, before: int, most: int) -> None:
        """Lets go of moving transforms that came before a time, and of the oldest where there are more than so many."""
        while self._moving and self._moving[0].arrived[-1] < before:
            self._moving.popleft()
        for batches in (self._static, self._moving):
            rows = sum(map(len, batches))
            while rows > most and len(batches) > 1:
                rows -= len(batches.popleft())

    def transforms(self) -> Transforms:
        """All rows, in the order in which they came."""
        sent = tuple(self._names)
        return Transforms.joined([*self._static, *self._moving], tuple(map(self._renamed, sent)), sent)

    def publishers(self) -> set[str]:
        """Who sent what has not been let go of."""
        return {name for batches in (self._static, self._moving) for batch in batches for name in batch.publishers}
