# SPDX-License-Identifier: Apache-2.0
"""Ranges of ultrasound and infrared sensors."""

from __future__ import annotations

from typing import Any, Literal, TypedDict

from coframe.viewer.displays._drawing import NO_NUMBERS, Drawing, Options, drawing_of_shapes, finite, header_of
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import ColorOption, DisplayRow, NumberOption

__all__ = ["RANGE", "RangeShape", "draw_range"]


class RangeShape(TypedDict):
    """A range measurement."""

    kind: Literal["range"]
    frame: str
    stamp: float
    range: float | None
    min_range: float | None
    max_range: float | None
    field_of_view: float | None
    radiation_type: int


def draw_range(message: Any, options: Options) -> Drawing:
    """Draw a Range as a cone."""
    frame, stamp = header_of(message, options)
    description = RangeShape(
        kind="range",
        frame=frame,
        stamp=stamp,
        range=finite(message.range),
        min_range=finite(message.min_range),
        max_range=finite(message.max_range),
        field_of_view=finite(message.field_of_view),
        radiation_type=message.radiation_type,
    )
    return drawing_of_shapes(message, description, NO_NUMBERS)


RANGE = DisplayRow(
    name="Range",
    messages={"sensor_msgs/msg/Range": draw_each_message(draw_range)},
    options=(
        ColorOption("Color", "#ffffff"),
        NumberOption("Alpha", 0.5, 0.0, 1.0, 0.05),
        NumberOption("Buffer Length", 1.0, 1.0, 1000.0, 1.0, sets="history"),
    ),
    shapes=(RangeShape,),
    guide="Range as a cone",
)
