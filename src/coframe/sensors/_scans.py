# SPDX-License-Identifier: Apache-2.0
"""Convert laser scans to points."""

from __future__ import annotations

import importlib
from array import array
from dataclasses import dataclass, field
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from coframe.messages import find
from coframe.sensors._deskewing import deskew
from coframe.time import SECOND, stamp_ns

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe import _core
    from coframe.time import StampLike

__all__ = ["ScanPoints", "project_scan"]

_FLOAT32, _INT32 = 7, 5  # Constants of PointField.


@dataclass(frozen=True, eq=False)
class ScanPoints:
    """The points measured by a laser scan.

    Attributes:
        points: Positions in ``frame`` in meters, shape (N, 3), float64.
        beams: Index of the beam of each point, shape (N,), int32.
        times: Time of each point in nanoseconds, shape (N,), int64.
        intensities: Intensities in the scan, shape (N,), float32, or None if it has none.
        frame: The frame of the points.
        stamp: The stamp of the points in nanoseconds.
    """

    points: NDArray[np.float64]
    beams: NDArray[np.int32]
    times: NDArray[np.int64]
    intensities: NDArray[np.float32] | None
    frame: str
    stamp: int
    _classes: tuple[Any, Any] = field(repr=False)

    def to_cloud(self) -> Any:
        """Return the points as a PointCloud2 message.

        The result is a ROS message if the scan comes from a ROS installation. The fields are those of
        `laser_geometry`: float32 x, y, z, intensity if the scan has intensities, and int32 `index` of the beam.
        """
        cloud_class, field_class = self._classes
        names = ["x", "y", "z", *(["intensity"] if self.intensities is not None else []), "index"]
        values = np.empty(len(self.points), np.dtype([(name, "<f4") for name in names[:-1]] + [("index", "<i4")]))
        values["x"], values["y"], values["z"] = self.points.T
        values["index"] = self.beams
        if self.intensities is not None:
            values["intensity"] = self.intensities
        cloud = cloud_class()
        cloud.header.frame_id = self.frame
        cloud.header.stamp.sec, cloud.header.stamp.nanosec = divmod(self.stamp, SECOND)
        cloud.height, cloud.width = 1, len(values)
        cloud.fields = [
            field_class(name=name, offset=4 * i, datatype=_INT32 if name == "index" else _FLOAT32, count=1)
            for i, name in enumerate(names)
        ]
        cloud.is_bigendian = False
        cloud.point_step = values.itemsize
        cloud.row_step = values.nbytes
        cloud.data = array("B", values.tobytes())
        cloud.is_dense = not np.isnan(self.points).any()
        return cloud


def project_scan(
    scan: Any,
    buffer: _core.Buffer | Any = None,
    target: str | None = None,
    *,
    fixed: str | None = None,
    at: StampLike | None = None,
    on_error: Literal["raise", "nan"] = "raise",
) -> ScanPoints:
    """Convert a laser scan to points. With a buffer, transform each beam to ``target`` at its own time.

    As in `laser_geometry`, beams without a valid range are skipped: NaN, infinite, below `range_min`, or not below
    `range_max`.

    Args:
        scan: A LaserScan message. Its stamp is the time of the first beam; `time_increment` is the time between beams.
        buffer: The buffer with the motion of the sensor; None keeps the points in the frame of the scan.
        target: The frame to transform to.
        fixed: As in :func:`coframe.sensors.deskew`: a frame that does not move during the scan, if ``target`` does.
        at: As in :func:`coframe.sensors.deskew`; by default the stamp of the scan.
        on_error: As in :func:`coframe.sensors.deskew`.

    Returns:
        The points.

    Raises:
        TransformException: As :func:`coframe.sensors.deskew`.
        TypeError: Only one of ``buffer`` and ``target`` is given.

    Example:
        >>> from coframe.messages import find
        >>> from coframe.sensors import project_scan
        >>> scan = find("sensor_msgs/msg/LaserScan")(range_max=10.0, ranges=[1.0, float("inf"), 2.0])
        >>> scan.angle_increment = np.pi / 2
        >>> project_scan(scan).points.round(3).tolist()
        [[1.0, 0.0, 0.0], [-2.0, 0.0, 0.0]]
    """
    ranges = np.asarray(scan.ranges, dtype=np.float64)
    hits = np.flatnonzero((ranges >= scan.range_min) & (ranges < scan.range_max))
    points = np.zeros((len(hits), 3))
    directions = _beam_directions(scan.angle_min, scan.angle_increment, len(ranges))
    points[:, :2] = directions[hits] * ranges[hits, np.newaxis]
    frame, stamp = scan.header.frame_id, stamp_ns(scan.header.stamp)
    times = stamp + np.rint(hits * (scan.time_increment * SECOND)).astype(np.int64)
    if buffer is not None and target is not None:
        if fixed is not None and fixed != target:
            at = stamp if at is None else at
        deskew(
            points,
            times,
            buffer,
            target,
            source=frame,
            fixed=fixed,
            at=at,
            on_error=on_error,
            in_place=True,
        )
        frame, stamp = target, stamp if at is None else stamp_ns(at)
    elif buffer is not None or target is not None:
        raise TypeError("project_scan() needs both a buffer and a target, or neither")
    has_intensities = len(scan.intensities) == len(ranges) > 0
    intensities = np.asarray(scan.intensities, dtype=np.float32)[hits] if has_intensities else None
    return ScanPoints(points, hits.astype(np.int32), times, intensities, frame, stamp, _message_classes(scan))


@lru_cache(maxsize=8)  # Cached, because all scans of a sensor have the same beams.
def _beam_directions(start: float, increment: float, count: int) -> NDArray[np.float64]:
    """Return the directions of all beams as unit vectors in the plane of the scan, shape (count, 2)."""
    angles = start + increment * np.arange(count)
    directions = np.stack((np.cos(angles), np.sin(angles)), axis=1)
    directions.setflags(write=False)
    return directions


def _message_classes(message: Any) -> tuple[Any, Any]:
    """Return PointCloud2 and PointField: ROS's classes for a ROS message, otherwise coframe's."""
    if type(message).__module__.startswith("sensor_msgs.msg._"):
        module = importlib.import_module("sensor_msgs.msg")
        return module.PointCloud2, module.PointField
    return find("sensor_msgs/msg/PointCloud2"), find("sensor_msgs/msg/PointField")
