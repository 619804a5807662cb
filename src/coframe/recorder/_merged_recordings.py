# SPDX-License-Identifier: Apache-2.0
"""Several recordings that are replayed together, as one."""

from __future__ import annotations

import heapq
from typing import TYPE_CHECKING, Any

from coframe.bags import RecordingError, open_bag

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from coframe._sources.sources import Location
    from coframe.bags import Recording
    from coframe.bags.storage import Channel

__all__ = ["MergedRecordings", "open_merged"]


class MergedRecordings:
    """Recordings with the part of the interface of `Recording` that a replay uses.

    Args:
        recordings: At least one recording; their messages are merged by receive time.

    Attributes:
        path: Their paths, separated by commas.
        topics: The topics of all recordings by name.
        types: The types of the messages of the first recording, which also finds those of coframe.
    """

    def __init__(self, recordings: Sequence[Recording]) -> None:
        self._recordings = recordings
        self._with_messages = [each for each in recordings if each.received_end] or list(recordings)
        self.path = ", ".join(str(each.path) for each in recordings)
        self.topics: dict[str, Any] = {name: topic for each in recordings for name, topic in each.topics.items()}
        self.types = recordings[0].types

    @property
    def received_start(self) -> int:
        """Receive time of the first message in nanoseconds."""
        return min(each.received_start for each in self._with_messages)

    @property
    def received_end(self) -> int:
        """Receive time of the last message in nanoseconds."""
        return max(each.received_end for each in self._with_messages)

    @property
    def duration(self) -> int:
        """Time from the first to the last message in nanoseconds."""
        return self.received_end - self.received_start

    def channels(self) -> list[Channel]:
        """Return the channels of all files."""
        return [channel for each in self._recordings for channel in each.channels()]

    def in_order(
        self, topics: Iterable[str] | None = None, start: int | None = None, stop: int | None = None
    ) -> Iterator[tuple[Channel, int, bytes]]:
        """Yield the messages of topics in receive order. See `Recording.in_order`."""
        chosen = None if topics is None else set(topics)
        streams = (
            each.in_order(None if chosen is None else chosen & set(each.topics), start, stop)
            for each in self._recordings
        )
        yield from heapq.merge(*streams, key=lambda message: message[1])

    def close(self) -> None:
        """Close all files."""
        for each in self._recordings:
            each.close()


def open_merged(paths: Sequence[Location]) -> Recording | MergedRecordings:
    """Open one or more recordings.

    Raises:
        RecordingError: One of them cannot be read, or there is none.
    """
    if not paths:
        raise RecordingError("no recording was given", hint="Give a file or a folder of rosbag2.")
    recordings: list[Recording] = []
    try:
        recordings += [open_bag(path) for path in paths]
    except BaseException:
        for each in recordings:
            each.close()
        raise
    return recordings[0] if len(recordings) == 1 else MergedRecordings(recordings)
