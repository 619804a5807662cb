# SPDX-License-Identifier: Apache-2.0
"""Sets of equal cells: flat ones in a plane, and voxels."""

from __future__ import annotations

from typing import Any, Literal, TypedDict

import numpy as np

from coframe.viewer.displays._drawing import (
    CannotDrawError,
    Drawing,
    Options,
    drawing_of_shapes,
    finite_all,
    header_of,
    near_points,
)
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import ChoiceOption, ColorOption, DisplayRow, FlagOption, NumberOption
from coframe.viewer.protocol.common import PayloadRows  # noqa: TC001 - the protocol evaluates annotations

__all__ = ["GRID_CELLS", "VOXEL_GRID", "CellsShape"]

MAX_CELLS = 1_000_000
_MAX_LEVELS = 16  # of a voxel grid, whose columns have two bits for each level


class CellsShape(TypedDict):
    """The centers of cells, as points, and their size along x, y and z in meters; flat cells have no height.

    ``unknown`` are the centers of voxels of which nothing is known.
    """

    kind: Literal["cells"]
    frame: str
    stamp: float
    points: PayloadRows
    unknown: PayloadRows
    size: list[float | None]


def draw_grid_cells(message: Any, options: Options) -> Drawing:
    """Draw the cells of a GridCells message as rectangles."""
    _check_count(len(message.cells))
    cells = np.array([(cell.x, cell.y, cell.z) for cell in message.cells], np.float64).reshape(-1, 3)
    points, offset = near_points(cells)
    frame, stamp = header_of(message, options)
    size = finite_all((message.cell_width, message.cell_height, 0.0))
    rows = (0, len(points))
    description = CellsShape(kind="cells", frame=frame, stamp=stamp, points=rows, unknown=(0, 0), size=size)
    return drawing_of_shapes(message, description, points, offset)


def draw_voxel_grid(message: Any, options: Options) -> Drawing:
    """Draw the marked voxels of Nav2's VoxelGrid: each number is a column, each level has two bits."""
    columns = message.size_x * message.size_y
    if len(message.data) != columns or message.size_z > _MAX_LEVELS:
        raise CannotDrawError(
            f"a voxel grid of {message.size_x} x {message.size_y} x {message.size_z} cells has data for "
            f"{len(message.data)} columns of at most {_MAX_LEVELS} cells"
        )
    data = np.asarray(message.data, np.uint32).reshape(message.size_y, message.size_x)
    bits = np.arange(message.size_z, dtype=np.uint32)
    lower, upper = (data[:, :, None] >> bits) & 1, (data[:, :, None] >> (bits + _MAX_LEVELS)) & 1
    marked, unknown = lower + upper == 2, lower + upper == 1
    _check_count(int(marked.sum()) + int(unknown.sum()))
    size, origin = message.resolutions, message.origin
    scale = np.array([size.x, size.y, size.z])
    centers = [
        (np.argwhere(chosen)[:, [1, 0, 2]] + 0.5) * scale + (origin.x, origin.y, origin.z)
        for chosen in (marked, unknown)
    ]
    points, offset = near_points(np.concatenate(centers))
    frame, stamp = header_of(message, options)
    description = CellsShape(
        kind="cells",
        frame=frame,
        stamp=stamp,
        points=(0, len(centers[0])),
        unknown=(3 * len(centers[0]), len(centers[1])),
        size=finite_all(scale),
    )
    return drawing_of_shapes(message, description, points, offset)


def _check_count(count: int) -> None:
    if count > MAX_CELLS:
        raise CannotDrawError(f"{count} cells are too many: the viewer draws at most {MAX_CELLS}")


GRID_CELLS = DisplayRow(
    name="GridCells",
    messages={"nav_msgs/msg/GridCells": draw_each_message(draw_grid_cells)},
    options=(ColorOption("Color", "#19ff00"), NumberOption("Alpha", 1.0, 0.0, 1.0, 0.05)),
    shapes=(CellsShape,),
    guide="GridCells",
)
VOXEL_GRID = DisplayRow(
    name="VoxelGrid",
    messages={"nav2_msgs/msg/VoxelGrid": draw_each_message(draw_voxel_grid)},
    options=(
        ColorOption("Color", "#ff8a1f", needs="Color By=Color"),
        ChoiceOption("Color By", "Height", ("Height", "Color")),
        NumberOption("Alpha", 1.0, 0.0, 1.0, 0.05),
        FlagOption("Show Unknown", False),
    ),
    shapes=(CellsShape,),
    guide="VoxelGrid of Nav2: the marked voxels, and optionally the unknown ones",
)
