"""Collector: messages with transforms, as they come in batches, into the rows of an observation."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.doctor.observation import Transforms

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from coframe import _core
    from coframe.bags.transforms import Columns

__all__ = ["Collector"]

# Names come from the wire: a million of them are somebody's mistake, and would cost as much memory as they like.
_MOST_NAMES = 100_000


class _Batch(NamedTuple):
    arrived: NDArray[np.int64]
    stamp: NDArray[np.int64]
    parent: NDArray[np.int64]
    child: NDArray[np.int64]
    publisher: NDArray[np.int64]
    static: NDArray[np.bool_]
    values: NDArray[np.float64]


class Collector:
    """Gathers transforms; names and publishers become numbers.

    Args:
        renaming: What the frames are called from here on; None: as they come.

    Attributes:
        empty: How many messages held no transform.
        damaged: How many were no TFMessage.
        messages: How many there were, by topic.
    """

    def __init__(self, renaming: _core.Renaming | None = None) -> None:
        self._renamed = renaming or str
        self.empty = 0
        self.damaged = 0
        self.messages: dict[str, int] = {}
        self._names: dict[str, int] = {}
        self._publishers: dict[str, int] = {}
        self._batches: list[_Batch] = []

    def add(
        self, topic: str, static: bool, columns: Columns, arrived: NDArray[np.int64], publishers: Sequence[str]
    ) -> None:
        """Takes in the transforms of some messages.

        Args:
            topic: Where they came.
            static: Valid for all time.
            columns: The transforms.
            arrived: (M,) when each message came.
            publishers: (M,) who sent each.
        """
        self.messages[topic] = self.messages.get(topic, 0) + len(arrived)
        self.damaged += columns.damaged
        self.empty += len(arrived) - columns.damaged - len(np.unique(columns.message))
        if not len(columns.stamp) or len(self._names) > _MOST_NAMES:
            return
        called = map(self._renamed, columns.names)
        names = np.array([self._names.setdefault(name, len(self._names)) for name in called], dtype=np.int64)
        number = self._publishers.setdefault
        who = np.array([number(name, len(self._publishers)) for name in publishers], dtype=np.int64)
        self._batches.append(
            _Batch(
                arrived[columns.message],
                columns.stamp,
                names[columns.parent],
                names[columns.child],
                who[columns.message],
                np.full(len(columns.stamp), static),
                columns.values,
            )
        )

    def forget(self, before: int, most: int) -> None:
        """Lets go of moving transforms that came before a time, and of the oldest where there are more than so many."""
        kept: list[_Batch] = []
        rows = 0
        for batch in reversed(self._batches):
            if batch.static[0]:
                kept.append(batch)
            elif batch.arrived[-1] >= before and rows < most:
                kept.append(batch)
                rows += len(batch.stamp)
        self._batches = kept[::-1]

    def transforms(self) -> Transforms:
        """All rows, in the order in which they came."""
        if not self._batches:
            none = np.zeros(0, dtype=np.int64)
            return Transforms(none, none, none, none, none, none.astype(bool), np.zeros((0, 7)), (), ())
        columns: list[Any] = [np.concatenate(column) for column in zip(*self._batches, strict=True)]
        arrived = columns[0]
        if (arrived[1:] < arrived[:-1]).any():
            order = np.argsort(arrived, kind="stable")
            columns = [column[order] for column in columns]
        named = _Batch(*columns)._asdict()
        return Transforms(**named, names=tuple(self._names), publishers=tuple(self._publishers))
