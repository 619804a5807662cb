# SPDX-License-Identifier: Apache-2.0
"""Polygons, and single points."""

from __future__ import annotations

from typing import Any, Literal, TypedDict

import numpy as np

from coframe.viewer.displays._drawing import Drawing, Options, drawing_of_shapes, header_of, near_points
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import ColorOption, DisplayRow, NumberOption
from coframe.viewer.protocol.common import PayloadRows  # noqa: TC001 - the protocol evaluates annotations

__all__ = ["POINT", "POLYGON", "PointShape", "PolygonShape"]


class PolygonShape(TypedDict):
    """The corners of a closed polygon, as points."""

    kind: Literal["polygon"]
    frame: str
    stamp: float
    points: PayloadRows


class PointShape(TypedDict):
    """One point."""

    kind: Literal["point"]
    frame: str
    stamp: float
    points: PayloadRows


def draw_polygon(message: Any, options: Options) -> Drawing:
    """Draw the outline of a PolygonStamped."""
    corners = [(point.x, point.y, point.z) for point in message.polygon.points]
    points, offset = near_points(np.array(corners, np.float64).reshape(-1, 3))
    frame, stamp = header_of(message, options)
    description = PolygonShape(kind="polygon", frame=frame, stamp=stamp, points=(0, len(points)))
    return drawing_of_shapes(message, description, points, offset)


def draw_point(message: Any, options: Options) -> Drawing:
    """Draw a PointStamped as a sphere."""
    points, offset = near_points(np.array([[message.point.x, message.point.y, message.point.z]]))
    frame, stamp = header_of(message, options)
    description = PointShape(kind="point", frame=frame, stamp=stamp, points=(0, 1))
    return drawing_of_shapes(message, description, points, offset)


POLYGON = DisplayRow(
    name="Polygon",
    messages={"geometry_msgs/msg/PolygonStamped": draw_each_message(draw_polygon)},
    options=(ColorOption("Color", "#19ff00"), NumberOption("Alpha", 1.0, 0.0, 1.0, 0.05)),
    shapes=(PolygonShape,),
    projected=True,
    guide="PolygonStamped, such as the footprint of a robot",
)
POINT = DisplayRow(
    name="PointStamped",
    messages={"geometry_msgs/msg/PointStamped": draw_each_message(draw_point)},
    options=(
        ColorOption("Color", "#cc29cc"),
        NumberOption("Alpha", 1.0, 0.0, 1.0, 0.05),
        NumberOption("Radius", 0.2, 0.001, 100.0, 0.05, "m"),
        NumberOption("History Length", 1.0, 1.0, 1000.0, 1.0, sets="history"),
    ),
    shapes=(PointShape,),
    projected=True,
    guide="PointStamped as a sphere",
)
