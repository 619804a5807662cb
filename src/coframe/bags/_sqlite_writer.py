# SPDX-License-Identifier: Apache-2.0
"""Writer for one SQLite file in the schema of rosbag2's storage plugin, version 4.

Iron and later write it: it has the definitions of the types. Humble reads it as well.
"""

from __future__ import annotations

import sqlite3
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

__all__ = ["SqliteWriter"]

_SCHEMA = """
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, serialization_format TEXT NOT NULL,
    offered_qos_profiles TEXT NOT NULL, type_description_hash TEXT NOT NULL);
CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding TEXT NOT NULL,
    encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
    data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
INSERT INTO schema(schema_version, ros_distro) VALUES (4, 'iron');
"""


class SqliteWriter:
    """Writes one SQLite file, with the methods and attributes of `McapWriter`. Not thread-safe.

    Args:
        path: The file, which must not exist.

    Raises:
        OSError: The file cannot be created.
    """

    def __init__(self, path: Path) -> None:
        path.touch(exist_ok=False)
        with _os_errors():
            self._database = sqlite3.connect(path, check_same_thread=False)
            self._database.executescript(_SCHEMA)
        self._described_types: set[str] = set()  # the types whose definitions were written
        self._written = 0
        self._pending: list[tuple[int, int, bytes]] = []
        self.pending = 0
        self.counts: list[int] = []
        self.start = 0
        self.end = 0

    @property
    def size(self) -> int:
        """Bytes of all messages, including pending ones."""
        return self._written + self.pending

    @property
    def count(self) -> int:
        """Number of flushed messages."""
        return sum(self.counts)

    def add_channel(
        self,
        topic: str,
        ros_type: str,
        *,
        encoding: str,
        definition: str,
        definition_format: str,
        metadata: Mapping[str, str],
    ) -> int:
        """Add a topic with messages of a type, and return its number."""
        self.counts.append(0)
        qos = metadata.get("offered_qos_profiles", "")
        with _os_errors():
            self._database.execute(
                "INSERT INTO topics VALUES (?, ?, ?, ?, ?, '')", (len(self.counts), topic, ros_type, encoding, qos)
            )
            if definition_format and ros_type not in self._described_types:
                self._described_types.add(ros_type)
                self._database.execute(
                    "INSERT INTO message_definitions(topic_type, encoding, encoded_message_definition, "
                    "type_description_hash) VALUES (?, ?, ?, '')",
                    (ros_type, definition_format, definition),
                )
        return len(self.counts) - 1

    def write(self, channel: int, data: bytes, log_time: int, publish_time: int) -> None:  # noqa: ARG002
        """Add a message, which the next flush writes. The format does not store the time of publication."""
        self._pending.append((channel, log_time, data))
        self.pending += len(data)

    def flush(self) -> None:
        """Write the pending messages. They survive the end of this process.

        Raises:
            OSError: Writing failed, for example because the disk is full.
        """
        pending, self._pending = self._pending, []
        self._written, self.pending = self._written + self.pending, 0
        with _os_errors():
            self._database.executemany(
                "INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)",
                [(channel + 1, log_time, data) for channel, log_time, data in pending],
            )
            self._database.commit()
        for channel, log_time, _ in pending:
            self.start = min(self.start, log_time) if self.count else log_time
            self.end = max(self.end, log_time)
            self.counts[channel] += 1

    def close(self) -> None:
        """Write the pending messages and close the file.

        Raises:
            OSError: Writing failed, for example because the disk is full.
        """
        try:
            self.flush()
        finally:
            self._database.close()


@contextmanager
def _os_errors() -> Iterator[None]:
    """Raise SQLite errors as OSError, as for other files."""
    try:
        yield
    except sqlite3.Error as error:
        raise OSError(str(error)) from error
