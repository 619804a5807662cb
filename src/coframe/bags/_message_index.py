# SPDX-License-Identifier: Apache-2.0
"""Index of all messages of a recording: their positions in the files, receive times and stamps."""

from __future__ import annotations

from array import array
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, TypeVar

import numpy as np

from coframe._files.os_errors import explain
from coframe._output.formatting import did_you_mean
from coframe.bags._compression import DamagedError
from coframe.errors import RecordingError
from coframe.messages.header_peek import STAMP_BYTES
from coframe.messages.slices import Slices

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Iterator

    from numpy.typing import NDArray

    from coframe._sources.sources import Readable
    from coframe.bags._recorded_types import RecordedTypes
    from coframe.bags.storage import Batch, Channel, Storage
    from coframe.messages.header_peek import StampReader

__all__ = ["MessageIndex", "MessageLoader", "Track", "largest_track", "reread"]

_MIN_CACHED_MESSAGES = 8  # of a topic whose rows are recomputed: a recording can have tens of thousands of such topics
_CLOCK_TYPE = "rosgraph_msgs/msg/Clock"
_Result = TypeVar("_Result")


@dataclass(eq=False, slots=True)
class Track:
    """The messages of one channel in one file, in file order."""

    storage: Storage
    channel: Channel
    types: RecordedTypes
    received: array[int] = field(default_factory=lambda: array("q"))
    positions: array[int] = field(default_factory=lambda: array("Q"))
    stamps: array[int] = field(default_factory=lambda: array("q"))  # empty if they have not been read

    @property
    def stamp_reader(self) -> StampReader | None:
        """Reader for the stamps of the messages, or None if they do not begin with a stamp."""
        return self.types.stamp_reader(self.channel)

    def add(self, batch: Batch) -> None:
        """Add messages, and their stamps if the bytes are available."""
        self.received.frombytes(batch.received.tobytes())
        self.positions.frombytes(batch.positions.tobytes())
        if batch.messages is not None:
            reader = self.stamp_reader
            stamps = batch.received if reader is None else reader.stamps(batch.messages, batch.received)
            self.stamps.frombytes(stamps.tobytes())

    def read_beginning(self, position: int) -> bytes:
        """Return enough of a message to contain its stamp; empty if it cannot be read."""
        try:
            return self.storage.head(position, STAMP_BYTES)
        except DamagedError:
            return b""


class _Rows(NamedTuple):
    """The messages on a topic in receive order."""

    tracks: list[Track]
    of_track: NDArray[np.uint32]  # index into tracks
    positions: NDArray[np.uint64]
    received: NDArray[np.int64]


class MessageLoader(Protocol):
    """Adds messages to the tracks of a recording when they are needed."""

    def load(self, topics: Collection[str], start: int | None, stop: int | None) -> None:
        """Add the messages on topics that were received from ``start`` until ``stop``, and others."""

    def load_first(self, topic: str) -> None:
        """Add the first messages on a topic, and others."""


class MessageIndex:
    """Finds the messages of a recording by topic and time, and reads their bytes.

    The rows of a topic are its messages in receive order, counted from 0.

    Args:
        path: The recording, for error messages.
        types: The types of its messages.
    """

    def __init__(self, path: Readable, types: RecordedTypes) -> None:
        self._path = path
        self._loader: MessageLoader | None = None
        self._types = types
        self._closed = False
        self._tracks: dict[str, list[Track]] = {}
        self._storages: dict[Storage, int] = {}  # with their numbers, in the order of the recording
        self._rows: dict[str, _Rows] = {}
        self._stamps: dict[str, NDArray[np.int64]] = {}
        self._by_stamp: dict[str, tuple[NDArray[np.int64], NDArray[np.intp]]] = {}

    def add_track(self, storage: Storage, channel: Channel) -> Track:
        """Add a channel of a file, without messages."""
        track = Track(storage, channel, self._types)
        self._storages.setdefault(storage, len(self._storages))
        self._tracks.setdefault(channel.topic, []).append(track)
        return track

    def load_with(self, loader: MessageLoader) -> None:
        """Let a loader add messages to the tracks when they are needed."""
        self._loader = loader

    @property
    def is_waiting(self) -> bool:
        """Whether messages are read when they are needed."""
        return self._loader is not None

    def forget(self, topics: Iterable[str]) -> None:
        """Discard cached results for topics whose tracks have new messages."""
        for topic in topics:
            for cache in (self._rows, self._stamps, self._by_stamp):
                cache.pop(topic, None)

    def while_open(self, function: Callable[[], _Result]) -> _Result:
        """Return the result of a function that reads messages.

        Raises:
            RecordingError: The files are closed.
        """
        if self._loader is not None:
            self._check_open()
        return function()

    def close(self) -> None:
        """Make all further reads raise an error, because the files are closed."""
        self._closed = True

    def topics(self) -> list[str]:
        """Return the names of all topics, sorted."""
        return sorted(self._tracks)

    def span(self, storage: Storage | None = None) -> tuple[int, int] | None:
        """Return the first and last receive time of one file or of all files, or None if there are no messages."""
        parts = [
            received
            for track in self.tracks()
            if (storage is None or track.storage is storage) and len(received := _int64(track.received))
        ]
        return (min(int(part.min()) for part in parts), max(int(part.max()) for part in parts)) if parts else None

    def tracks(self, topic: str | None = None) -> list[Track]:
        """Return the tracks of a topic, or of all topics."""
        return [track for name in (self._tracks if topic is None else (topic,)) for track in self._tracks[name]]

    def find_topic(self, topic: str) -> str:
        """Return the full name of a topic whose leading slash may be missing.

        Raises:
            RecordingError: The topic does not exist.
        """
        name = topic if topic in self._tracks else f"/{topic}"
        if name not in self._tracks:
            there = f"Its topics: {', '.join(self.topics()) or 'none'}."
            raise RecordingError(
                f"{self._path} has no topic {topic!r}", hint=f"{there} {did_you_mean(name, self.topics())}".rstrip()
            )
        return name

    def received(self, topic: str) -> NDArray[np.int64]:
        """Return the receive times of a topic's messages, sorted: (N,) nanoseconds."""
        return self._rows_of(topic).received

    def channel(self, topic: str, row: int) -> Channel:
        """Return the channel of a message."""
        rows = self._rows_of(topic)
        return rows.tracks[int(rows.of_track[row])].channel

    def first_message(self, topic: str) -> tuple[Channel, bytes] | None:
        """Return the first message of a topic that can be read, with its channel, or None if there is none."""
        if self._loader is not None:
            self._check_open()
            self._loader.load_first(topic)
        rows = self._rows_in_memory(topic)
        for number, position in zip(rows.of_track, rows.positions, strict=True):
            if (data := self._bytes(rows.tracks[number], int(position))) is not None:
                return rows.tracks[number].channel, data
        return None

    def read(self, topic: str, row: int) -> bytes | None:
        """Return the bytes of a message, or None if it can no longer be read, which is added to the problems."""
        rows = self._rows_of(topic)
        return self._bytes(rows.tracks[rows.of_track[row]], int(rows.positions[row]))

    def head(self, topic: str, row: int, size: int) -> bytes:
        """Return the first bytes of a message; empty if it can no longer be read."""
        self._check_open()
        rows = self._rows_of(topic)
        with suppress(DamagedError, OSError):
            data: bytes = rows.tracks[rows.of_track[row]].storage.head(int(rows.positions[row]), size)
            return data
        return b""

    def stamps(self, topic: str) -> NDArray[np.int64]:
        """Return the stamps of a topic's messages in receive order: (N,) nanoseconds."""
        if topic not in self._stamps:
            tracks = self._rows_of(topic).tracks
            stamps = np.concatenate([self._track_stamps(track) for track in tracks])
            self._stamps[topic] = stamps[self._receive_order(tracks)]
            self._stamps[topic].setflags(write=False)
        return self._stamps[topic]

    def newest_row(self, topic: str, stamp: int) -> int | None:
        """Return the row of the message with the largest stamp that is at most `stamp`, or None if there is none."""
        if topic not in self._by_stamp:
            order = np.argsort(self.stamps(topic), kind="stable")
            self._by_stamp[topic] = (self.stamps(topic)[order], order)
        stamps, order = self._by_stamp[topic]
        index = int(np.searchsorted(stamps, stamp, side="right")) - 1
        return None if index < 0 else int(order[index])

    def in_order(
        self, topics: Iterable[str] | None, start: int | None, stop: int | None
    ) -> Iterator[tuple[Channel, int, bytes]]:
        """Yield channel, receive time and bytes of the messages on several topics in receive order.

        Messages with equal times keep the order in which they were written.
        """
        topics = list(self._tracks if topics is None else topics)
        self._read_positions(topics, start, stop)
        tracks = [track for name in topics for track in self.tracks(name)]
        if not tracks:
            return
        received = np.concatenate([_int64(track.received) for track in tracks])
        positions = np.concatenate([np.array(track.positions, dtype=np.uint64) for track in tracks])
        of_track = np.repeat(np.arange(len(tracks)), [len(track.received) for track in tracks])
        order = self._receive_order(tracks)
        first = 0 if start is None else int(np.searchsorted(received[order], start))
        last = len(order) if stop is None else int(np.searchsorted(received[order], stop))
        for row in order[first:last]:
            track = tracks[of_track[row]]
            data = self._bytes(track, int(positions[row]))
            if data is not None:
                yield track.channel, int(received[row]), data

    def _bytes(self, track: Track, position: int) -> bytes | None:
        self._check_open()
        try:
            return track.storage.read(position)
        except (DamagedError, OSError) as error:
            track.storage.add_problem(f"a message on {track.channel.topic} cannot be read again: {explain(error)}")
            return None

    def _check_open(self) -> None:
        if self._closed:
            raise RecordingError(
                f"{self._path} is closed: its messages can no longer be read",
                hint="Read messages before close(), inside the `with` block. The transforms stay available.",
            )

    def _receive_order(self, tracks: list[Track]) -> NDArray[np.intp]:
        """Return the order of the messages of tracks by receive time; equal ones as they were written."""
        received = _concatenate([_int64(track.received) for track in tracks])
        order = np.argsort(received, kind="stable")
        if len(tracks) == 1 or (np.diff(received[order]) > 0).all():
            return order
        # Positions are signed for rows of SQLite, and grow within a file.
        positions = _concatenate([np.asarray(track.positions, dtype=np.uint64).view(np.int64) for track in tracks])
        files = np.repeat([self._storages[track.storage] for track in tracks], [len(each.received) for each in tracks])
        return np.lexsort((positions, files, received))

    def _read_positions(self, topics: Collection[str], start: int | None = None, stop: int | None = None) -> None:
        """Read the positions of the messages on topics, if they have not been read."""
        if self._loader is not None:
            self._check_open()
            self._loader.load(topics, start, stop)

    def _rows_of(self, topic: str) -> _Rows:
        self._read_positions((topic,))
        return self._rows_in_memory(topic)

    def _rows_in_memory(self, topic: str) -> _Rows:
        if topic in self._rows:
            return self._rows[topic]
        tracks = self._tracks[topic]
        received = _concatenate([_int64(track.received) for track in tracks])
        positions = _concatenate([np.asarray(track.positions, dtype=np.uint64) for track in tracks])
        of_track = _numbers([len(track.received) for track in tracks])
        if len(tracks) > 1 or not (received[1:] >= received[:-1]).all():
            order = self._receive_order(tracks)
            received, positions, of_track = received[order], positions[order], of_track[order]
        rows = _Rows(tracks, of_track, positions, received)
        if len(received) > _MIN_CACHED_MESSAGES:
            self._rows[topic] = rows
        return rows

    def _track_stamps(self, track: Track) -> NDArray[np.int64]:
        received = _int64(track.received)
        reader = track.stamp_reader
        if reader is None:
            return self.to_ros_time(received)
        if len(track.stamps) == len(track.received):
            return _int64(track.stamps)
        self._check_open()
        heads = Slices.join([track.read_beginning(position) for position in track.positions])
        return reader.stamps(heads, received)

    def to_ros_time(self, receive_time: NDArray[np.int64]) -> NDArray[np.int64]:
        """Convert receive times to the ROS clock, if /clock was recorded."""
        if self._clock is None:
            return receive_time
        wall, simulated = self._clock
        elapsed = np.interp((receive_time - wall[0]).astype(np.float64), wall - wall[0], simulated - simulated[0])
        return np.asarray(simulated[0] + np.rint(elapsed).astype(np.int64))

    @cached_property
    def _clock(self) -> tuple[NDArray[np.int64], NDArray[np.int64]] | None:
        """Receive times and times of the messages on /clock."""
        tracks = self._tracks.get("/clock")
        if not tracks or largest_track(tracks).channel.type != _CLOCK_TYPE:
            return None
        if any(track.stamp_reader is None for track in tracks):  # Its definition is not that of a Clock message.
            return None
        return self.received("/clock"), self.stamps("/clock")


def largest_track(tracks: list[Track]) -> Track:
    """Return the track with the most messages."""
    return max(tracks, key=lambda track: len(track.received))


def reread(tracks: Iterable[Track]) -> Iterator[tuple[Channel, Slices]]:
    """Yield the messages of tracks one by one in file order, without those that cannot be read."""
    for track in tracks:
        for position in track.positions:
            with suppress(DamagedError):  # This was reported when the file was first read.
                yield track.channel, Slices.join([track.storage.read(position)])


def _numbers(sizes: list[int]) -> NDArray[np.uint32]:
    """Return the track number of each message; nearly all topics have one track."""
    if len(sizes) == 1:
        return np.zeros(sizes[0], dtype=np.uint32)
    return np.repeat(np.arange(len(sizes), dtype=np.uint32), sizes)


def _int64(values: array[int]) -> NDArray[np.int64]:
    return np.asarray(values, dtype=np.int64)


def _concatenate(parts: list[NDArray[Any]]) -> NDArray[Any]:
    return parts[0] if len(parts) == 1 else np.concatenate(parts)
