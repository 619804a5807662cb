"""Recording: every transform of a run, and every other message, at any time."""

from __future__ import annotations

import weakref
from array import array
from contextlib import ExitStack, suppress
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe import time
from coframe.bags import tree
from coframe.bags.compression import DamagedError
from coframe.bags.decoding import decoder, ros2_name
from coframe.bags.file_discovery import open_files
from coframe.bags.problems import Problems
from coframe.bags.table import edge_table
from coframe.bags.transforms import ingest_for
from coframe.errors import RecordingError
from coframe.frame_names import absolute, kept, renaming
from coframe.messages.header_peek import STAMP_BYTES, stamp_reader
from coframe.messages.slices import Slices

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable, Iterator

    from numpy.typing import NDArray
    from typing_extensions import Self

    from coframe import _core
    from coframe.bags.storage import Channel, Storage
    from coframe.buffer import Buffer
    from coframe.messages.header_peek import StampReader
    from coframe.time import StampLike

__all__ = ["RecordedMessage", "Recording", "Topic", "open_bag"]


class Topic(NamedTuple):
    """What a recording has of one topic.

    Attributes:
        name: The topic.
        type: Of its messages, ``sensor_msgs/msg/Imu``; as recorded, if it is not ROS.
        messages: How many there are.
        rate: Messages per second over the time from the first to the last; 0 for fewer than two.
        encoding: ``cdr``, ``ros1``, ``protobuf``, ``json``, ...
    """

    name: str
    type: str
    messages: int
    rate: float
    encoding: str


class RecordedMessage:
    """One message of a recording. All times are nanoseconds.

    Attributes:
        topic: Where it was sent.
        type: Of what type it is.
        stamp: What time it tells of: its header's stamp, or when it was received where it has none.
        received: When the recorder got it.
        data: The bytes.
    """

    __slots__ = ("_decode", "_message", "data", "received", "stamp", "topic", "type")

    def __init__(
        self, topic: str, type_: str, stamp: int, received: int, data: bytes, decode: Callable[[bytes], Any]
    ) -> None:
        self.topic = topic
        self.type = type_
        self.stamp = stamp
        self.received = received
        self.data = data
        self._decode = decode

    @property
    def message(self) -> Any:
        """The message, decoded when it is first asked for; bytes where nothing says what they mean.

        Raises:
            DecodeError: The bytes are damaged.
        """
        if not hasattr(self, "_message"):
            self._message = self._decode(self.data)
        return self._message

    def __repr__(self) -> str:
        return f"RecordedMessage({self.topic!r}, {self.type}, stamp={self.stamp}, {len(self.data)} bytes)"


@dataclass(eq=False)
class _Track:
    """Where one channel's messages are."""

    storage: Storage
    channel: Channel
    received: array[int] = field(default_factory=lambda: array("q"))
    positions: array[int] = field(default_factory=lambda: array("Q"))
    stamps: array[int] = field(default_factory=lambda: array("q"))  # empty where they have not been read

    @cached_property
    def stamp_reader(self) -> StampReader | None:
        """Reader for the stamps of the messages; None if they do not begin with a stamp."""
        return stamp_reader(ros2_name(self.channel.type), self.channel.encoding, self.channel.definition)


class _Index(NamedTuple):
    """All messages of a topic in the order in which they were received: of which track, and where there."""

    tracks: list[_Track]
    of_track: NDArray[np.uint32]
    positions: NDArray[np.uint64]
    received: NDArray[np.int64]


def open_bag(
    path: str | os.PathLike[str],
    *,
    namespace: str | None = None,
    tf_topics: Iterable[str] | None = None,
    prefix: str = "",
    keep: Iterable[str] = (),
    progress: Callable[[int, int], object] | None = None,
    heard: Callable[[Channel, NDArray[np.int64], Slices], object] | None = None,
) -> Recording:
    """Reads a recording: rosbag2 (MCAP or SQLite, any compression), a bag of ROS 1, or MCAP with Foxglove's transforms.

    Args:
        path: A file, or a folder of rosbag2, with or without its metadata.
        namespace: Only transforms of this one, such as ``/robot1`` for ``/robot1/tf``; None: all.
        tf_topics: Only transforms of these topics, such as ``["/robot1/tf", "/tf_static"]``; None: all.
        prefix: Goes in front of the names of frames in the buffers, as it is: ``robot1/`` makes ``robot1/base_link``.
        keep: The frames that get no prefix, as they are shared: ``["map"]``.
        progress: Called now and then with the bytes that are read and the bytes that there are.
        heard: Called with all messages that hold transforms, many at a time: their channel, when they were received,
            and their bytes.

    Returns:
        The recording. What could not be read of it is among its ``problems``.

    Raises:
        RecordingError: Nothing of it can be read, or it lacks a topic of ``tf_topics`` that is not /tf or /tf_static.
        ValueError: The prefix begins with a slash.

    Example:
        >>> import coframe
        >>> coframe.open_bag("nowhere.mcap")
        Traceback (most recent call last):
        coframe.RecordingError: nowhere.mcap cannot be read: No such file or directory
    """
    keep = kept(keep)
    tf_topics = None if tf_topics is None else list(tf_topics)
    recording = Recording(Path(path))
    recording.options = {"namespace": namespace, "tf_topics": tf_topics, "prefix": prefix, "keep": keep}
    recording._renaming = renaming(prefix, keep)  # noqa: SLF001 - the other half of __init__
    try:
        wanted = tree.Wanted(namespace, tf_topics)
        recording._scan(wanted, progress or (lambda _done, _total: None), heard)  # noqa: SLF001 - likewise
        recording._check_tf_topics(tf_topics or [])  # noqa: SLF001 - likewise
    except BaseException:
        recording.close()
        raise
    return recording


class Recording:
    """What :func:`open_bag` gives; usable as a context manager. Any thread may ask.

    Attributes:
        path: What was opened.
        buffer: Every transform, with unlimited history. Where the robots of several namespaces use the same names,
            those of the first one only; see ``buffers``.
        buffers: The transforms of each namespace: ``""`` for ``/tf``, ``/robot1`` for ``/robot1/tf``.
        topics: By name.
        options: What :func:`open_bag` was told of namespace, topics and names, for whoever opens it once more.
    """

    buffer: Buffer
    buffers: dict[str, Buffer]
    topics: dict[str, Topic]
    options: dict[str, Any]

    def __init__(self, path: Path) -> None:
        self.path = path
        self._problems = Problems()
        self._renaming: _core.Renaming | None = None
        self._closing = ExitStack()
        self._closed = False
        weakref.finalize(self, self._closing.close)  # for those who never close()
        self._tracks: dict[str, list[_Track]] = {}
        self._indices: dict[str, _Index] = {}
        self._stamps: dict[str, NDArray[np.int64]] = {}
        self._by_stamp: dict[str, tuple[NDArray[np.int64], NDArray[np.intp]]] = {}
        self._decoders: dict[int, Callable[[bytes], Any]] = {}

    def _scan(
        self,
        wanted: tree.Wanted,
        progress: Callable[[int, int], object],
        heard: Callable[[Channel, NDArray[np.int64], Slices], object] | None,
    ) -> None:
        storages = open_files(self.path, self._problems, self._closing)
        total = sum(storage.size for storage in storages)
        done = 0
        collected = tree.Transforms(self._problems, wanted, self._renaming, heard)
        for storage in storages:
            self._scan_file(storage, collected, lambda bytes_, before=done: progress(before + bytes_, total))  # type: ignore[misc]
            done += storage.size
        self.topics = {name: self._topic(name) for name in sorted(self._tracks)}
        self.buffers = collected.buffers()
        self.buffer = collected.together(self.buffers, self._transform_messages)
        tree.report(self.buffer, self._problems)

    def _scan_file(self, storage: Storage, collected: tree.Transforms, progress: Callable[[int], object]) -> None:
        tracks: dict[Channel, tuple[_Track, Callable[[NDArray[np.int64], Slices], None] | None]] = {}
        for channel, received, positions, messages in storage.batches(_has_transforms, progress):
            if channel not in tracks:
                tracks[channel] = _Track(storage, channel), collected.ingest(channel)
                self._tracks.setdefault(channel.topic, []).append(tracks[channel][0])
            track, ingest = tracks[channel]
            track.received.frombytes(received.tobytes())
            track.positions.frombytes(positions.tobytes())
            if messages is not None:
                reader = track.stamp_reader
                stamps = received if reader is None else reader.stamps(messages, received)
                track.stamps.frombytes(stamps.tobytes())
                if ingest is not None:
                    ingest(received, messages)

    def _check_tf_topics(self, chosen: list[str]) -> None:
        """Of a misspelt topic nothing wrong could be found; those that are usual need not be there."""
        missing = set(map(absolute, chosen)) - set(map(absolute, self._tracks)) - {"/tf", "/tf_static"}
        if missing:
            there = sorted(name for name, tracks in self._tracks.items() if _has_transforms(tracks[0].channel))
            hint = f"Topics with transforms: {', '.join(there) or 'none'}."
            raise RecordingError(f"{self.path} has no topic {', '.join(sorted(missing))}", hint=hint)

    def _transform_messages(self) -> Iterator[tuple[Channel, Slices]]:
        """All messages with transforms once more, as they lie in their files."""
        for track in (track for tracks in self._tracks.values() for track in tracks):
            if _has_transforms(track.channel):
                for position in track.positions:
                    with suppress(DamagedError):  # told of before
                        yield track.channel, Slices.join([track.storage.read(position)])

    def _topic(self, name: str) -> Topic:
        tracks = self._tracks[name]
        main = max(tracks, key=lambda track: len(track.received))
        types = {track.channel.type for track in tracks}
        if len(types) > 1:
            self._problems.add(f"{name} has messages of several types: {', '.join(sorted(types))}")
        received = self._index(name).received
        seconds = (int(received[-1]) - int(received[0])) / time.SECOND if len(received) else 0.0
        rate = (len(received) - 1) / seconds if seconds > 0 else 0.0
        return Topic(name, main.channel.type, len(received), rate, main.channel.encoding)

    def frame(self, name: str) -> str:
        """What a frame that a message names is called in the buffers: with the prefix, if it was given one."""
        return name.removeprefix("/") if self._renaming is None else self._renaming(name)

    @property
    def problems(self) -> list[str]:
        """What could not be read, or is odd, one sentence each; reading messages may add to it."""
        return self._problems.sentences()

    @cached_property
    def start(self) -> int:
        """When the first message was received, in nanoseconds; 0 if there is none."""
        return min((int(self._index(name).received[0]) for name in self.topics), default=0)

    @cached_property
    def end(self) -> int:
        """When the last message was received, in nanoseconds; 0 if there is none."""
        return max((int(self._index(name).received[-1]) for name in self.topics), default=0)

    @property
    def duration(self) -> int:
        """From :attr:`start` to :attr:`end`, in nanoseconds."""
        return self.end - self.start

    @cached_property
    def span(self) -> tuple[int, int]:
        """The first and the last stamp, in nanoseconds, on the clock that most transforms are told by.

        In a simulation this is not the clock by which messages are received. Without moving transforms: from the first
        to the last message.
        """
        return tree.span(self.buffer) or (self.start, self.end)

    def messages(
        self, topic: str, start: StampLike | None = None, stop: StampLike | None = None
    ) -> Iterator[RecordedMessage]:
        """The messages of a topic in the order in which they were received, read and decoded one by one.

        Args:
            topic: Its name; the slash in front may be left out.
            start: Only those whose stamps are at or after this.
            stop: Only those whose stamps are before this.

        Raises:
            RecordingError: There is no such topic.
        """
        name = self._name(topic)
        stamps = self.stamps(name)
        chosen = np.ones(len(stamps), dtype=bool)
        if start is not None:
            chosen &= stamps >= time.stamp_ns(start)
        if stop is not None:
            chosen &= stamps < time.stamp_ns(stop)
        return self._read_all(name, np.flatnonzero(chosen))

    def channels(self) -> list[Channel]:
        """What was recorded on which topic, as the files say: one for each file, topic and type."""
        return [track.channel for tracks in self._tracks.values() for track in tracks]

    def in_order(
        self, topics: Iterable[str] | None = None, start: int | None = None, stop: int | None = None
    ) -> Iterator[tuple[Channel, int, bytes]]:
        """The messages of several topics as they were received: (channel, time of receipt in nanoseconds, bytes).

        Args:
            topics: Their names; None: all.
            start: Only those received at or after this, in nanoseconds.
            stop: Only those received before this.

        Raises:
            RecordingError: There is no such topic.
        """
        tracks = [
            track
            for name in (self._tracks if topics is None else map(self._name, topics))
            for track in self._tracks[name]
        ]
        if not tracks:
            return
        received = np.concatenate([_numbers(track.received) for track in tracks])
        positions = np.concatenate([np.array(track.positions, dtype=np.uint64) for track in tracks])
        of_track = np.repeat(np.arange(len(tracks)), [len(track.received) for track in tracks])
        order = np.argsort(received, kind="stable")
        first = 0 if start is None else int(np.searchsorted(received[order], start))
        last = len(order) if stop is None else int(np.searchsorted(received[order], stop))
        for row in order[first:last]:
            track = tracks[of_track[row]]
            data = self._bytes(track, int(positions[row]))
            if data is not None:
                yield track.channel, int(received[row]), data

    def _read_all(self, name: str, rows: NDArray[np.intp]) -> Iterator[RecordedMessage]:
        for row in rows.tolist():
            message = self._read(name, row)
            if message is not None:
                yield message

    def stamps(self, topic: str) -> NDArray[np.int64]:
        """What times a topic's messages tell of, in the order in which they were received.

        Args:
            topic: Its name; the slash in front may be left out.

        Returns:
            (N,) nanoseconds, not always sorted: the stamp of the header, or of the first of many; of messages without
            one the time of receipt, on the clock of ``/clock`` where that was recorded.

        Raises:
            RecordingError: There is no such topic.
        """
        name = self._name(topic)
        if name not in self._stamps:
            index = self._index(name)
            stamps = np.concatenate([self._track_stamps(track) for track in index.tracks])
            order = np.argsort(np.concatenate([_numbers(track.received) for track in index.tracks]), kind="stable")
            self._stamps[name] = stamps[order]
            self._stamps[name].setflags(write=False)
        return self._stamps[name]

    def received(self, topic: str) -> NDArray[np.int64]:
        """When a topic's messages were received: (N,) nanoseconds by the recorder's clock, sorted.

        Args:
            topic: Its name; the slash in front may be left out.

        Raises:
            RecordingError: There is no such topic.
        """
        return self._index(self._name(topic)).received

    def message_at(self, topic: str, stamp: StampLike) -> RecordedMessage | None:
        """The newest message of a topic that is no newer than a time; None before the first one.

        Args:
            topic: Its name; the slash in front may be left out.
            stamp: When, on the clock of :meth:`stamps`.

        Raises:
            RecordingError: There is no such topic.
        """
        name = self._name(topic)
        if name not in self._by_stamp:
            order = np.argsort(self.stamps(name), kind="stable")
            self._by_stamp[name] = (self.stamps(name)[order], order)
        stamps, order = self._by_stamp[name]
        row = int(np.searchsorted(stamps, time.stamp_ns(stamp), side="right")) - 1
        return None if row < 0 else self._read(name, int(order[row]))

    def table(self, format_: str = "arrow") -> Any:
        """Every transform as one table, a row a sample, one edge after the other.

        Args:
            format_: ``"arrow"`` for a ``pyarrow.Table``, ``"pandas"`` for a ``DataFrame``.

        Returns:
            The columns ``stamp_ns`` (int64; 0 where static), ``parent``, ``child``, ``x``, ``y``, ``z`` (metres, told
            in the parent), ``qx``, ``qy``, ``qz``, ``qw``, ``static``, ``topic`` (by which the edge was told of last).

        Raises:
            RecordingError: The package is not installed.
        """
        return edge_table(self.buffers.values(), format_)

    def _read(self, name: str, row: int) -> RecordedMessage | None:
        """One message; None, and a problem more, if it can no longer be read."""
        index = self._index(name)
        track = index.tracks[index.of_track[row]]
        data = self._bytes(track, int(index.positions[row]))
        if data is None:
            return None
        key = id(track.channel)
        if key not in self._decoders:
            self._decoders[key] = decoder(track.channel, self._problems)
        stamp, received = int(self.stamps(name)[row]), int(index.received[row])
        return RecordedMessage(name, track.channel.type, stamp, received, data, self._decoders[key])

    def _bytes(self, track: _Track, position: int) -> bytes | None:
        self._check_open()
        try:
            return track.storage.read(position)
        except (DamagedError, OSError) as error:
            track.storage.add_problem(f"a message on {track.channel.topic} cannot be read again: {error}")
            return None

    def _track_stamps(self, track: _Track) -> NDArray[np.int64]:
        received = _numbers(track.received)
        if track.stamp_reader is None:
            return self._on_stamps_clock(received)
        if len(track.stamps) == len(track.received):
            return _numbers(track.stamps)
        self._check_open()
        heads = Slices.join([_head(track, position) for position in track.positions])
        return track.stamp_reader.stamps(heads, received)

    def _on_stamps_clock(self, received: NDArray[np.int64]) -> NDArray[np.int64]:
        """Times of receipt on the clock that stamps are told by."""
        ticks = self._clock
        if ticks is None:
            return received
        wall, simulated = ticks
        between = np.interp((received - wall[0]).astype(np.float64), wall - wall[0], simulated - simulated[0])
        return np.asarray(simulated[0] + np.rint(between).astype(np.int64))

    @cached_property
    def _clock(self) -> tuple[NDArray[np.int64], NDArray[np.int64]] | None:
        """Times of receipt and what /clock said then."""
        topic = self.topics.get("/clock")
        if topic is None or topic.type != "rosgraph_msgs/msg/Clock":
            return None
        return self._index("/clock").received, self.stamps("/clock")

    def _index(self, name: str) -> _Index:
        if name not in self._indices:
            tracks = self._tracks[name]
            received = _joined([_numbers(track.received) for track in tracks])
            positions = _joined([np.asarray(track.positions, dtype=np.uint64) for track in tracks])
            of_track = np.repeat(np.arange(len(tracks), dtype=np.uint32), [len(track.received) for track in tracks])
            if not (received[1:] >= received[:-1]).all():
                order = np.argsort(received, kind="stable")
                received, positions, of_track = received[order], positions[order], of_track[order]
            self._indices[name] = _Index(tracks, of_track, positions, received)
        return self._indices[name]

    def _name(self, topic: str) -> str:
        name = topic if topic in self._tracks else f"/{topic}"
        if name not in self._tracks:
            raise RecordingError(
                f"{self.path} has no topic {topic!r}", hint=f"It has {', '.join(sorted(self._tracks)) or 'none'}."
            )
        return name

    def close(self) -> None:
        """Lets go of the files; the transforms stay."""
        self._closed = True
        self._closing.close()

    def _check_open(self) -> None:
        if self._closed:
            raise RecordingError(
                f"{self.path} is closed: only its transforms are left",
                hint="Read messages before close(), inside `with`.",
            )

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        seconds = self.duration / time.SECOND
        return f"Recording({str(self.path)!r}, {len(self.topics)} topics, {seconds:.1f} s)"


def _has_transforms(channel: Channel) -> bool:
    return ingest_for(channel) is not None


def _head(track: _Track, position: int) -> bytes:
    try:
        return track.storage.head(position, STAMP_BYTES)
    except DamagedError:
        return b""


def _numbers(values: array[int]) -> NDArray[np.int64]:
    return np.asarray(values, dtype=np.int64)


def _joined(parts: list[NDArray[Any]]) -> NDArray[Any]:
    return parts[0] if len(parts) == 1 else np.concatenate(parts)
