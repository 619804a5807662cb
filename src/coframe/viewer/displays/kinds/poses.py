# SPDX-License-Identifier: Apache-2.0
"""Poses: Pose, PoseArray, PoseWithCovariance, and Odometry with a trail."""

from __future__ import annotations

from collections import deque
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal, TypedDict

from coframe.viewer.displays._drawing import (
    Drawing,
    Options,
    PoseRow,
    drawing_of_shapes,
    finite_all,
    header_of,
    pose_row,
    pose_rows,
)
from coframe.viewer.displays._renderers import NewMessages, draw_each_message
from coframe.viewer.displays._row import ChoiceOption, ColorOption, DisplayRow, FlagOption, NumberOption, Option
from coframe.viewer.protocol.common import PayloadRows  # noqa: TC001 - the protocol evaluates annotations

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.viewer.displays.resources import Resources
    from coframe.viewer.sources.topic_messages import StampedMessage, TopicMessages

__all__ = ["ODOMETRY", "POSE", "POSE_ARRAY", "POSE_WITH_COVARIANCE", "OdometryShape", "PosesShape"]


class PosesShape(TypedDict):
    """Poses of one message; 36 covariances, or none."""

    kind: Literal["poses"]
    frame: str
    stamp: float
    poses: PayloadRows
    covariance: list[float | None] | None


class OdometryShape(TypedDict):
    """The trail of an odometry topic, newest pose last."""

    kind: Literal["odometry"]
    frame: str
    child_frame: str
    stamp: float
    poses: PayloadRows
    covariance: list[float | None] | None


def draw_pose(message: Any, options: Options) -> Drawing:
    """Draw a PoseStamped, or a PoseWithCovarianceStamped with its covariance."""
    pose = message.pose
    covariance = getattr(pose, "covariance", None)
    if covariance is None:
        return _draw_poses(message, [pose_row(pose)], None, options)
    return _draw_poses(message, [pose_row(pose.pose)], finite_all(covariance), options)


def draw_pose_array(message: Any, options: Options) -> Drawing:
    """Draw a PoseArray."""
    return _draw_poses(message, [pose_row(pose) for pose in message.poses], None, options)


def draw_odometry(message: Any, trail: Sequence[PoseRow], options: Options) -> Drawing:
    """Draw an Odometry message with a trail of the previous poses."""
    poses, offset = pose_rows(trail)
    frame, stamp = header_of(message, options)
    description = OdometryShape(
        kind="odometry",
        frame=frame,
        child_frame=message.child_frame_id,
        stamp=stamp,
        poses=(0, len(poses)),
        covariance=finite_all(message.pose.covariance),
    )
    return drawing_of_shapes(message, description, poses, offset)


class OdometryRenderer:
    """Draws the last poses as a trail."""

    def __init__(self, messages: TopicMessages, options: Options, _resources: Resources) -> None:
        self._new_messages = NewMessages(messages, options.keep)
        self._options = options
        self._trail: deque[PoseRow] = deque(maxlen=options.keep)

    def draw(self, message: StampedMessage, time: int, at: int) -> list[Drawing]:
        """Return the drawing of the message and of the trail that ends there."""
        del time, at
        continues, new = self._new_messages.until(message)
        if not continues:
            self._trail.clear()
        for one in new:
            self._trail.append(pose_row(one.read().pose.pose))
        return [draw_odometry(message.read(), list(self._trail), self._options)]

    def has_changed(self, time: int, at: int) -> bool:
        """Return False."""
        del time, at
        return False


def _draw_poses(
    message: Any, rows: Sequence[PoseRow], covariance: list[float | None] | None, options: Options
) -> Drawing:
    poses, offset = pose_rows(rows)
    frame, stamp = header_of(message, options)
    description = PosesShape(kind="poses", frame=frame, stamp=stamp, poses=(0, len(poses)), covariance=covariance)
    return drawing_of_shapes(message, description, poses, offset)


_SHAPE = (
    ChoiceOption("Shape", "Arrow", ("Arrow", "Axes")),
    ColorOption("Color", "#ff8a1f"),
    NumberOption("Alpha", 1.0, 0.0, 1.0, 0.05),
    NumberOption("Shaft Length", 0.35, 0.001, 100.0, 0.05, "m", needs="Shape=Arrow"),
    NumberOption("Shaft Radius", 0.02, 0.0005, 10.0, 0.005, "m", needs="Shape=Arrow"),
    NumberOption("Head Length", 0.12, 0.001, 100.0, 0.01, "m", needs="Shape=Arrow"),
    NumberOption("Head Radius", 0.045, 0.001, 10.0, 0.005, "m", needs="Shape=Arrow"),
    NumberOption("Axes Length", 0.3, 0.001, 100.0, 0.05, "m", needs="Shape=Axes"),
    NumberOption("Axes Radius", 0.02, 0.0005, 10.0, 0.005, "m", needs="Shape=Axes"),
)
_ARRAY_SHAPE: tuple[Option, ...] = (
    ChoiceOption("Shape", "Arrow (3D)", ("Arrow (Flat)", "Arrow (3D)", "Axes")),
    *_SHAPE[1:3],
    NumberOption("Arrow Length", 0.3, 0.001, 100.0, 0.05, "m", needs="Shape=Arrow (Flat)"),
    *(replace(option, needs=option.needs.replace("Arrow", "Arrow (3D)")) for option in _SHAPE[3:]),
)
# RViz 2 nests the options of the shape of an Odometry display; those of poses are not nested.
_NESTED_SHAPE = (
    replace(_SHAPE[0], key="Shape/Value", label="Shape"),
    *(
        replace(
            option,
            key=f"Shape/{option.key}",
            label=option.key,
            aliases=(option.key,),
            needs=option.needs.replace("Shape=", "Shape/Value="),
        )
        for option in _SHAPE[1:]
    ),
)
_COVARIANCE_KEY = "Covariance/Value"
_COVARIANCE = (
    FlagOption(_COVARIANCE_KEY, True, label="Covariance"),
    FlagOption("Covariance/Position/Value", True, label="Position", needs=_COVARIANCE_KEY),
    NumberOption("Covariance/Position/Scale", 1.0, 0.0, 1000.0, 1.0, label="Position Scale", needs=_COVARIANCE_KEY),
    ColorOption("Covariance/Position/Color", "#cc33cc", label="Position Color", needs=_COVARIANCE_KEY),
    NumberOption("Covariance/Position/Alpha", 0.3, 0.0, 1.0, 0.05, label="Position Alpha", needs=_COVARIANCE_KEY),
    FlagOption("Covariance/Orientation/Value", True, label="Orientation", needs=_COVARIANCE_KEY),
    NumberOption(
        "Covariance/Orientation/Scale", 1.0, 0.0, 1000.0, 1.0, label="Orientation Scale", needs=_COVARIANCE_KEY
    ),
    NumberOption(
        "Covariance/Orientation/Offset", 1.0, 0.0, 100.0, 0.1, "m", label="Orientation Offset", needs=_COVARIANCE_KEY
    ),
    ColorOption("Covariance/Orientation/Color", "#ffff7f", label="Orientation Color", needs=_COVARIANCE_KEY),
    NumberOption("Covariance/Orientation/Alpha", 0.5, 0.0, 1.0, 0.05, label="Orientation Alpha", needs=_COVARIANCE_KEY),
)

POSE = DisplayRow(
    name="Pose",
    guide="PoseStamped as an arrow or axes",
    messages={"geometry_msgs/msg/PoseStamped": draw_each_message(draw_pose)},
    options=_SHAPE,
    shapes=(PosesShape,),
    projected=True,
)
POSE_ARRAY = DisplayRow(
    name="PoseArray",
    guide="PoseArray as flat or solid arrows, or axes",
    messages={"geometry_msgs/msg/PoseArray": draw_each_message(draw_pose_array)},
    options=_ARRAY_SHAPE,
    shapes=(PosesShape,),
    projected=True,
)
POSE_WITH_COVARIANCE = DisplayRow(
    name="PoseWithCovariance",
    rank=3,
    guide=(
        "PoseWithCovarianceStamped; the covariance is an ellipsoid of one standard deviation "
        "and a cone around the x axis"
    ),
    lacks="Color Style *Unique* of the orientation, which is drawn as one cone",
    messages={"geometry_msgs/msg/PoseWithCovarianceStamped": draw_each_message(draw_pose)},
    options=(*_SHAPE, *_COVARIANCE),
    shapes=(PosesShape,),
    projected=True,
)
ODOMETRY = DisplayRow(
    name="Odometry",
    rank=3,
    guide="Odometry with a trail of the poses that differ by the tolerances, and covariances as PoseWithCovariance",
    messages={"nav_msgs/msg/Odometry": OdometryRenderer},
    options=(*_NESTED_SHAPE, NumberOption("Keep", 100.0, 1.0, 1000.0, 10.0, sets="keep"), *_COVARIANCE),
    shapes=(OdometryShape,),
    projected=True,
)
