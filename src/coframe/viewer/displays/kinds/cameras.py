# SPDX-License-Identifier: Apache-2.0
"""View frustums of cameras."""

from __future__ import annotations

from typing import Any, Literal, TypedDict

from coframe.viewer.displays._drawing import NO_NUMBERS, Drawing, Options, drawing_of_shapes, finite_all, header_of
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import ColorOption, DisplayRow, NumberOption

__all__ = ["CAMERA_INFO", "CameraShape", "draw_camera"]

MAX_DISTORTION_COEFFICIENTS = 16  # OpenCV's models have at most 14.


class CameraShape(TypedDict):
    """The intrinsics of a camera: image size in pixels, the 3x3 matrix K and the 3x4 matrix P in row-major order."""

    kind: Literal["camera"]
    frame: str
    stamp: float
    width: int
    height: int
    k: list[float | None]
    p: list[float | None]
    distortion_model: str
    d: list[float | None]


def draw_camera(message: Any, options: Options) -> Drawing:
    """Draw the view frustum of a CameraInfo."""
    frame, stamp = header_of(message, options)
    description = CameraShape(
        kind="camera",
        frame=frame,
        stamp=stamp,
        width=message.width,
        height=message.height,
        k=finite_all(message.k),
        p=finite_all(message.p),
        distortion_model=message.distortion_model,
        d=finite_all(message.d[:MAX_DISTORTION_COEFFICIENTS]),
    )
    return drawing_of_shapes(message, description, NO_NUMBERS)


CAMERA_INFO = DisplayRow(
    name="CameraInfo",
    messages={"sensor_msgs/msg/CameraInfo": draw_each_message(draw_camera)},
    options=(
        NumberOption("Far Clip", 0.5, 0.01, 1000.0, 0.1, "m", label="Length"),
        ColorOption("Color", "#f5d90a"),
        NumberOption("Alpha", 0.15, 0.0, 1.0, 0.05),
    ),
    shapes=(CameraShape,),
)
