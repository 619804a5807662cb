# SPDX-License-Identifier: Apache-2.0
"""Align one trajectory with another by a rigid motion or a similarity (Umeyama, 1991)."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe import quaternion
from coframe.errors import TrajectoryError
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["ALIGNMENTS", "Alignment", "align", "align_origin", "align_scale", "check_positions"]

ALIGNMENTS = ("none", "se3", "sim3", "scale", "hand-eye")
MAX_POSITION = 1e100  # meters. Squares of larger numbers overflow, and LAPACK may never return for infinite values.


class Alignment(NamedTuple):
    """A rigid motion with a scale that maps the poses of an estimate to a reference.

    Attributes:
        transform: The rotation and the translation in meters, from the frame of the estimate to the frame of the
        reference.
        scale: Factor for the positions of the estimate, applied before the transform.
    """

    transform: Transform
    scale: float

    def apply(self, poses: Transform) -> Transform:
        """Return the aligned poses: scaled, rotated and moved."""
        scaled = Transform(
            self.scale * poses.translation,
            poses.quaternion,
            target=poses.target,
            source=poses.source,
            stamp=poses.stamps,
        )
        return self.transform @ scaled


def align(reference: Transform, estimate: Transform, *, with_scale: bool = False) -> Alignment:
    """Return the alignment that minimizes the squared distances between paired positions.

    Args:
        reference: A batch of shape (N,), as returned by :func:`associate`.
        estimate: A batch of the same shape.
        with_scale: Whether to also estimate the scale, as for a monocular camera.

    Raises:
        TrajectoryError: The positions do not determine the rotation: fewer than three, or all on one line. Or a
            position is above `MAX_POSITION`.
        ValueError: The shapes differ.
    """
    if reference.shape != estimate.shape or len(reference.shape) != 1:
        raise ValueError(f"The trajectories must have the same shape (N,), not {reference.shape} and {estimate.shape}.")
    check_positions(reference)
    check_positions(estimate)
    rotation, translation, scale = _umeyama(estimate.translation, reference.translation, with_scale)
    q = quaternion.from_matrix(rotation)
    return Alignment(Transform(translation, q, target=reference.target, source=estimate.target), scale)


def align_scale(reference: Transform, estimate: Transform) -> Alignment:
    """Return only the scale of :func:`align`, about the origin of the estimate's frame.

    Args:
        reference: A batch of shape (N,), as returned by :func:`associate`.
        estimate: A batch of the same shape.

    Raises:
        TrajectoryError: As :func:`align`.
    """
    scale = align(reference, estimate, with_scale=True).scale
    return Alignment(Transform(target=estimate.target, source=estimate.target), scale)


def align_origin(reference: Transform, estimate: Transform, *, scale: float = 1.0) -> Alignment:
    """Return the alignment that makes the first poses coincide.

    Args:
        reference: A batch of shape (N,), as returned by :func:`associate`.
        estimate: A batch of the same shape.
        scale: Factor for the positions of the estimate.
    """
    scaled = Alignment(Transform(), scale).apply(estimate[:1].replace(target=None))
    motion = reference[:1].replace(source=None) @ scaled.replace(source=None).inverse()
    return Alignment(
        Transform(motion.translation[0], motion.quaternion[0], target=reference.target, source=estimate.target),
        scale,
    )


def check_positions(poses: Transform) -> None:
    """Raise a TrajectoryError if a position is too large for the computation."""
    largest = float(np.abs(poses.translation).max(initial=0.0))
    if largest > MAX_POSITION:
        raise TrajectoryError(
            f"A trajectory has a position of {largest:g} m; the maximum is {MAX_POSITION:g} m",
            hint="Check the unit and the rows of the files.",
        )


def _umeyama(
    points: NDArray[np.float64], targets: NDArray[np.float64], with_scale: bool
) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """Return R, t and c that minimize the sum of |targets - (c R points + t)|^2."""
    mean, target_mean = points.mean(axis=0), targets.mean(axis=0)
    centerd = points - mean
    covariance = (targets - target_mean).T @ centerd / len(points)
    u, singular, vt = np.linalg.svd(covariance)
    # The rounding error of the sums; for positions on one line, the second singular value is not larger than this.
    if singular[1] <= len(points) * np.finfo(np.float64).eps * singular[0]:
        raise TrajectoryError(
            f"The alignment is not determined: the {len(points)} paired positions are on one line or at one point",
            hint="Compare without alignment, or use a trajectory with turns.",
        )
    signs = np.array([1.0, 1.0, np.sign(np.linalg.det(u) * np.linalg.det(vt))])
    rotation = (u * signs) @ vt
    scale = float((singular * signs).sum() / (centerd**2).sum(axis=1).mean()) if with_scale else 1.0
    return rotation, target_mean - scale * rotation @ mean, scale
