# SPDX-License-Identifier: Apache-2.0
"""Paths."""

from __future__ import annotations

from typing import Any, Literal, TypedDict

from coframe.viewer.displays._drawing import Drawing, Options, drawing_of_shapes, header_of, pose_row, pose_rows
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import ChoiceOption, ColorOption, DisplayRow, NumberOption
from coframe.viewer.protocol.common import PayloadRows  # noqa: TC001 - the protocol evaluates annotations

__all__ = ["PATH", "PathShape", "draw_path"]


class PathShape(TypedDict):
    """A path."""

    kind: Literal["path"]
    frame: str
    stamp: float
    poses: PayloadRows


def draw_path(message: Any, options: Options) -> Drawing:
    """Draw a Path, with all poses expressed in the frame of its own header."""
    poses, offset = pose_rows([pose_row(stamped.pose) for stamped in message.poses])
    frame, stamp = header_of(message, options)
    description = PathShape(kind="path", frame=frame, stamp=stamp, poses=(0, len(poses)))
    return drawing_of_shapes(message, description, poses, offset)


_ARROWS = "Pose Style=Arrows"
PATH = DisplayRow(
    name="Path",
    rank=3,
    messages={"nav_msgs/msg/Path": draw_each_message(draw_path)},
    options=(
        ColorOption("Color", "#19d245"),
        NumberOption("Alpha", 1.0, 0.0, 1.0, 0.05),
        ChoiceOption("Line Style", "Lines", ("Lines", "Billboards")),
        NumberOption("Line Width", 0.03, 0.001, 10.0, 0.01, "m", needs="Line Style=Billboards"),
        NumberOption("Buffer Length", 1.0, 1.0, 1000.0, 1.0, sets="history"),
        *(NumberOption(f"Offset/{axis}", 0.0, -1e6, 1e6, 0.1, "m", label=f"Offset {axis}") for axis in "XYZ"),
        ChoiceOption("Pose Style", "None", ("None", "Axes", "Arrows")),
        NumberOption("Length", 0.3, 0.001, 100.0, 0.05, "m", needs="Pose Style=Axes"),
        NumberOption("Radius", 0.03, 0.0005, 10.0, 0.005, "m", needs="Pose Style=Axes"),
        ColorOption("Pose Color", "#ff55ff", needs=_ARROWS),
        NumberOption("Shaft Length", 0.1, 0.001, 100.0, 0.05, "m", needs=_ARROWS),
        NumberOption("Shaft Diameter", 0.1, 0.0005, 10.0, 0.01, "m", needs=_ARROWS),
        NumberOption("Head Length", 0.2, 0.001, 100.0, 0.05, "m", needs=_ARROWS),
        NumberOption("Head Diameter", 0.3, 0.0005, 10.0, 0.01, "m", needs=_ARROWS),
    ),
    shapes=(PathShape,),
    guide="Path as a line, with axes or arrows at its poses",
    projected=True,
)
