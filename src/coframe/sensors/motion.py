# SPDX-License-Identifier: Apache-2.0
"""Find a frame that does not move with a sensor, in which its points can be deskewed."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

import numpy as np

from coframe.errors import TransformException

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from coframe import _core

__all__ = ["still_frame"]

_MIN_MOTION = 1e-7  # meters, and parts of a quaternion: more than rounding, less than any motion
_MAX_ANCESTORS = 100  # frames above the target
_FIXED_FRAMES = ("odom", "map", "world", "earth", "utm", "camera_init")
_SAMPLE_COUNT = 33  # times over all samples


def still_frame(buffer: _core.Buffer, target: str, source: str, stamps: NDArray[np.int64]) -> str | None:
    """Return the frame in which points can be deskewed: one that does not move with the robot that carries the sensor.

    This is the target, unless it moves together with the sensor relative to a frame above both: then it is that frame,
    even if a joint between the two moves. Frames that are fixed by convention, such as ``odom`` and ``map``,
    are not taken for parts of the robot, although a localization may move them a little.

    Args:
        buffer: The transforms between the frames.
        target: A frame.
        source: The frame of a sensor.
        stamps: (N,) nanoseconds; the times at which the poses are compared.

    Returns:
        None if the source moves relative to none of these frames; the target if it has no transform to the source.
    """
    if target != source and not buffer.can_transform(target, source):
        return target
    if not _is_fixed(target) and (carrier := _find_motion_frame(buffer, _joint_parent(buffer, target, source), stamps)):
        return carrier
    return (
        target
        if _motion(buffer, target, source, stamps) > _MIN_MOTION
        else _find_reference_above(buffer, target, source, stamps)
    )


def _find_reference_above(buffer: _core.Buffer, target: str, source: str, stamps: NDArray[np.int64]) -> str | None:
    """Return the nearest frame above the target relative to which the source moves."""
    above = (parent for _, parent in _iterate_edges_above(buffer, target))
    return next((frame for frame in above if _motion(buffer, frame, source, stamps) > _MIN_MOTION), None)


def _joint_parent(buffer: _core.Buffer, target: str, source: str) -> str:
    """Return the lowest frame above both frames, or one of them if it is above the other."""
    above_source = {source, *(parent for _, parent in _iterate_edges_above(buffer, source))}
    above_target = [target, *(parent for _, parent in _iterate_edges_above(buffer, target))]
    return next((frame for frame in above_target if frame in above_source), target)


def _find_motion_frame(buffer: _core.Buffer, robot: str, stamps: NDArray[np.int64]) -> str | None:
    """Return the frame above a frame of a robot in which the robot moves, or None if it does not move.

    Of several edges that move, the upper ones are corrections of a localization: the frame is the one with the usual
    name, or else the parent of the edge that moves most.
    """
    motions = {parent: _motion(buffer, parent, child, stamps) for child, parent in _iterate_edges_above(buffer, robot)}
    moving = {frame: motion for frame, motion in motions.items() if motion > _MIN_MOTION}
    usual = next((frame for frame in moving if "odom" in frame.rpartition("/")[2]), None)
    return usual or max(moving, key=lambda frame: moving[frame], default=None)


def _iterate_edges_above(buffer: _core.Buffer, frame: str) -> Iterator[tuple[str, str]]:
    """Yield child and parent of the edges from a frame up to its root."""
    for _ in range(_MAX_ANCESTORS):
        state = buffer._edge_at(frame, 0)
        if state is None or not state[1]:
            return
        yield frame, state[1]
        frame = state[1]


def _is_fixed(frame: str) -> bool:
    """Return whether a frame does not move with a robot by convention (REP 105)."""
    name = frame.rpartition("/")[2].lower()
    return any(usual in name for usual in _FIXED_FRAMES)


def _motion(buffer: _core.Buffer, target: str, source: str, stamps: NDArray[np.int64]) -> float:
    """Return how far one frame moves relative to another, in meters and parts of a quaternion; 0.0 if unconnected.

    Tried are these times and some between the first and the last sample.
    """
    if target == source or not buffer.can_transform(target, source):
        return 0.0
    if buffer.latest_common_time(target, source) == 0:
        return 0.0
    ends = np.array([np.iinfo(np.int64).min + 1, np.iinfo(np.int64).max])
    tried_stamps = [stamps]
    with suppress(TransformException):  # The edges have no common time if a frame changes its parent.
        buffer._lookup_rows(target, source, ends, np.empty((2, 7)), None, None, "clip", 1)  # noqa: SLF001
        first, last = int(ends[0]), int(ends[1])
        tried_stamps.append(
            np.array([first + (last - first) * i // (_SAMPLE_COUNT - 1) for i in range(_SAMPLE_COUNT)], dtype=np.int64)
        )
    return max(_motion_extent(_poses(buffer, target, source, times)) for times in tried_stamps)


def _poses(buffer: _core.Buffer, target: str, source: str, stamps: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the poses at the times for which there is one: (N, 7)."""
    rows: NDArray[np.float64] = np.full((len(stamps), 7), np.nan)
    try:
        buffer._lookup_rows(target, source, stamps.copy(), rows, None, None, "nan", 1)  # noqa: SLF001
    except TransformException:
        return rows[:0]
    found: NDArray[np.float64] = rows[~np.isnan(rows[:, 0])]
    return found


def _motion_extent(poses: NDArray[np.float64]) -> float:
    """Return the largest difference from the first pose."""
    if len(poses) < 2:
        return 0.0
    # A quaternion and its negative are the same rotation.
    rotations = poses[:, 3:] * np.where(poses[:, 3:] @ poses[0, 3:] < 0, -1.0, 1.0)[:, None]
    return float(np.hypot(np.abs(poses[:, :3] - poses[0, :3]).max(), np.abs(rotations - rotations[0]).max()))
