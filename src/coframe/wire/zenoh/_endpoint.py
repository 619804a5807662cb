# SPDX-License-Identifier: Apache-2.0
"""The common base of publishers and subscriptions of a Zenoh session."""

from __future__ import annotations

import os
import threading
from typing import TYPE_CHECKING, NamedTuple

from coframe import _core
from coframe.wire.zenoh import _keys

if TYPE_CHECKING:
    import zenoh
    from coframe.wire.names import Endpoint
    from coframe.wire.zenoh._graph import ZenohGraph


class Place(NamedTuple):
    """The context of a subscription: its session, graph, keys, and identity."""

    session: zenoh.Session
    graph: ZenohGraph
    key_list: list[str]
    endpoint: Endpoint
    type_hash: str
    guid: bytes


class ZenohEndpoint:
    """A publisher or subscription. Implements `coframe.wire._backend.BackendEndpoint`.

    Args:
        graph: The graph of the domain of the endpoint.
        endpoint: The topic or service.
        type_hash: The hash of its type, or `keys.ANY_HASH`.
        guid: The identifier of the endpoint.
        on_change: Set when a status changes; may be None.
    """

    is_writer = False
    refused_policy = 0  # no quality of service prevents a match

    def __init__(
        self, graph: ZenohGraph, endpoint: Endpoint, type_hash: str, guid: bytes, on_change: _core.Event | None
    ) -> None:
        self.guid = guid
        self.endpoint = endpoint
        self.type_hash = type_hash
        self._graph = graph
        self._on_change = on_change
        self._status_lock = threading.Lock()
        self._known: set[int] = set()
        self._statuses: dict[int, tuple[int, int, int, int]] = {}
        self._totals: dict[int, int] = {}
        self._process = os.getpid()
        self._closed = False

    @property
    def matched(self) -> int:
        """The number of endpoints on the other side."""
        return len(self.matched_handles())

    def matched_handles(self) -> list[int]:
        """Return the handles of the endpoints on the other side."""
        self._check_open()
        return list(self._graph.matching(self.endpoint, self.type_hash, writers=not self.is_writer))

    def take_status(self, kind: int) -> tuple[int, int, int, int] | None:
        """Return the counts of a status if it has changed since the last call."""
        self.update_matched()
        with self._status_lock:
            return self._statuses.pop(kind, None)

    def update_matched(self) -> None:
        """Update the status of the matched endpoints after a change of the graph."""
        if self._closed:
            return
        now = set(self.matched_handles())
        with self._status_lock:
            new, change = len(now - self._known), len(now) - len(self._known)
            if now == self._known:
                return
            self._known = now
            total = self._totals[_core.MATCHED] = self._totals.get(_core.MATCHED, 0) + new
            _, new_before, _, change_before = self._statuses.get(_core.MATCHED, (0, 0, 0, 0))
            self._statuses[_core.MATCHED] = total, new_before + new, len(now), change_before + change
        self._notify()

    def close(self) -> None:
        """Close the endpoint. A second call has no effect."""
        if not self._closed:
            self._closed = True
            if not self._is_forked():
                self._undeclare()

    def _undeclare(self) -> None:
        """Undeclare the Zenoh entities of the endpoint."""

    def _is_forked(self) -> bool:
        return os.getpid() != self._process

    def _add_lost(self, count: int) -> None:
        """Count messages that did not arrive."""
        with self._status_lock:
            total = self._totals[_core.SAMPLE_LOST] = self._totals.get(_core.SAMPLE_LOST, 0) + count
            _, before, _, _ = self._statuses.get(_core.SAMPLE_LOST, (0, 0, 0, 0))
            self._statuses[_core.SAMPLE_LOST] = total, before + count, 0, 0
        self._notify()

    def _notify(self) -> None:
        if self._on_change is not None:
            self._on_change.set()

    def _check_open(self) -> None:
        if self._is_forked():
            raise RuntimeError("This process was forked while its parent used Zenoh. Start processes with 'spawn'.")
        if self._closed:
            raise _core.EndpointError("the endpoint is closed")


class Sequence:
    """Creates the attachments of one publisher or client: a counter from 1, and its identifier."""

    def __init__(self, gid: bytes) -> None:
        self._gid = gid
        self._last = 0

    def next(self) -> bytes:
        """Return the attachment of the next message. The caller must send messages in this order."""
        self._last += 1
        return _keys.attachment(self._last, self._gid)
