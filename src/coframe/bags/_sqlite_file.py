# SPDX-License-Identifier: Apache-2.0
"""Reader for rosbag2's SQLite files of all schema versions."""

from __future__ import annotations

import sqlite3
import threading
from array import array
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe._files.regular_files import open_regular
from coframe._output.formatting import count
from coframe.bags._compression import MAX_UNPACKED_BYTES, DamagedError
from coframe.bags._sqlite_database import DAMAGE_ERRORS, Database
from coframe.bags._sqlite_leaves import LeafRow, Leaves
from coframe.bags.formats import SQLITE
from coframe.bags.storage import Batch, Channel, Storage
from coframe.messages.slices import Slices

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from coframe.bags._problems import Problems

__all__ = ["SqliteStorage"]

_BATCH_SIZE = 2000  # rows
_BATCH_BYTES = 64 << 20
_MAX_TOPIC_BYTES = 1 << 20
_DAMAGED = (
    "database disk image is malformed",
    "file is not a database",
    "disk I/O error",
    "the rows of messages are not in order",
)
# Querying type and size does not read the data. The value is NULL for data of a wrong type or size.
_DATA, _SIZE = (
    f"CASE WHEN typeof(data) = 'blob' AND length(data) <= {MAX_UNPACKED_BYTES} THEN {value} END"
    for value in ("data", "length(data)")
)


class SqliteStorage(Storage):
    """A ``.db3`` file. The position of a message is its row ID."""

    format = SQLITE

    def __init__(self, path: Path, problems: Problems) -> None:
        super().__init__(path, problems)
        self._path = path
        self._lock = threading.Lock()
        self._database = Database(path, self.add_problem)
        self._channels: dict[int, Channel] = {}
        # Rows that share pages have more data than the file.
        self._bytes_left = self._database.size
        # Of a damaged database:
        self._damage_reason = ""
        self._leaves: Leaves | None = None
        self._leaf_rows: dict[int, LeafRow] = {}  # the messages that were found without the tree, by row ID
        self._are_leaves_known = False
        self._found_count = self._last_row = 0

    def channels(self) -> list[Channel]:
        """Return the channels found so far."""
        return list(self._channels.values())

    def batches(self, is_selected: Callable[[Channel], bool], progress: Callable[[int], object]) -> Iterator[Batch]:
        """Yield the messages of the wanted channels with their bytes, then the others without bytes."""
        total = 0
        try:
            self._channels = self._read_channels()
            total = self._database.last_row("messages") or 0
        except DAMAGE_ERRORS as error:
            if not _is_damaged(error):
                self.add_problem(f"the database cannot be read: {error}")
                return
            self._note_damage(error)
            self._channels = self._channels or self._recovered_channels()
            rows = 0
            if not self._channels and self._leaves is not None:
                rows = sum(row.is_message for row in self._leaves.rows())
            if not self._channels and rows:
                self.add_problem(f"its topics are lost, so that {count(rows, 'message')} in it cannot be read")
        with_data = [number for number, channel in self._channels.items() if is_selected(channel)]
        without_data = [number for number in self._channels if number not in with_data]
        for numbers, column in ((with_data, _DATA), (without_data, _SIZE)):
            yield from self._rows(numbers, column, lambda row: progress(self.size * row // max(total, row, 1)))
        if self._leaves is not None:
            self._report_missing(total)
        progress(self.size)

    def _rows(self, numbers: list[int], column: str, progress: Callable[[int], object]) -> Iterator[Batch]:
        if not numbers:
            return
        read = array("q")
        try:
            if self._leaves is not None:
                raise sqlite3.DatabaseError(self._damage_reason)  # The tree has been found damaged before.
            found = self._database.rows(
                "messages", f"topic_id, timestamp, {column}", f"topic_id IN ({', '.join(map(str, numbers))})"
            )
            for rows in self._parts(found):
                read.extend(row[0] for row in rows)
                progress(rows[-1][0])
                self._note_rows(rows)
                yield from self._batches_by_topic(rows, with_data=column == _DATA)
        except DAMAGE_ERRORS as error:
            if not _is_damaged(error):
                self.add_problem(f"the database is damaged and was read only in part: {error}")
                return
            self._note_damage(error)
        else:
            return
        try:
            for rows in self._parts(self._recovered_rows(set(numbers), set(read), with_data=column == _DATA)):
                self._note_rows(rows)
                yield from self._batches_by_topic(rows, with_data=column == _DATA)
        except sqlite3.DatabaseError as error:
            self.add_problem(f"the database is damaged and was read only in part: {error}")

    def _report_missing(self, total: int) -> None:
        """Report how many messages are missing, of ``total`` ones, or 0 if that is not known."""
        lost = max(total, self._last_row) - self._found_count
        missing = f"{count(lost, 'message')} of {total} missing" if total else f"{lost} missing before the last one"
        unknown = "" if total else "; how many come after it is unknown"
        found = count(self._found_count, "message")
        self.add_problem(f"the database is damaged ({self._damage_reason}): {found} read, {missing}{unknown}")

    def _note_damage(self, error: Exception) -> None:
        self._damage_reason = str(error)
        self._leaves = self._leaves or Leaves(self._path)

    def _note_rows(self, rows: list[tuple[Any, ...]]) -> None:
        self._found_count += len(rows)
        self._last_row = max(self._last_row, rows[-1][0])

    def _recovered_channels(self) -> dict[int, Channel]:
        """Return the topics on the leaves of a damaged database."""
        found: dict[int, Channel] = {}
        for row in self._leaves.rows() if self._leaves is not None else ():
            if row.is_topic and row.size <= _MAX_TOPIC_BYTES:
                with suppress(DamagedError):
                    name, type_, encoding, *rest = (str(each, "utf-8", "replace") for each in self._values(row, 1))
                    if name.startswith("/") and "/" in type_:
                        found.setdefault(row.number, Channel(name, type_, encoding, offered_qos="".join(rest[:1])))
        return found

    def _recovered_rows(self, numbers: set[int], read: set[int], *, with_data: bool) -> Iterator[tuple[Any, ...]]:
        """Yield the rows of messages on the leaves of a damaged database, except those that have been read."""
        leaves = self._leaves
        for row in leaves.rows() if leaves is not None else ():
            if not row.is_message or row.number in self._leaf_rows or row.number in read:
                continue
            with suppress(DamagedError):
                _, topic, time = self._integers(row)
                if topic in numbers:
                    data = self._values(row, 3)[0]
                    self._leaf_rows[row.number] = row
                    self._last_row = max(self._last_row, row.number)
                    yield row.number, topic, time, data if with_data else len(data)

    def _integers(self, row: LeafRow) -> list[int]:
        if self._leaves is None:
            raise DamagedError("the file is closed")
        with self._lock:
            return self._leaves.integers(row, 3)

    def _values(self, row: LeafRow, first: int) -> list[bytes]:
        if self._leaves is None:
            raise DamagedError("the file is closed")
        with self._lock:
            return self._leaves.values(row, first)

    def _parts(self, found: Iterator[tuple[Any, ...]]) -> Iterator[list[tuple[Any, ...]]]:
        """Yield the rows in parts of limited size, so that only a few messages are in memory."""
        rows: list[tuple[Any, ...]] = []
        size = 0
        for row in found:
            data = row[3]
            size += len(data) if isinstance(data, bytes) else data or 0
            if size > self._bytes_left:
                break
            rows.append(row)
            if len(rows) == _BATCH_SIZE or size > _BATCH_BYTES:
                self._bytes_left -= size
                yield rows
                rows, size = [], 0
        if rows:
            yield rows
        if size > self._bytes_left:
            raise sqlite3.DatabaseError("the messages have more bytes than the file")
        self._bytes_left -= size

    def _batches_by_topic(self, rows: list[tuple[Any, ...]], *, with_data: bool) -> Iterator[Batch]:
        """Yield one batch per topic. Rows with a time or data of the wrong type are skipped."""
        _, topics, times, data = zip(*rows, strict=True)
        if set(map(type, times)) != {int} or None in data:
            good = [row for row in rows if isinstance(row[2], int) and row[3] is not None]
            limit = f"{MAX_UNPACKED_BYTES >> 20} MiB"
            problem = f"rows with a time or data of the wrong type, or with more than {limit}"
            self.add_problem(problem, len(rows) - len(good))
            rows = good
            topics = tuple(row[1] for row in good)
        numbers = set(topics)
        for number in numbers:
            group = rows if len(numbers) == 1 else [row for row in rows if row[1] == number]
            positions, _, received, messages = zip(*group, strict=True)
            yield Batch(
                self._channels[number],
                np.fromiter(received, np.int64, len(group)),
                np.fromiter(positions, np.int64, len(group)).astype(np.uint64),
                Slices.join(messages) if with_data else None,
            )

    def _read_channels(self) -> dict[int, Channel]:
        tables = self._database.tables()
        for name in ("topics", "messages"):
            if name not in tables:
                raise sqlite3.DatabaseError(f"no table {name}: {self._missing_tables_reason()}")
        definitions = {}
        if "message_definitions" in tables:
            columns = "topic_type, encoding, encoded_message_definition"
            for _, type_, kind, text in self._count_bytes(self._database.rows("message_definitions", columns)):
                definitions[type_] = (str(text).encode(), str(kind))
        qos = "offered_qos_profiles" if "offered_qos_profiles" in tables["topics"] else "''"
        # In some recordings, the column id of topics is not the row number.
        found = self._count_bytes(self._database.rows("topics", f"id, name, type, serialization_format, {qos}"))
        return {
            number: Channel(str(topic), str(type_), str(encoding), *definitions.get(type_, (b"", "")), str(offered))
            for _, number, topic, type_, encoding, offered in found
            if isinstance(number, int)
        }

    def _missing_tables_reason(self) -> str:
        """Return why the tables can be missing."""
        with open_regular(self._path) as file:
            is_in_wal_mode = file.read(20)[18:] == b"\x02\x02"
        log = f"{self.path.name}-wal"
        if is_in_wal_mode and not self._path.with_name(log).exists():
            return f"its recorder wrote to {log}, which is missing; copy that file as well"
        return "the file is not a recording of rosbag2"

    def _count_bytes(self, rows: Iterator[tuple[Any, ...]]) -> Iterator[tuple[Any, ...]]:
        """Yield rows, and count the bytes of their strings."""
        for row in rows:
            self._bytes_left -= sum(len(value) for value in row if isinstance(value, str | bytes))
            if self._bytes_left < 0:
                raise sqlite3.DatabaseError("the topics and definitions have more bytes than the file")
            yield row

    def read(self, position: int) -> bytes:
        """Return the data of a row."""
        if (row := self._leaf_rows.get(_row(position))) is not None:
            return self._values(row, 3)[0]
        try:
            with self._lock:
                data = self._database.blob("messages", "data", _row(position))
        except DAMAGE_ERRORS as error:
            raise DamagedError(f"the database is damaged: {error}") from None
        if data is None:
            return self._read_from_leaf(_row(position))
        return data

    def _read_from_leaf(self, number: int) -> bytes:
        """Return the data of a row that was read before, but that a search in the damaged tree does not find."""
        with self._lock:
            self._leaves = self._leaves or Leaves(self._path)
            if not self._are_leaves_known:
                self._are_leaves_known = True
                self._leaf_rows |= {row.number: row for row in self._leaves.rows() if row.is_message}
        if (row := self._leaf_rows.get(number)) is None:
            raise DamagedError("the message no longer exists")
        return self._values(row, 3)[0]

    def head(self, position: int, size: int) -> bytes:
        """Return the first bytes of the data of a row, without reading the rest."""
        if _row(position) in self._leaf_rows:
            return self.read(position)[:size]
        try:
            with self._lock:
                return self._database.beginning("messages", "data", _row(position), size)
        except DAMAGE_ERRORS as error:
            raise DamagedError(f"the database is damaged: {error}") from None

    def close(self) -> None:
        """Close the file."""
        self._database.close()
        if self._leaves is not None:
            self._leaves.close()
            self._leaves = None


def _is_damaged(error: Exception) -> bool:
    """Return whether SQLite found a damaged page, unlike a database that is not a recording or does not end."""
    return str(error).startswith(_DAMAGED)


def _row(position: int) -> int:
    """Return the row ID (signed) for a position (unsigned)."""
    return position - (1 << 64) if position >= 1 << 63 else position
