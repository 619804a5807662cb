# SPDX-License-Identifier: Apache-2.0
"""View frustums of cameras."""

from __future__ import annotations

from typing import Any, Literal, TypedDict

from coframe._output.formatting import error_text
from coframe.cameras import CameraError, lens_of
from coframe.viewer.displays._drawing import NO_NUMBERS, Drawing, Options, drawing_of_shapes, finite_all, header_of
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import ColorOption, DisplayRow, FlagOption, NumberOption

__all__ = ["CAMERA_INFO", "CameraShape", "draw_camera"]

MAX_DISTORTION_COEFFICIENTS = 16  # OpenCV's models have at most 14.


class CameraShape(TypedDict):
    """A camera: size in pixels, the matrices K, R and P in row-major order, and its lens, as in `coframe.cameras`."""

    kind: Literal["camera"]
    frame: str
    stamp: float
    width: int
    height: int
    k: list[float | None]
    p: list[float | None]
    r: list[float | None]
    distortion_model: str
    d: list[float | None]
    roi: list[int]
    binning: list[int]
    problem: str


def draw_camera(message: Any, options: Options) -> Drawing:
    """Draw the view frustum of a CameraInfo."""
    frame, stamp = header_of(message, options)
    model, d, problem = message.distortion_model, message.d[:MAX_DISTORTION_COEFFICIENTS], ""
    try:
        lens = lens_of(model, d)
        model, d = lens.name, lens.coefficients
    except CameraError as error:
        problem = error_text(error)
    roi = message.roi
    description = CameraShape(
        kind="camera",
        frame=frame,
        stamp=stamp,
        width=message.width,
        height=message.height,
        k=finite_all(message.k),
        p=finite_all(message.p),
        r=finite_all(message.r),
        distortion_model=model,
        d=finite_all(d),
        roi=[int(value) for value in (roi.x_offset, roi.y_offset, roi.width, roi.height)],
        binning=[max(1, int(message.binning_x)), max(1, int(message.binning_y))],
        problem=problem,
    )
    return drawing_of_shapes(message, description, NO_NUMBERS)


CAMERA_INFO = DisplayRow(
    name="CameraInfo",
    messages={"sensor_msgs/msg/CameraInfo": draw_each_message(draw_camera)},
    options=(
        NumberOption("Far clip", 0.5, 0.01, 1000.0, 0.1, "m", label="Length", aliases=("Far Clip",)),
        FlagOption("Show polygons", True),
        FlagOption("Not show side polygons", False, needs="Show polygons"),
        ColorOption("Color", "#f5d90a", needs="Show polygons"),
        NumberOption("Alpha", 0.15, 0.0, 1.0, 0.05, needs="Show polygons"),
        FlagOption("Show edges", True),
        ColorOption("Edge color", "#f5d90a", needs="Show edges"),
    ),
    shapes=(CameraShape,),
    guide="CameraInfo as a view frustum",
    lacks="the image plane: an Image display shows the image",
)
