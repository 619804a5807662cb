# SPDX-License-Identifier: Apache-2.0
"""Covariances of poses: conventions, composition, fusion.

A covariance is a (6, 6) matrix over x, y, z in meters and rotations about x, y, z in radians along the axes of the
target, as in ROS's PoseWithCovariance. It describes the error xi of the body: the true pose is T exp(xi), and the
covariance is that of D xi, where D rotates both parts of xi from the axes of the source to those of the target.

- To first order this is ROS's position error along, and rotation error about, fixed axes; ROS defines no more.
- "body" is the covariance of xi itself; "gtsam" has the rotation first.
- Inverse and composition with an exact transform are linear in xi, so they are exact for errors of any size.
"""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import coframe.lazy_numpy as np
from coframe.errors import InvalidArgumentException

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike, NDArray

    from coframe.transform.transform import Transform

Array: TypeAlias = "NDArray[np.float64]"

# How much a matrix may differ from a symmetric one without negative eigenvalues, relative to its largest number; allows
# matrices that were stored as float32.
_TOLERANCE = 1e-6
# Fusion ends when a step is shorter than this, or after this many.
_SMALL_STEP, _MAX_STEPS = 1e-13, 50
# Directions whose variance is smaller than this fraction of the largest one count as exact in a fusion.
_EXACT_RATIO = 1e-14
_ROTATION_FIRST = [3, 4, 5, 0, 1, 2]


class Ellipsoid(NamedTuple):
    """A region that contains a position with a probability.

    Attributes:
        pose: The center, and the principal axes as a rotation; a batch for a batch.
        radii: The lengths of the semi-axes in meters, shape (..., 3), from the longest to the shortest.
    """

    pose: Transform
    radii: Array


def check_covariances(covariance: ArrayLike, shape: tuple[int, ...], name: str = "covariance") -> Array:
    """Return covariances of a batch as an array (*shape, 6, 6).

    Raises:
        InvalidArgumentException: A matrix is not finite, not symmetric, or has a negative eigenvalue.
        ValueError: The shape is different.
    """
    array = square(covariance, name)
    try:
        array = np.broadcast_to(array, (*shape, 6, 6))
    except ValueError:
        raise ValueError(f"{name} must have shape {(*shape, 6, 6)}, not {array.shape}") from None
    size = np.abs(array).max(axis=(-1, -2), initial=0.0)
    if not np.isfinite(size).all():
        raise _invalid(f"{name} must be finite, but contains NaN or inf", "Check where the values come from.")
    skew = np.abs(array - np.swapaxes(array, -1, -2)).max(axis=(-1, -2), initial=0.0)
    if (skew > _TOLERANCE * size).any():
        raise _invalid(
            f"{name} must be symmetric, but differs from its transpose by up to {skew.max():.3g}",
            "Is it the square root of a covariance, or a part of a larger matrix?",
        )
    symmetric: Array = 0.5 * (array + np.swapaxes(array, -1, -2))
    least = np.linalg.eigvalsh(symmetric).min(axis=-1, initial=0.0)
    if (least < -_TOLERANCE * size).any():
        raise _invalid(
            f"{name} must not have negative eigenvalues, but has {least.min():.3g}",
            "Variances are not negative. ROS marks unknown covariances with -1 in the first place: pass None instead.",
        )
    return symmetric


def square(values: ArrayLike, name: str) -> Array:
    """Return matrices (..., 6, 6) from matrices or from rows (..., 36).

    Raises:
        ValueError: The values have another shape.
    """
    array = np.asarray(values, dtype=np.float64)
    if array.shape[-2:] == (6, 6):
        return array
    if array.ndim and array.shape[-1] == 36:
        return array.reshape(*array.shape[:-1], 6, 6)
    raise ValueError(f"{name} must have shape (..., 6, 6) or (..., 36), not {array.shape}")


def rotate_covariances(covariance: Array, rotation: Array) -> Array:
    """Return covariances along other axes: D C D^T."""
    both = np.zeros((*rotation.shape[:-2], 6, 6))
    both[..., :3, :3] = both[..., 3:, 3:] = rotation
    return _conjugate(both, covariance)


def to_body(covariance: Array, rotation: Array) -> Array:
    """Return the covariance of xi, along the axes of the source."""
    return rotate_covariances(covariance, np.swapaxes(rotation, -1, -2))


def from_body(covariance: Array, rotation: Array) -> Array:
    """Return a covariance along the axes of the target from that of xi."""
    return rotate_covariances(covariance, rotation)


def to_convention(covariance: Array, rotation: Array, convention: str) -> Array:
    """Return a covariance in another convention."""
    _check_convention(convention)
    if convention == "ros":
        return covariance
    body = to_body(covariance, rotation)
    return _reorder(body) if convention == "gtsam" else body


def from_convention(covariance: Array, rotation: Array, convention: str) -> Array:
    """Return a covariance that was given in another convention."""
    _check_convention(convention)
    if convention == "ros":
        return covariance
    return from_body(_reorder(covariance) if convention == "gtsam" else covariance, rotation)


def adjoint(rotation: Array, translation: Array) -> Array:
    """Return the adjoint matrices (..., 6, 6), in the order linear, angular."""
    matrix = np.zeros((*rotation.shape[:-2], 6, 6))
    matrix[..., :3, :3] = matrix[..., 3:, 3:] = rotation
    matrix[..., :3, 3:] = _cross(translation) @ rotation
    return matrix


def invert_covariance(covariance: Array, rotation: Array, translation: Array) -> Array:
    """Return the covariance of the inverse of a transform: its error is -Ad(T) xi."""
    return rotate_covariances(_conjugate(_lever_matrix(translation), covariance), np.swapaxes(rotation, -1, -2))


def compound_covariances(first: Array | None, second: Array | None, rotation: Array, translation: Array) -> Array:
    """Return the covariance of A B from those of A and B, of which one may be exact (None).

    The error of A moves to the source of B linearly. Two errors combine to fourth order (T. Barfoot and P. Furgale,
    "Associating Uncertainty with Three-Dimensional Poses for Use in Estimation Problems", 2014, equations 54 to 57).

    Args:
        first: Covariance of A along the axes of its target.
        second: Covariance of B along the axes of its target.
        rotation: Rotation matrix of A.
        translation: Translation of B.
    """
    arm = (rotation @ translation[..., None])[..., 0]
    a = None if first is None else _conjugate(_lever_matrix(-arm), first)
    b = None if second is None else rotate_covariances(second, rotation)
    if a is None or b is None:
        return a if b is None else b  # type: ignore[return-value]  # one of them is known
    a, b = np.broadcast_arrays(a, b)
    twice_a = np.einsum("...ij,ikl,jlm->...km", a, _bracket_matrices(), _bracket_matrices())
    twice_b = np.einsum("...ij,ikl,jlm->...km", b, _bracket_matrices(), _bracket_matrices())
    once = np.einsum("...ij,ikl,...lm,jnm->...kn", a, _bracket_matrices(), b, _bracket_matrices(), optimize=True)
    half = twice_a @ b + twice_b @ a
    result: Array = a + b + 0.25 * once + (half + np.swapaxes(half, -1, -2)) / 12.0
    return result


def fuse_poses(mine: Array, others: Array, error_at: Callable[[Array], Array]) -> tuple[Array, Array]:
    """Fuse two estimates of a pose, A with the covariance `mine` and B with `others`, both of xi.

    Args:
        mine: Covariance of A, shape (..., 6, 6).
        others: Covariance of B.
        error_at: Returns log(B^-1 A exp(x)).

    Returns:
        The twist x, with the fused pose A exp(x), and the covariance of the fused pose.
    """
    mine, others = np.broadcast_arrays(mine, others)
    x = np.zeros(mine.shape[:-1])
    for _ in range(_MAX_STEPS):
        error = error_at(x)
        # A small change d of x changes the error by `slope` d.
        slope = np.asarray(np.linalg.solve(_right_jacobian(error), _right_jacobian(x)), dtype=np.float64)
        projected_covariance = mine @ np.swapaxes(slope, -1, -2)
        gain: Array = projected_covariance @ np.linalg.pinv(
            slope @ projected_covariance + others, rcond=_EXACT_RATIO, hermitian=True
        )
        previous, x = x, _product(gain, _product(slope, x) - error)
        if np.abs(x - previous).max(initial=0.0) < _SMALL_STEP * max(1.0, np.abs(x).max(initial=0.0)):
            break
    left = (np.eye(6) - gain @ slope) @ mine
    covariance = _conjugate(_right_jacobian(x), 0.5 * (left + np.swapaxes(left, -1, -2)))
    return x, covariance


def mahalanobis(error: Array, covariance: Array) -> Array:
    """Return the length of errors (..., 6) in standard deviations.

    Raises:
        InvalidArgumentException: A covariance is singular.
    """
    try:
        root = np.linalg.cholesky(covariance)
    except np.linalg.LinAlgError:
        raise _invalid(
            "the covariance is singular, so the distance is infinite in some direction",
            "Give each direction a variance above zero, also z, roll and pitch of a robot on a plane.",
        ) from None
    distance: Array = np.linalg.norm(np.linalg.solve(root, error[..., None])[..., 0], axis=-1)
    return distance


def ellipsoid(covariance: Array, confidence: float) -> tuple[Array, Array]:
    """Return the radii (..., 3) and the axes, the columns of (..., 3, 3), of the ellipsoid of the position."""
    if not 0.0 < confidence < 1.0:
        raise ValueError(f"confidence must be between 0 and 1, not {confidence}")
    variances, axes = np.linalg.eigh(covariance[..., :3, :3])
    variances, axes = np.maximum(variances[..., ::-1], 0.0), axes[..., ::-1].copy()
    axes[..., 2] *= np.linalg.det(axes)[..., None]  # a rotation, not a reflection
    return _sphere_radius(confidence) * np.sqrt(variances), axes


def _sphere_radius(confidence: float) -> float:
    """Return the radius of the sphere that contains three normal variables with a probability (Maxwell)."""
    low, high = 0.0, 40.0
    for _ in range(100):
        middle = 0.5 * (low + high)
        inside = math.erf(middle / math.sqrt(2.0)) - math.sqrt(2.0 / math.pi) * middle * math.exp(-0.5 * middle**2)
        low, high = (middle, high) if inside < confidence else (low, middle)
    return high


def _lever_matrix(arm: Array) -> Array:
    """Return the matrix that adds the rotation error times an arm to the position error."""
    lever = np.zeros((*arm.shape[:-1], 6, 6))
    lever[..., range(6), range(6)] = 1.0
    lever[..., :3, 3:] = _cross(arm)
    return lever


def _right_jacobian(twist: Array) -> Array:
    """Return J with exp(x + d) = exp(x) exp(J d) for small d: the sum of (-ad x)^n / (n + 1)!."""
    bracket = -np.einsum("...i,ijk->...jk", twist, _bracket_matrices())
    term = np.broadcast_to(np.eye(6), bracket.shape)
    total: Array = term.copy()
    for n in range(1, 30):  # the angles are at most pi, and pi^30 / 31! is below 1e-18
        term = term @ bracket / (n + 1)
        total += term
    return total


def _conjugate(matrix: Array, covariance: Array) -> Array:
    result: Array = matrix @ covariance @ np.swapaxes(matrix, -1, -2)
    return 0.5 * (result + np.swapaxes(result, -1, -2))


def _product(matrix: Array, vector: Array) -> Array:
    result: Array = (matrix @ vector[..., None])[..., 0]
    return result


def _reorder(covariance: Array) -> Array:
    return covariance[..., _ROTATION_FIRST, :][..., _ROTATION_FIRST]


def _check_convention(convention: str) -> None:
    if convention not in {"ros", "body", "gtsam"}:
        raise ValueError(f"convention must be 'ros', 'body' or 'gtsam', not {convention!r}")


def _invalid(text: str, hint: str) -> InvalidArgumentException:
    return InvalidArgumentException.with_details(text, hint=hint)


def _cross(vectors: Array) -> Array:
    """Return the matrices whose product with u is the cross product of the vectors and u."""
    matrix = np.zeros((*vectors.shape, 3))
    x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
    matrix[..., 0, 1], matrix[..., 0, 2] = -z, y
    matrix[..., 1, 0], matrix[..., 1, 2] = z, -x
    matrix[..., 2, 0], matrix[..., 2, 1] = -y, x
    return matrix


@cache
def _bracket_matrices() -> Array:
    """Return the matrices of the Lie bracket with each of the six unit twists, shape (6, 6, 6)."""
    crosses = _cross(np.eye(3))
    brackets = np.zeros((6, 6, 6))
    brackets[:3, :3, 3:] = crosses
    brackets[3:, :3, :3] = brackets[3:, 3:, 3:] = crosses
    return brackets
