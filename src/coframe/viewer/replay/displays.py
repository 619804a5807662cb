"""The displays of a replay: what a tab would have been sent of each, picture after picture."""

from __future__ import annotations

import base64
import math
from concurrent.futures import Executor, Future
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from coframe.viewer.displays import DISPLAYS
from coframe.viewer.displays.display import Display
from coframe.viewer.protocol.binary import near

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from numpy.typing import NDArray
    from typing_extensions import ParamSpec

    from coframe import Buffer
    from coframe.viewer.displays import Options
    from coframe.viewer.sources.messages import Messages

    P = ParamSpec("P")

__all__ = ["MOST_BYTES", "MOST_POINTS", "Pictures", "ReplayDisplay", "display_blocks", "packed"]

T = TypeVar("T")

MOST_BYTES = 48 << 20  # of all displays; a third more as text
MOST_POINTS = 10_000  # of a cloud
_HEAVY = {"sensor_msgs/msg/CompressedImage", "sensor_msgs/msg/Image", "sensor_msgs/msg/PointCloud2"}


class ReplayDisplay(NamedTuple):
    """A display that goes with a replay."""

    topic: str
    options: Options


class Pictures(NamedTuple):
    """What a replay shows.

    Attributes:
        buffer: Its transforms.
        fixed: The frame that everything is told in.
        times: When each picture is, in nanoseconds.
        local: What positions are relative to, as those of the frames.
    """

    buffer: Buffer
    fixed: str
    times: NDArray[np.int64]
    local: NDArray[np.float64]


class _TooLargeError(Exception):
    """No room for so many pictures.

    Attributes:
        share: How much of them there was room for, above 0 and below 1.
    """

    def __init__(self, share: float) -> None:
        super().__init__()
        self.share = share


def packed(array: NDArray[Any]) -> str:
    """Numbers as text."""
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode()


def display_blocks(
    displays: Sequence[ReplayDisplay], messages: Mapping[str, Messages], pictures: Pictures
) -> list[dict[str, Any]]:
    """What the page needs of each display, in order; topics that are not there, or cannot be displayed, are left out.

    What is too much is thinned: clouds to `MOST_POINTS`, and a display whose drawings take more than half of what is
    left of `MOST_BYTES` to every so-manieth picture. The last one, a cloud or camera if there is one, takes all that
    is left.
    """
    known = [one for one in displays if one.topic in messages and messages[one.topic].type in DISPLAYS]
    order = sorted(range(len(known)), key=lambda index: messages[known[index].topic].type in _HEAVY)
    blocks: dict[int, dict[str, Any]] = {}
    left = MOST_BYTES
    for index in order:
        room = left if index == order[-1] else left // 2
        recorded = _Recorded(index, known[index], messages[known[index].topic])
        recorded.record(pictures, room)
        left -= recorded.size
        blocks[index] = recorded.block()
    return [blocks[index] for index in range(len(known))]


class _AtOnce(Executor):
    """Does what it is asked while one waits."""

    def submit(self, fn: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        """As of Executor."""
        done: Future[T] = Future()
        done.set_result(fn(*args, **kwargs))
        return done


class _Recorded:
    """What was recorded of a display.

    A listing is what is to be seen from a picture on: for each drawing its number, where its frame is, and when that
    was.
    """

    def __init__(self, number: int, display: ReplayDisplay, messages: Messages) -> None:
        self._number = number
        self._topic = display.topic
        self._messages = messages
        self._options = replace(display.options, most_points=min(display.options.most_points, MOST_POINTS))
        self._begin()

    def _begin(self) -> None:
        self.size = 0
        self._drawings: dict[int, str] = {}
        self._statuses: list[tuple[int, str, str]] = []
        self._pictures: list[int] = []
        self._counts: list[int] = []
        self._listings: list[_Listing] = []
        self._every = 1

    def record(self, pictures: Pictures, room: int) -> None:
        """Records as many pictures as there is room for, in bytes: all, or every so-manieth."""
        every = 1
        while True:
            self._begin()
            self._every = every
            try:
                self._try(pictures, room)
            except _TooLargeError as error:
                if every >= len(pictures.times):
                    self._leave_out(room)
                    return
                every = min(max(every + 1, math.ceil(every / error.share)), len(pictures.times))
            else:
                return

    def block(self) -> dict[str, Any]:
        """As the page takes it."""
        listings = self._listings
        return {
            "topic": self._topic,
            "type": self._messages.type,
            "display": DISPLAYS[self._messages.type],
            "color_by": self._options.color_by,
            "every": self._every,
            "statuses": self._statuses,
            "drawings": self._drawings,
            "pictures": packed(np.array(self._pictures, "<u4")),
            "counts": packed(np.array(self._counts, "<u4")),
            "sequences": packed(np.concatenate([one.sequences for one in listings] or [np.zeros(0, "<u4")])),
            "poses": packed(np.concatenate([one.poses for one in listings] or [np.zeros(0, "<f4")])),
            "stamps": packed(np.concatenate([one.stamps for one in listings] or [np.zeros(0, "<f8")])),
        }

    def _try(self, pictures: Pictures, room: int) -> None:
        display = Display(self._number, self._messages, self._options, _no_mesh, _AtOnce())
        count = len(pictures.times)
        for picture in range(0, count, self._every):
            at = max(int(pictures.times[picture]), 1)  # 0 would be the newest
            for _ in ("drawn", "placed"):
                display.advance(pictures.buffer, pictures.fixed, at, at)
            for sequence, drawing in display.take_unsent():
                self._drawings[sequence] = base64.b64encode(drawing).decode()
                self.size += len(drawing)
            self._note(picture, display, pictures.local)
            if self.size > room:
                raise _TooLargeError((picture + 1) / (count + 1))

    def _note(self, picture: int, display: Display, local: NDArray[np.float64]) -> None:
        """What is to be seen now, and what became of the display, where that is new."""
        if not self._statuses or self._statuses[-1][1:] != display.status:
            self._statuses.append((picture, *display.status))
        listing = _Listing.of(display, local, self._options.origin)
        if not self._listings or not listing.is_like(self._listings[-1]):
            self._pictures.append(picture)
            self._counts.append(len(listing.sequences))
            self._listings.append(listing)
            self.size += listing.sequences.nbytes + listing.poses.nbytes + listing.stamps.nbytes

    def _leave_out(self, room: int) -> None:
        self._begin()
        text = f"left out of this replay: a message of it takes more than the {room / 1e6:.0f} MB that were left"
        self._statuses = [(0, "error", text)]


class _Listing(NamedTuple):
    """N drawings: sequences (N,), poses (7 N,) and stamps (N,) in nanoseconds, NaN for the time of the picture."""

    sequences: NDArray[np.uint32]
    poses: NDArray[np.float32]
    stamps: NDArray[np.float64]

    @classmethod
    def of(cls, display: Display, local: NDArray[np.float64], origin: int) -> _Listing:
        """What a display shows now."""
        entries = display.poses()
        nowhere = np.full(7, np.nan)
        poses = [nowhere if entry.pose is None else near(entry.pose, local) for entry in entries]
        stamps = [math.nan if stamp is None else float(stamp - origin) for stamp in display.stamps()]
        return cls(
            np.array([entry.sequence for entry in entries], "<u4"),
            np.array(poses, "<f4").reshape(-1),
            np.array(stamps, "<f8"),
        )

    def is_like(self, other: _Listing) -> bool:
        """Whether the same is to be seen; NaN is like NaN."""
        return self._bytes() == other._bytes()

    def _bytes(self) -> tuple[bytes, ...]:
        return self.sequences.tobytes(), self.poses.tobytes(), self.stamps.tobytes()


def _no_mesh(_reference: str) -> tuple[str | None, str | None]:
    return None, "Meshes of markers do not go with a replay."
