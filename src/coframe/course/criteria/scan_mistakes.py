# SPDX-License-Identifier: Apache-2.0
"""Find the mistake in a wrong cloud: apply each common mistake to the scan, and compare the results."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from coframe.transform.transform import Transform
    from sensor_msgs.msg import LaserScan

    Array = NDArray[np.float64]

__all__ = ["SentScan", "cloud_mistake", "filter_mistake", "valid_beams"]

_TOLERANCE = 2e-3  # meters


class SentScan(NamedTuple):
    """A scan, and the expected cloud in base_link.

    Attributes:
        message: The scan.
        pose: The pose of the lidar relative to base_link at the stamp.
        earlier: Its pose at the latest transform that had arrived before the scan.
        mounts: The pose of each lidar relative to base_link by its frame, at the stamp.
    """

    message: LaserScan
    pose: Transform
    earlier: Transform
    mounts: dict[str, Transform]

    @property
    def points(self) -> Array:
        """The valid points in base_link, shape (N, 3)."""
        return np.asarray(self.pose @ flat_points(self.message, valid_beams(self.message)))


def ranges_and_angles(scan: LaserScan) -> tuple[Array, Array]:
    """Return the ranges and the angles of all beams."""
    ranges = np.array(scan.ranges, dtype=np.float64)
    return ranges, np.asarray(scan.angle_min + scan.angle_increment * np.arange(len(ranges)), dtype=np.float64)


def valid_beams(scan: LaserScan) -> NDArray[np.bool_]:
    """Return which beams of a scan have an echo."""
    ranges, _ = ranges_and_angles(scan)
    return np.isfinite(ranges) & (ranges >= scan.range_min) & (ranges <= scan.range_max)


def flat_points(scan: LaserScan, used_beams: NDArray[np.bool_]) -> Array:
    """Return points of a scan in the frame of the lidar, shape (N, 3)."""
    ranges, angles = ranges_and_angles(scan)
    return _points(ranges[used_beams], angles[used_beams])


def _points(ranges: Array, angles: Array) -> Array:
    return np.column_stack([ranges * np.cos(angles), ranges * np.sin(angles), np.zeros(len(ranges))])


def filter_mistake(scan: LaserScan, count: int) -> str:
    """Return which invalid beams were kept or lost, from the number of points, or "" if that is not known."""
    ranges, _ = ranges_and_angles(scan)
    finite, near, far = np.isfinite(ranges), ranges >= scan.range_min, ranges <= scan.range_max
    with np.errstate(invalid="ignore"):
        trials = (
            ("no beam is dropped: keep those with np.isfinite(ranges), from range_min to range_max", finite | ~finite),
            ("only inf and NaN are dropped: also drop ranges outside range_min to range_max", finite),
            ("inf and NaN are not dropped: np.isfinite(ranges)", ~((finite & ~near) | (finite & ~far))),
            ("NaN is not dropped: np.isfinite(ranges)", (near & far) | np.isnan(ranges)),
            ("NaN is dropped, but not inf and ranges outside range_min to range_max", ~np.isnan(ranges)),
            ("ranges below range_min are not dropped", finite & far),
            ("ranges above range_max are not dropped", finite & near),
        )
    return next((cause for cause, used in trials if int(used.sum()) == count), "")


def cloud_mistake(pairs: Sequence[tuple[SentScan, Array]]) -> str:
    """Return the mistake that explains all wrong clouds, or "" if no common mistake does.

    Args:
        pairs: Scans, and the published points, shape (N, 3).
    """
    if not pairs:
        return ""
    fitting = [{cause for cause, points in _trials(scan) if _agree(points, found)} for scan, found in pairs]
    common = set.intersection(*fitting)
    return next((cause for cause, _ in _trials(pairs[0][0]) if cause in common), "")


def _agree(expected: Array, found: Array) -> bool:
    if len(expected) != len(found):
        kept = found[np.isfinite(found).all(axis=1)]
        if not len(kept) or not len(expected):
            return False
        gaps = np.linalg.norm(expected[:, None, :] - kept[None, :, :], axis=2)
        return bool(gaps.min(axis=1).max() <= _TOLERANCE)
    with np.errstate(invalid="ignore"):
        return bool(np.linalg.norm(expected - found, axis=1).max() <= _TOLERANCE)


def _trials(scan: SentScan) -> Iterator[tuple[str, Array]]:
    """Yield each common mistake with the cloud that it would give."""
    used = valid_beams(scan.message)
    ranges, angles = ranges_and_angles(scan.message)
    scan_points = _points(ranges[used], angles[used])
    rotation, translation = scan.pose.rotation, scan.pose.translation

    def placed(points: Array) -> Array:
        return np.asarray(scan.pose @ points)

    yield (
        "the lookup uses the latest transform, Time(), instead of the one at the stamp of the scan",
        np.asarray(scan.earlier @ scan_points),
    )
    for frame, pose in scan.mounts.items():
        if frame != scan.message.header.frame_id:
            yield (
                f"the source frame is always {frame!r}: use scan.header.frame_id, the frame of the scan",
                np.asarray(pose @ scan_points),
            )
    yield (
        "target and source are swapped: lookup_transform('base_link', scan.header.frame_id, ...)",
        np.asarray(scan.pose.inverse() @ scan_points),
    )
    yield (
        "R is used instead of its transpose: points @ R.T + t for points in rows",
        scan_points @ rotation + translation,
    )
    yield "the translation of the transform is not added", scan_points @ rotation.T
    yield "the rotation of the transform is not applied", scan_points + translation
    yield "the points are not transformed: they are still in the frame of the scan", scan_points
    yield "the points are moved before they are turned: points @ R.T + t", (scan_points + translation) @ rotation.T
    for cause, changed in _angle_mistakes(scan.message, used, ranges, angles):
        yield cause, placed(changed)


def _angle_mistakes(
    scan: LaserScan, used_beams: NDArray[np.bool_], ranges: Array, angles: Array
) -> Iterator[tuple[str, Array]]:
    """Yield each common mistake in the angles with the points in the frame of the lidar."""
    kept, right = ranges[used_beams], angles[used_beams]
    yield "the angles are not filtered with the ranges: use the same beams of both", _points(kept, angles[: len(kept)])
    yield "the angles do not begin at angle_min", _points(kept, right - scan.angle_min)
    x, y, zero = kept * np.cos(np.degrees(right)), kept * np.sin(np.degrees(right)), np.zeros(len(kept))
    degrees = "the angles are converted to degrees: np.cos and np.sin take radians"
    yield degrees, np.column_stack([x, kept * np.sin(right), zero])
    yield degrees, np.column_stack([kept * np.cos(right), y, zero])
    yield degrees, np.column_stack([x, y, zero])
    yield "x and y are exchanged: x = range cos(angle), y = range sin(angle)", _points(kept, right)[:, [1, 0, 2]]
    yield "the sign of the angles is changed", _points(kept, -right)
    yield "all ranges are used as x: multiply by the cosine and sine of the angle", np.column_stack([kept, zero, zero])
