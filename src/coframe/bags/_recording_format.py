# SPDX-License-Identifier: Apache-2.0
"""Base class of the file formats of recordings.

A format is one class: its names and suffixes, how a file is recognized, read and written. The class imports its reader
and writer when they are needed, so that suffixes are known without NumPy.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Protocol

from coframe._base_error import CoframeError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

    from coframe._sources.sources import Readable
    from coframe.bags._problems import Problems
    from coframe.bags.storage import Channel, Storage
    from coframe.messages import Message

__all__ = ["FileWriter", "RecordingFormat", "bare_name"]


class FileWriter(Protocol):
    """Writes one file of a recording. Errors of the operating system are raised as OSError.

    Attributes:
        counts: Number of flushed messages by channel.
        start: First receive time of the flushed messages, in nanoseconds, or 0 if there are none.
        end: Last receive time of the flushed messages, in nanoseconds, or 0 if there are none.
    """

    counts: list[int]
    start: int
    end: int

    @property
    def size(self) -> int:
        """Bytes of the file, including those that the next flush writes."""

    @property
    def count(self) -> int:
        """Number of flushed messages."""

    @property
    def pending(self) -> int:
        """Bytes that the next flush writes."""

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
        """Add a channel for messages of a type on a topic, and return its number, counted from 0."""

    def write(self, channel: int, data: bytes, log_time: int, publish_time: int) -> None:
        """Add a message, which the next flush writes. Times are in nanoseconds."""

    def flush(self) -> None:
        """Write the pending messages. They survive the end of this process."""

    def close(self) -> None:
        """Write everything and close the file."""


class RecordingFormat:
    """A file format of recordings. A subclass describes one format. Its instances have no state.

    Your own format overrides `name`, `suffixes` and `messages`, and is installed as an entry point of the group
    ``coframe.recordings``. All of coframe then reads such files: `open_bag`, the commands, the doctor, the viewer.

    Attributes:
        name: The name, such as ``MCAP``.
        suffixes: The suffixes of files in this format, such as ``(".mcap",)``.
        magic: The first bytes of each file; empty: files are recognized by their suffix.
        storage_id: The name in rosbag2's metadata and options, such as ``mcap``; empty: rosbag2 has no such format.
    """

    name: ClassVar[str]
    suffixes: ClassVar[tuple[str, ...]]
    magic: ClassVar[bytes] = b""
    storage_id: ClassVar[str] = ""

    def matches(self, path: Path, beginning: bytes) -> bool:
        """Return whether a file is in this format.

        Args:
            path: The file.
            beginning: Its first bytes, at least 16 unless the file is shorter.
        """
        return beginning.startswith(self.magic) if self.magic else path.suffix.lower() in self.suffixes

    def refusal(self, beginning: bytes) -> str:
        """Return why a file that this format does not match cannot be read, such as an old version, or "" otherwise."""
        del beginning
        return ""

    def messages(self, path: Path) -> Iterator[tuple[str, int, Message]]:
        """Yield the messages of a file, in any order: topic, receive time in nanoseconds, and message.

        Messages are instances of ROS's classes, such as ``geometry_msgs.msg.PoseStamped`` or the class that
        ``coframe.messages.find("tf2_msgs/msg/TFMessage")`` returns. If the file is damaged, raise any exception: the
        messages before it are used, and its text is added to the problems of the recording.

        Args:
            path: The file.
        """
        raise NotImplementedError(f"{type(self).__name__} does not define messages(path)")

    def serialized_messages(self, path: Path) -> Iterator[tuple[Channel, int, bytes]]:
        """Yield the messages of a file as bytes, instead of :meth:`messages`: channel, receive time and bytes.

        Args:
            path: The file.
        """
        from coframe.bags._message_file import serialize_messages  # noqa: PLC0415 - it imports NumPy

        return serialize_messages(self.messages(path))

    def open(self, path: Path, problems: Problems) -> Storage:
        """Open a file. The default reads all messages once, and keeps their bytes in a temporary file.

        Args:
            path: The file.
            problems: Receives what cannot be read.

        Raises:
            OSError: The file cannot be opened.
        """
        from coframe.bags._message_file import MessageFile  # noqa: PLC0415 - it imports NumPy

        return MessageFile(path, problems, self)

    def open_source(self, source: Readable, problems: Problems) -> Storage | None:
        """Open a file without a path, such as one on a server, to read parts of it. None: `open` reads a copy.

        Args:
            source: The file.
            problems: Receives what cannot be read.

        Raises:
            OSError: The file cannot be read.
        """
        del source, problems
        return None

    @property
    def is_written(self) -> bool:
        """Whether recordings in this format can be written."""
        return type(self).create is not RecordingFormat.create

    def create(self, path: Path, compression: str) -> FileWriter:
        """Create a file and return its writer.

        Args:
            path: The file, which must not exist.
            compression: ``zstd``, ``lz4`` or ``none``; formats without compression ignore it.

        Raises:
            OSError: The file cannot be created.
        """
        del compression
        raise CoframeError(f"{path} cannot be written: recordings in the format {self.name} are only read")

    def recording_name(self, file: str) -> str:
        """Return the common part of the file names of a recording: ``run`` for ``run_0`` and ``run_1``.

        Args:
            file: The name of a file without its suffix.
        """
        stem = bare_name(file)
        return file if stem is None else stem


def bare_name(file: str) -> str | None:
    """Return the name of a file without the number at its end, or None if it has no number."""
    stem, separator, number = file.rpartition("_")
    return stem if separator and number.isdigit() else None
