# SPDX-License-Identifier: Apache-2.0
"""Edit one SQLite file of rosbag2: read its rows once, and write those that are kept to a new database."""

from __future__ import annotations

import re
import sqlite3
from typing import TYPE_CHECKING, Any

from coframe.bags._compression import MAX_UNPACKED_BYTES, DamagedError
from coframe.bags._offered_qos import OfferedQos, to_yaml
from coframe.bags._sqlite_database import DAMAGE_ERRORS, Database
from coframe.bags.editing._message import EditedMessage
from coframe.bags.editing._metadata import edit_text
from coframe.bags.editing._survey import Source
from coframe.bags.storage import Channel
from coframe.messages.definition_texts import definition_of
from coframe.type_names import TF_MESSAGE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from coframe.bags.editing._metadata import EditedFile
    from coframe.bags.editing._pipeline import InsertedMessage, Pipeline, Route

__all__ = ["SqliteEditor", "SqliteSource"]

# The columns of rosbag2's tables in all versions of its schema, with their definitions. Others are not copied.
_TABLES = {
    "schema": {"schema_version": "INTEGER PRIMARY KEY", "ros_distro": "TEXT NOT NULL"},
    "metadata": {"id": "INTEGER PRIMARY KEY", "metadata_version": "INTEGER NOT NULL", "metadata": "TEXT NOT NULL"},
    "topics": {
        "id": "INTEGER PRIMARY KEY",
        "name": "TEXT NOT NULL",
        "type": "TEXT NOT NULL",
        "serialization_format": "TEXT NOT NULL",
        "offered_qos_profiles": "TEXT NOT NULL",
        "type_description_hash": "TEXT NOT NULL",
    },
    "message_definitions": {
        "id": "INTEGER PRIMARY KEY",
        "topic_type": "TEXT NOT NULL",
        "encoding": "TEXT NOT NULL",
        "encoded_message_definition": "TEXT NOT NULL",
        "type_description_hash": "TEXT NOT NULL",
    },
    "messages": {
        "id": "INTEGER PRIMARY KEY",
        "topic_id": "INTEGER NOT NULL",
        "timestamp": "INTEGER NOT NULL",
        "data": "BLOB NOT NULL",
    },
}
_DATA = f"CASE WHEN typeof(data) = 'blob' AND length(data) <= {MAX_UNPACKED_BYTES} THEN data END"
_BATCH_BYTES = 4 << 20
_PROGRESS_STEP = 1000  # rows


class SqliteSource(Source):
    """A SQLite file.

    Raises:
        DamagedError: The file is damaged, or is not a recording.
    """

    def __init__(self, path: Path) -> None:
        self.database = Database(path, self._refuse)
        try:
            definitions = self.database.tables()
            self._require_tables(definitions)
            # The names of the columns of each table that rosbag2 defines.
            self.columns = {
                table: [name for name in columns if re.search(rf"\b{name}\b", definitions[table])]
                for table, columns in _TABLES.items()
                if table in definitions
            }
            self.topics = {row["id"]: row for row in self.rows("topics")}
            described = {row["topic_type"]: row for row in self.rows("message_definitions")}
            self.types = described
        except DAMAGE_ERRORS as error:
            self.database.close()
            raise DamagedError(f"the database cannot be read: {error}") from None
        except BaseException:
            self.database.close()
            raise
        self.by_number = {number: _channel(row, described) for number, row in self.topics.items()}

    @staticmethod
    def _require_tables(found: dict[str, str]) -> None:
        if not {"topics", "messages"} <= found.keys():
            raise DamagedError("it has no tables named topics and messages")

    @staticmethod
    def _refuse(problem: str) -> None:
        raise DamagedError(problem)

    def rows(self, table: str) -> Iterator[dict[str, Any]]:
        """Yield the rows of a table by column, or nothing if the table does not exist."""
        columns = self.columns.get(table)
        if columns:
            for row in self.database.rows(table, ", ".join(columns)):
                yield dict(zip(columns, row[1:], strict=True))

    def channels(self) -> list[Channel]:
        """Return all channels."""
        return list(self.by_number.values())

    def span(self) -> tuple[int, int] | None:
        """Return the first and last receive time."""
        try:
            return self.database.extremes("messages", "timestamp")
        except DAMAGE_ERRORS as error:
            raise DamagedError(f"the database cannot be read: {error}") from None

    def messages(self, is_selected: Callable[[Channel], bool]) -> Iterator[tuple[Channel, int, bytes]]:
        """Yield the messages of some channels in the order of their rows."""
        numbers = [number for number, channel in self.by_number.items() if is_selected(channel)]
        try:
            condition = f"topic_id IN ({', '.join(map(str, numbers))})"
            for _, number, received, data in self.database.rows("messages", f"topic_id, timestamp, {_DATA}", condition):
                if not isinstance(data, bytes) or not isinstance(received, int):
                    raise DamagedError("a row has a time or data of the wrong type")
                yield self.by_number[number], received, data
        except DAMAGE_ERRORS as error:
            raise DamagedError(f"the database cannot be read: {error}") from None


class SqliteEditor:
    """Edits one file.

    Args:
        source: The file to read.
        target: The file to write, which must not exist; None to write nothing.
        pipeline: What to change.
        inserted: Messages to add at the beginning.
        edited: Receives the counts.

    Raises:
        OSError: The file cannot be written.
        DamagedError: The file is damaged.
    """

    def __init__(
        self,
        source: SqliteSource,
        target: Path | None,
        pipeline: Pipeline,
        inserted_messages: list[InsertedMessage],
        edited: EditedFile,
    ) -> None:
        self._source = source
        self._target = target
        self._pipeline = pipeline
        self._inserted_messages = inserted_messages
        self._edited_file = edited
        self._routes: dict[int, Route] = {n: pipeline.route(each) for n, each in source.by_number.items()}
        self._kept_numbers: dict[int, int] = dict.fromkeys(self._routes, 0)
        self._pending: list[tuple[int, int, int, bytes]] = []
        self._pending_bytes = 0

    def run(self, progress: Callable[[int], object]) -> None:
        """Edit the file; `progress` is called with the part of its bytes that has been read."""
        if self._target is not None:
            self._target.touch(exist_ok=False)
        self._out = sqlite3.connect(":memory:" if self._target is None else self._target)
        try:
            self._copy(progress)
        except sqlite3.Error as error:
            raise OSError(f"SQLite reports: {error}") from error
        finally:
            self._out.close()

    def _copy(self, progress: Callable[[int], object]) -> None:
        self._out.execute("PRAGMA journal_mode = OFF")  # The file is removed if it does not become complete.
        for table, columns in self._source.columns.items():
            definitions = ", ".join(f"{name} {_TABLES[table][name]}" for name in columns)
            self._out.execute(f"CREATE TABLE {table}({definitions})")
        for table in ("schema", "message_definitions"):
            self._copy_rows(table, list(self._source.rows(table)))
        topics = [{**row, "name": self._routes[n].topic} for n, row in self._source.topics.items()]
        self._copy_rows("topics", [row for row in topics if row["name"] is not None])
        shift = self._insert()
        self._copy_messages(shift, progress)
        for number, kept in self._kept_numbers.items():
            topic = self._routes[number].topic
            if topic is not None:
                self._routes[number].count(kept)
                self._edited_file.counts[topic] = self._edited_file.counts.get(topic, 0) + kept
        metadata = list(self._source.rows("metadata"))
        for row in metadata:
            row["metadata"] = edit_text(str(row["metadata"]), self._pipeline, self._edited_file.counts)
        self._copy_rows("metadata", metadata)
        self._out.execute("CREATE INDEX timestamp_idx ON messages (timestamp ASC)")
        self._out.commit()

    def _copy_rows(self, table: str, rows: list[dict[str, Any]]) -> None:
        for row in rows:
            marks = ", ".join("?" * len(row))
            self._out.execute(f"INSERT INTO {table}({', '.join(row)}) VALUES ({marks})", tuple(row.values()))  # noqa: S608 - the names are those above

    def _insert(self) -> int:
        """Write the messages to add, and return the offset to add to the numbers of the other rows."""
        first = self._source.database.first_row("messages")
        for row, (topic, data, received) in enumerate(self._inserted_messages, start=1):
            self._add(row, self._number_of(topic), received, data)
        return max(0, len(self._inserted_messages) + 1 - first) if self._inserted_messages and first is not None else 0

    def _number_of(self, topic: str) -> int:
        """Return the number of a topic with TFMessages, which is added if the recording has none."""
        for number, route in self._routes.items():
            if route.topic == topic and self._source.by_number[number].type == TF_MESSAGE:
                return number
        number = max(self._routes, default=0) + 1
        values = {
            "id": number,
            "name": topic,
            "type": TF_MESSAGE,
            "serialization_format": "cdr",
            "offered_qos_profiles": to_yaml([OfferedQos(1, transient_local=True)]),
            "type_description_hash": "",
        }
        self._copy_rows("topics", [{name: values[name] for name in self._source.columns["topics"]}])
        if "message_definitions" in self._source.columns and TF_MESSAGE not in self._source.types:
            row = {
                "topic_type": TF_MESSAGE,
                "encoding": "ros2msg",
                "encoded_message_definition": definition_of(TF_MESSAGE),
            }
            self._copy_rows("message_definitions", [{**row, "type_description_hash": ""}])
        self._source.by_number[number] = Channel(topic, TF_MESSAGE, "cdr")
        self._routes[number] = self._pipeline.unchanged(topic)
        self._kept_numbers[number] = 0
        self._edited_file.new_topics.append(topic)
        return number

    def _copy_messages(self, shift: int, progress: Callable[[int], object]) -> None:
        database = self._source.database
        total = database.last_row("messages") or 1
        try:
            for read, (row, number, received, data) in enumerate(
                database.rows("messages", f"topic_id, timestamp, {_DATA}")
            ):
                if not isinstance(data, bytes) or not isinstance(received, int) or number not in self._routes:
                    raise DamagedError("a row has no topic, or a time or data of the wrong type")
                if read % _PROGRESS_STEP == 0:
                    progress(database.size * row // max(total, row, 1))
                route = self._routes[number]
                if route.topic is None:
                    route.count(1)
                    continue
                message = EditedMessage(data, received, received)
                if not route.steps or route.edit(message):
                    self._add(row + shift, number, message.received, message.data)
        except DAMAGE_ERRORS as error:
            raise DamagedError(f"the database cannot be read: {error}") from None
        self._flush()

    def _add(self, row: int, number: int, receive_time: int, data: bytes) -> None:
        self._kept_numbers[number] += 1
        self._edited_file.add_span(receive_time, receive_time)
        if self._target is None:
            return
        self._pending.append((row, number, receive_time, data))
        self._pending_bytes += len(data)
        if self._pending_bytes > _BATCH_BYTES:
            self._flush()

    def _flush(self) -> None:
        self._out.executemany("INSERT INTO messages(id, topic_id, timestamp, data) VALUES (?, ?, ?, ?)", self._pending)
        self._out.commit()
        self._pending, self._pending_bytes = [], 0


def _channel(row: dict[str, Any], descriptions: dict[str, dict[str, Any]]) -> Channel:
    definition = descriptions.get(row["type"], {})
    return Channel(
        str(row["name"]),
        str(row["type"]),
        str(row["serialization_format"]),
        str(definition.get("encoded_message_definition", "")).encode(),
        str(definition.get("encoding", "")),
        str(row.get("offered_qos_profiles", "")),
    )
