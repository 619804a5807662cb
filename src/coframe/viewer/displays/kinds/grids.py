# SPDX-License-Identifier: Apache-2.0
"""Occupancy grids."""

from __future__ import annotations

from typing import Any

import numpy as np

from coframe.time import stamp_ns
from coframe.viewer.displays._drawing import CannotDrawError, Drawing, Options, far_offset, pose_row
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import ChoiceOption, DisplayRow, FlagOption, NumberOption
from coframe.viewer.protocol.encoding import encode_grid

__all__ = ["MAP", "draw_grid"]

_MAX_FLOAT = float(np.finfo(np.float32).max)


def draw_grid(grid: Any, _options: Options) -> Drawing:
    """Draw an OccupancyGrid: -1 is unknown, 0 free, 100 occupied."""
    info = grid.info
    cells = np.asarray(grid.data, dtype=np.int8)
    if cells.size != info.width * info.height:
        raise CannotDrawError(f"a grid of {info.width} x {info.height} cells has data for {cells.size} cells")
    corner = pose_row(info.origin)
    if not all(abs(number) <= _MAX_FLOAT for number in (info.resolution, *corner)):
        raise CannotDrawError("the resolution or the origin of the grid is not a finite 32-bit number")
    offset = far_offset(np.array([corner[:3]]))
    near = (*np.subtract(corner[:3], offset).tolist(), *corner[3:])
    data = encode_grid(float(info.resolution), near, cells.reshape(info.height, info.width))
    return Drawing(grid.header.frame_id, stamp_ns(grid.header.stamp), data, offset=offset)


MAP = DisplayRow(
    name="Map",
    rank=2,
    max_automatic=3,
    messages={"nav_msgs/msg/OccupancyGrid": draw_each_message(draw_grid)},
    options=(
        NumberOption("Alpha", 0.7, 0.0, 1.0, 0.05),
        ChoiceOption("Color Scheme", "map", ("map", "costmap", "raw")),
        FlagOption("Draw Behind", False),
    ),
)
