# SPDX-License-Identifier: Apache-2.0
"""Writer for recordings in rosbag2's format: a folder with MCAP or SQLite files and a metadata.yaml."""

from __future__ import annotations

import importlib
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from coframe import time
from coframe._files.complete_files import write_complete
from coframe._files.os_errors import reason
from coframe._process.optional_imports import pip_install
from coframe.bags._latched_messages import LatchedMessages, LatchedSpace
from coframe.bags._mcap_writer import compressor
from coframe.bags._offered_qos import OfferedQos, to_yaml
from coframe.bags.formats import MCAP, METADATA, storage_formats
from coframe.bags.transforms import is_static
from coframe.errors import RecordingError
from coframe.messages.definition_texts import definition_of

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Hashable, Sequence
    from datetime import timedelta

    from typing_extensions import Self

    from coframe.bags._recording_format import FileWriter

__all__ = ["Writer", "yaml_dump"]

_MAX_TOPICS = 65_000  # channel numbers have 16 bits
_MAX_TIME = 1 << 63
_MAX_CHUNK_BYTES = 4 << 20  # bytes before compression
T = TypeVar("T")
_VERSION = 5  # metadata version that Humble writes and later versions of rosbag2 read


@dataclass
class _Topic:
    """A topic of the recording."""

    name: str
    type: str
    encoding: str
    definition: str
    definition_format: str
    offered_qos: str
    latched: LatchedMessages | None
    before: int = 0  # number of messages in finished files
    channel: int | None = None  # number of the channel in the current file


@dataclass
class _File:
    """The metadata of one file."""

    name: str
    start: int = 0
    end: int = 0
    count: int = 0


@dataclass
class _Contents:
    """The files and topics of the recording."""

    files: list[_File] = field(default_factory=list)
    topics: list[_Topic] = field(default_factory=list)


class Writer:
    """Writes a recording that rosbag2, Foxglove and other tools can open.

    A context manager; not thread-safe. Each file begins with the latched (transient-local) messages that are valid at
    that time, such as static transforms. Flushed messages survive the end of the process, and the files are valid after
    each flush.

    Args:
        path: The folder, which must not exist.
        compression: Compression of the chunks of MCAP files: ``zstd``, ``lz4`` or ``none``.
        storage: Format of the files: ``mcap`` or ``sqlite3``, as rosbag2 names them.
        max_size: File size in bytes at which a new file is started, or None for no limit.
        max_duration: Duration after which a new file is started, such as "10min", a timedelta or nanoseconds; None for
        no
            limit.

    Attributes:
        path: The folder.
        undescribed: Types whose definitions coframe does not have. Readers of the recording need them from another
            source.

    Raises:
        RecordingError: The folder exists or cannot be created, or a package is not installed.
        ValueError: The compression or the storage is unknown, or ``max_size`` is below 1.

    Example:
        >>> with Writer("run") as writer:                                            # doctest: +SKIP
        ...     tf = writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        ...     writer.write(tf, cdr, received=stamp)
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        *,
        compression: str = "zstd",
        storage: str = MCAP.storage_id,
        max_size: int | None = None,
        max_duration: str | int | timedelta | None = None,
    ) -> None:
        if max_size is not None and max_size < 1:
            raise ValueError(f"max_size must be at least 1 byte, not {max_size}")
        written = storage_formats(written=True)
        if storage not in written:
            raise ValueError(f"No storage named {storage!r}. Known storages: {', '.join(written)}.")
        self.path = Path(path)
        self._format = written[storage]
        self.undescribed: list[str] = []
        self._compression = compression
        self._max_size = max_size
        self._max_duration = None if max_duration is None else time.duration_ns(max_duration)
        self._dump_yaml = yaml_dump()
        compressor(compression)  # Raises before the folder is created.
        self._contents = _Contents()
        self._numbers: dict[tuple[str, str, str, str | None], int] = {}
        self._is_split = max_size is not None or self._max_duration is not None
        self._latched_space = LatchedSpace()
        self._closed = 0  # bytes of finished files
        self._first_size = 0  # bytes of the file before its own messages
        self._first_time: int | None = None
        try:
            self.path.mkdir(parents=True)
        except FileExistsError:
            raise RecordingError(
                f"{self.path} already exists and is not overwritten", hint="Choose another folder."
            ) from None
        except OSError as error:
            raise RecordingError(
                f"{self.path} cannot be created: {reason(error)}",
                hint="Choose a folder with write permission.",
            ) from None
        self._file = self._guard_write(self._open)
        self._write_metadata()

    def add_topic(
        self,
        name: str,
        ros_type: str,
        *,
        offered_qos: Sequence[OfferedQos] = (),
        encoding: str = "cdr",
        definition: str | None = None,
        definition_format: str = "ros2msg",
    ) -> int:
        """Add a topic, and return its number, which is the same for the same name, type, encoding and definition.

        Args:
            name: The name with a leading slash, such as "/tf".
            ros_type: The type of the messages, such as "tf2_msgs/msg/TFMessage".
            offered_qos: The QoS that its publishers offer. The topic is latched if one of them is transient local.
            encoding: The encoding of the messages.
            definition: The definition of the type; None uses coframe's definition.
            definition_format: The format of the definition.

        Raises:
            RecordingError: There are more topics than an MCAP file can have.
        """
        key = (name, ros_type, encoding, definition)
        if key not in self._numbers:
            if len(self._numbers) >= _MAX_TOPICS:
                raise RecordingError(
                    f"{self.path} has the maximum of {_MAX_TOPICS} topics", hint="Record a selection of topics."
                )
            known = definition_of(ros_type) if definition is None else definition
            if not known and ros_type not in self.undescribed:
                self.undescribed.append(ros_type)
            latched = is_static(name) or any(qos.transient_local for qos in offered_qos)
            self._numbers[key] = len(self._contents.topics)
            self._contents.topics.append(
                _Topic(
                    name,
                    ros_type,
                    encoding,
                    known,
                    definition_format if known else "",
                    to_yaml(offered_qos or ([OfferedQos(1, transient_local=True)] if latched else [])),
                    LatchedMessages(name, ros_type, self._latched_space) if latched and self._is_split else None,
                )
            )
        return self._numbers[key]

    def write(
        self, topic: int, data: bytes, received: int, *, published: int | None = None, publisher: Hashable = None
    ) -> None:
        """Write a message. It is written by the next flush, which happens automatically every few megabytes.

        Args:
            topic: The number of the topic.
            data: The serialized message.
            received: Receive time in nanoseconds.
            published: Time of publication in nanoseconds; None or an invalid time means the receive time.
            publisher: Distinguishes the publishers of a latched topic.

        Raises:
            RecordingError: The operating system reports an error, such as a full disk.
        """
        if self._is_full(received):
            self._guard_write(self._next_file)
            self._begin_file(received)
        elif self._first_time is None:
            self._first_time = received
        published = received if published is None or not 0 <= published < _MAX_TIME else published
        entry = self._contents.topics[topic]
        self._write_message(entry, data, received, published)
        if entry.latched is not None:
            entry.latched.add(data, published, publisher)
        if self._file.pending >= _MAX_CHUNK_BYTES:
            self.flush()

    def flush(self) -> None:
        """Pass all messages to the operating system. They survive a crash of the process, but not a power failure.

        Raises:
            RecordingError: The operating system reports an error, such as a full disk.
        """
        if self._file.pending:
            self._guard_write(self._file.flush)
            self._write_metadata()

    @property
    def size(self) -> int:
        """Size of all files in bytes."""
        return self._closed + self._file.size

    @property
    def messages(self) -> int:
        """Number of flushed messages."""
        return sum(map(self._count, self._contents.topics))

    @property
    def files(self) -> int:
        """Number of files."""
        return len(self._contents.files)

    @property
    def incomplete(self) -> list[str]:
        """Topics with more latched messages than can be repeated at the beginning of each file."""
        return [topic.name for topic in self._contents.topics if topic.latched and topic.latched.omitted]

    def close(self) -> None:
        """Write the index and the metadata, and wait until all is on the disk.

        Raises:
            RecordingError: The operating system reports an error, such as a full disk.
        """
        try:
            self._guard_write(self._file.close)
        finally:
            self._write_metadata()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _write_message(self, topic: _Topic, data: bytes, receive_time: int, published: int) -> None:
        if topic.channel is None:
            topic.channel = self._file.add_channel(
                topic.name,
                topic.type,
                encoding=topic.encoding,
                definition=topic.definition,
                definition_format=topic.definition_format,
                metadata={"offered_qos_profiles": topic.offered_qos},
            )
        self._file.write(topic.channel, data, receive_time, published)

    def _count(self, topic: _Topic) -> int:
        return topic.before + (0 if topic.channel is None else self._file.counts[topic.channel])

    def _is_full(self, receive_time: int) -> bool:
        if self._first_time is None:
            return False
        if self._max_size is not None and self._file.size - self._first_size >= self._max_size:
            return True
        return self._max_duration is not None and receive_time - self._first_time >= self._max_duration

    def _next_file(self) -> None:
        self._file.close()
        self._note_file()
        self._closed += self._file.size
        for topic in self._contents.topics:
            topic.before, topic.channel = self._count(topic), None
        self._file = self._open()

    def _begin_file(self, receive_time: int) -> None:
        """Write the latched messages with the current receive time, so that each file can be read on its own."""
        for topic in self._contents.topics:
            for message in topic.latched.messages if topic.latched else []:
                self._write_message(topic, message.data, receive_time, message.published)
        self._first_time, self._first_size = receive_time, self._file.size

    def _open(self) -> FileWriter:
        name = f"{self.path.name}_{len(self._contents.files)}{self._format.suffixes[0]}"
        self._contents.files.append(_File(name))
        return self._format.create(self.path / name, self._compression)

    def _guard_write(self, write: Callable[[], T]) -> T:
        try:
            return write()
        except OSError as error:
            raise self._write_error(error) from error

    def _write_error(self, error: OSError) -> RecordingError:
        return RecordingError(
            f"{self.path} cannot be written: {reason(error)}",
            hint="Check the free space and the write permission. The messages written before this error can be read.",
        )

    def _note_file(self) -> None:
        file = self._contents.files[-1]
        file.start, file.end, file.count = self._file.start, self._file.end, self._file.count

    def _write_metadata(self) -> None:
        """Write metadata.yaml. If the disk is full, the previous version is kept."""
        self._note_file()
        text = self._dump_yaml({"rosbag2_bagfile_information": self._metadata()})
        with suppress(OSError):
            write_complete(self.path / METADATA, text.encode())

    def _metadata(self) -> dict[str, Any]:
        files = [file for file in self._contents.files if file.count] or self._contents.files[:1]
        start, end = min(file.start for file in files), max(file.end for file in files)
        return {
            "version": _VERSION,
            "storage_identifier": self._format.storage_id,
            "duration": {"nanoseconds": end - start},
            "starting_time": {"nanoseconds_since_epoch": start},
            "message_count": sum(file.count for file in files),
            "topics_with_message_count": [
                {
                    "topic_metadata": {
                        "name": topic.name,
                        "type": topic.type,
                        "serialization_format": topic.encoding,
                        "offered_qos_profiles": topic.offered_qos,
                    },
                    "message_count": self._count(topic),
                }
                for topic in self._contents.topics
            ],
            "compression_format": "",
            "compression_mode": "",
            "relative_file_paths": [file.name for file in self._contents.files],
            "files": [
                {
                    "path": file.name,
                    "starting_time": {"nanoseconds_since_epoch": file.start},
                    "duration": {"nanoseconds": file.end - file.start},
                    "message_count": file.count,
                }
                for file in self._contents.files
            ],
        }


def yaml_dump() -> Callable[[Any], str]:
    """Return the function that writes YAML.

    Raises:
        RecordingError: PyYAML is not installed.
    """
    try:
        yaml: Any = importlib.import_module("yaml")
    except ModuleNotFoundError:
        raise RecordingError(
            "writing a recording needs the package PyYAML, which is not installed", hint=pip_install("bags")
        ) from None
    dumper = getattr(yaml, "CSafeDumper", yaml.SafeDumper)
    return lambda value: str(yaml.dump(value, Dumper=dumper, sort_keys=False, allow_unicode=True))
