# SPDX-License-Identifier: Apache-2.0
"""The displays of a replay: the data that a client would have received for each, at every time of the replay."""

from __future__ import annotations

import base64
import math
from concurrent.futures import Executor, Future
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias, TypeVar

import numpy as np

from coframe.viewer.displays.display import Display
from coframe.viewer.displays.resources import Resources
from coframe.viewer.displays.rows import DISPLAYS, row_of
from coframe.viewer.protocol.encoding import relative_to
from coframe.viewer.protocol.replay_block import ReplayDisplayBlock

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from numpy.typing import NDArray
    from typing_extensions import ParamSpec

    from coframe.buffer.buffer import Buffer
    from coframe.viewer.displays import Options
    from coframe.viewer.protocol.common import DisplayState
    from coframe.viewer.sources.topic_messages import TopicMessages

    P = ParamSpec("P")

__all__ = [
    "MAX_BYTES",
    "MAX_CLOUD_POINTS",
    "ImmediateExecutor",
    "Progress",
    "ReplayDisplay",
    "ReplayTimes",
    "no_progress",
    "pack",
    "record_displays",
]

T = TypeVar("T")
Progress: TypeAlias = "Callable[[str, int, int], object]"
"""Called with a task, the completed amount and the total."""

MAX_BYTES = 48 << 20  # For all displays together; base64 adds a third.
MAX_CLOUD_POINTS = 10_000


class ReplayDisplay(NamedTuple):
    """A display that a replay contains."""

    topic: str
    options: Options

    @property
    def topics(self) -> tuple[str, ...]:
        """The topic, and the other topics that the display needs."""
        row = DISPLAYS.get(self.options.display)
        return (self.topic,) if row is None else (self.topic, *row.other_topics(self.topic, self.options))


class ReplayTimes(NamedTuple):
    """The times of a replay.

    Attributes:
        buffer: The transforms.
        fixed: The fixed frame.
        times: The times in nanoseconds, (N,).
        origin: The local origin of all positions, in meters in the fixed frame, (3,).
    """

    buffer: Buffer
    fixed: str
    times: NDArray[np.int64]
    origin: NDArray[np.float64]


class _TooLargeError(Exception):
    """The drawings do not fit.

    Attributes:
        share: The fraction that fits, above 0 and below 1.
    """

    def __init__(self, share: float) -> None:
        super().__init__()
        self.share = share


def pack(array: NDArray[Any]) -> str:
    """Return an array as base64 text."""
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode()


def no_progress(_task: str, _done: int, _total: int) -> None:
    """Report nothing."""


def record_displays(
    displays: Sequence[ReplayDisplay],
    messages: Mapping[str, TopicMessages],
    replay_times: ReplayTimes,
    progress: Progress = no_progress,
) -> list[ReplayDisplayBlock]:
    """Return the recorded data of each display, in order; topics that cannot be displayed are skipped.

    Large displays are thinned: clouds to `MAX_CLOUD_POINTS`, and a display whose drawings take more than half of the
    remaining `MAX_BYTES` to every n-th time. The last display, which is a cloud or an image if there is one, may use
    all remaining bytes.
    """
    found = [(one, row_of(messages[one.topic].type, one.options)) for one in displays if one.topic in messages]
    known = [(one, row) for one, row in found if row is not None]
    order = sorted(range(len(known)), key=lambda index: known[index][1].large_in_replay)
    blocks: dict[int, ReplayDisplayBlock] = {}
    left = MAX_BYTES
    for index in order:
        room = left if index == order[-1] else left // 2
        display, row = known[index]
        wanted = row.other_topics(display.topic, display.options)
        others = {topic: messages[topic] for topic in wanted if topic in messages}
        resources = Resources(display.topic, _no_mesh, others)
        recorder = _DisplayRecorder(index, display, row.name, messages[display.topic], resources, progress)
        recorder.record(replay_times, room)
        left -= recorder.size
        blocks[index] = recorder.block()
    return [blocks[index] for index in range(len(known))]


class ImmediateExecutor(Executor):
    """An executor that runs each call in the caller's thread."""

    def submit(self, fn: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        """Run a call and return its result as a completed future."""
        done: Future[T] = Future()
        done.set_result(fn(*args, **kwargs))
        return done


class _DisplayRecorder:
    """Records a display.

    A listing contains the drawings that are visible from a time on: their sequence numbers, the poses of their frames
    and the stamps of these poses.
    """

    def __init__(
        self,
        number: int,
        display: ReplayDisplay,
        name: str,
        messages: TopicMessages,
        resources: Resources,
        progress: Progress,
    ) -> None:
        self._number = number
        self._topic = display.topic
        self._name = name
        self._messages = messages
        self._resources = resources
        self._progress = progress
        self._options = replace(
            display.options, max_points=min(display.options.max_points, MAX_CLOUD_POINTS), is_replay=True
        )
        self._clear()

    def _clear(self) -> None:
        self.size = 0
        self._drawings: dict[str, str] = {}
        self._statuses: list[tuple[int, DisplayState, str]] = []
        self._changes: list[int] = []
        self._counts: list[int] = []
        self._listings: list[_Listing] = []
        self._every = 1

    def record(self, replay_times: ReplayTimes, room: int) -> None:
        """Record all times, or every n-th time if all of them take more than `room` bytes."""
        every = 1
        while True:
            self._clear()
            self._every = every
            try:
                self._try(replay_times, room)
            except _TooLargeError as error:
                if every >= len(replay_times.times):
                    self._omit(room)
                    return
                every = min(max(every + 1, math.ceil(every / error.share)), len(replay_times.times))
            else:
                return

    def block(self) -> ReplayDisplayBlock:
        """Return the recorded display."""
        listings = self._listings
        return ReplayDisplayBlock(
            topic=self._topic,
            type=self._messages.type,
            display=self._name,
            color_by=self._options.color_by,
            every=self._every,
            statuses=self._statuses,
            drawings=self._drawings,
            changes=pack(np.array(self._changes, "<u4")),
            counts=pack(np.array(self._counts, "<u4")),
            sequences=pack(np.concatenate([one.sequences for one in listings] or [np.zeros(0, "<u4")])),
            poses=pack(np.concatenate([one.poses for one in listings] or [np.zeros(0, "<f4")])),
            stamps=pack(np.concatenate([one.stamps for one in listings] or [np.zeros(0, "<f8")])),
        )

    def _try(self, replay_times: ReplayTimes, room: int) -> None:
        display = Display(self._number, self._messages, self._options, self._resources, ImmediateExecutor())
        count = len(replay_times.times)
        for index in range(0, count, self._every):
            at = max(int(replay_times.times[index]), 1)  # 0 would select the newest message.
            for _ in ("draw", "place"):
                display.update(replay_times.buffer, replay_times.fixed, at, at)
            while display.is_unfinished:
                display.update(replay_times.buffer, replay_times.fixed, at, at)
            for sequence, drawing in display.take_unsent():
                self._drawings[str(sequence)] = base64.b64encode(drawing).decode()
                self.size += len(drawing)
            self._add(index, display, replay_times.origin)
            self._progress(self._topic, index + 1, count)
            if self.size > room:
                raise _TooLargeError((index + 1) / (count + 1))

    def _add(self, index: int, display: Display, origin: NDArray[np.float64]) -> None:
        """Add the listing and the status at a time, if they have changed."""
        shown = (display.status.state, display.status.text)
        if not self._statuses or self._statuses[-1][1:] != shown:
            self._statuses.append((index, display.status.state, display.status.text))
        listing = _Listing.of(display, origin, self._options.origin)
        if not self._listings or not listing.equals(self._listings[-1]):
            self._changes.append(index)
            self._counts.append(len(listing.sequences))
            self._listings.append(listing)
            self.size += listing.sequences.nbytes + listing.poses.nbytes + listing.stamps.nbytes

    def _omit(self, room: int) -> None:
        self._clear()
        text = f"omitted from this replay, because one message takes more than the remaining {room / 1e6:.0f} MB"
        self._statuses = [(0, "error", text)]


class _Listing(NamedTuple):
    """N drawings: sequences (N,), poses (7 N,), and stamps (N,) in nanoseconds, NaN for the time of the listing."""

    sequences: NDArray[np.uint32]
    poses: NDArray[np.float32]
    stamps: NDArray[np.float64]

    @classmethod
    def of(cls, display: Display, local: NDArray[np.float64], origin: int) -> _Listing:
        """Return the current drawing of a display."""
        entries = display.poses()
        no_pose = np.full(7, np.nan)
        poses = [no_pose if entry.pose is None else relative_to(local, entry.pose) for entry in entries]
        stamps = [math.nan if stamp is None else float(stamp - origin) for stamp in display.stamps()]
        return cls(
            np.array([entry.sequence for entry in entries], "<u4"),
            np.array(poses, "<f4").reshape(-1),
            np.array(stamps, "<f8"),
        )

    def equals(self, other: _Listing) -> bool:
        """Return whether both listings are the same; NaN equals NaN."""
        return self._bytes() == other._bytes()

    def _bytes(self) -> tuple[bytes, ...]:
        return self.sequences.tobytes(), self.poses.tobytes(), self.stamps.tobytes()


def _no_mesh(_reference: str) -> tuple[str | None, str | None]:
    return None, "a replay does not contain meshes of markers"
