# SPDX-License-Identifier: Apache-2.0
"""A recording as a source, with all frames and messages at any time."""

from __future__ import annotations

import shlex
import threading
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.errors import DecodeError, ViewerError
from coframe.viewer.sources.requested_quality import AUTOMATIC, RequestedQuality
from coframe.viewer.sources.source import WithoutClock
from coframe.viewer.sources.topic_messages import StampedMessage
from coframe.viewer.sources.topic_names import VIEWER_NODE, resolve_topic

if TYPE_CHECKING:
    from collections.abc import Generator

    from numpy.typing import NDArray

    from coframe.bags import Recording
    from coframe.connection.connection import Connection
    from coframe.doctor import Report
    from coframe.viewer.sources.source import Mode

__all__ = ["RecordedSource"]

# The doctor needs a few seconds and 100 bytes per sample for this many samples; longer recordings are not examined.
_MAX_EXAMINED_SAMPLES = 2_000_000


class RecordedSource(WithoutClock):
    """A recording as a source.

    Args:
        recording: The recording to show.
        own: Whether closing the source also closes the recording.
    """

    mode: Mode = "recording"
    connection: Connection | None = None
    node = VIEWER_NODE

    def __init__(self, recording: Recording, *, own: bool = False) -> None:
        self.buffer = recording.buffer
        self.title = recording.path.name
        first, last = recording.span
        self.span: tuple[int, int] | None = (first, last) if last > first else None
        self._recording = recording
        self.recording: Recording | None = recording
        self._owns_recording = own

    def topics(self) -> list[tuple[str, str]]:
        """Return the recorded topics, with their types."""
        return [(topic.name, topic.type) for topic in self._recording.topics.values()]

    def resolve(self, topic: str) -> str:
        """Return the full name of a topic; recorded names are used as they are, whether ROS 2 allows them or not."""
        return topic if topic in self._recording.topics else resolve_topic(topic, self.node)

    def open(self, topic: str, _quality: RequestedQuality = AUTOMATIC) -> RecordedMessages | None:
        """Return the messages on a topic, or None if it was not recorded."""
        if topic not in self._recording.topics:
            return None
        return RecordedMessages(self._recording, topic)

    def refresh(self) -> None:
        """Do nothing: a recording does not change."""

    def examine(self) -> Generator[dict[str, Report], None, None]:
        """Return a generator of the one report that `coframe doctor` prints for the recording.

        Raises:
            RecordingError: The recording cannot be read.
            ViewerError: The recording is too long to be examined in the background.
        """
        samples = sum(info.samples for buffer in self._recording.buffers.values() for info in buffer.frames())
        if samples > _MAX_EXAMINED_SAMPLES:
            raise ViewerError(
                f"the recording has {samples} samples, but the viewer examines at most {_MAX_EXAMINED_SAMPLES}",
                hint=f"Run: coframe doctor {shlex.quote(str(self._recording.path))}",
            )
        # Imported here because the first frame update does not need the doctor.
        from coframe.doctor import diagnose  # noqa: PLC0415
        from coframe.doctor.recorded import observe_chosen  # noqa: PLC0415

        observed = observe_chosen(self._recording.path, self._recording.choice)
        yield {name: diagnose(observation) for name, observation in observed.items()}

    def close(self) -> None:
        """Close the recording if the source owns it."""
        if self._owns_recording:
            self._recording.close()


class RecordedMessages:
    """The messages on a recorded topic, ordered by their stamps.

    Args:
        recording: The recording that contains the topic.
        topic: The name of the topic.
    """

    def __init__(self, recording: Recording, topic: str) -> None:
        self.type = recording.topics[topic].type
        self._recording = recording
        self._topic = topic
        stamps = recording.stamps(topic)
        self._rows = np.argsort(stamps, kind="stable")
        self._times = stamps[self._rows]
        self._reading = threading.Lock()

    def frame(self, name: str) -> str:
        """Return the buffer's name for a frame in a message."""
        return self._recording.frame(name)

    def pending(self) -> bool:
        """Return False: the times of all messages are known."""
        return False

    def at(self, time: int) -> StampedMessage | None:
        """Return the last message at or before a time in nanoseconds; 0 selects the newest message."""
        end = self._index_after(time)
        return self._message(end - 1) if end else None

    def before(self, time: int, count: int) -> list[StampedMessage]:
        """Return up to `count` messages at or before a time, oldest first; 0 selects the newest messages."""
        end = self._index_after(time)
        return [self._message(index) for index in range(max(0, end - count), end)]

    def after(self, key: int, last: int) -> list[StampedMessage]:
        """Return the messages with keys above `key` and up to `last`, oldest first."""
        return [self._message(index) for index in range(max(key, 0), min(last, len(self._times)))]

    def times(self) -> NDArray[np.int64]:
        """Return the positions of all messages on the timeline, in order."""
        return self._times

    @property
    def shortfall(self) -> str:
        """Return "": a recording has no publishers."""
        return ""

    def close(self) -> None:
        """Do nothing. The recording stays open."""

    def _index_after(self, time: int) -> int:
        return len(self._times) if time == 0 else int(np.searchsorted(self._times, time, side="right"))

    def _message(self, index: int) -> StampedMessage:
        return StampedMessage(index + 1, int(self._times[index]), lambda: self._read(index))

    def _read(self, index: int) -> Any:
        with self._reading:
            found = self._recording.message_in_row(self._topic, int(self._rows[index]))
        if found is None:
            raise DecodeError(f"a message of {self._topic} cannot be read: has the recording changed?")
        return found.message
