# SPDX-License-Identifier: Apache-2.0
"""Downsampling of point clouds by a voxel grid."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["thin_points"]


def thin_points(points: NDArray[Any], edge: float) -> NDArray[Any]:
    """Return the first point in each voxel.

    Args:
        points: A structured array with finite x, y, z in meters.
        edge: Edge length of the voxels in meters.

    Raises:
        ValueError: ``edge`` is not positive, or so small that there are too many voxels to number.
    """
    if not edge > 0:
        raise ValueError(f"the voxel size must be above 0 m, not {edge:g} m")
    if not points.size:
        return points
    cells = np.stack([np.floor(points[axis].astype(np.float64) / edge) for axis in "xyz"])
    cells -= cells.min(axis=1, keepdims=True)
    sizes = cells.max(axis=1) + 1
    if float(np.prod(sizes)) > 2**62:
        raise ValueError(f"a voxel size of {edge:g} m is too small for the extent of the points. Use a larger one.")
    x, y, z = cells.astype(np.int64)
    _, first = np.unique((x * int(sizes[1]) + y) * int(sizes[2]) + z, return_index=True)
    return points[np.sort(first)]
