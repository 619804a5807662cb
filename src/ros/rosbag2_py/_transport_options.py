# SPDX-License-Identifier: Apache-2.0
"""Options of players and recorders, with the names of Humble and of later distributions."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import timedelta
from typing import Any

__all__ = ["PlayOptions", "RecordOptions", "ServiceRequestsSource"]


class ServiceRequestsSource:
    """From where requests of recorded services are sent."""

    SERVICE_INTROSPECTION = 0
    CLIENT_INTROSPECTION = 1


@dataclass
class PlayOptions:
    """How a recording is replayed; durations are in seconds, a negative limit means none."""

    read_ahead_queue_size: int = 1000
    node_prefix: str = ""
    rate: float = 1.0
    topics_to_filter: list[str] = field(default_factory=list)
    services_to_filter: list[str] = field(default_factory=list)
    regex_to_filter: str = ""
    exclude_topics_to_filter: list[str] = field(default_factory=list)
    exclude_services_to_filter: list[str] = field(default_factory=list)
    exclude_regex_to_filter: str = ""
    topics_regex_to_filter: str = ""  # Humble's name of regex_to_filter
    topics_regex_to_exclude: str = ""  # Humble's name of exclude_regex_to_filter
    topic_qos_profile_overrides: dict[str, Any] = field(default_factory=dict)
    loop: bool = False
    topic_remapping_options: list[str] = field(default_factory=list)
    clock_publish_frequency: float = 0.0
    clock_publish_on_topic_publish: bool = False
    clock_topics: list[str] = field(default_factory=list)
    delay: float = 0.0
    playback_duration: float = -1.0
    playback_until_timestamp: int = -1
    start_paused: bool = False
    start_offset: float = 0.0
    disable_keyboard_controls: bool = False
    wait_acked_timeout: int = -1
    disable_loan_message: bool = False
    publish_service_requests: bool = False
    service_requests_source: int = ServiceRequestsSource.SERVICE_INTROSPECTION

    @property
    def playback_until(self) -> float:
        """The receive time at which the replay ends, in seconds; negative for none."""
        return self.playback_until_timestamp / 1e9

    @playback_until.setter
    def playback_until(self, seconds: float) -> None:
        self.playback_until_timestamp = int(seconds * 1e9) if seconds >= 0 else -1


@dataclass
class RecordOptions:
    """What is recorded."""

    all: bool = False  # Humble's name of all_topics
    all_topics: bool = False
    all_services: bool = False
    is_discovery_disabled: bool = False
    topics: list[str] = field(default_factory=list)
    topic_types: list[str] = field(default_factory=list)
    services: list[str] = field(default_factory=list)
    exclude_topics: list[str] = field(default_factory=list)
    exclude_topic_types: list[str] = field(default_factory=list)
    exclude_service_events: list[str] = field(default_factory=list)
    rmw_serialization_format: str = ""
    input_serialization_format: str = ""
    output_serialization_format: str = ""
    topic_polling_interval: timedelta = timedelta(milliseconds=100)
    regex: str = ""
    exclude: str = ""  # Humble's name of exclude_regex
    exclude_regex: str = ""
    node_prefix: str = ""
    compression_mode: str = ""
    compression_format: str = ""
    compression_queue_size: int = 1
    compression_threads: int = 0
    compression_threads_priority: int = 0
    topic_qos_profile_overrides: dict[str, Any] = field(default_factory=dict)
    include_hidden_topics: bool = False
    include_unpublished_topics: bool = False
    ignore_leaf_topics: bool = False
    start_paused: bool = False
    use_sim_time: bool = False
    disable_keyboard_controls: bool = False
