# SPDX-License-Identifier: Apache-2.0
"""Maps as masked arrays."""

from array import array
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nav_msgs.msg import MapMetaData, OccupancyGrid
from ros2_numpy.registry import converts_from_numpy, converts_to_numpy

__all__ = ["numpy_to_occupancy_grid", "occupancygrid_to_numpy"]

_UNKNOWN = -1


@converts_to_numpy(OccupancyGrid)
def occupancygrid_to_numpy(msg: OccupancyGrid) -> Any:
    """Return the cells of a map, shape (height, width), int8, in which unknown cells are masked."""
    cells = np.asarray(msg.data, np.int8).reshape(msg.info.height, msg.info.width)
    masked: Any = np.ma.array(cells, mask=cells == _UNKNOWN, fill_value=_UNKNOWN)
    return masked


@converts_from_numpy(OccupancyGrid)
def numpy_to_occupancy_grid(arr: NDArray[Any], info: MapMetaData | None = None) -> OccupancyGrid:
    """Return a map.

    Args:
        arr: Cells, shape (height, width), int8. Masked cells are unknown.
        info: Resolution and origin of the map; the size comes from the array.

    Raises:
        TypeError: The array is not two-dimensional or not int8.
    """
    if arr.ndim != 2:
        raise TypeError("Array must be 2D")
    if arr.dtype != np.int8:
        raise TypeError("Array must be of int8s")
    cells = arr.filled(_UNKNOWN) if isinstance(arr, np.ma.MaskedArray) else arr
    grid = OccupancyGrid()
    if info is not None:
        grid.info = info
    grid.info.height, grid.info.width = arr.shape
    grid.data = array("b", np.ascontiguousarray(cells).tobytes())
    return grid
