# SPDX-License-Identifier: Apache-2.0
"""Velocity of a frame relative to another, computed as tf2's finite difference of two lookups."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import coframe.lazy_numpy as np
from coframe.errors import TransformException
from coframe.time import SECOND

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.buffer.buffer import Buffer

Vector = tuple[float, float, float]

# Earliest start of the averaging window in nanoseconds, as in tf2. Time zero would request the latest transform.
_EARLIEST_START = 10_000


class TrackedPoint(NamedTuple):
    """A moving frame, and the point whose velocity is computed, expressed in `point_frame`."""

    frame: str
    point: Vector
    point_frame: str


def lookup_velocity(
    core: Buffer, tracked: TrackedPoint, observation: str, reference: str, *, stamp: int, interval: int
) -> tuple[Vector, Vector]:
    """Return the linear (m/s) and angular (rad/s) velocity of a tracked point relative to `observation`.

    Both are expressed in `reference`. `stamp` and `interval` are in nanoseconds. The averaging window ends at the
    latest common time if that is earlier than `stamp + interval / 2`.
    """
    end = min(stamp + interval // 2, _latest_common_time(core, observation, tracked.frame))
    start = max(_EARLIEST_START + interval, end) - interval
    seconds = (end - start) / SECOND or math.nan
    first = core.lookup(observation, tracked.frame, start)
    last = core.lookup(observation, tracked.frame, end)
    velocity = (last.translation - first.translation) / seconds
    rate = first.matrix[:3, :3] @ _rotation_vector((first.inverse() @ last).quaternion) / seconds

    into_reference = core.lookup(reference, tracked.frame, stamp)
    rotation = into_reference.matrix[:3, :3]
    angular = rotation @ rate
    linear = rotation @ velocity + np.cross(into_reference.translation, angular)

    point = core.lookup(reference, tracked.point_frame, stamp) @ np.array(tracked.point)
    # Correct would be a cross product with the lever arm. tf has multiplied element by element since ROS 1, and this
    # implementation returns the same values as upstream.
    linear = linear + angular * (point - into_reference.translation)
    return _vector(linear), _vector(angular)


def _latest_common_time(core: Buffer, target: str, source: str) -> int:
    """Return the latest common time, or 0 if there is none, so that the lookups raise the error."""
    try:
        return core.latest_common_time(target, source)
    except TransformException:
        return 0


def _rotation_vector(quaternion: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the rotation vector (axis times angle) of a unit quaternion (x, y, z, w)."""
    axis, w = quaternion[:3], quaternion[3]
    sine = float(np.linalg.norm(axis))
    if sine == 0.0:
        return np.zeros(3)
    return np.asarray(axis * (2.0 * math.atan2(sine, w) / sine))


def _vector(array: NDArray[np.float64]) -> Vector:
    return float(array[0]), float(array[1]), float(array[2])
