# SPDX-License-Identifier: Apache-2.0
"""TimeWindow: the part of a recording that is read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from coframe import time
from coframe.bags.storage import Batch
from coframe.bags.time_points import parse_time_point
from coframe.messages.slices import Slices

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.bags.storage import ListedChunk
    from coframe.time import StampLike

__all__ = ["ALL_TIME", "Limits", "TimeWindow"]

TRANSFORM_MARGIN: Final = 10 * time.SECOND
"""Time before and after the window in which dynamic transforms are read, for poses at its ends."""
_EARLIEST, _LATEST = -(1 << 63), (1 << 63) - 1


@dataclass(frozen=True)
class TimeWindow:
    """The messages of a recording to read, by their receive times.

    Attributes:
        start: The first time; or a string such as ``10min`` from the start or ``-2min`` from the end. None: the start.
        stop: The end, which is not included, in the same form. None: everything after ``start``.
    """

    start: StampLike | str | None = None
    stop: StampLike | str | None = None

    @property
    def is_all(self) -> bool:
        """Whether all messages are read."""
        return self.start is None and self.stop is None

    def limits(self, span: Callable[[], tuple[int, int]]) -> Limits:
        """Return the window in nanoseconds.

        Args:
            span: Returns the first and last receive time of the recording; called if the window refers to them.

        Raises:
            ValueError: A text is not a point in time, or the window ends before it begins.
        """

        def nanoseconds(point: StampLike | str | None, default: int) -> int:
            if point is None:
                return default
            return parse_time_point(point, span()) if isinstance(point, str) else time.stamp_ns(point)

        start, stop = nanoseconds(self.start, _EARLIEST), nanoseconds(self.stop, _LATEST)
        if stop <= start:
            raise ValueError(f"stop must be after start, not {stop} ns after {start} ns")
        return Limits(start, stop)


ALL_TIME: Final = TimeWindow()


@dataclass(frozen=True)
class Limits:
    """A window in nanoseconds.

    Attributes:
        start: The first receive time.
        stop: The end, which is not included.
    """

    start: int = _EARLIEST
    stop: int = _LATEST

    def messages(self, batch: Batch) -> Batch:
        """Return the messages of a batch inside of the window."""
        return _part(batch, self.start, self.stop)

    def transforms(self, batch: Batch, *, static: bool) -> Batch:
        """Return the messages of a batch whose transforms are needed: static ones since the start of the recording."""
        first, stop = self._transform_limits(static=static)
        return _part(batch, first, stop)

    def needs(self, chunk: ListedChunk, *, transforms: bool, static: bool) -> bool:
        """Return whether a chunk has messages of the window, or transforms that are needed.

        Args:
            chunk: The chunk.
            transforms: Whether it may have dynamic transforms.
            static: Whether it may have static transforms.
        """
        spans = [(self.start, self.stop)]
        spans += [self._transform_limits(static=kind) for kind, there in ((False, transforms), (True, static)) if there]
        return any(chunk.last >= first and chunk.first < stop for first, stop in spans)

    def _transform_limits(self, *, static: bool) -> tuple[int, int]:
        if static:
            return _EARLIEST, self.stop
        return max(self.start - TRANSFORM_MARGIN, _EARLIEST), min(self.stop + TRANSFORM_MARGIN, _LATEST)


def _part(batch: Batch, start: int, stop: int) -> Batch:
    rows = (batch.received >= start) & (batch.received < stop)
    if rows.all():
        return batch
    messages = batch.messages
    if messages is not None:
        messages = Slices(messages.data, messages.starts[rows], messages.ends[rows])
    return Batch(batch.channel, batch.received[rows], batch.positions[rows], messages, batch.is_intact)
