# SPDX-License-Identifier: Apache-2.0
"""Read only those chunks of a recording that contain what is needed, by the indexes of its files."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Final, NamedTuple, Protocol

from coframe._sources.block_cache import MAX_RANGE
from coframe._sources.remote_error import RemoteFileError
from coframe._sources.sources import Source
from coframe.bags.transforms import ingest_for, is_static
from coframe.errors import RecordingError
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Iterator

    from coframe.bags._message_index import MessageIndex
    from coframe.bags._time_window import Limits
    from coframe.bags.storage import Batch, Channel, ListedChunk, Listing, Storage

__all__ = ["ChunkReader", "TopicFacts", "listed_span", "topic_facts"]

_MAX_GAP: Final = 128 << 10  # bytes between two chunks that are read with one request


class _Chunk(NamedTuple):
    """A chunk, and the file it is in."""

    storage: Storage
    listed: ListedChunk

    @property
    def key(self) -> tuple[int, int]:
        """What identifies the chunk in its recording."""
        return id(self.storage), self.listed.offset

    @property
    def size(self) -> int:
        """Its size in bytes."""
        return self.listed.end - self.listed.offset

    def has(self, channels: Collection[Channel]) -> bool:
        """Return whether the chunk may have messages of channels."""
        if not channels:
            return False
        return self.listed.channels is None or any(channel in self.listed.channels for channel in channels)


class TopicFacts(NamedTuple):
    """The number of messages on a topic and their rate in Hz, from the indexes of the files."""

    messages: int
    rate: float


class _Add(Protocol):
    def __call__(self, storage: Storage, batch: Batch, *, keep: bool = True, ingest: bool = True) -> None:
        """Add a batch to the index (``keep``), and its transforms to the buffers (``ingest``)."""


class ChunkReader:
    """Reads chunks when their messages are needed. Thread-safe.

    Args:
        listings: The files of the recording with their indexes.
        index: Receives the messages.
        selects: Returns whether the transforms of a channel are read.
        add: Adds the messages of a chunk.
        progress: Called with the number of bytes read, and the number needed.
    """

    def __init__(
        self,
        listings: list[tuple[Storage, Listing]],
        index: MessageIndex,
        selects: Callable[[Channel], bool],
        add: _Add,
        progress: Callable[[int, int], object],
    ) -> None:
        self._chunks = [_Chunk(storage, chunk) for storage, listing in listings for chunk in listing.chunks]
        self._index = index
        self._selects = selects
        self._add = add
        self._progress = progress
        self._lock = threading.RLock()
        self._read_positions: set[tuple[int, int]] = set()  # chunks whose messages are in the index
        self._complete: set[str] = set()  # topics

    def load(self, topics: Collection[str], start: int | None = None, stop: int | None = None) -> None:
        """Add the messages on topics that were received from ``start`` until ``stop``, and others."""
        with self._lock:
            missing_topics = [topic for topic in topics if topic not in self._complete]
            channels = self._channels(missing_topics)
            chunks = [
                chunk
                for chunk in self._chunks
                if (start is None or chunk.listed.last >= start)
                and (stop is None or chunk.listed.first < stop)
                and chunk.has(channels)
            ]
            self._add_chunks([chunk for chunk in chunks if chunk.key not in self._read_positions])
            if start is None and stop is None:
                self._complete.update(missing_topics)

    def load_first(self, topic: str) -> None:
        """Add the first messages on a topic, and others."""
        with self._lock:
            channels = self._channels([topic])
            for chunk in sorted(self._chunks, key=lambda each: each.listed.first):
                if topic not in self._complete and chunk.has(channels):
                    self._add_chunks([chunk] if chunk.key not in self._read_positions else [])
                    if any(track.received for track in self._index.tracks(topic)):
                        return

    def read_window(self, limits: Limits) -> None:
        """Read all messages and transforms of a window."""
        chosen = self._transform_channels()
        static = [channel for channel in chosen if is_static(channel.topic)]
        dynamic = [channel for channel in chosen if not is_static(channel.topic)]
        self._add_chunks(
            [
                chunk
                for chunk in self._chunks
                if limits.needs(chunk.listed, transforms=chunk.has(dynamic), static=chunk.has(static))
            ],
            ingest=True,
        )

    def read_transforms(self) -> None:
        """Read all transforms, in the order of the files, because later static ones replace earlier ones."""
        with self._lock:
            channels = self._transform_channels()
            self._add_chunks([chunk for chunk in self._chunks if chunk.has(channels)], ingest=True)

    def transform_batches(self) -> Iterator[Batch]:
        """Yield the messages with transforms again."""
        channels = self._transform_channels()
        for chunk in self._chunks:
            if chunk.has(channels):
                yield from (
                    batch for batch in chunk.storage.read_chunk(chunk.listed) if ingest_for(batch.channel) is not None
                )

    def _channels(self, topics: Iterable[str]) -> list[Channel]:
        return [track.channel for topic in topics for track in self._index.tracks(topic)]

    def _transform_channels(self) -> list[Channel]:
        return [channel for channel in self._channels(self._index.topics()) if self._selects(channel)]

    def _add_chunks(self, chunks: list[_Chunk], *, ingest: bool = False) -> None:
        """Read chunks, and add the messages that were not added before."""
        total = sum(chunk.size for chunk in chunks)
        done, changed = 0, set[str]()
        try:
            for group in _groups(chunks):
                _prefetch(group)
                for chunk in group:
                    for batch in chunk.storage.read_chunk(chunk.listed):
                        changed.add(batch.channel.topic)
                        self._add(chunk.storage, batch, keep=chunk.key not in self._read_positions, ingest=ingest)
                    self._read_positions.add(chunk.key)
                    done += chunk.size
                    self._progress(done, total)
        finally:
            self._index.forget(changed)


def _groups(chunks: list[_Chunk]) -> Iterator[list[_Chunk]]:
    """Yield chunks that are next to each other in a file, so that one request can read them."""
    group: list[_Chunk] = []
    for chunk in chunks:
        if group and not (
            chunk.storage is group[-1].storage
            and 0 <= chunk.listed.offset - group[-1].listed.end <= _MAX_GAP
            and chunk.listed.end - group[0].listed.offset <= MAX_RANGE // 2
        ):
            yield group
            group = []
        group.append(chunk)
    if group:
        yield group


def _prefetch(group: list[_Chunk]) -> None:
    path = group[0].storage.path
    if isinstance(path, Source) and path.is_remote:
        begin, end = group[0].listed.offset, group[-1].listed.end
        try:
            for offset in range(begin, end, MAX_RANGE // 2):
                path.cache.prefetch(offset, min(end, offset + MAX_RANGE // 2))
        except RemoteFileError as error:
            raise RecordingError(str(error), hint=error.hint) from None


def listed_span(listings: Iterable[tuple[Storage, Listing]]) -> tuple[int, int] | None:
    """Return the first and last receive time by the indexes of files, or None if they list no messages."""
    chunks = [chunk for _, listing in listings for chunk in listing.chunks]
    return (min(chunk.first for chunk in chunks), max(chunk.last for chunk in chunks)) if chunks else None


def topic_facts(listings: Iterable[tuple[Storage, Listing]]) -> dict[str, TopicFacts]:
    """Return the facts about topics from the indexes of files, by name."""
    counts: dict[str, int] = {}
    chunks: dict[str, list[ListedChunk]] = {}
    for _, listing in listings:
        for channel, messages in listing.counts.items():
            counts[channel.topic] = counts.get(channel.topic, 0) + messages
        for chunk in listing.chunks:
            for channel in chunk.channels or ():
                chunks.setdefault(channel.topic, []).append(chunk)
    return {topic: TopicFacts(messages, _rate(messages, chunks.get(topic, []))) for topic, messages in counts.items()}


def _rate(messages: int, chunks: list[ListedChunk]) -> float:
    """Return the rate in Hz by the times of the chunks with the messages, or 0 for a single burst in one of them."""
    if messages < 2 or len(chunks) < 2:
        return 0.0
    elapsed = max(chunk.last for chunk in chunks) - min(chunk.first for chunk in chunks)
    return (messages - 1) * SECOND / elapsed if elapsed > 0 else 0.0
