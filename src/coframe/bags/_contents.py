# SPDX-License-Identifier: Apache-2.0
"""Read the files of a recording once: all transforms, and the position of each message."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from coframe import time
from coframe._output.formatting import join_names
from coframe._process.freed_memory import collection_paused
from coframe._sources.remote_error import RemoteFileError
from coframe._sources.sources import Source
from coframe.bags._file_discovery import open_files
from coframe.bags._message_index import MessageIndex, largest_track, reread
from coframe.bags._problems import Problems
from coframe.bags._recorded_message import RecordedTopic, RecordedTopics
from coframe.bags._recorded_types import RecordedTypes
from coframe.bags._selective_reading import ChunkReader, listed_span, topic_facts
from coframe.bags._time_window import ALL_TIME
from coframe.bags.formats import BUILT_IN, recording_name
from coframe.bags.namespaces import TransformCollector, report_mixed_clocks
from coframe.bags.transforms import has_unknown_encoding, ingest_for, is_static
from coframe.errors import CoframeError, RecordingError
from coframe.frame_names import TF_STATIC_TOPIC, TF_TOPIC, absolute

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import numpy as np
    from numpy.typing import NDArray

    from coframe._sources.sources import Readable
    from coframe.bags._message_index import Track
    from coframe.bags._recording_format import RecordingFormat
    from coframe.bags._selective_reading import TopicFacts
    from coframe.bags._time_window import Limits, TimeWindow
    from coframe.bags.namespaces import TransformChoice
    from coframe.bags.storage import Batch, Channel, Listing, Storage
    from coframe.buffer import Buffer
    from coframe.messages.slices import Slices

    OnTransforms = Callable[[Channel, NDArray[np.int64], Slices], object]

__all__ = ["Contents", "read_contents"]

_MAX_PAUSE = 60 * time.SECOND  # between the files of one recording that do not have the same name
_BURST_SHARE = 0.01  # of the recording's duration


class Buffers(NamedTuple):
    """The transforms of a recording.

    Attributes:
        common: All transforms, or those of the first namespace if several contain the same frames.
        by_namespace: The transforms by namespace.
    """

    common: Buffer
    by_namespace: dict[str, Buffer]


class _ChannelTrack(NamedTuple):
    """The messages of a channel, and the function that ingests their transforms, or None if they are not needed."""

    track: Track
    ingest: Callable[[NDArray[np.int64], Slices], None] | None


@dataclass(frozen=True)
class Contents:
    """The contents of a recording; :class:`coframe.bags.Recording` describes the attributes with the same names.

    Attributes:
        path: The recording.
        problems: The problems found so far.
        closing: Closes the files.
        types: The types of the messages.
        index: The position of each message.
        received_span: First and last receive time, or None without messages.
        read_buffers: Returns the transforms; of a recording on a server, it reads them.
    """

    path: Readable
    problems: Problems
    closing: ExitStack
    types: RecordedTypes
    index: MessageIndex
    files: list[tuple[Readable, int]]
    formats: list[RecordingFormat]
    compression: str
    received_span: tuple[int, int] | None
    topics: RecordedTopics
    read_buffers: Callable[[], Buffers]


def read_contents(
    path: Readable,
    choice: TransformChoice,
    window: TimeWindow = ALL_TIME,
    progress: Callable[[int, int], object] | None = None,
    on_transforms: OnTransforms | None = None,
) -> Contents:
    """Read the files of a recording; of those on servers only the indexes, until more is needed.

    Args:
        path: A file, or a folder with files.
        choice: Selects the transforms to read, and the names of their frames.
        window: Selects the messages to read.
        progress: Called regularly with the number of bytes read and the total number of bytes.
        on_transforms: Called with all messages that contain transforms, in batches.

    Raises:
        RecordingError: Nothing can be read, or a chosen topic other than /tf and /tf_static does not exist.
        ValueError: The window is not valid.
    """
    reading = _ReadState(path, choice, window, progress or (lambda _done, _total: None), on_transforms)
    try:
        with collection_paused():
            return reading.read()
    except RemoteFileError as error:
        reading.closing.close()
        raise RecordingError(str(error), hint=error.hint) from None
    except BaseException:
        reading.closing.close()
        raise


class _ReadState:
    def __init__(
        self,
        path: Readable,
        choice: TransformChoice,
        window: TimeWindow,
        progress: Callable[[int, int], object],
        on_transforms: OnTransforms | None,
    ) -> None:
        self.closing = ExitStack()
        self._path = path
        self._choice = choice
        self._window = window
        self._limits: Limits | None = None
        self._progress = progress
        self._problems = Problems()
        self._types = RecordedTypes()
        self._index = MessageIndex(path, self._types)
        self._collector = TransformCollector(self._problems, choice, on_transforms)
        self._is_watched = on_transforms is not None
        self._tracks: dict[Channel, _ChannelTrack] = {}

    def read(self) -> Contents:
        """Read the data that is needed immediately."""
        storages, listed_topics, _ = open_files(self._path, self._problems, self.closing, self._progress)
        may_wait = self._window.is_all and not self._is_watched and any(map(_is_remote, storages))
        listings = _listings(storages) if may_wait or not self._window.is_all else None
        if not self._window.is_all:
            self._limits = self._window.limits(lambda: _whole_span(storages, listings))
        waiting = None
        if listings is None:
            self._read_files(storages)
        else:
            waiting = self._read_chunks(listings)
        for channel in listed_topics:
            if channel.topic not in self._index.topics():
                self._index.add_track(storages[0], channel)
        if waiting is None:
            self._check_related(storages)
        span = self._index.span() if waiting is None else listed_span(listings or ())
        facts = {} if waiting is None else topic_facts(listings or ())
        topics = RecordedTopics((name, self._topic(name, span, facts)) for name in self._index.topics())
        read_buffers = partial(self._buffers, waiting)
        if waiting is None:
            buffers = read_buffers()
            read_buffers = partial(_keep_buffers, buffers)
        self._check_tf_topics()
        return Contents(
            path=self._path,
            problems=self._problems,
            closing=self.closing,
            types=self._types,
            index=self._index,
            files=[(storage.path, storage.size) for storage in storages],
            formats=list(dict.fromkeys(storage.format for storage in storages)),
            compression=", ".join(sorted(set().union(*(each.compressions for each in storages)))) or "none",
            received_span=span,
            topics=topics,
            read_buffers=read_buffers,
        )

    def _read_chunks(self, listings: list[tuple[Storage, Listing]]) -> ChunkReader | None:
        """Read the chunks of the window; without one, return the reader that waits until chunks are needed."""
        for storage, _ in listings:
            self._add_channels(storage)
        chunks = ChunkReader(listings, self._index, self._has_chosen_transforms, self._add, self._progress)
        if self._limits is None:
            self._index.load_with(chunks)
            return chunks
        chunks.read_window(self._limits)
        return None

    def _buffers(self, waiting: ChunkReader | None) -> Buffers:
        """Return the transforms; read them first if they are waiting in chunks."""
        if waiting is not None:
            waiting.read_transforms()
        buffers = self._collector.buffers()
        with_transforms = [track for track in self._index.tracks() if _has_transforms(track.channel)]
        buffer = self._collector.common_buffer(
            buffers, lambda: reread(with_transforms) if waiting is None else _again(waiting)
        )
        report_mixed_clocks(buffer, self._problems)
        return Buffers(buffer, buffers)

    def _read_files(self, storages: list[Storage]) -> None:
        total = sum(storage.size for storage in storages)
        offset = 0
        for storage in storages:
            for batch in self._batches(storage, lambda bytes_, before=offset: self._progress(before + bytes_, total)):  # type: ignore[misc]
                self._add(storage, batch)
            self._add_channels(storage)
            offset += storage.size

    def _add_channels(self, storage: Storage) -> None:
        """Add the channels of a file without messages so far."""
        for channel in storage.channels():
            self._track(storage, channel)

    def _track(self, storage: Storage, channel: Channel) -> _ChannelTrack:
        if channel not in self._tracks:
            self._tracks[channel] = _ChannelTrack(
                self._index.add_track(storage, channel), self._collector.ingest(channel)
            )
        return self._tracks[channel]

    def _add(self, storage: Storage, batch: Batch, *, keep: bool = True, ingest: bool = True) -> None:
        """Add the messages of a batch to the index, and their transforms to the buffers."""
        channel = batch.channel
        track, take = self._track(storage, channel)
        if not track.received and has_unknown_encoding(channel):
            text = f"its transforms, {channel.type}, are in the encoding {channel.encoding!r}, which is not known"
            self._problems.add(f"{channel.topic}: {text}")
        if not batch.is_intact and _has_transforms(channel):
            # A flipped bit in a transform would be a wrong pose without a word.
            text = f"{channel.topic}: messages in damaged chunks were skipped, because their transforms may be wrong"
            self._problems.add(text, len(batch.received))
            return
        if keep:
            track.add(batch if self._limits is None else self._limits.messages(batch))
        if take is None or not ingest:
            return
        if self._limits is not None:
            batch = self._limits.transforms(batch, static=is_static(channel.topic))
        if batch.messages is not None:
            take(batch.received, batch.messages)

    def _has_chosen_transforms(self, channel: Channel) -> bool:
        return _has_transforms(channel) and self._choice.selects(channel.topic)

    def _batches(self, storage: Storage, progress: Callable[[int], object]) -> Iterator[Batch]:
        """Yield the batches of a file. An error in the format of another distribution ends this file."""
        try:
            yield from storage.batches(_has_transforms, progress)
        except (OSError, CoframeError):
            raise
        except Exception as error:
            if storage.format in BUILT_IN:
                raise
            storage.add_problem(f"the format {storage.format.name} failed: {type(error).__name__}: {error}")

    def _check_related(self, storages: list[Storage]) -> None:
        """Raise an error if the folder contains files of several recordings that were made at different times."""
        groups: dict[str, list[Storage]] = {}
        for storage in storages:
            groups.setdefault(recording_name(storage.path, storage.format), []).append(storage)
        if len(groups) == 1:
            return
        spans = []
        for group in groups.values():
            parts = [span for storage in group if (span := self._index.span(storage)) is not None]
            if parts:
                spans.append((min(first for first, _ in parts), max(last for _, last in parts)))
        spans.sort()
        apart = any(later[0] - earlier[1] > _MAX_PAUSE for earlier, later in pairwise(spans))
        if apart:
            names = join_names(group[0].path.name for group in groups.values())
            raise RecordingError(
                f"{self._path} contains {len(groups)} recordings from different times: {names}",
                hint="Give the path of one of them.",
            )

    def _check_tf_topics(self) -> None:
        """Raise an error for a misspelled topic, which would look like a healthy recording; /tf may be missing."""
        names = self._index.topics()
        missing = (
            set(map(absolute, self._choice.topics or ())) - set(map(absolute, names)) - {TF_TOPIC, TF_STATIC_TOPIC}
        )
        if missing:
            existing = [name for name in names if _has_transforms(self._index.tracks(name)[0].channel)]
            hint = f"Topics with transforms: {', '.join(existing) or 'none'}."
            raise RecordingError(f"{self._path} has no topic {', '.join(sorted(missing))}", hint=hint)

    def _topic(self, name: str, span: tuple[int, int] | None, facts: dict[str, TopicFacts]) -> RecordedTopic:
        tracks = self._index.tracks(name)
        main = largest_track(tracks)
        types = {track.channel.type for track in tracks}
        if len(types) > 1:
            self._problems.add(f"{name} has messages of several types: {', '.join(sorted(types))}")
        if name in facts:
            return RecordedTopic(name, main.channel.type, *facts[name], main.channel.encoding)
        received = self._index.received(name)
        rate = _rate(received, span)
        return RecordedTopic(name, main.channel.type, len(received), rate, main.channel.encoding)


def _rate(receive_times: NDArray[np.int64], span: tuple[int, int] | None) -> float:
    """Return the rate of messages in Hz, or 0 for a single burst, such as the static transforms at the start."""
    elapsed = int(receive_times[-1]) - int(receive_times[0]) if len(receive_times) else 0
    if span is None or elapsed <= 0:
        return 0.0
    is_burst = elapsed < time.SECOND and (len(receive_times) == 2 or elapsed < _BURST_SHARE * (span[1] - span[0]))
    return 0.0 if is_burst else (len(receive_times) - 1) * time.SECOND / elapsed


def _is_remote(storage: Storage) -> bool:
    return isinstance(storage.path, Source) and storage.path.is_remote


def _listings(storages: list[Storage]) -> list[tuple[Storage, Listing]] | None:
    """Return the indexes of files, or None if one of them has none."""
    listings = []
    for storage in storages:
        listing = storage.listing()
        if listing is None:
            return None
        listings.append((storage, listing))
    return listings


def _whole_span(storages: list[Storage], listings: list[tuple[Storage, Listing]] | None) -> tuple[int, int]:
    """Return the first and last receive time of all messages; without an index, they are all read for this."""
    if listings is not None:
        return listed_span(listings) or (0, 0)
    batches = (batch.received for each in storages for batch in each.batches(lambda _: False, lambda _: None))
    spans = [(int(received.min()), int(received.max())) for received in batches if len(received)]
    return (min(first for first, _ in spans), max(last for _, last in spans)) if spans else (0, 0)


def _again(waiting: ChunkReader) -> Iterator[tuple[Channel, Slices]]:
    """Yield the messages with transforms again."""
    for batch in waiting.transform_batches():
        if batch.messages is not None:
            yield batch.channel, batch.messages


def _keep_buffers(buffers: Buffers) -> Buffers:
    return buffers


def _has_transforms(channel: Channel) -> bool:
    return ingest_for(channel) is not None
