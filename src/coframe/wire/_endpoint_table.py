# SPDX-License-Identifier: Apache-2.0
"""The writers or the readers of a graph."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.wire.graph import DiscoveredEndpoint


class EndpointTable:
    """Endpoints by their handles. Those on a topic are found without looking at the others."""

    def __init__(self) -> None:
        self._all: dict[int, DiscoveredEndpoint] = {}
        self._by_topic: dict[str, dict[int, DiscoveredEndpoint]] = {}

    def __contains__(self, handle: int) -> bool:
        return handle in self._all

    def __iter__(self) -> Iterator[DiscoveredEndpoint]:
        return iter(self._all.values())

    def get(self, handle: int) -> DiscoveredEndpoint | None:
        """Return an endpoint, or None if there is none with this handle."""
        return self._all.get(handle)

    def store(self, handle: int, endpoint: DiscoveredEndpoint) -> None:
        """Add an endpoint, or replace the one with this handle."""
        self.remove(handle)
        self._all[handle] = endpoint
        self._by_topic.setdefault(endpoint.topic, {})[handle] = endpoint

    def remove(self, handle: int) -> DiscoveredEndpoint | None:
        """Remove and return an endpoint, or return None if there is none with this handle."""
        endpoint = self._all.pop(handle, None)
        if endpoint is not None:
            on_topic = self._by_topic[endpoint.topic]
            del on_topic[handle]
            if not on_topic:
                del self._by_topic[endpoint.topic]
        return endpoint

    def copy(self) -> dict[int, DiscoveredEndpoint]:
        """Return all endpoints by their handles."""
        return dict(self._all)

    def on_topic(self, topic: str) -> dict[int, DiscoveredEndpoint]:
        """Return the endpoints on a DDS topic by their handles."""
        return dict(self._by_topic.get(topic, {}))

    def by_topic(self) -> dict[str, dict[int, DiscoveredEndpoint]]:
        """Return all endpoints by DDS topic and handle."""
        return {topic: dict(endpoints) for topic, endpoints in self._by_topic.items()}

    def types(self) -> Iterator[tuple[str, set[str]]]:
        """Yield each DDS topic with the DDS types of its endpoints."""
        for topic, endpoints in self._by_topic.items():
            yield topic, {endpoint.type for endpoint in endpoints.values()}
