# SPDX-License-Identifier: Apache-2.0
"""Mounts that a recording shows by itself, from two sensors that see one thing at the same time.

The poses of one object in two sensors, A and B, give the pose A B^-1 of the second sensor in the first one, regardless
of how both move. Odometry is not involved, so its drift cannot look like a mount that moves.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from coframe import quaternion
from coframe.buffer.gaps import MAX_GAP
from coframe.calibration.estimation import calibrate_rigid
from coframe.errors import CalibrationError, CoframeError, TransformException
from coframe.trajectories import resample
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from coframe.bags import Recording

    Array = NDArray[np.float64]

__all__ = ["MAX_CHI_SQUARED", "MeasuredMount", "measure_mounts", "measure_pair", "measure_rigid"]

MAX_CHI_SQUARED = 3.0
"""Above it, the residuals are not noise about one mount, and no movement is derived from them."""
MIN_COMMON_POSES = 40
_BLOCKS = 20  # of neighboring poses, whose means show the noise that does not average out quickly
_MEDIAN_OF_NORM = 1.538  # of three normally distributed numbers, in standard deviations
_POSE_TYPES = {
    "geometry_msgs/msg/PoseStamped",
    "geometry_msgs/msg/PoseWithCovarianceStamped",
    "geometry_msgs/msg/TransformStamped",
}


@dataclass(frozen=True, eq=False)
class MeasuredMount:
    """The mount of a sensor as one recording shows it.

    Attributes:
        recording: The name of the recording.
        start: The time of its first pose in nanoseconds.
        sources: The topics or trajectories that were compared.
        transform: The pose of the child (``source``) in the parent (``target``), with its covariance.
        chi_squared: The ratio of the variance of the residuals to that of their noise; about 1 for a mount that does
            not move.
        count: The number of poses or motions.
        published: The transform between both frames in /tf_static, or None if there is none.
    """

    recording: str
    start: int
    sources: str
    transform: Transform
    chi_squared: float
    count: int
    published: Transform | None = None

    @property
    def name(self) -> tuple[str, str, str]:
        """The parent, the child and the sources, which identify the mount in several recordings."""
        return str(self.transform.target), str(self.transform.source), self.sources

    @property
    def fits(self) -> bool:
        """Whether the residuals are noise about one mount."""
        return self.chi_squared <= MAX_CHI_SQUARED


def measure_mounts(
    recording: Recording, pairs: Iterable[tuple[str, str]] = (), rigid: Iterable[tuple[str, str]] = ()
) -> list[MeasuredMount]:
    """Return the mounts that a recording shows.

    Args:
        recording: The recording.
        pairs: Pairs of topics with poses of one object in two sensors.
        rigid: Pairs of trajectories of one rigid body, as ``odom:base_link``. If neither is given, all pairs of pose
            topics are used whose frames differ and have a static transform between them.

    Raises:
        CalibrationError: A given pair does not show a mount.
        CoframeError: A topic or frame does not exist.
    """
    found = [measure_pair(recording, *pair) for pair in pairs]
    found += [measure_rigid(recording, *pair) for pair in rigid]
    if found:
        return found
    topics = [name for name, topic in recording.topics.items() if topic.type in _POSE_TYPES]
    for pair in combinations(sorted(topics), 2):
        try:
            mount = measure_pair(recording, *pair)
        except CoframeError:
            continue
        if mount.published is not None and mount.fits:
            found.append(mount)
    return found


def measure_pair(recording: Recording, first: str, second: str) -> MeasuredMount:
    """Return the mount between two sensors that publish poses of one object, each in its own frame.

    Args:
        recording: The recording.
        first: Topic of the poses in the frame of the parent sensor.
        second: Topic of the poses in the frame of the child sensor.

    Raises:
        CalibrationError: They have too few common times, are in the same frame, or mostly contradict each other.
        RecordingError: A topic does not exist or contains no poses.
    """
    poses = [recording.trajectory(topic) for topic in (first, second)]
    parent, child = (recording.frame(str(each.target or "")) for each in poses)
    if not parent or not child or parent == child:
        raise CalibrationError(
            f"the poses on {first} and {second} are in the frames {parent!r} and {child!r}, not those of two sensors",
            hint="Give topics with poses of one object, each in the frame of its sensor.",
        )
    first_poses, second_poses = poses
    at_same_times = resample(second_poses, np.asarray(first_poses.stamps))
    common = resample(first_poses, np.asarray(at_same_times.stamps)) if len(at_same_times) else at_same_times
    if len(common) < MIN_COMMON_POSES:
        raise CalibrationError(
            f"{first} and {second} have {len(common)} common times; {MIN_COMMON_POSES} are needed",
            hint="Record while both sensors see the same object.",
        )
    a, b = (each.replace(target=None, source=None, stamp=None) for each in (common, at_same_times))
    mount, chi_squared = _mean_pose(a @ b.inverse())
    return _measured(recording, f"{first} and {second}", mount, (parent, child), chi_squared, common)


def measure_rigid(recording: Recording, first: str, second: str) -> MeasuredMount:
    """Return the mount of a sensor on a body from two trajectories, by :func:`coframe.calibration.calibrate_rigid`.

    Args:
        recording: The recording.
        first: The body in a root: ``odom:base_link``.
        second: The sensor in another root: ``map:camera``.

    Raises:
        CalibrationError: The motion does not show the mount.
        CoframeError: A frame does not exist.
    """
    first_poses, second_poses = (recording.trajectory(pair, max_gap=MAX_GAP) for pair in (first, second))
    found = calibrate_rigid(first_poses, second_poses)
    if len(found.hidden) or not found.is_rotation_observable:
        raise CalibrationError(
            f"the motion of {first} and {second} does not show the whole mount",
            hint="Record turns about several axes; `coframe calibrate rigid` names the hidden directions.",
        )
    chi_squared = 0.0
    for residuals in (found.rotation_residuals, found.translation_residuals):
        noise = max(float(np.median(residuals)) / _MEDIAN_OF_NORM, 1e-12)
        chi_squared = max(chi_squared, float(np.mean(residuals**2)) / (3.0 * noise**2))
    names = (str(first_poses.source), str(second_poses.source))
    return _measured(recording, f"{first} and {second}", found.transform, names, chi_squared, first_poses)


def _measured(
    recording: Recording,
    sources: str,
    mount: Transform,
    names: tuple[str, str],
    chi_squared: float,
    poses: Transform,
) -> MeasuredMount:
    published = None
    try:
        if recording.buffer.latest_common_time(*names) == 0:
            published = recording.buffer.lookup(*names)
    except TransformException:
        published = None
    stamps = np.asarray(poses.stamps)
    return MeasuredMount(
        str(recording.path),
        int(stamps[0]),
        sources,
        Transform(mount.translation, mount.quaternion, target=names[0], source=names[1], covariance=mount.covariance),
        chi_squared,
        len(stamps),
        published,
    )


def _mean_pose(each: Transform) -> tuple[Transform, float]:
    """Return the mean of poses with its covariance, and how much more they scatter than their neighbors differ."""
    rotations, places = np.asarray(each.quaternion), np.asarray(each.translation)
    mean = np.asarray(np.linalg.eigh(rotations.T @ rotations)[1][:, -1])
    turns = quaternion.to_rotvec(quaternion.multiply(rotations, quaternion.inverse(mean)))
    rows = np.concatenate([places, turns], axis=1)
    rows, center = _without_outliers(rows)
    noise = np.diff(rows, axis=0)
    noise_variance = (noise**2).mean(axis=0) / 2.0
    ratios = rows.var(axis=0) / np.maximum(noise_variance, 1e-24)
    blocks = np.stack([part.mean(axis=0) for part in np.array_split(rows, min(_BLOCKS, len(rows) // 4))])
    covariance = np.cov(blocks.T) / len(blocks)
    white = np.cov(rows.T) / len(rows)
    if np.trace(white) > np.trace(covariance):
        covariance = white
    rotation = quaternion.multiply(quaternion.from_rotvec(center[3:]), mean)
    return Transform(center[:3], rotation, covariance=(covariance + covariance.T) / 2.0), float(ratios.max())


def _without_outliers(rows: Array) -> tuple[Array, Array]:
    """Return the rows without those that are far from the median, and their mean.

    Raises:
        CalibrationError: Most rows are far from the median.
    """
    middle = np.median(rows, axis=0)
    spread = 1.4826 * np.median(np.abs(rows - middle), axis=0)
    # Of rounded values, most may be equal, so that their median deviation is zero but for rounding.
    deviation = rows.std(axis=0)
    spread = np.where(spread > 1e-6 * deviation, spread, deviation)
    kept = rows[(np.abs(rows - middle) <= np.maximum(6.0 * spread, 1e-12)).all(axis=1)]
    if 2 * len(kept) <= len(rows):
        raise CalibrationError(
            f"{len(rows) - len(kept)} of {len(rows)} common poses are outliers",
            hint="Compare topics with poses of one object, which both sensors see at the same time.",
        )
    return kept, kept.mean(axis=0)
