# SPDX-License-Identifier: Apache-2.0
"""Find a frame that does not move with a sensor, in which its points can be deskewed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.errors import TransformException

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe import _core

__all__ = ["moves", "still_frame"]

_MIN_MOTION = 1e-7  # meters, and parts of a quaternion: more than rounding, less than any motion
_MAX_ABOVE = 100  # frames above the target
_TRIED = 33  # times over all samples


def still_frame(buffer: _core.Buffer, target: str, source: str, stamps: NDArray[np.int64]) -> str | None:
    """Return the target if the source moves relative to it, or else the nearest frame above for which this is so.

    Args:
        buffer: The buffer.
        target: A frame.
        source: The frame of a sensor.
        stamps: (N,) nanoseconds; the times at which the poses are compared.

    Returns:
        None if the source moves relative to none of these frames; the target if it has no transform to the source.
    """
    frame = target
    for above in range(_MAX_ABOVE):
        if above == 0 and frame != source and not buffer.can_transform(frame, source):
            return target
        if moves(buffer, frame, source, stamps):
            return frame
        state = buffer._edge_at(frame, 0)
        if state is None or not state[1]:
            return None
        frame = state[1]
    return None


def moves(buffer: _core.Buffer, target: str, source: str, stamps: NDArray[np.int64]) -> bool:
    """Return whether one frame moves relative to another, at these times or at any other; False if unconnected."""
    if target == source or not buffer.can_transform(target, source):
        return False
    if _differ(_poses(buffer, target, source, stamps)):
        return True
    if buffer.latest_common_time(target, source) == 0:
        return False
    ends = np.array([np.iinfo(np.int64).min + 1, np.iinfo(np.int64).max])
    buffer._lookup_rows(target, source, ends, np.empty((2, 7)), None, None, "clip", 1)  # noqa: SLF001
    first, last = int(ends[0]), int(ends[1])
    stamps = np.array([first + (last - first) * i // (_TRIED - 1) for i in range(_TRIED)], dtype=np.int64)
    return _differ(_poses(buffer, target, source, stamps))


def _poses(buffer: _core.Buffer, target: str, source: str, stamps: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the poses at the times for which there is one: (N, 7)."""
    rows: NDArray[np.float64] = np.full((len(stamps), 7), np.nan)
    try:
        buffer._lookup_rows(target, source, stamps.copy(), rows, None, None, "nan", 1)  # noqa: SLF001
    except TransformException:
        return rows[:0]
    found: NDArray[np.float64] = rows[~np.isnan(rows[:, 0])]
    return found


def _differ(poses: NDArray[np.float64]) -> bool:
    if len(poses) < 2:
        return False
    # A quaternion and its negative are the same rotation.
    rotations = poses[:, 3:] * np.where(poses[:, 3:] @ poses[0, 3:] < 0, -1.0, 1.0)[:, None]
    step = np.hypot(np.abs(poses[:, :3] - poses[0, :3]).max(), np.abs(rotations - rotations[0]).max())
    return bool(step > _MIN_MOTION)
