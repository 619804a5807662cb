# SPDX-License-Identifier: Apache-2.0
"""The values of a message at a part of its drawing that the user has selected: of one point, or of the message."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.sensors import project_scan
from coframe.sensors.layout import field_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from coframe.viewer.sources.topic_messages import StampedMessage

__all__ = ["PartValues", "part_values"]

_MAX_FIELDS = 64


class PartValues(NamedTuple):
    """The names and values of a part, and the expressions of those that can be plotted."""

    fields: list[tuple[str, str]]
    curves: list[str]


def part_values(
    message: StampedMessage | None, ros_type: str, topic: str, offset: Sequence[float], local: Sequence[float]
) -> PartValues:
    """Return the values of the part of a message at a position.

    Args:
        message: The message, or None if it was dropped.
        ros_type: Its type.
        topic: Its topic, with which the expressions begin.
        offset: The position of the drawing in the frame of the message.
        local: The position of the part in the drawing.
    """
    find = _PARTS.get(ros_type)
    if message is None or find is None:
        return PartValues([], [f"{topic}.{path}" for path in _NUMBERS.get(ros_type, ())])
    try:
        return find(message.read(), topic, np.add(offset, local))
    except ValueError:  # The message is damaged; its display shows the reason.
        return PartValues([], [])


def _point(cloud: Any, topic: str, position: NDArray[np.float64]) -> PartValues:
    del topic  # Expressions cannot select a point of a cloud.
    points = np.stack([field_of(cloud, name).reshape(-1).astype(np.float64) for name in "xyz"], axis=1)
    index = _nearest_index(points, position)
    if index is None:
        return PartValues([], [])
    values = [("index", str(index))]
    for field in cloud.fields[:_MAX_FIELDS]:
        value = field_of(cloud, field.name).reshape(-1)[index]
        packed = field.name in {"rgb", "rgba"} and value.dtype.itemsize == 4
        text = f"#{int(value.view(np.uint32)) & 0xFFFFFF:06x}" if packed else _number(value)
        values.append((field.name, text))
    return PartValues(values, [])


def _beam(scan: Any, topic: str, position: NDArray[np.float64]) -> PartValues:
    hits = project_scan(scan)
    nearest = _nearest_index(hits.points, position)
    if nearest is None:
        return PartValues([], [])
    beam = int(hits.beams[nearest])
    angle = scan.angle_min + beam * scan.angle_increment
    values = [
        ("beam", str(beam)),
        ("range", f"{_number(scan.ranges[beam])} m"),
        ("angle", f"{_number(np.degrees(angle))}°"),
    ]
    curves = [f"{topic}.ranges[{beam}]"]
    if hits.intensities is not None:
        values.append(("intensity", _number(scan.intensities[beam])))
        curves.append(f"{topic}.intensities[{beam}]")
    return PartValues(values, curves)


def _nearest_index(points: NDArray[np.float64], position: NDArray[np.float64]) -> int | None:
    """Return the index of the point nearest to a position, or None if no point is finite."""
    with np.errstate(over="ignore", invalid="ignore"):
        distances = np.square(points - position).sum(axis=1)
    finite = np.isfinite(distances)
    return int(np.argmin(np.where(finite, distances, np.inf))) if finite.any() else None


def _number(value: Any) -> str:
    return f"{float(value):.7g}"


_PARTS: dict[str, Callable[[Any, str, NDArray[np.float64]], PartValues]] = {
    "sensor_msgs/msg/PointCloud2": _point,
    "sensor_msgs/msg/LaserScan": _beam,
}
# The numbers of other messages that are worth a plot.
_POSE = ("x", "y", "yaw")
_NUMBERS: dict[str, tuple[str, ...]] = {
    "geometry_msgs/msg/PoseStamped": _POSE,
    "geometry_msgs/msg/PoseWithCovarianceStamped": _POSE,
    "nav_msgs/msg/Odometry": (*_POSE, "twist.twist.linear.x", "twist.twist.angular.z"),
    "sensor_msgs/msg/Range": ("range",),
}
