# SPDX-License-Identifier: Apache-2.0
"""The feeds of nodes and widgets: each record is sent when it has changed, and not more often than it is drawn."""

from __future__ import annotations

from functools import partial
from operator import attrgetter
from typing import TYPE_CHECKING, NamedTuple, TypeVar

from coframe.viewer.clients._update import Update
from coframe.viewer.protocol.encoding import encode
from coframe.viewer.protocol.server_messages import RemovedNodes, RemovedWidgets
from coframe.viewer.scripting.records import Record

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from coframe.viewer.clients._state import ClientState
    from coframe.viewer.scripting.nodes import NodeRecord
    from coframe.viewer.scripting.records import RecordStore
    from coframe.viewer.scripting.widgets import WidgetRecord

__all__ = ["NodesFeed", "SentRecords", "WidgetsFeed"]

RecordT = TypeVar("RecordT", bound=Record)

MAX_UPDATE_BYTES = 16 << 20
"""The bytes of geometry after which the rest of the nodes waits for the next update."""


class _SentVersions(NamedTuple):
    version: int
    geometry_version: int


class SentRecords:
    """The records of a store that a client has received.

    Attributes:
        revision: The revision of the store of which the client has everything.
        count: The number of records that were sent.
    """

    def __init__(self) -> None:
        self.revision = 0
        self.count = 0
        self._sent: dict[int, _SentVersions] = {}

    def version(self, record: Record) -> _SentVersions | None:
        """Return the version of a record that the client has, or None if it does not have the record."""
        return self._sent.get(record.id)

    def add(self, record: Record, geometry_version: int = 0) -> None:
        """Remember that a record was sent."""
        self.count += 1
        self._sent[record.id] = _SentVersions(record.version, geometry_version)

    def forget(self, records: Sequence[Record]) -> list[int]:
        """Forget all but these records and return the ids of the others."""
        ids = {record.id for record in records}
        gone = [number for number in self._sent if number not in ids]
        for number in gone:
            del self._sent[number]
        return gone


class WidgetsFeed:
    """The widgets."""

    def __init__(self, client: ClientState) -> None:
        self.due = 0.0
        self._client = client

    def updates(self, now: float) -> Iterator[Update]:
        """Yield the widgets that have changed, and those that were removed."""
        del now
        sent, store = self._client.widgets, self._client.viewer.widgets
        if sent.revision == store.revision:
            return
        revision, records = _read(store)
        for record in records:
            if (known := sent.version(record)) is None or known.version != record.version:
                sent.add(record)
                yield Update(None, None, partial(_encode_widget, record))
        if gone := sent.forget(records):
            yield Update(None, None, partial(encode, RemovedWidgets(type="widgets_removed", ids=gone)))
        sent.revision = revision


class NodesFeed:
    """The nodes."""

    def __init__(self, client: ClientState) -> None:
        self.due = 0.0
        self._client = client

    def updates(self, now: float) -> Iterator[Update]:
        """Yield the nodes that have changed, and those that were removed."""
        del now
        sent, store = self._client.nodes, self._client.viewer.nodes
        if sent.revision == store.revision:
            return
        revision, records = _read(store)
        size = 0
        # The oldest changes first: otherwise, nodes that change all the time could use up the bytes of every update.
        for record in sorted(records, key=attrgetter("version")):
            known = sent.version(record)
            if known is not None and known.version == record.version:
                continue
            yield Update(None, None, partial(_encode_node, record, self._client.origin))
            if record.geometry is not None and (known is None or known.geometry_version != record.geometry_version):
                yield Update(None, None, partial(record.geometry.encode, record.id))
                size += record.geometry.size
            sent.add(record, record.geometry_version)
            if size > MAX_UPDATE_BYTES:
                return
        # Removed last, so that a node that replaces another is drawn before the other disappears.
        if gone := sent.forget(records):
            yield Update(None, None, partial(encode, RemovedNodes(type="nodes_removed", ids=gone)))
        sent.revision = revision


def _read(store: RecordStore[RecordT]) -> tuple[int, list[RecordT]]:
    with store.lock:
        return store.revision, store.all()


def _encode_widget(record: WidgetRecord) -> str:
    return encode(record.message())


def _encode_node(record: NodeRecord, origin: int) -> str:
    return encode(record.message(origin))
