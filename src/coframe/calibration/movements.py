# SPDX-License-Identifier: Apache-2.0
"""Sensors that have moved between recordings, by more than the uncertainty of their measured mounts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe import quaternion

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from coframe.calibration.measured_mounts import MeasuredMount
    from coframe.transform.transform import Transform

    Array = NDArray[np.float64]

__all__ = ["MIN_SIGNIFICANCE", "MountChange", "Movement", "change_between", "find_movements"]

MIN_SIGNIFICANCE = 4.0
"""Standard deviations above which a mount differs."""
_SAME_PUBLISHED = (1e-6, 1e-6)  # meters and radians


class MountChange(NamedTuple):
    """How far a mount is from an earlier one: size and standard deviation of both parts.

    Attributes:
        meters: The distance between both positions.
        meters_deviation: Its standard deviation.
        radians: The angle between both rotations.
        radians_deviation: Its standard deviation.
    """

    meters: float
    meters_deviation: float
    radians: float
    radians_deviation: float

    @property
    def has_shifted(self) -> bool:
        """Whether the distance is above four standard deviations."""
        return self.meters > MIN_SIGNIFICANCE * self.meters_deviation

    @property
    def has_turned(self) -> bool:
        """Whether the angle is above four standard deviations."""
        return self.radians > MIN_SIGNIFICANCE * self.radians_deviation

    @property
    def is_significant(self) -> bool:
        """Whether one of both is above four standard deviations."""
        return self.has_shifted or self.has_turned


@dataclass(frozen=True, eq=False)
class Movement:
    """A sensor that has moved.

    Attributes:
        before: The reference: the first recording with the earlier mount.
        after: The newest recording.
        change: How far it has moved.
        is_confirmed: Whether two recordings in a row show it.
    """

    before: MeasuredMount
    after: MeasuredMount
    change: MountChange
    is_confirmed: bool


def change_between(before: Transform, after: Transform) -> MountChange:
    """Return how far a mount is from an earlier one; both have covariances."""
    rotation = quaternion.to_rotvec(quaternion.multiply(after.quaternion, quaternion.inverse(before.quaternion)))
    step = np.asarray(after.translation) - np.asarray(before.translation)
    covariance = np.asarray(before.covariance) + np.asarray(after.covariance)
    meters, meters_deviation = _size(step, covariance[:3, :3])
    radians, radians_deviation = _size(np.asarray(rotation), covariance[3:, 3:])
    return MountChange(meters, meters_deviation, radians, radians_deviation)


def _size(vector: Array, covariance: Array) -> tuple[float, float]:
    """Return the length of a vector, and its standard deviation along it."""
    length = float(np.linalg.norm(vector))
    if not length:
        return 0.0, float(np.sqrt(np.trace(covariance) / 3.0))
    along = vector / length
    return length, float(np.sqrt(along @ covariance @ along))


def find_movements(series: Sequence[MeasuredMount]) -> list[Movement]:
    """Return the movements of one sensor in the measurements of several recordings.

    Measurements whose residuals do not fit are ignored. If the published transform changes, the mount has been
    calibrated again, and the measurement becomes the new reference.

    Args:
        series: The mount in each recording.

    Returns:
        The confirmed movements in order of time, and at the end that of the newest recording, if no second one confirms
        it.
    """
    found: list[Movement] = []
    reference: MeasuredMount | None = None
    pending: MeasuredMount | None = None
    for mount in sorted((each for each in series if each.fits), key=lambda each: each.start):
        if reference is None or not _is_same_publication(reference, mount):
            reference, pending = mount, None
            continue
        change = change_between(reference.transform, mount.transform)
        if not change.is_significant:
            pending = None
        elif pending is None:
            pending = mount
        else:
            found.append(Movement(reference, mount, change, is_confirmed=True))
            reference, pending = mount, None
    if reference is not None and pending is not None:
        change = change_between(reference.transform, pending.transform)
        found.append(Movement(reference, pending, change, is_confirmed=False))
    return found


def _is_same_publication(first: MeasuredMount, second: MeasuredMount) -> bool:
    if first.published is None or second.published is None:
        return first.published is None and second.published is None
    meters, radians = first.published.distance(second.published)
    return bool(meters <= _SAME_PUBLISHED[0] and radians <= _SAME_PUBLISHED[1])
