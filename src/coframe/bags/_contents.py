# SPDX-License-Identifier: Apache-2.0
"""Read the files of a recording once: all transforms, and the position of each message."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

from coframe import time
from coframe._output.formatting import join_names
from coframe._process.freed_memory import collection_paused
from coframe.bags._file_discovery import open_files
from coframe.bags._message_index import MessageIndex, largest_track, reread
from coframe.bags._problems import Problems
from coframe.bags._recorded_message import RecordedTopic
from coframe.bags._recorded_types import RecordedTypes
from coframe.bags.formats import BUILT_IN, recording_name
from coframe.bags.namespaces import TransformCollector, report_mixed_clocks
from coframe.bags.transforms import has_unknown_encoding, ingest_for
from coframe.errors import CoframeError, RecordingError
from coframe.frame_names import TF_STATIC_TOPIC, TF_TOPIC, absolute

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    import numpy as np
    from numpy.typing import NDArray

    from coframe.bags._message_index import Track
    from coframe.bags._recording_format import RecordingFormat
    from coframe.bags.namespaces import TransformChoice
    from coframe.bags.storage import Batch, Channel, Storage
    from coframe.buffer import Buffer
    from coframe.messages.slices import Slices

    OnTransforms = Callable[[Channel, NDArray[np.int64], Slices], object]

__all__ = ["Contents", "read_contents"]

_MAX_PAUSE = 60 * time.SECOND  # between the files of one recording that do not have the same name
_BURST_SHARE = 0.01  # of the recording's duration


@dataclass(frozen=True)
class Contents:
    """The contents of a recording; :class:`coframe.bags.Recording` describes the attributes with the same names.

    Attributes:
        path: The recording.
        problems: The problems found so far.
        closing: Closes the files.
        types: The types of the messages.
        index: The position of each message.
        received_span: First and last receive time; None without messages.
    """

    path: Path
    problems: Problems
    closing: ExitStack
    types: RecordedTypes
    index: MessageIndex
    files: list[tuple[Path, int]]
    formats: list[RecordingFormat]
    compression: str
    received_span: tuple[int, int] | None
    topics: dict[str, RecordedTopic]
    buffer: Buffer
    buffers: dict[str, Buffer]


def read_contents(
    path: Path,
    choice: TransformChoice,
    progress: Callable[[int, int], object] | None = None,
    on_transforms: OnTransforms | None = None,
) -> Contents:
    """Read the files of a recording.

    Args:
        path: A file, or a folder with files.
        choice: Selects the transforms to read, and the names of their frames.
        progress: Called regularly with the number of bytes read and the total number of bytes.
        on_transforms: Called with all messages that contain transforms, in batches.

    Raises:
        RecordingError: Nothing can be read, or a chosen topic other than /tf and /tf_static does not exist.
    """
    reading = _Reading(path, choice, on_transforms)
    try:
        with collection_paused():
            return reading.read(progress or (lambda _done, _total: None))
    except BaseException:
        reading.closing.close()
        raise


class _Reading:
    def __init__(self, path: Path, choice: TransformChoice, on_transforms: OnTransforms | None) -> None:
        self.closing = ExitStack()
        self._path = path
        self._choice = choice
        self._problems = Problems()
        self._types = RecordedTypes()
        self._index = MessageIndex(path, self._types)
        self._collected = TransformCollector(self._problems, choice, on_transforms)

    def read(self, progress: Callable[[int, int], object]) -> Contents:
        """Read everything."""
        storages, listed_topics, _ = open_files(self._path, self._problems, self.closing)
        total = sum(storage.size for storage in storages)
        done = 0
        for storage in storages:
            self._read_file(storage, lambda bytes_, before=done: progress(before + bytes_, total))  # type: ignore[misc]
            done += storage.size
        for channel in listed_topics:
            if channel.topic not in self._index.topics():
                self._index.add_track(storages[0], channel)
        self._check_related(storages)
        span = self._index.span()
        topics = {name: self._topic(name, span) for name in self._index.topics()}
        buffers = self._collected.buffers()
        with_transforms = [track for track in self._index.tracks() if _has_transforms(track.channel)]
        buffer = self._collected.common_buffer(buffers, lambda: reread(with_transforms))
        report_mixed_clocks(buffer, self._problems)
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
            buffer=buffer,
            buffers=buffers,
        )

    def _read_file(self, storage: Storage, progress: Callable[[int], object]) -> None:
        tracks: dict[Channel, tuple[Track, Callable[[NDArray[np.int64], Slices], None] | None]] = {}
        for batch in self._batches(storage, progress):
            channel = batch.channel
            if channel not in tracks:
                tracks[channel] = self._index.add_track(storage, channel), self._collected.ingest(channel)
                if has_unknown_encoding(channel):
                    text = (
                        f"its transforms, {channel.type}, are in the encoding {channel.encoding!r}, which is not known"
                    )
                    self._problems.add(f"{channel.topic}: {text}")
            track, ingest = tracks[channel]
            if not batch.is_intact and _has_transforms(channel):
                # A flipped bit in a transform would be a wrong pose without a word.
                text = (
                    f"{channel.topic}: messages in damaged chunks were left out, because their transforms may be wrong"
                )
                self._problems.add(text, len(batch.received))
                continue
            track.add(batch)
            if batch.messages is not None and ingest is not None:
                ingest(batch.received, batch.messages)
        for channel in storage.channels():
            if channel not in tracks:
                self._index.add_track(storage, channel)

    def _batches(self, storage: Storage, progress: Callable[[int], object]) -> Iterator[Batch]:
        """Yield the batches of a file; an error in the format of another distribution ends this file."""
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
                f"{self._path} contains {len(groups)} recordings that were made at different times: {names}",
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

    def _topic(self, name: str, span: tuple[int, int] | None) -> RecordedTopic:
        tracks = self._index.tracks(name)
        main = largest_track(tracks)
        types = {track.channel.type for track in tracks}
        if len(types) > 1:
            self._problems.add(f"{name} has messages of several types: {', '.join(sorted(types))}")
        received = self._index.received(name)
        rate = _rate(received, span)
        return RecordedTopic(name, main.channel.type, len(received), rate, main.channel.encoding)


def _rate(received: NDArray[np.int64], span: tuple[int, int] | None) -> float:
    """Return the rate of messages in Hz; 0 for a single burst, such as the static transforms at the start."""
    elapsed = int(received[-1]) - int(received[0]) if len(received) else 0
    if span is None or elapsed <= 0:
        return 0.0
    is_burst = elapsed < time.SECOND and (len(received) == 2 or elapsed < _BURST_SHARE * (span[1] - span[0]))
    return 0.0 if is_burst else (len(received) - 1) * time.SECOND / elapsed


def _has_transforms(channel: Channel) -> bool:
    return ingest_for(channel) is not None
