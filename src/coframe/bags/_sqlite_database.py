# SPDX-License-Identifier: Apache-2.0
"""Open untrusted SQLite files without writing next to them, and limit the work of each query.

A database of a few kilobytes can describe endless rows: pages shared by several rows, pages that contain themselves,
views that are programs.
"""

from __future__ import annotations

import os
import re
import shutil
import sqlite3
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from coframe._files.existence import is_file
from coframe._files.regular_files import open_regular
from coframe._files.temporary_folders import temporary_folder
from coframe.bags._compression import MAX_UNPACKED_BYTES

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["DAMAGE_ERRORS", "Database"]

# SQLite's error messages quote damaged data, which may not be UTF-8.
DAMAGE_ERRORS: Final = (sqlite3.Error, UnicodeDecodeError)

# SQLite's virtual machine runs about 50 million steps per second. A row of a recording takes about 20 steps and has
# more than 20 bytes.
MIN_STEPS: Final = 5_000_000
MAX_STEPS_PER_BYTE: Final = 4
MAX_SCHEMA_STEPS: Final = 20_000  # enough for about 2000 tables and indexes; recordings have at most six
MAX_SQL: Final = 20_000  # bytes of the definition of a table; those of recordings have less than 500
MAX_COLUMNS: Final = 100
MAX_RECOVERED: Final = 4 << 30  # bytes of a database that is copied because its recorder was killed
_STEPS_PER_CHECK: Final = 1000
_BEFORE_FIRST_ROW: Final = -(1 << 63) - 1
_PLAIN_DEFINITION: Final = re.compile(r"CREATE (TABLE|(UNIQUE )?INDEX) ", re.IGNORECASE)
# If two databases were changed together, a journal ends with the name of another file, which SQLite may delete.
_MASTER_JOURNAL_MAGIC: Final = b"\xd9\xd5\x05\xf9\x20\xa1\x63\xd7"


class Database:
    """A read-only connection.

    Args:
        path: The file.
        add_problem: Receives a message if a journal next to the file cannot be used.

    Attributes:
        size: The size of the file and its journal in bytes, an upper bound for all data.
    """

    def __init__(self, path: Path, add_problem: Callable[[str], object]) -> None:
        self._closing = ExitStack()
        self._steps = 0
        self._process = os.getpid()
        self._path = path.resolve()  # SQLite looks for journals next to the target of a link.
        self.size = self._path.stat().st_size
        self._connection = self._recover_journal(add_problem) or self._connect(self._path, "mode=ro&immutable=1")
        self._closing.callback(self._connection.close)

    def close(self) -> None:
        """Close the file."""
        self._closing.close()

    def tables(self) -> dict[str, str]:
        """Return the definitions of all tables by name.

        Raises:
            sqlite3.Error: The file is not a database, or has objects that are neither tables nor indexes.
        """
        found = self._query("SELECT name, sql FROM sqlite_master", (), MAX_SCHEMA_STEPS).fetchall()
        for name, definition in found:
            # Only the definitions matter: the names and types in the other columns can differ from them.
            if definition is not None and not _PLAIN_DEFINITION.match(str(definition)):
                raise sqlite3.DatabaseError(
                    f"{str(name)[:60]} is neither a table nor an index: recordings have no others"
                )
        self._limit("SQL_LENGTH", MAX_UNPACKED_BYTES)
        return {str(name): str(definition) for name, definition in found if definition is not None}

    def rows(self, table: str, columns: str, condition: str = "") -> Iterator[tuple[Any, ...]]:
        """Yield the rows of a table in the order of their IDs.

        Args:
            table: Its name.
            columns: The values to read from each row, as SQL.
            condition: The rows to read, as an SQL condition after WHERE, or "" for all.

        Raises:
            sqlite3.Error: The database is damaged, or has no plain table of this name.
        """
        if any(hidden for *_, hidden in self._query(f"PRAGMA table_xinfo({table})")):
            # Their expressions can take any amount of memory and time.
            raise sqlite3.DatabaseError(f"the table {table} has generated columns, which rosbag2 does not write")
        # Safe from SQL injection: callers pass only integers and names of their own.
        query = f"SELECT rowid, {columns} FROM {table} NOT INDEXED {condition and 'WHERE'} {condition} ORDER BY rowid"  # noqa: S608
        plan = [row[-1] for row in self._query(f"EXPLAIN QUERY PLAN {query}")]
        if len(plan) != 1 or not re.fullmatch(rf"SCAN (TABLE )?{table}", plan[0]):
            raise sqlite3.DatabaseError(f"{table} is not a plain table: rosbag2 writes only plain tables")
        last = _BEFORE_FIRST_ROW
        found = self._query(query)
        with self._explain_interruption():
            for row in found:
                if row[0] <= last:
                    raise sqlite3.DatabaseError(f"the rows of {table} are not in order: it contains a page twice")
                last = row[0]
                yield row

    def last_row(self, table: str) -> int | None:
        """Return the largest row ID of a table, or None if it is empty."""
        (number,) = self._query(f"SELECT max(rowid) FROM {table}").fetchone()  # noqa: S608 - as in `rows`
        if number is not None and not isinstance(number, int):
            raise sqlite3.DatabaseError(f"{table} has a column named rowid, which rosbag2 does not write")
        return number

    def first_row(self, table: str) -> int | None:
        """Return the smallest row ID of a table, or None if it is empty."""
        found = self.extremes(table, "rowid")
        return None if found is None else found[0]

    def extremes(self, table: str, column: str) -> tuple[int, int] | None:
        """Return the smallest and the largest value of a column of integers, or None if there are none."""
        low, high = self._query(f"SELECT min({column}), max({column}) FROM {table}").fetchone()  # noqa: S608 - as in `rows`
        return (low, high) if isinstance(low, int) and isinstance(high, int) else None

    def blob(self, table: str, column: str, row: int) -> bytes | None:
        """Return the value of a row, or None if the row does not exist or its value is not a BLOB."""
        query = f"SELECT {column} FROM {table} WHERE rowid = ? AND typeof({column}) = 'blob'"  # noqa: S608 - as in `rows`
        found = self._query(query, (row,)).fetchone()
        return None if found is None else bytes(found[0])

    def beginning(self, table: str, column: str, row: int, size: int) -> bytes:
        """Return the first bytes of the value of a row, without reading the rest if Python supports that."""
        self._check_process()
        if not hasattr(self._connection, "blobopen"):  # before Python 3.11
            return (self.blob(table, column, row) or b"")[:size]
        with self._connection.blobopen(table, column, row, readonly=True) as blob:
            return bytes(blob.read(size))

    def _check_process(self) -> None:
        """Open the file again in a forked process, which must not use the connection of its parent."""
        if self._process != os.getpid():
            self._process = os.getpid()
            self._inherited_connection = self._connection  # Closing it would release the locks of the parent.
            self._connect(*self._open_arguments)

    def _query(self, query: str, values: tuple[Any, ...] = (), steps: int | None = None) -> sqlite3.Cursor:
        self._check_process()
        self._steps = max(MIN_STEPS, MAX_STEPS_PER_BYTE * self.size) if steps is None else steps
        with self._explain_interruption():
            return self._connection.execute(query, values)

    @contextmanager
    def _explain_interruption(self) -> Iterator[None]:
        """Replace SQLite's message for an interrupted query."""
        try:
            yield
        except sqlite3.OperationalError as error:
            if self._steps >= 0:
                raise
            raise sqlite3.OperationalError(
                "a query takes more steps than in any valid recording of this size"
            ) from error

    def _connect(self, path: Path, options: str) -> sqlite3.Connection:
        self._open_arguments = (path, options)
        connection = sqlite3.connect(f"{path.as_uri()}?{options}", uri=True, check_same_thread=False)
        self._connection = connection
        self._limit("LENGTH", min(MAX_UNPACKED_BYTES, max(self.size, MAX_SQL)))
        self._limit("SQL_LENGTH", MAX_SQL)
        self._limit("COLUMN", MAX_COLUMNS)
        connection.set_progress_handler(self._count_steps, _STEPS_PER_CHECK)
        connection.text_factory = lambda text: text.decode("utf-8", "replace")
        connection.execute("PRAGMA trusted_schema = OFF")
        return connection

    def _limit(self, name: str, value: int) -> None:
        if hasattr(self._connection, "setlimit"):  # from Python 3.11
            self._connection.setlimit(getattr(sqlite3, f"SQLITE_LIMIT_{name}"), value)

    def _count_steps(self) -> bool:
        """Count steps, and return True to interrupt the query."""
        self._steps -= _STEPS_PER_CHECK
        return self._steps < 0

    def _recover_journal(self, add_problem: Callable[[str], object]) -> sqlite3.Connection | None:
        """Return a connection that also reads the journal of a recorder, or None if there is no journal."""
        wal, journal, shared = (self._path.with_name(f"{self._path.name}-{kind}") for kind in ("wal", "journal", "shm"))
        try:
            there = [file for file in (wal, journal) if os.path.lexists(file) and _has_content(file)]
            if not there:
                return None
            self.size += sum(file.stat().st_size for file in there)
            if there == [wal] and is_file(shared):
                return self._open_and_test(self._path, "mode=ro&readonly_shm=1")
            return self._open_and_test(self._copy(there), "mode=ro" if there == [wal] else "mode=rw")
        except (*DAMAGE_ERRORS, OSError) as error:
            reason = error.strerror if isinstance(error, OSError) and error.strerror else error
            add_problem(f"the journal of the database cannot be read ({reason}); the last messages are missing")
            return None

    def _open_and_test(self, path: Path, options: str) -> sqlite3.Connection:
        with ExitStack() as on_error:
            connection = on_error.enter_context(closing(self._connect(path, options)))
            self._query("PRAGMA schema_version").fetchone()  # reads the journal
            on_error.pop_all()
        return connection

    def _copy(self, journals: list[Path]) -> Path:
        """Copy the database with its journals to a temporary folder, because recovery writes next to it."""
        if self.size > MAX_RECOVERED:
            raise OSError(
                f"the database and its journal have {self.size} bytes, which exceeds the maximum of {MAX_RECOVERED} "
                "for recovery"
            )
        folder = Path(self._closing.enter_context(temporary_folder("coframe-recovered-")))
        for file in (self._path, *journals):
            with open_regular(file) as source, (folder / file.name).open("wb") as copy:
                shutil.copyfileobj(source, copy, 1 << 20)
        return folder / self._path.name


def _has_content(journal: Path) -> bool:
    """Return whether a journal has not been committed.

    Raises:
        OSError: It is not a regular file, cannot be read, or names another file.
    """
    with open_regular(journal) as file:
        if file.read(1) in {b"", b"\0"}:
            return False
        file.seek(-min(len(_MASTER_JOURNAL_MAGIC), journal.stat().st_size), os.SEEK_END)
        if file.read() == _MASTER_JOURNAL_MAGIC:
            raise OSError("the journal belongs to several databases")
    return True
