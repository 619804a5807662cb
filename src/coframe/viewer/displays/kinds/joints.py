# SPDX-License-Identifier: Apache-2.0
"""Joints of a robot: efforts, and planned trajectories. The page places them with the robot that it shows."""

from __future__ import annotations

from typing import Any, Literal, TypedDict

import numpy as np

from coframe.viewer.displays._drawing import (
    NO_NUMBERS,
    CannotDrawError,
    Drawing,
    Options,
    drawing_of_shapes,
    finite_all,
    header_of,
)
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import ColorOption, DisplayRow, FlagOption, NumberOption
from coframe.viewer.protocol.common import PayloadRows  # noqa: TC001 - the protocol evaluates annotations

__all__ = ["EFFORT", "JOINT_TRAJECTORY", "EffortsShape", "TrajectoryShape"]

MAX_JOINTS = 1000
MAX_TRAJECTORY_POINTS = 2000


class EffortsShape(TypedDict):
    """The efforts of joints, in newtons or newton meters."""

    kind: Literal["efforts"]
    frame: str
    stamp: float
    joints: list[str]
    efforts: list[float | None]


class TrajectoryShape(TypedDict):
    """Positions of joints over time: one row per point, with one number per joint, in radians or meters."""

    kind: Literal["trajectory"]
    frame: str
    stamp: float
    joints: list[str]
    points: PayloadRows


def draw_efforts(message: Any, options: Options) -> Drawing:
    """Draw the efforts of a JointState."""
    if len(message.effort) != len(message.name):
        raise CannotDrawError(f"the JointState has {len(message.name)} joints, but {len(message.effort)} efforts")
    frame, stamp = header_of(message, options)
    description = EffortsShape(
        kind="efforts",
        frame=frame,
        stamp=stamp,
        joints=list(message.name[:MAX_JOINTS]),
        efforts=finite_all(message.effort[:MAX_JOINTS]),
    )
    drawing = drawing_of_shapes(message, description, NO_NUMBERS)
    drawing.placed = False
    return drawing


def draw_trajectory(message: Any, options: Options) -> Drawing:
    """Draw a JointTrajectory, thinned to the number of points that the page can draw."""
    joints = list(message.joint_names[:MAX_JOINTS])
    step = max(1, -(-len(message.points) // MAX_TRAJECTORY_POINTS))
    chosen = [*message.points[:-1:step], *message.points[-1:]]
    if any(len(point.positions) != len(message.joint_names) for point in chosen):
        raise CannotDrawError(f"a point of the trajectory does not have {len(message.joint_names)} positions")
    points = np.array([point.positions[:MAX_JOINTS] for point in chosen], np.float32).reshape(-1, max(len(joints), 1))
    frame, stamp = header_of(message, options)
    description = TrajectoryShape(
        kind="trajectory", frame=frame, stamp=stamp, joints=joints, points=(0, len(points) if joints else 0)
    )
    drawing = drawing_of_shapes(message, description, points)
    drawing.placed = False
    return drawing


EFFORT = DisplayRow(
    name="Effort",
    messages={"sensor_msgs/msg/JointState": draw_each_message(draw_efforts)},
    options=(
        NumberOption("Alpha", 1.0, 0.0, 1.0, 0.05),
        NumberOption("Width", 0.02, 0.001, 10.0, 0.01, "m"),
        NumberOption("Scale", 1.0, 0.0, 1000.0, 0.1),
    ),
    shapes=(EffortsShape,),
    automatic=False,
    has_surfaces=False,
    guide="JointState: the effort of each joint of a displayed robot as a circle, red at the limit of the joint",
    lacks="History Length: efforts are drawn at the current joints only",
)
JOINT_TRAJECTORY = DisplayRow(
    name="JointTrajectory",
    messages={"trajectory_msgs/msg/JointTrajectory": draw_each_message(draw_trajectory)},
    options=(
        ColorOption("Color", "#e93d82"),
        NumberOption("Alpha", 1.0, 0.0, 1.0, 0.05),
        FlagOption("Show End", True),
    ),
    shapes=(TrajectoryShape,),
    has_surfaces=False,
    guide="JointTrajectory: the paths of the links of a displayed robot, and the robot at the end",
)
