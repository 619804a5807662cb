# SPDX-License-Identifier: Apache-2.0
"""Options of readers and writers, with the names and the order of Humble; Jazzy's additions come last."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from typing import Any

__all__ = ["ConverterOptions", "ReadOrder", "ReadOrderSortBy", "StorageFilter", "StorageOptions", "TopicMetadata"]


@dataclass
class StorageOptions:
    """The location and the write options of a recording; sizes in bytes, durations in seconds, 0 for no limit."""

    uri: str
    storage_id: str = ""
    max_bagfile_size: int = 0
    max_bagfile_duration: int = 0
    max_cache_size: int = 0
    storage_preset_profile: str = ""
    storage_config_uri: str = ""
    snapshot_mode: bool = False
    start_time_ns: int = -1
    end_time_ns: int = -1
    custom_data: dict[str, str] = field(default_factory=dict)


@dataclass
class ConverterOptions:
    """Serialization formats; coframe converts none, so both must be ``cdr`` or empty."""

    input_serialization_format: str = ""
    output_serialization_format: str = ""


@dataclass
class StorageFilter:
    """The topics to read; empty: all. Regular expressions must match the whole name of a topic."""

    topics: list[str] = field(default_factory=list)
    topics_regex: str = ""
    topics_regex_to_exclude: str = ""


class TopicMetadata:
    """Name, type, serialization format and offered QoS of a topic; Jazzy's `id` may come first."""

    def __init__(self, *words: Any, **fields: Any) -> None:
        names = ["name", "type", "serialization_format", "offered_qos_profiles", "type_description_hash"]
        if words and isinstance(words[0], int):
            names.insert(0, "id")
        values = {
            "id": 0,
            "offered_qos_profiles": "",
            "type_description_hash": "",
            **dict(zip(names, words, strict=False)),
            **fields,
        }
        missing = [name for name in ("name", "type", "serialization_format") if name not in values]
        unknown = sorted(values.keys() - {*names, "id"})
        if missing or unknown or len(words) > len(names):
            problem = f"missing: {', '.join(missing)}" if missing else f"unknown: {', '.join(unknown) or 'too many'}"
            raise TypeError(f"TopicMetadata(name, type, serialization_format, offered_qos_profiles=''): {problem}")
        self.id: int = values["id"]
        self.name: str = values["name"]
        self.type: str = values["type"]
        self.serialization_format: str = values["serialization_format"]
        self.offered_qos_profiles: Any = values["offered_qos_profiles"]
        self.type_description_hash: str = values["type_description_hash"]

    def equals(self, other: TopicMetadata) -> bool:
        """Return whether all but the id are equal."""
        return {**vars(self), "id": 0} == {**vars(other), "id": 0}

    def __repr__(self) -> str:
        return f"TopicMetadata(name={self.name!r}, type={self.type!r})"


class ReadOrderSortBy(Enum):
    """By what messages are sorted."""

    RECEIVED_TIMESTAMP = 0
    PUBLISHED_TIMESTAMP = 1
    FILE = 2


@dataclass
class ReadOrder:
    """The order in which messages are read."""

    sort_by: ReadOrderSortBy = ReadOrderSortBy.RECEIVED_TIMESTAMP
    reverse: bool = False
