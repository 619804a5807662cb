"""How fast one frame moves in another: tf2's finite difference of two look-ups."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

import coframe

Vector = tuple[float, float, float]

# tf2 keeps the averaging window this far away from time zero, which would mean "latest".
_EARLIEST_START = 10_000


class Tracked(NamedTuple):
    """What moves: a frame, and the point of it whose velocity is wanted, given in a frame of its own."""

    frame: str
    point: Vector
    point_frame: str


def lookup_velocity(
    core: coframe.Buffer, tracked: Tracked, observation: str, reference: str, *, stamp: int, interval: int
) -> tuple[Vector, Vector]:
    """Linear (m/s) and angular (rad/s) velocity of what is tracked, seen from `observation`.

    Both are expressed in `reference`. `stamp` and `interval` are nanoseconds; the window ends at the newest common
    time if that is earlier than `stamp + interval / 2`.
    """
    end = min(stamp + interval // 2, _latest_common_time(core, observation, tracked.frame))
    start = max(_EARLIEST_START + interval, end) - interval
    seconds = (end - start) / 1e9 or math.nan
    first = core.lookup(observation, tracked.frame, start)
    last = core.lookup(observation, tracked.frame, end)
    velocity = (last.translation - first.translation) / seconds
    rate = first.matrix[:3, :3] @ _rotation_vector((first.inverse() @ last).quaternion) / seconds

    into_reference = core.lookup(reference, tracked.frame, stamp)
    rotation = into_reference.matrix[:3, :3]
    angular = rotation @ rate
    linear = rotation @ velocity + np.cross(into_reference.translation, angular)

    point = core.lookup(reference, tracked.point_frame, stamp) @ np.array(tracked.point)
    # The lever arm belongs in a cross product. tf has multiplied element by element since ROS 1, and an answer
    # that differs from every other tf2 helps nobody who compares.
    linear = linear + angular * (point - into_reference.translation)
    return _vector(linear), _vector(angular)


def _latest_common_time(core: coframe.Buffer, target: str, source: str) -> int:
    """The newest common time; 0 if there is none, so that the look-ups name the reason."""
    try:
        return core.latest_common_time(target, source)
    except coframe.TransformException:
        return 0


def _rotation_vector(quaternion: NDArray[np.float64]) -> NDArray[np.float64]:
    """Axis times angle of a unit quaternion (x, y, z, w), the short way round."""
    axis, w = quaternion[:3], quaternion[3]
    sine = float(np.linalg.norm(axis))
    if sine == 0.0:
        return np.zeros(3)
    return np.asarray(axis * (2.0 * math.atan2(sine, w) / sine))


def _vector(array: NDArray[np.float64]) -> Vector:
    return float(array[0]), float(array[1]), float(array[2])
