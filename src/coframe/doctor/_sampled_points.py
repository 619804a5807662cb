# SPDX-License-Identifier: Apache-2.0
"""The points of a few lidar messages, to find the end of its sweeps and to check its mount."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.analysis.liveness import usual_period
from coframe.doctor.observation import ObservedPoints
from coframe.errors import CoframeError, DecodeError
from coframe.sensors import project_scan
from coframe.sensors.layout import field_of
from coframe.sensors.point_times import TIME_FIELDS, UnknownTimesError, read_times
from coframe.time import SECOND
from coframe.type_names import LASER_SCAN, POINT_CLOUD

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.bags import Recording

__all__ = ["sampled_points"]

_MAX_MESSAGES = 12  # of a topic
_MAX_POINTS = 1500  # of a message
_MAX_RANGE = 1e4  # meters; no lidar measures farther
_WINDOW = 10 * SECOND  # in which the position of a robot hardly drifts


def sampled_points(recording: Recording, topic: str, type_: str) -> tuple[ObservedPoints, ...]:
    """Return the points of some messages from ten seconds in the middle of a topic, without empty messages.

    Args:
        recording: The recording to read.
        topic: The name of the topic.
        type_: The type of its messages; only PointCloud2 and LaserScan have points.
    """
    if type_ not in {LASER_SCAN, POINT_CLOUD}:
        return ()
    stamps = np.unique(recording.stamps(topic))
    middle = stamps[len(stamps) // 2 : len(stamps) // 2 + 1]
    near = stamps[(np.abs(stamps - middle) <= _WINDOW // 2)] if len(stamps) else stamps
    some = near[np.unique(np.linspace(0, len(near) - 1, _MAX_MESSAGES).astype(np.intp))] if len(near) else near
    sampled = (_sample(recording, topic, stamp, round(usual_period(stamps))) for stamp in some.tolist())
    return tuple(points for points in sampled if points is not None and len(points.points))


def _sample(recording: Recording, topic: str, stamp: int, period: int) -> ObservedPoints | None:
    """Return the points of the message with a stamp, or None if it is damaged or has other fields."""
    try:
        recorded = recording.message_at(topic, stamp)
        if recorded is None:
            return None
        message = recorded.message
        frame = recording.frame(str(message.header.frame_id).lstrip("/"))
        points, times = _scan(message) if hasattr(message, "ranges") else _cloud(message, stamp, period)
    except (CoframeError, DecodeError, ValueError, TypeError, AttributeError, OverflowError):
        return None
    with np.errstate(invalid="ignore", over="ignore"):
        finite = np.isfinite(points).all(axis=1) & (np.abs(points).max(axis=1, initial=0.0) < _MAX_RANGE)
    points, times = points[finite], times[finite] if times is not None else None
    sweep = max(int(times.max()) - stamp, 0) if times is not None and len(times) else 0
    some = slice(None, None, -(-len(points) // _MAX_POINTS) or 1)
    times = np.full(len(points), stamp, dtype=np.int64) if times is None else times
    return ObservedPoints(topic, frame, stamp, sweep, times[some], points[some])


def _scan(message: Any) -> tuple[NDArray[np.float64], NDArray[np.int64] | None]:
    hits = project_scan(message)
    return np.asarray(hits.points, dtype=np.float64), hits.times if message.time_increment != 0 else None


def _cloud(message: Any, stamp: int, period: int) -> tuple[NDArray[np.float64], NDArray[np.int64] | None]:
    names = [field.name for field in message.fields if field.name in TIME_FIELDS and field.count <= 1]
    points = np.stack([field_of(message, axis).reshape(-1).astype(np.float64) for axis in "xyz"], axis=1)
    columns = {name: field_of(message, name).reshape(-1) for name in names}
    structured = np.empty(len(points), dtype=[(name, values.dtype) for name, values in columns.items()])
    for name, values in columns.items():
        structured[name] = values
    try:
        read = read_times(structured, stamp, period=period) if names else None
    except UnknownTimesError:
        read = None
    return points, read.times if read is not None else None
