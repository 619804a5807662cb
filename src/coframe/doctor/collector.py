# SPDX-License-Identifier: Apache-2.0
"""Collector: builds the table of transforms of an observation from batches of messages."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor._transform_rows import TransformRows
from coframe.doctor._transforms import Transforms, number_names

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from coframe import _core
    from coframe.messages.tf_columns import TransformColumns

__all__ = ["Collector"]

# A faulty publisher may send any number of names; the limit bounds the memory for them.
MAX_NAMES = 100_000
MAX_NAME_BYTES = 64 << 20


class Collector:
    """Collects transforms; frame names become numbers.

    Args:
        renaming: Returns the new names of frames; None keeps the names.

    Attributes:
        empty: The number of messages without transforms.
        damaged: The number of messages that are not valid TFMessages.
        ignored: The number of messages ignored because the limit of names was reached.
        messages: The number of messages by topic.
    """

    def __init__(self, renaming: _core.Renaming | None = None) -> None:
        self._rename = renaming or str
        self.empty = 0
        self.damaged = 0
        self.ignored = 0
        self.messages: dict[str, int] = {}
        self._names: dict[str, int] = {}
        self._name_bytes = 0
        self._static = TransformRows()
        self._dynamic_rows = TransformRows()

    def add(
        self,
        topic: str,
        static: bool,
        columns: TransformColumns,
        arrival_times: NDArray[np.int64],
        publisher: NDArray[np.int64],
        publishers: Sequence[str],
    ) -> None:
        """Add the transforms of some messages.

        Args:
            topic: The topic of the messages.
            static: Whether it is a topic of static transforms.
            columns: The transforms.
            arrival_times: (M,) time of arrival of each message.
            publisher: (M,) number of the publisher of each message.
            publishers: The names of the publishers, or "" for one that is unknown.
        """
        self.messages[topic] = self.messages.get(topic, 0) + len(arrival_times)
        self.damaged += columns.damaged
        self.empty += len(arrival_times) - columns.damaged - len(np.unique(columns.message))
        self._name_bytes += sum(len(name) for name in columns.names if name not in self._names)
        if len(self._names) > MAX_NAMES or self._name_bytes > MAX_NAME_BYTES:
            self.ignored += len(arrival_times)
            return
        if not len(columns.stamp):
            return
        names = number_names(self._names, columns.names)
        batch = Transforms(
            arrived=arrival_times[columns.message],
            stamp=columns.stamp,
            parent=names[columns.parent],
            child=names[columns.child],
            publisher=publisher[columns.message],
            static=np.full(len(columns.stamp), static),
            values=columns.values,
            publishers=tuple(publishers),
        )
        (self._static if static else self._dynamic_rows).append(batch)

    def forget(self, cutoff: int, limit: int) -> None:
        """Remove dynamic transforms that arrived before a time, and the oldest ones beyond a maximum number of rows."""
        self._dynamic_rows.forget(cutoff, limit)
        self._static.forget(0, limit)

    @property
    def forgotten_until(self) -> int:
        """The arrival time of the last transform removed because of the limit, or 0 if none was."""
        return max(self._static.forgotten_until, self._dynamic_rows.forgotten_until)

    def transforms(self) -> Transforms:
        """Return all rows in the order of arrival."""
        sent = tuple(self._names)
        return Transforms.join_batches(
            [self._static.table(), self._dynamic_rows.table()], tuple(map(self._rename, sent)), sent
        )

    def publishers(self) -> set[str]:
        """Return the names of the publishers of the remaining rows."""
        return self._static.publishers() | self._dynamic_rows.publishers()
