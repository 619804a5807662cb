"""Writer: a recording as rosbag2 makes it, a folder of MCAP files and a metadata.yaml."""

from __future__ import annotations

import importlib
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from coframe import time
from coframe.bags.definitions import definition_of
from coframe.bags.latched import Latched
from coframe.bags.mcap_writer import McapWriter, compressor
from coframe.bags.offered_qos import OfferedQos, to_yaml
from coframe.bags.transforms import is_static
from coframe.errors import RecordingError

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Hashable, Sequence
    from datetime import timedelta

    from typing_extensions import Self

__all__ = ["Writer"]

_MOST_TOPICS = 65_000  # channels have numbers of 16 bits
_TOO_LATE = 1 << 63
_LARGEST_CHUNK = 4 << 20  # bytes before compression
T = TypeVar("T")
_VERSION = 5  # of the metadata: what Humble writes, and all later ones read


@dataclass
class _Topic:
    """One topic of the recording."""

    name: str
    type: str
    encoding: str
    definition: str
    definition_format: str
    offered_qos: str
    latched: Latched | None
    before: int = 0  # messages in finished files
    channel: int | None = None  # in the file that is being written


@dataclass
class _File:
    """What the metadata says of one file."""

    name: str
    start: int = 0
    end: int = 0
    count: int = 0


@dataclass
class _Facts:
    """What the metadata says of the whole."""

    files: list[_File] = field(default_factory=list)
    topics: list[_Topic] = field(default_factory=list)


class Writer:
    """Writes a recording that rosbag2, Foxglove and others open; usable as a context manager, by one thread at a time.

    Every file begins with the latched messages that hold: static transforms, and what other publishers keep for late
    joiners. What was flushed survives the end of this process, and the files are whole after every flush.

    Args:
        path: The folder, which must not be there yet.
        compression: Of the chunks: ``zstd``, ``lz4`` or ``none``.
        max_size: Bytes after which the next file begins; None: never.
        max_duration: Time after which the next file begins, as "10min", a timedelta or nanoseconds; None: never.

    Attributes:
        path: The folder.
        undescribed: Types of which nobody here knows what they are made of: readers will need to know it themselves.

    Raises:
        RecordingError: The folder is there already or cannot be made, or a package is missing.

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
        max_size: int | None = None,
        max_duration: str | int | timedelta | None = None,
    ) -> None:
        if max_size is not None and max_size < 1:
            raise ValueError(f"a file of at most {max_size} bytes cannot be written")
        self.path = Path(path)
        self.undescribed: list[str] = []
        self._compression = compression
        self._max_size = max_size
        self._max_duration = None if max_duration is None else time.duration_ns(max_duration)
        self._dump = _yaml_dump()
        compressor(compression)  # is there, or there will be no folder
        self._facts = _Facts()
        self._numbers: dict[tuple[str, str], int] = {}
        self._closed = 0  # bytes of finished files
        self._first_size = 0  # bytes of the file before its own messages
        self._first_time: int | None = None
        try:
            self.path.mkdir(parents=True)
        except FileExistsError:
            raise RecordingError(
                f"{self.path} is there already, and nothing is overwritten", hint="Choose another folder."
            ) from None
        except OSError as error:
            raise RecordingError(
                f"{self.path} cannot be made: {error.strerror or error}", hint="Name a folder where you may write."
            ) from None
        self._mcap = self._writing(self._open)
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
        """A topic to write messages on: its number. Asked again for the same name and type it is the same one.

        Args:
            name: With its slash: "/tf".
            ros_type: Of the messages: "tf2_msgs/msg/TFMessage".
            offered_qos: What its publishers offered; a topic that one of them keeps messages of is latched.
            encoding: Of the messages.
            definition: What the type is made of; None: as coframe knows it.
            definition_format: Of that text.

        Raises:
            RecordingError: There are more topics than an MCAP file can have.
        """
        key = (name, ros_type)
        if key not in self._numbers:
            if len(self._numbers) >= _MOST_TOPICS:
                raise RecordingError(f"{self.path} cannot have more than {_MOST_TOPICS} topics", hint="Choose some.")
            known = definition_of(ros_type) if definition is None else definition
            if not known and ros_type not in self.undescribed:
                self.undescribed.append(ros_type)
            latched = is_static(name) or any(qos.transient_local for qos in offered_qos)
            self._numbers[key] = len(self._facts.topics)
            self._facts.topics.append(
                _Topic(
                    name,
                    ros_type,
                    encoding,
                    known,
                    definition_format if known else "",
                    to_yaml(offered_qos or ([OfferedQos(1, transient_local=True)] if latched else [])),
                    Latched(name, ros_type) if latched else None,
                )
            )
        return self._numbers[key]

    def write(
        self, topic: int, data: bytes, received: int, *, published: int | None = None, publisher: Hashable = None
    ) -> None:
        """Takes a message in; it is on the disk after the next flush, which large amounts bring about by themselves.

        Args:
            topic: Its number.
            data: The serialised message.
            received: When it was received, in nanoseconds.
            published: When it was sent; None, or a time that is none: when it was received.
            publisher: Whose it is, of several publishers of a latched topic.

        Raises:
            RecordingError: The disk is full, or what else the operating system says.
        """
        if self._is_full(received):
            self._writing(self._next_file)
            self._begin_file(received)
        elif self._first_time is None:
            self._first_time = received
        published = received if published is None or not 0 <= published < _TOO_LATE else published
        facts = self._facts.topics[topic]
        self._put(facts, data, received, published)
        if facts.latched is not None:
            facts.latched.add(data, published, publisher)
        if self._mcap.pending >= _LARGEST_CHUNK:
            self.flush()

    def flush(self) -> None:
        """Gives everything to the operating system: it survives the end of this process, not that of the machine.

        Raises:
            RecordingError: The disk is full, or what else the operating system says.
        """
        if self._mcap.pending:
            self._writing(self._mcap.flush)
            self._write_metadata()

    @property
    def size(self) -> int:
        """Bytes of all files so far."""
        return self._closed + self._mcap.size

    @property
    def messages(self) -> int:
        """How many messages were flushed."""
        return sum(map(self._count, self._facts.topics))

    @property
    def files(self) -> int:
        """How many files there are so far."""
        return len(self._facts.files)

    def close(self) -> None:
        """Ends the files with their index and the metadata, and waits until the disk has them.

        Raises:
            RecordingError: The disk is full, or what else the operating system says.
        """
        try:
            self._writing(self._mcap.close)
        finally:
            self._write_metadata()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _put(self, topic: _Topic, data: bytes, received: int, published: int) -> None:
        if topic.channel is None:
            topic.channel = self._mcap.add_channel(
                topic.name,
                topic.type,
                encoding=topic.encoding,
                definition=topic.definition,
                definition_format=topic.definition_format,
                about={"offered_qos_profiles": topic.offered_qos},
            )
        self._mcap.write(topic.channel, data, received, published)

    def _count(self, topic: _Topic) -> int:
        return topic.before + (0 if topic.channel is None else self._mcap.counts[topic.channel])

    def _is_full(self, received: int) -> bool:
        if self._first_time is None:
            return False
        if self._max_size is not None and self._mcap.size - self._first_size >= self._max_size:
            return True
        return self._max_duration is not None and received - self._first_time >= self._max_duration

    def _next_file(self) -> None:
        self._mcap.close()
        self._note_file()
        self._closed += self._mcap.size
        for topic in self._facts.topics:
            topic.before, topic.channel = self._count(topic), None
        self._mcap = self._open()

    def _begin_file(self, received: int) -> None:
        """With the latched messages, as if they had been received now: each file can be read for itself."""
        for topic in self._facts.topics:
            for message in topic.latched.messages if topic.latched else []:
                self._put(topic, message.data, received, message.published)
        self._first_time, self._first_size = received, self._mcap.size

    def _open(self) -> McapWriter:
        name = f"{self.path.name}_{len(self._facts.files)}.mcap"
        self._facts.files.append(_File(name))
        return McapWriter(self.path / name, self._compression)

    def _writing(self, write: Callable[[], T]) -> T:
        try:
            return write()
        except OSError as error:
            raise self._cannot_write(error) from error

    def _cannot_write(self, error: OSError) -> RecordingError:
        return RecordingError(
            f"{self.path} cannot be written: {error.strerror or error}",
            hint="Is there room on the disk, and may you write there? What was written before can be read.",
        )

    def _note_file(self) -> None:
        file = self._facts.files[-1]
        file.start, file.end, file.count = self._mcap.start, self._mcap.end, self._mcap.count

    def _write_metadata(self) -> None:
        """Where the disk is full, the metadata stay as they were, and are a little behind the files."""
        self._note_file()
        text = self._dump({"rosbag2_bagfile_information": self._metadata()})
        new = self.path / "metadata.yaml.new"
        try:
            new.write_text(text, encoding="utf-8")
            new.replace(self.path / "metadata.yaml")
        except OSError:
            with suppress(OSError):
                new.unlink(missing_ok=True)

    def _metadata(self) -> dict[str, Any]:
        files = [file for file in self._facts.files if file.count] or self._facts.files[:1]
        start, end = min(file.start for file in files), max(file.end for file in files)
        return {
            "version": _VERSION,
            "storage_identifier": "mcap",
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
                for topic in self._facts.topics
            ],
            "compression_format": "",
            "compression_mode": "",
            "relative_file_paths": [file.name for file in self._facts.files],
            "files": [
                {
                    "path": file.name,
                    "starting_time": {"nanoseconds_since_epoch": file.start},
                    "duration": {"nanoseconds": file.end - file.start},
                    "message_count": file.count,
                }
                for file in self._facts.files
            ],
        }


def _yaml_dump() -> Callable[[Any], str]:
    try:
        yaml: Any = importlib.import_module("yaml")
    except ModuleNotFoundError:
        raise RecordingError(
            "writing a recording needs the package PyYAML, which is not installed", hint="pip install 'coframe[bags]'"
        ) from None
    dumper = getattr(yaml, "CSafeDumper", yaml.SafeDumper)
    return lambda value: str(yaml.dump(value, Dumper=dumper, sort_keys=False, allow_unicode=True))
