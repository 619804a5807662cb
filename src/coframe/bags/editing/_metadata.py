# SPDX-License-Identifier: Apache-2.0
"""The metadata of rosbag2 for an edited recording. Everything else is preserved."""

from __future__ import annotations

import copy
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from coframe._files.bounded_yaml import MAX_BYTES, read_yaml
from coframe.bags._offered_qos import OfferedQos, to_yaml
from coframe.bags._writer import yaml_dump
from coframe.type_names import TF_MESSAGE

if TYPE_CHECKING:
    from coframe.bags.editing._pipeline import Pipeline
    from coframe.bags.storage import Channel

__all__ = ["ROSBAG2", "EditedFile", "edit_text", "edited_metadata", "metadata_text", "new_metadata"]

ROSBAG2 = "rosbag2"  # name of the record of MCAP files in which rosbag2 repeats its metadata.yaml
_VERSION = 5  # that Humble writes and later versions of rosbag2 read
_TEXT_QOS_VERSION = 9
_INFINITE_DURATION = {"sec": 9223372036, "nsec": 854775807}
_STATIC_QOS = {
    "history": "keep_last",
    "depth": 1,
    "reliability": "reliable",
    "durability": "transient_local",
    "deadline": _INFINITE_DURATION,
    "lifespan": _INFINITE_DURATION,
    "liveliness": "automatic",
    "liveliness_lease_duration": _INFINITE_DURATION,
    "avoid_ros_namespace_conventions": False,
}
_ROOT = "rosbag2_bagfile_information"


@dataclass
class EditedFile:
    """One written file.

    Attributes:
        name: Its name.
        counts: Number of messages by topic.
        new_topics: Topics that the input does not have.
        span: First and last receive time in nanoseconds, or None if there are no messages.
    """

    name: str
    counts: dict[str, int] = field(default_factory=dict)
    new_topics: list[str] = field(default_factory=list)
    span: tuple[int, int] | None = None

    def add_span(self, first: int, last: int) -> None:
        """Extend the span."""
        self.span = (first, last) if self.span is None else (min(self.span[0], first), max(self.span[1], last))

    @property
    def messages(self) -> int:
        """The number of messages."""
        return sum(self.counts.values())


def edit_text(text: str, pipeline: Pipeline, counts: dict[str, int]) -> str:
    """Return the YAML of rosbag2's metadata with the new topics; unchanged if it cannot be read or stays valid."""
    try:
        found = read_yaml(text, MAX_BYTES)
        inner = found.get(_ROOT, found)
        new = _edited_topics(inner, pipeline, counts if inner.get("message_count") else None)
    except (ValueError, TypeError, KeyError, AttributeError):
        return text
    if new == inner:
        return text
    return yaml_dump()({_ROOT: new} if _ROOT in found else new)


def edited_metadata(metadata: dict[str, Any], pipeline: Pipeline, files: list[EditedFile]) -> dict[str, Any]:
    """Return rosbag2's metadata of a folder for its edited files."""
    counts: dict[str, int] = {}
    for file in files:
        for topic, number in file.counts.items():
            counts[topic] = counts.get(topic, 0) + number
    try:
        new = _edited_topics(metadata, pipeline, counts)
    except (TypeError, KeyError, AttributeError):
        new = copy.deepcopy(metadata)
    known = {each["topic_metadata"]["name"] for each in new.get("topics_with_message_count", [])}
    for topic in dict.fromkeys(name for file in files for name in file.new_topics):
        if topic not in known:
            new.setdefault("topics_with_message_count", []).append(_static_topic(topic, new, counts))
    return new | _totals(new, files)


def new_metadata(channels: list[Channel], pipeline: Pipeline, files: list[EditedFile], storage: str) -> dict[str, Any]:
    """Return rosbag2's metadata for a recording that had none."""
    topics = [
        {
            "topic_metadata": {
                "name": channel.topic,
                "type": channel.type,
                "serialization_format": channel.encoding,
                "offered_qos_profiles": channel.offered_qos,
            },
            "message_count": 0,
        }
        for channel in {each.topic: each for each in channels}.values()
    ]
    bare = {
        "version": _VERSION,
        "storage_identifier": storage,
        "duration": {},
        "starting_time": {},
        "message_count": 0,
        "topics_with_message_count": topics,
        "compression_format": "",
        "compression_mode": "",
        "relative_file_paths": [],
        "files": [],
    }
    return edited_metadata(bare, pipeline, files)


def metadata_text(metadata: dict[str, Any]) -> str:
    """Return the text of metadata.yaml."""
    return yaml_dump()({_ROOT: metadata})


def _edited_topics(metadata: dict[str, Any], pipeline: Pipeline, counts: dict[str, int] | None) -> dict[str, Any]:
    """Return metadata with the new names of topics, and their counts if they are given."""
    new = copy.deepcopy(metadata)
    topics: dict[str, Any] = {}
    for entry in new.get("topics_with_message_count", []):
        topic = entry["topic_metadata"]
        name = pipeline.topic(str(topic["name"]))
        if name is not None and name not in topics:
            topic["name"] = name
            entry["message_count"] = entry["message_count"] if counts is None else counts.get(name, 0)
            topics[name] = entry
    new["topics_with_message_count"] = list(topics.values())
    if counts is not None and "message_count" in new:
        new["message_count"] = sum(counts.values())
    return new


def _totals(metadata: dict[str, Any], files: list[EditedFile]) -> dict[str, Any]:
    spans = [file.span for file in files if file.span is not None]
    start, end = (min(first for first, _ in spans), max(last for _, last in spans)) if spans else (0, 0)
    found: dict[str, Any] = {
        "duration": {"nanoseconds": end - start},
        "starting_time": {"nanoseconds_since_epoch": start},
        "message_count": sum(file.messages for file in files),
        "relative_file_paths": [file.name for file in files],
    }
    if "files" in metadata:
        found["files"] = [
            {
                "path": file.name,
                "starting_time": {"nanoseconds_since_epoch": (file.span or (0, 0))[0]},
                "duration": {"nanoseconds": (file.span or (0, 0))[1] - (file.span or (0, 0))[0]},
                "message_count": file.messages,
            }
            for file in files
        ]
    return found


def _static_topic(name: str, metadata: dict[str, Any], counts: dict[str, int]) -> dict[str, Any]:
    """Return the entry of a topic with static transforms."""
    version = metadata.get("version", 0)
    uses_words = isinstance(version, int) and version >= _TEXT_QOS_VERSION
    topic: dict[str, Any] = {
        "name": name,
        "type": TF_MESSAGE,
        "serialization_format": "cdr",
        "offered_qos_profiles": [_STATIC_QOS] if uses_words else to_yaml([OfferedQos(1, transient_local=True)]),
    }
    if uses_words:
        topic["type_description_hash"] = ""
    return {"topic_metadata": topic, "message_count": counts.get(name, 0)}
