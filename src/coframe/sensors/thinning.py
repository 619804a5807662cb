"""One point for each cube of space."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["thinned"]


def thinned(points: NDArray[Any], edge: float) -> NDArray[Any]:
    """The first point in each cube.

    Args:
        points: A structured array with finite x, y, z in metres.
        edge: Of the cubes, metres.

    Raises:
        ValueError: ``edge`` is not above 0, or so small that the cubes cannot be numbered.
    """
    if not edge > 0:
        raise ValueError(f"the cubes' edge must be above 0 m, not {edge:g}")
    if not points.size:
        return points
    places = np.stack([np.floor(points[axis].astype(np.float64) / edge) for axis in "xyz"])
    places -= places.min(axis=1, keepdims=True)
    sizes = places.max(axis=1) + 1
    if float(np.prod(sizes)) > 2**62:
        raise ValueError(f"cubes of {edge:g} m are too many for points that are so far apart: take larger ones")
    x, y, z = places.astype(np.int64)
    _, first = np.unique((x * int(sizes[1]) + y) * int(sizes[2]) + z, return_index=True)
    return points[np.sort(first)]
