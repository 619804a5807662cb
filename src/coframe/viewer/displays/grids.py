# SPDX-License-Identifier: Apache-2.0
"""Occupancy grids."""

from __future__ import annotations

from typing import Any

import numpy as np

from coframe.time import stamp_ns
from coframe.viewer.displays.drawing import CannotDrawError, Drawing, Options, pose_row
from coframe.viewer.protocol.encoding import encode_grid

__all__ = ["draw_grid"]

_LARGEST = float(np.finfo(np.float32).max)


def draw_grid(grid: Any, _options: Options) -> Drawing:
    """Draw an OccupancyGrid: -1 is unknown, 0 free, 100 occupied."""
    info = grid.info
    cells = np.asarray(grid.data, dtype=np.int8)
    if cells.size != info.width * info.height:
        raise CannotDrawError(f"a grid of {info.width} x {info.height} cells has data for {cells.size} cells")
    corner = pose_row(info.origin)
    if not all(abs(number) <= _LARGEST for number in (info.resolution, *corner)):
        raise CannotDrawError("the resolution or the origin of the grid is not a finite 32-bit number")
    data = encode_grid(float(info.resolution), corner, cells.reshape(info.height, info.width))
    return Drawing(grid.header.frame_id, stamp_ns(grid.header.stamp), data)
