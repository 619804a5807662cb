# SPDX-License-Identifier: Apache-2.0
"""Laser scans and point clouds: points with one scalar or one color each."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.sensors import project_scan
from coframe.sensors.layout import field_of, grid_of
from coframe.time import stamp_ns
from coframe.viewer.displays._drawing import MAX_NEAR, CannotDrawError, Drawing, Options, Vector, far_offset
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import ChoiceOption, ColorOption, DisplayRow, FlagOption, NumberOption, Option
from coframe.viewer.protocol.client_messages import MAX_POINTS
from coframe.viewer.protocol.encoding import encode_cloud

if TYPE_CHECKING:
    from numpy.typing import NDArray

_MAX_SAMPLED_POINTS = 64  # of each cloud; its points are close to each other

__all__ = ["LASER_SCAN", "POINT_CLOUD2", "draw_cloud", "draw_scan"]


def draw_scan(scan: Any, options: Options) -> Drawing:
    """Draw the end points of the beams of a LaserScan."""
    hits = project_scan(scan)
    points = hits.points.astype(np.float32)
    intensities = hits.intensities if options.color_by in {None, "intensity"} else None
    scalars = _scalars(points, options, intensities)
    return Drawing(hits.frame, hits.stamp, encode_cloud(float(hits.stamp - options.origin), points, scalars, None))


def draw_cloud(cloud: Any, options: Options) -> Drawing:
    """Draw a PointCloud2, thinned to the number of points that the page can draw, without non-finite points."""
    stamp = stamp_ns(cloud.header.stamp)
    try:
        count = int(np.prod(grid_of(cloud)))
        if count > MAX_POINTS:
            raise CannotDrawError(f"a cloud of {count} points is too large: the viewer draws at most {MAX_POINTS}")
        step = max(1, -(-count // options.max_points))
        points, offset = _positions(cloud, step)
        names = {field.name for field in cloud.fields}
        valid = np.isfinite(points).all(axis=1)
        dense = bool(valid.all())
        points = points if dense else points[valid]
        colors = None
        scalars = None
        name = next((name for name in ("rgb", "rgba") if name in names), None)
        if name is not None and options.color_by in {None, "rgb"}:
            colors = _colors(field_of(cloud, name).reshape(-1)[::step], alpha=name == "rgba")
            colors = colors if dense else colors[valid]
        else:
            intensities = None
            if options.color_by in {None, "intensity"}:
                intensities = _intensities(cloud, names, step)
                intensities = intensities if dense or intensities is None else intensities[valid]
            scalars = _scalars(points + np.array(offset, np.float32), options, intensities)
    except ValueError as error:
        raise CannotDrawError(str(error)) from None
    data = encode_cloud(float(stamp - options.origin), points, scalars, colors, step)
    return Drawing(cloud.header.frame_id, stamp, data, offset=offset)


def _positions(cloud: Any, step: int) -> tuple[NDArray[np.float32], Vector]:
    """Return the points, (N, 3), and the point to which they are relative."""
    columns = [field_of(cloud, name).reshape(-1)[::step] for name in "xyz"]
    points = np.empty((len(columns[0]), 3), np.float32)
    is_far = any(
        float(np.abs(column[:: 1 + len(column) // _MAX_SAMPLED_POINTS]).max(initial=0)) > MAX_NEAR for column in columns
    )
    offset = far_offset(np.stack(columns, axis=1).astype(np.float64)) if is_far else (0.0, 0.0, 0.0)
    for axis, column in enumerate(columns):
        with np.errstate(over="ignore"):
            points[:, axis] = column - offset[axis] if offset[axis] else column
    return points, offset


def _intensities(cloud: Any, names: set[str], step: int) -> NDArray[np.float32] | None:
    name = next((name for name in ("intensity", "intensities", "i") if name in names), None)
    return None if name is None else field_of(cloud, name).reshape(-1)[::step].astype(np.float32)


def _scalars(
    points: NDArray[np.float32], options: Options, intensities: NDArray[np.float32] | None
) -> NDArray[np.float32] | None:
    """Return the scalar that determines each point's color: the requested one, or the intensity or distance."""
    if options.color_by == "flat":
        return None
    if options.color_by == "axis":
        return points[:, options.axis]
    if intensities is not None:
        return intensities
    with np.errstate(over="ignore"):
        distances: NDArray[np.float32] = np.sqrt(np.einsum("ij,ij->i", points, points))
    return distances


def _colors(packed: NDArray[Any], *, alpha: bool) -> NDArray[np.uint8]:
    """Return red, green, blue and alpha from 0xAARRGGBB, which is often stored as if it were a float32."""
    if packed.dtype.itemsize != 4:
        raise CannotDrawError(f"the color field must have four bytes per point, not type {packed.dtype}")
    words = np.ascontiguousarray(packed.reshape(-1)).astype(packed.dtype.newbyteorder("<")).view("<u4")
    blue_first = words.view(np.uint8).reshape(-1, 4)
    colors = blue_first[:, [2, 1, 0, 3]]
    if not alpha:
        colors[:, 3] = 255
    return colors


def _options(size: float, transformer: str) -> tuple[Option, ...]:
    return (
        ChoiceOption(
            "Color Transformer",
            transformer,
            choices=("Intensity", "AxisColor", "RGB8", "FlatColor", "Distance"),
            meanings=("intensity", "axis", "rgb", "flat", "distance"),
            sets="color_by",
        ),
        ChoiceOption("Axis", "Z", choices=("X", "Y", "Z"), meanings=("x", "y", "z"), sets="axis"),
        FlagOption("Use Fixed Frame", True),
        ColorOption("Color", "#ff5a36"),
        ChoiceOption("Style", "Points", ("Points", "Flat Squares", "Spheres", "Boxes", "Squares")),
        NumberOption("Size (Pixels)", 3.0, 1.0, 40.0, 1.0),
        NumberOption("Size (m)", size, 0.001, 10.0, 0.01),
        NumberOption("Alpha", 1.0, 0.0, 1.0, 0.05),
        NumberOption("Decay Time", 0.0, 0.0, 3600.0, 0.5, "s", sets="decay"),
    )


LASER_SCAN = DisplayRow(
    name="LaserScan",
    rank=1,
    messages={"sensor_msgs/msg/LaserScan": draw_each_message(draw_scan)},
    options=_options(0.03, "Intensity"),
)
POINT_CLOUD2 = DisplayRow(
    name="PointCloud2",
    rank=4,
    max_automatic=2,
    messages={"sensor_msgs/msg/PointCloud2": draw_each_message(draw_cloud)},
    options=_options(0.01, "AxisColor"),
    large_in_replay=True,
)
