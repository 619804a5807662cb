# SPDX-License-Identifier: Apache-2.0
"""Norms and unit vectors."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def vector_norm(data: ArrayLike, axis: int | None = None, out: Array | None = None) -> Any:
    """Return the Euclidean norm of all values, or along an axis."""
    length = np.linalg.norm(np.asarray(data, dtype=np.float64), axis=axis)
    if out is not None:
        out[...] = length
        return None
    return float(length) if np.ndim(length) == 0 else length


def unit_vector(data: ArrayLike, axis: int | None = None, out: Array | None = None) -> Array | None:
    """Return the normalized vector, or the vectors normalized along an axis."""
    vector = np.asarray(data, dtype=np.float64)
    unit = vector / np.linalg.norm(vector, axis=axis, keepdims=axis is not None)
    if out is not None:
        out[...] = unit
        return None
    return np.asarray(unit)


def unit_direction(data: ArrayLike) -> Array:
    """Return the first three values as a normalized vector."""
    vector = np.asarray(data, dtype=np.float64)[:3]
    return np.asarray(vector / np.linalg.norm(vector))


def random_vector(size: int | tuple[int, ...]) -> Array:
    """Return uniformly distributed random numbers in [0, 1)."""
    return np.random.default_rng().random(size)
