# SPDX-License-Identifier: Apache-2.0
"""The displays without a topic, which the page draws itself: frames, grids, axes, and robots."""

from __future__ import annotations

from coframe.viewer.displays._row import (
    FIXED_FRAME,
    ChoiceOption,
    ColorOption,
    DisplayRow,
    FlagOption,
    NumberOption,
    TextOption,
)

__all__ = ["AXES", "GRID", "ROBOT_MODEL", "TF"]

TF = DisplayRow(
    name="TF",
    options=(
        FlagOption("Show Names", True),
        FlagOption("Show Axes", True),
        FlagOption("Show Arrows", True),
        NumberOption("Marker Scale", 1.0, 0.01, 1000.0, 0.1),
        NumberOption("Frame Timeout", 15.0, 0.0, 86400.0, 1.0, "s"),
        TextOption("Filter (whitelist)", ""),
        TextOption("Filter (blacklist)", ""),
    ),
    guide="the frames with their names and arrows; needs no messages",
    has_surfaces=False,
)

GRID = DisplayRow(
    name="Grid",
    guide="a grid in a plane; needs no messages",
    options=(
        NumberOption("Cell Size", 1.0, 0.001, 10000.0, 0.1, "m"),
        NumberOption("Plane Cell Count", 10.0, 1.0, 1000.0, 1.0),
        NumberOption("Normal Cell Count", 0.0, 0.0, 100.0, 1.0),
        ChoiceOption("Plane", "XY", ("XY", "XZ", "YZ")),
        ColorOption("Color", ""),
        NumberOption("Alpha", 0.5, 0.0, 1.0, 0.05),
        ChoiceOption("Line Style/Value", "Lines", ("Lines", "Billboards"), label="Line Style"),
        NumberOption(
            "Line Style/Line Width",
            0.03,
            0.001,
            10.0,
            0.01,
            "m",
            label="Line Width",
            needs="Line Style/Value=Billboards",
        ),
        NumberOption("Offset/X", 0.0, -1e6, 1e6, 0.1, "m", label="Offset X"),
        NumberOption("Offset/Y", 0.0, -1e6, 1e6, 0.1, "m", label="Offset Y"),
        NumberOption("Offset/Z", 0.0, -1e6, 1e6, 0.1, "m", label="Offset Z"),
        TextOption("Reference Frame", FIXED_FRAME),
    ),
    has_surfaces=False,
)

AXES = DisplayRow(
    name="Axes",
    guide="the axes of one frame; needs no messages",
    options=(
        NumberOption("Length", 1.0, 0.001, 10000.0, 0.1, "m"),
        NumberOption("Radius", 0.1, 0.0001, 1000.0, 0.01, "m"),
        NumberOption("Alpha", 1.0, 0.0, 1.0, 0.05),
        TextOption("Reference Frame", FIXED_FRAME),
    ),
    has_surfaces=False,
)

ROBOT_MODEL = DisplayRow(
    name="RobotModel",
    guide=(
        "from `/robot_description`, the topics in a `.rviz` file, or a file; "
        "with textures from DAE, OBJ, GLB and the URDF"
    ),
    lacks="Mass Properties, the list of links, and Update Interval: the page draws each frame update",
    options=(
        FlagOption("Visual Enabled", True),
        FlagOption("Collision Enabled", False),
        NumberOption("Alpha", 1.0, 0.0, 1.0, 0.05),
        TextOption("TF Prefix", ""),
    ),
)
