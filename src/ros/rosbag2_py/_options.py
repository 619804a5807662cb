# SPDX-License-Identifier: Apache-2.0
"""Options of readers and writers, with the names and the order of Humble; Jazzy's additions come last."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from typing import Any

from coframe.distributions import since

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
    """Serialization formats. coframe converts none, so both must be ``cdr`` or empty."""

    input_serialization_format: str = ""
    output_serialization_format: str = ""


_FILTER_HUMBLE = ("topics", "regex", "regex_to_exclude")
_FILTER = ("topics", "services_events", "regex", "exclude_topics", "exclude_service_events", "regex_to_exclude")
_FILTER_ALIASES = {"topics_regex": "regex", "topics_regex_to_exclude": "regex_to_exclude"}


class StorageFilter:
    """The topics and services to read. If none is given, all. Regular expressions must match a whole name.

    Positional arguments have the order of the distribution that the process follows: up to Humble `topics`,
    `topics_regex`, `topics_regex_to_exclude`, from Jazzy on the order below.

    Args:
        topics: Names of topics.
        services_events: Names of topics with events of services, such as `/add_two_ints/_service_event`.
        regex: Regular expression of names; Humble's `topics_regex`.
        exclude_topics: Names of topics to leave out.
        exclude_service_events: Names of topics with events of services to leave out.
        regex_to_exclude: Regular expression of names to leave out; Humble's `topics_regex_to_exclude`.
    """

    def __init__(self, *words: Any, **fields: Any) -> None:
        order = _FILTER if since("bag_filter") else _FILTER_HUMBLE
        values = dict(zip(order, words, strict=False))
        for name, value in fields.items():
            known = _FILTER_ALIASES.get(name, name)
            if known not in _FILTER or known in values:
                raise TypeError(f"StorageFilter() does not take the argument {name!r} here; it has {', '.join(order)}")
            values[known] = value
        if len(words) > len(order):
            raise TypeError(f"StorageFilter() takes {len(order)} arguments, but {len(words)} were given")
        self.topics: list[str] = list(values.get("topics", []))
        self.services_events: list[str] = list(values.get("services_events", []))
        self.regex: str = values.get("regex", "")
        self.exclude_topics: list[str] = list(values.get("exclude_topics", []))
        self.exclude_service_events: list[str] = list(values.get("exclude_service_events", []))
        self.regex_to_exclude: str = values.get("regex_to_exclude", "")

    @property
    def topics_regex(self) -> str:
        """`regex` under its name up to Humble."""
        return self.regex

    @topics_regex.setter
    def topics_regex(self, value: str) -> None:
        self.regex = value

    @property
    def topics_regex_to_exclude(self) -> str:
        """`regex_to_exclude` under its name up to Humble."""
        return self.regex_to_exclude

    @topics_regex_to_exclude.setter
    def topics_regex_to_exclude(self, value: str) -> None:
        self.regex_to_exclude = value

    def __repr__(self) -> str:
        return f"StorageFilter({', '.join(f'{name}={getattr(self, name)!r}' for name in _FILTER)})"


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

    ReceivedTimestamp = 0
    PublishedTimestamp = 1
    File = 2


@dataclass
class ReadOrder:
    """The order in which messages are read."""

    sort_by: ReadOrderSortBy = ReadOrderSortBy.ReceivedTimestamp
    reverse: bool = False
