# SPDX-License-Identifier: Apache-2.0
"""Check the numbers that callers pass to Transform, and return them as arrays."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import coframe.lazy_numpy as np
from coframe.errors import InvalidArgumentException

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray

    from coframe.quaternion import Array

# Maximum deviation of a matrix from a rotation; allows matrices that were stored as float32 or printed with five
# digits.
_MATRIX_TOLERANCE = 1e-5
# Between these lengths, the squared norm of a quaternion fits into a float64 with full precision.
_MIN_NORM, _MAX_NORM = 1e-140, 1e140


def single_pose(
    translation: ArrayLike, quaternion: ArrayLike
) -> tuple[float, float, float, float, float, float, float] | None:
    """Return the values of a single pose of floats without NumPy, which would take ten times as long for seven numbers.

    Returns:
        x, y, z, qx, qy, qz, qw, or None for batches, other types of numbers and invalid values.
    """
    t, q = _few_numbers(translation, 3), _few_numbers(quaternion, 4)
    if t is None or q is None or not all(type(number) is float for number in (*t, *q)):
        return None
    (x, y, z), (qx, qy, qz, qw) = t, q
    length = math.sqrt(qx * qx + qy * qy + qz * qz + qw * qw)
    if not (_MIN_NORM < length < _MAX_NORM and math.isfinite(x) and math.isfinite(y) and math.isfinite(z)):
        return None
    return x, y, z, qx / length, qy / length, qz / length, qw / length


def _few_numbers(values: Any, count: int) -> Sequence[Any] | None:
    """Return the numbers of an array of shape (count,), a tuple or a list, or None for other values."""
    if np.is_array(values):
        return values.tolist() if values.shape == (count,) else None
    return values if isinstance(values, tuple | list) and len(values) == count else None


def checked_vectors(values: ArrayLike, size: int, name: str) -> Array:
    """Return vectors as float64, shape (..., size).

    Raises:
        InvalidArgumentException: A number is not finite.
        ValueError: The array has another shape.
    """
    array = np.asarray(values, dtype=np.float64)
    if array.ndim == 0 or array.shape[-1] != size:
        raise ValueError(f"{name} must have shape (..., {size}), not {array.shape}")
    if not np.isfinite(array).all():
        raise InvalidArgumentException.with_details(
            f"{name} must be finite, but contains NaN or inf", hint="Check where the values come from."
        )
    return array


def checked_points(values: ArrayLike) -> NDArray[Any]:
    """Return points (..., 3) as float64, or as float32 if they already are.

    Raises:
        ValueError: The array has another shape.
    """
    points = np.asarray(values)
    if points.dtype != np.float32:
        points = points.astype(np.float64, copy=False)
    if points.ndim == 0 or points.shape[-1] != 3:
        raise ValueError(f"points must have shape (..., 3), not {points.shape}")
    return points


def normalize_quaternions(q: Array) -> Array:
    """Return quaternions (..., 4) with unit length, also very short and very long ones.

    Raises:
        InvalidArgumentException: A quaternion is zero.
    """
    with np.errstate(over="ignore"):
        length = np.sqrt((q * q).sum(axis=-1, keepdims=True))
    if not ((length > _MIN_NORM) & (length < _MAX_NORM)).all():  # The squares overflow or underflow.
        largest = np.abs(q).max(axis=-1, keepdims=True, initial=0.0)
        if not (largest > 0.0).all():
            raise InvalidArgumentException.with_details(
                "quaternion must not be zero", hint="Is w unset? The identity rotation has w = 1."
            )
        q = q / largest
        length = np.sqrt((q * q).sum(axis=-1, keepdims=True))
    unit: Array = q / length
    return unit


def checked_rotation(rotation: Array) -> Array:
    """Return the matrices (..., 3, 3) if all of them are rotations.

    Raises:
        ValueError: A matrix is not a rotation.
    """
    error = np.abs(rotation @ np.swapaxes(rotation, -1, -2) - np.eye(3)).max(initial=0.0)
    if not error <= _MATRIX_TOLERANCE:
        raise ValueError(
            f"the upper left 3x3 of the matrix is not a rotation: R R^T differs from the identity by up to {error:.2g}"
        )
    if (np.linalg.det(rotation) < 0).any():
        raise ValueError(
            "the upper left 3x3 of the matrix is a reflection, not a rotation: its determinant is -1. Is one axis "
            "negated, or are two axes exchanged, as between left-handed and right-handed coordinates?"
        )
    return rotation
