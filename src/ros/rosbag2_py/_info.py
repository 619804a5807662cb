# SPDX-License-Identifier: Apache-2.0
"""Metadata of recordings, as shown by ``ros2 bag info``."""

from __future__ import annotations

import importlib
from dataclasses import dataclass, field
from datetime import datetime, timedelta, timezone
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coframe._files.bounded_yaml import MAX_BYTES, read_yaml
from coframe._files.regular_files import read_regular
from coframe._process.optional_imports import pip_install
from coframe.bags import Recording, RecordingError, open_bag
from coframe.bags.formats import METADATA
from rosbag2_py._options import TopicMetadata

if TYPE_CHECKING:
    from typing_extensions import Self

__all__ = ["BagMetadata", "FileInformation", "Info", "MetadataIo", "TopicInformation", "metadata_of"]

_VERSION = 5  # of metadata.yaml, Humble's


class _Duration(timedelta):
    """A timedelta, as Humble has, with ``nanoseconds``, as Jazzy's durations have."""

    nanoseconds: int

    @classmethod
    def of(cls, nanoseconds: int) -> Self:
        duration = cls(microseconds=nanoseconds // 1000)
        duration.nanoseconds = nanoseconds
        return duration


class _Time(datetime):
    """A datetime, as Humble has, with ``nanoseconds``, as Jazzy's times have."""

    nanoseconds: int

    @classmethod
    def of(cls, nanoseconds: int) -> Self:
        seconds, rest = divmod(nanoseconds, 1_000_000_000)
        instant = cls.fromtimestamp(seconds, timezone.utc).astimezone().replace(tzinfo=None)
        instant = instant.replace(microsecond=rest // 1000)
        instant.nanoseconds = nanoseconds
        return instant


@dataclass
class TopicInformation:
    """A topic and the number of its messages."""

    topic_metadata: TopicMetadata
    message_count: int


@dataclass
class FileInformation:
    """A file and the time that it covers."""

    path: str
    starting_time: _Time
    duration: _Duration
    message_count: int


@dataclass
class BagMetadata:
    """The metadata of a recording; ``str()`` shows it as ``ros2 bag info`` does."""

    version: int = _VERSION
    bag_size: int = 0
    storage_identifier: str = ""
    relative_file_paths: list[str] = field(default_factory=list)
    files: list[FileInformation] = field(default_factory=list)
    duration: _Duration = field(default_factory=lambda: _Duration.of(0))
    starting_time: _Time = field(default_factory=lambda: _Time.of(0))
    message_count: int = 0
    topics_with_message_count: list[TopicInformation] = field(default_factory=list)
    compression_format: str = ""
    compression_mode: str = ""
    custom_data: dict[str, str] = field(default_factory=dict)
    ros_distro: str = ""

    def __str__(self) -> str:
        start = self.starting_time.nanoseconds
        rows = [
            ("Files:", ", ".join(self.relative_file_paths)),
            ("Bag size:", _size(self.bag_size)),
            ("Storage id:", self.storage_identifier),
            ("Duration:", f"{self.duration.nanoseconds / 1e9:.9f}s"),
            ("Start:", _instant(start)),
            ("End:", _instant(start + self.duration.nanoseconds)),
            ("Messages:", str(self.message_count)),
        ]
        topics = [
            f"Topic: {topic.topic_metadata.name} | Type: {topic.topic_metadata.type} | Count: {topic.message_count} | "
            f"Serialization Format: {topic.topic_metadata.serialization_format}"
            for topic in self.topics_with_message_count
        ]
        rows += zip(["Topic information:", *[""] * len(topics)], topics, strict=False)
        return "\n" + "\n".join(f"{name:<18} {text}".rstrip() for name, text in rows) + "\n"


class Info:
    """Reads the metadata of a recording from its files."""

    def read_metadata(self, uri: str, storage_id: str = "") -> BagMetadata:  # noqa: ARG002 - the format is recognized
        """Return the metadata of a recording."""
        try:
            with open_bag(uri, transforms=False) as recording:
                return metadata_of(recording)
        except RecordingError as error:
            raise RuntimeError(str(error)) from error


class MetadataIo:
    """Reads and writes the file metadata.yaml of a recording."""

    def metadata_file_exists(self, uri: str) -> bool:
        """Return whether a folder has a metadata.yaml."""
        return (Path(uri) / METADATA).is_file()

    def read_metadata(self, uri: str) -> BagMetadata:
        """Return the contents of the metadata.yaml of a folder."""
        try:
            text = read_regular(Path(uri) / METADATA, MAX_BYTES)
            return _from_yaml(read_yaml(text)["rosbag2_bagfile_information"], Path(uri))
        except Exception as error:
            raise RuntimeError(f"Exception on parsing info file: {error}") from error

    def write_metadata(self, uri: str, metadata: BagMetadata) -> None:
        """Write the metadata.yaml of a folder."""
        text = _yaml().safe_dump({"rosbag2_bagfile_information": _to_yaml(metadata)}, sort_keys=False)
        (Path(uri) / METADATA).write_text(text, encoding="utf-8")


def metadata_of(recording: Recording) -> BagMetadata:
    """Return the metadata of an open recording."""
    qos = {channel.topic: channel.offered_qos for channel in recording.channels()}
    topics = [
        TopicInformation(TopicMetadata(topic.name, topic.type, topic.encoding, qos.get(topic.name, "")), topic.messages)
        for topic in recording.topics.values()
    ]
    start, duration = _Time.of(recording.received_start), _Duration.of(recording.duration)
    count = sum(topic.message_count for topic in topics)
    single = [FileInformation(recording.files[0][0].name, start, duration, count)] if len(recording.files) == 1 else []
    return BagMetadata(
        bag_size=sum(size for _, size in recording.files),
        storage_identifier=", ".join(each.storage_id or each.name for each in recording.formats),
        relative_file_paths=[path.name for path, _ in recording.files],
        files=single,
        duration=duration,
        starting_time=start,
        message_count=count,
        topics_with_message_count=topics,
    )


def _to_yaml(metadata: BagMetadata) -> dict[str, Any]:
    return {
        "version": metadata.version,
        "storage_identifier": metadata.storage_identifier,
        "duration": {"nanoseconds": metadata.duration.nanoseconds},
        "starting_time": {"nanoseconds_since_epoch": metadata.starting_time.nanoseconds},
        "message_count": metadata.message_count,
        "topics_with_message_count": [
            {
                "topic_metadata": {
                    "name": topic.topic_metadata.name,
                    "type": topic.topic_metadata.type,
                    "serialization_format": topic.topic_metadata.serialization_format,
                    "offered_qos_profiles": topic.topic_metadata.offered_qos_profiles,
                },
                "message_count": topic.message_count,
            }
            for topic in metadata.topics_with_message_count
        ],
        "compression_format": metadata.compression_format,
        "compression_mode": metadata.compression_mode,
        "relative_file_paths": metadata.relative_file_paths,
        "files": [
            {
                "path": file.path,
                "starting_time": {"nanoseconds_since_epoch": file.starting_time.nanoseconds},
                "duration": {"nanoseconds": file.duration.nanoseconds},
                "message_count": file.message_count,
            }
            for file in metadata.files
        ],
        **({"custom_data": metadata.custom_data} if metadata.custom_data else {}),
        **({"ros_distro": metadata.ros_distro} if metadata.ros_distro else {}),
    }


def _from_yaml(content: dict[str, Any], folder: Path) -> BagMetadata:
    paths = [str(path) for path in content["relative_file_paths"]]
    return BagMetadata(
        version=content["version"],
        bag_size=sum((folder / path).stat().st_size for path in paths if (folder / path).is_file()),
        storage_identifier=content["storage_identifier"],
        relative_file_paths=paths,
        files=[
            FileInformation(
                file["path"],
                _Time.of(file["starting_time"]["nanoseconds_since_epoch"]),
                _Duration.of(file["duration"]["nanoseconds"]),
                file["message_count"],
            )
            for file in content.get("files", [])
        ],
        duration=_Duration.of(content["duration"]["nanoseconds"]),
        starting_time=_Time.of(content["starting_time"]["nanoseconds_since_epoch"]),
        message_count=content["message_count"],
        topics_with_message_count=[
            TopicInformation(
                TopicMetadata(
                    **{
                        name: value
                        for name, value in topic["topic_metadata"].items()
                        if name in {"name", "type", "serialization_format", "offered_qos_profiles"}
                    }
                ),
                topic["message_count"],
            )
            for topic in content["topics_with_message_count"]
        ],
        compression_format=content.get("compression_format", ""),
        compression_mode=content.get("compression_mode", ""),
        custom_data={str(name): str(value) for name, value in (content.get("custom_data") or {}).items()},
        ros_distro=content.get("ros_distro", ""),
    )


def _yaml() -> Any:
    try:
        return importlib.import_module("yaml")
    except ModuleNotFoundError:
        raise RuntimeError(f"metadata.yaml needs the package PyYAML: {pip_install('bags')}") from None


def _size(size: int) -> str:
    value, unit = float(size), 0
    while value >= 1024 and unit < 3:
        value, unit = value / 1024, unit + 1
    return f"{value:.1f} {('B', 'KiB', 'MiB', 'GiB')[unit]}"


def _instant(nanoseconds: int) -> str:
    seconds, rest = divmod(nanoseconds, 1_000_000_000)
    local = datetime.fromtimestamp(seconds, timezone.utc).astimezone()
    return f"{local:%b} {local.day} {local:%Y %H:%M:%S}.{rest:09d} ({seconds}.{rest:09d})"
