"""A recording: all of its frames and messages, at any time."""

from __future__ import annotations

import shlex
import threading
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.errors import DecodeError, ViewerError
from coframe.viewer.displays import DISPLAYS
from coframe.viewer.sources.messages import Sighting
from coframe.viewer.sources.source import Mode, Topic

if TYPE_CHECKING:
    from collections.abc import Generator

    from numpy.typing import NDArray

    from coframe.bags import Recording
    from coframe.connection import Connection
    from coframe.doctor import Report

__all__ = ["RecordedSource"]

# Samples: the doctor takes a few seconds of them, and 100 bytes each; more are left to who asks for it.
_MOST_EXAMINED = 2_000_000


class RecordedSource:
    """A recording.

    Args:
        recording: What is shown.
        own: Whether it is closed with the source.
    """

    mode: Mode = "recording"
    connection: Connection | None = None

    def __init__(self, recording: Recording, *, own: bool = False) -> None:
        self.buffer = recording.buffer
        self.title = recording.path.name
        first, last = recording.span
        self.span: tuple[int, int] | None = (first, last) if last > first else None
        self._recording = recording
        self._own = own

    def topics(self) -> list[Topic]:
        """What a display can show."""
        known = self._recording.topics.values()
        return [Topic(topic.name, topic.type, DISPLAYS[topic.type]) for topic in known if topic.type in DISPLAYS]

    def open(self, topic: str) -> RecordedMessages | None:
        """The messages of a topic."""
        if topic not in self._recording.topics:
            return None
        return RecordedMessages(self._recording, topic)

    def refresh(self) -> None:
        """Nothing changes."""

    def examine(self) -> Generator[dict[str, Report], None, None]:
        """What `coframe doctor` says of it, once.

        Raises:
            RecordingError: It cannot be read any more.
            ViewerError: It is too long to be examined beside.
        """
        samples = sum(info.samples for buffer in self._recording.buffers.values() for info in buffer.frames())
        if samples > _MOST_EXAMINED:
            hint = f"Run: coframe doctor {shlex.quote(str(self._recording.path))}"
            raise ViewerError(f"the recording has {samples} samples, too many to examine them beside", hint=hint)
        from coframe.doctor import diagnose, observe_recording  # noqa: PLC0415 - the first picture needs no doctor

        observed = observe_recording(self._recording.path, **self._recording.options)
        yield {name: diagnose(observation) for name, observation in observed.items()}

    def close(self) -> None:
        """Lets go of the files, where that is the source's to do."""
        if self._own:
            self._recording.close()


class RecordedMessages:
    """The messages of a topic, by the times that they tell of.

    Args:
        recording: Where they are.
        topic: The topic.
    """

    def __init__(self, recording: Recording, topic: str) -> None:
        self.type = recording.topics[topic].type
        self._recording = recording
        self._topic = topic
        self._times = np.sort(recording.stamps(topic))
        self._reading = threading.Lock()

    def frame(self, name: str) -> str:
        """What a frame that a message names is called among the transforms."""
        return self._recording.frame(name)

    def pending(self) -> bool:
        """Never: where all messages lie is known."""
        return False

    def at(self, time: int) -> Sighting | None:
        """The last message at or before a time in nanoseconds; 0 is the newest of all."""
        end = self._index_behind(time)
        return self._sighting(end - 1) if end else None

    def before(self, time: int, count: int) -> list[Sighting]:
        """The last messages at or before a time, 0 is the newest, the oldest first, at most so many."""
        end = self._index_behind(time)
        return [self._sighting(index) for index in range(max(0, end - count), end)]

    def times(self) -> NDArray[np.int64]:
        """Where all messages lie on the timeline, in order."""
        return self._times

    def close(self) -> None:
        """The recording stays open."""

    def _index_behind(self, time: int) -> int:
        return len(self._times) if time == 0 else int(np.searchsorted(self._times, time, side="right"))

    def _sighting(self, index: int) -> Sighting:
        return Sighting(index + 1, int(self._times[index]), lambda: self._read(index))

    def _read(self, index: int) -> Any:
        time = int(self._times[index])
        earlier = index - int(np.searchsorted(self._times, time, side="left"))
        with self._reading:
            for skipped, found in enumerate(self._recording.messages(self._topic, start=time, stop=time + 1)):
                if skipped == earlier:
                    return found.message
        raise DecodeError(f"a message on {self._topic} can no longer be read")
