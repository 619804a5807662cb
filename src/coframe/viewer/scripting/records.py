# SPDX-License-Identifier: Apache-2.0
"""A store of immutable records that any thread may change, and that feeds read by version."""

from __future__ import annotations

import itertools
import threading
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Generic, TypeVar

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["Record", "RecordStore"]


@dataclass(frozen=True)
class Record:
    """The displayed state of one node or widget.

    Attributes:
        id: Its number, which is never used again.
        version: The revision of the store at its last change.
    """

    id: int
    version: int


R = TypeVar("R", bound=Record)


class RecordStore(Generic[R]):
    """Records by their ids, in the order in which they were added.

    Attributes:
        lock: Held while several records are read or changed together.
        revision: A number that increases with every change.
    """

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self.revision = 0
        self._records: dict[int, R] = {}
        self._ids = itertools.count(1)

    def __len__(self) -> int:
        return len(self._records)

    def all(self) -> list[R]:
        """Return all records."""
        with self.lock:
            return list(self._records.values())

    def get(self, number: int) -> R | None:
        """Return a record, or None if it was removed."""
        return self._records.get(number)

    def next_id(self) -> int:
        """Return the id for a new record."""
        return next(self._ids)

    def put(self, record: R, **fields: Any) -> R:
        """Add a record with other values of some fields, or replace the one with its id; return it with its version."""
        with self.lock:
            self.revision += 1
            stored = self._records[record.id] = replace(record, version=self.revision, **fields)
            return stored

    def change(self, number: int, **fields: Any) -> R | None:
        """Change fields of a record and return it, or None if it was removed."""
        with self.lock:
            record = self._records.get(number)
            return None if record is None else self.put(record, **fields)

    def drop(self, numbers: Iterable[int]) -> None:
        """Remove records. Those that do not exist are skipped."""
        with self.lock:
            for number in list(numbers):
                if self._records.pop(number, None) is not None:
                    self.revision += 1
