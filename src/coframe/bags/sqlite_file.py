# SPDX-License-Identifier: Apache-2.0
"""Reader for rosbag2's SQLite files of all schema versions."""

from __future__ import annotations

import sqlite3
import threading
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.bags.compression import LARGEST, DamagedError
from coframe.bags.storage import Batch, Channel, Storage
from coframe.messages.slices import Slices

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from coframe.bags.problems import Problems

__all__ = ["MAGIC", "SqliteStorage"]

MAGIC = b"SQLite format 3\0"

# SQLite's error texts quote damaged data, which may not be UTF-8.
_DAMAGE = (sqlite3.Error, UnicodeDecodeError)
_BATCH_SIZE = 2000  # rows
_BATCH_BYTES = 64 << 20


class SqliteStorage(Storage):
    """A ``.db3`` file; the position of a message is the id of its row."""

    format = "SQLite"

    def __init__(self, path: Path, problems: Problems) -> None:
        super().__init__(path, problems)
        self._lock = threading.Lock()
        self._database = self._open()
        self._channels: dict[int, Channel] = {}

    def _open(self) -> sqlite3.Connection:
        # A journal next to the file means that the recorder was killed. SQLite recovers the data from it, which fails
        # in a read-only folder.
        journals = [self.path.with_name(f"{self.path.name}-{kind}") for kind in ("wal", "journal")]
        if any(journal.exists() for journal in journals):
            recovered = sqlite3.connect(f"{self.path.absolute().as_uri()}?mode=ro", uri=True, check_same_thread=False)
            try:
                recovered.execute("SELECT count(*) FROM sqlite_master").fetchone()
            except _DAMAGE as error:
                recovered.close()
                self.add_problem(f"the journal of the database cannot be read ({error}); the last messages are missing")
            else:
                return recovered
        uri = f"{self.path.absolute().as_uri()}?mode=ro&immutable=1"
        return sqlite3.connect(uri, uri=True, check_same_thread=False)

    def channels(self) -> list[Channel]:
        """Return the channels found so far."""
        return list(self._channels.values())

    def batches(self, wanted: Callable[[Channel], bool], progress: Callable[[int], object]) -> Iterator[Batch]:
        """Yield the messages of the wanted channels with their bytes, then the others without."""
        try:
            self._database.text_factory = lambda text: text.decode("utf-8", "replace")
            self._database.execute("PRAGMA trusted_schema = OFF")
            self._channels = self._read_channels()
            (total,) = self._database.execute("SELECT max(id) FROM messages").fetchone()
        except (*_DAMAGE, TypeError) as error:
            self.add_problem(f"the database cannot be read: {error}")
            return
        if not isinstance(total, int):
            return
        with_data = [number for number, channel in self._channels.items() if wanted(channel)]
        without_data = [number for number in self._channels if number not in with_data]
        data = f"CASE WHEN length(data) <= {LARGEST} THEN data END"
        for numbers, column in ((with_data, data), (without_data, "NULL")):
            yield from self._rows(numbers, column, lambda row: progress(self.size * row // max(total, 1)))
        progress(self.size)

    def _rows(self, numbers: list[int], column: str, progress: Callable[[int], object]) -> Iterator[Batch]:
        if not numbers:
            return
        # Safe from SQL injection: the query contains only integers and column names of this module.
        query = (
            f"SELECT topic_id, id, timestamp, {column} FROM messages "  # noqa: S608
            f"WHERE topic_id IN ({', '.join(map(str, numbers))}) ORDER BY id"
        )
        try:
            cursor = self._database.execute(query)
            for rows in _parts(cursor):
                progress(rows[-1][1])
                yield from self._grouped(rows, with_data=column != "NULL")
        except _DAMAGE as error:
            self.add_problem(f"the database is damaged and was read only in part: {error}")

    def _grouped(self, rows: list[tuple[Any, ...]], *, with_data: bool) -> Iterator[Batch]:
        """Yield one batch per topic; rows with a time or data of the wrong type are skipped."""
        topics, _, times, data = zip(*rows, strict=True)
        if set(map(type, times)) != {int} or (with_data and set(map(type, data)) != {bytes}):
            good = [row for row in rows if isinstance(row[2], int) and (isinstance(row[3], bytes) or not with_data)]
            limit = f"{LARGEST >> 20} MiB"
            problem = f"rows with a time or data of the wrong type, or with more than {limit}"
            self.add_problem(problem, len(rows) - len(good))
            rows = good
        numbers = set(topics)
        for number in numbers:
            group = rows if len(numbers) == 1 else [row for row in rows if row[0] == number]
            if group:
                _, positions, received, messages = zip(*group, strict=True)
                yield Batch(
                    self._channels[number],
                    np.fromiter(received, np.int64, len(group)),
                    np.fromiter(positions, np.int64, len(group)).astype(np.uint64),
                    Slices.join(messages) if with_data else None,
                )

    def _read_channels(self) -> dict[int, Channel]:
        tables = dict(self._query("SELECT name, sql FROM sqlite_master WHERE type = 'table'"))
        for name in ("topics", "messages"):
            if not str(tables.get(name)).upper().startswith("CREATE TABLE"):
                raise sqlite3.DatabaseError(f"no table {name}: the file is not a recording of rosbag2")
        for name in ("topics", "messages", "message_definitions"):
            if any(hidden for *_, hidden in self._query(f"PRAGMA table_xinfo({name})")):
                # Their expressions can ask for any amount of memory and time.
                raise sqlite3.DatabaseError(f"the table {name} has generated columns, unlike recordings of rosbag2")
        definitions = {}
        if "message_definitions" in tables:
            for type_, kind, text in self._query(
                "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions"
            ):
                definitions[type_] = (str(text).encode(), str(kind))
        qos = "offered_qos_profiles" if "offered_qos_profiles" in str(tables["topics"]) else "''"
        return {
            number: Channel(str(topic), str(type_), str(encoding), *definitions.get(type_, (b"", "")), str(offered))
            for number, topic, type_, encoding, offered in self._query(
                f"SELECT id, name, type, serialization_format, {qos} FROM topics"  # noqa: S608 - a column name of this module
            )
            if isinstance(number, int)
        }

    def _query(self, query: str) -> list[Any]:
        return self._database.execute(query).fetchall()

    def read(self, position: int) -> bytes:
        """Return the data of a row."""
        try:
            with self._lock:
                row = self._database.execute("SELECT data FROM messages WHERE id = ?", (_row(position),)).fetchone()
        except _DAMAGE as error:
            raise DamagedError(f"the database is damaged: {error}") from None
        if row is None or not isinstance(row[0], bytes):
            raise DamagedError("the message no longer exists")
        return bytes(row[0])

    def head(self, position: int, size: int) -> bytes:
        """Return the first bytes of the data of a row, without reading the rest."""
        if not hasattr(self._database, "blobopen"):  # before Python 3.11
            return super().head(position, size)
        try:
            with self._lock, self._database.blobopen("messages", "data", _row(position), readonly=True) as blob:
                return bytes(blob.read(size))
        except _DAMAGE as error:
            raise DamagedError(f"the database is damaged: {error}") from None

    def close(self) -> None:
        """Close the file."""
        self._database.close()


def _parts(cursor: sqlite3.Cursor) -> Iterator[list[tuple[Any, ...]]]:
    """Yield the rows in parts of limited size, so that the data of few messages is in memory."""
    rows: list[tuple[Any, ...]] = []
    size = 0
    for row in cursor:
        rows.append(row)
        size += len(row[3]) if isinstance(row[3], bytes) else 0
        if len(rows) == _BATCH_SIZE or size > _BATCH_BYTES:
            yield rows
            rows, size = [], 0
    if rows:
        yield rows


def _row(position: int) -> int:
    """Return the id of a row, which may be negative, for a position, which is unsigned."""
    return position - (1 << 64) if position >= 1 << 63 else position
