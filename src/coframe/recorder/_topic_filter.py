# SPDX-License-Identifier: Apache-2.0
"""Which topics a recording or a replay includes."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from coframe.frame_names import absolute

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["TopicFilter"]

_HIDDEN = "/_"  # a name with a part that begins with an underscore is hidden, such as the topics of actions
_SERVICE_EVENT = "/_service_event"  # the end of the topic with the requests and responses of a service


class TopicFilter:
    """The selection of topics by their names and types.

    Without `topics`, `regex`, `types` and `services`, all topics are selected that are not hidden. Topics are selected
    that meet any of these conditions and none of those that exclude topics.

    Args:
        topics: The names of topics.
        regex: A regular expression. Topics whose full name matches it are selected.
        exclude: A regular expression. Topics whose full name matches it are not selected.
        types: Types; their topics are selected.
        services: The names of services whose requests and responses are selected, or True for all services.
        hidden: Whether hidden topics are selected if no condition is given.
        exclude_topics: The names of topics that are not selected.
        exclude_types: Types whose topics are not selected.
        exclude_services: The names of services whose requests and responses are not selected.

    Raises:
        ValueError: `regex` or `exclude` is not a valid regular expression.
    """

    def __init__(
        self,
        topics: Iterable[str] | None = None,
        regex: str | None = None,
        exclude: str | None = None,
        *,
        types: Iterable[str] = (),
        services: Iterable[str] | bool = (),
        hidden: bool = False,
        exclude_topics: Iterable[str] = (),
        exclude_types: Iterable[str] = (),
        exclude_services: Iterable[str] = (),
    ) -> None:
        self._names = None if topics is None else set(map(absolute, topics))
        self._regex, self._exclude_regex = _compile_regex(regex), _compile_regex(exclude)
        self._types = set(types)
        self._all_services = services is True
        self._events = set() if isinstance(services, bool) else _events(services)
        self._includes_hidden = hidden
        self._excluded_topics = {*map(absolute, exclude_topics), *_events(exclude_services)}
        self._excluded_types = set(exclude_types)
        self._is_selective = self._names is not None or bool(
            self._regex or self._types or self._events or self._all_services
        )

    def __call__(self, topic: str, ros_type: str = "") -> bool:
        """Return whether a topic is selected."""
        if topic in self._excluded_topics or ros_type in self._excluded_types:
            return False
        if self._exclude_regex is not None and self._exclude_regex.fullmatch(topic):
            return False
        if not self._is_selective:
            return self._includes_hidden or _HIDDEN not in topic
        return (
            topic in (self._names or ())
            or topic in self._events
            or ros_type in self._types
            or (self._all_services and topic.endswith(_SERVICE_EVENT))
            or bool(self._regex and self._regex.fullmatch(topic))
        )

    def missing(self, available: Iterable[str]) -> list[str]:
        """Return the requested names that are not among the available topics."""
        return sorted(((self._names or set()) | self._events) - set(available))


def _events(services: Iterable[str]) -> set[str]:
    """Return the topics with the requests and responses of services."""
    return {f"{absolute(name)}{_SERVICE_EVENT}" for name in services}


def _compile_regex(regex: str | None) -> re.Pattern[str] | None:
    try:
        return None if regex is None else re.compile(regex)
    except re.error as error:
        raise ValueError(f"{regex!r} is not a valid regular expression: {error}") from None
