# SPDX-License-Identifier: Apache-2.0
"""Vectors at the origin of a frame: velocities, accelerations, forces, and the measurements of an IMU."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypedDict

from coframe.viewer.displays._drawing import NO_NUMBERS, Drawing, Options, drawing_of_shapes, finite_all, header_of
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import ColorOption, DisplayRow, FlagOption, NumberOption, Option

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["ACCEL", "IMU", "TWIST", "WRENCH", "ImuShape", "ScrewShape"]


class ScrewShape(TypedDict):
    """Two vectors: a velocity, acceleration or force along its direction, and one around it."""

    kind: Literal["screw"]
    frame: str
    stamp: float
    linear: list[float | None]
    angular: list[float | None]


class ImuShape(TypedDict):
    """The orientation (a quaternion, or None if it is unknown), and the acceleration in m/s²."""

    kind: Literal["imu"]
    frame: str
    stamp: float
    orientation: list[float | None] | None
    acceleration: list[float | None]


def _xyz(vector: Any) -> list[float | None]:
    return finite_all((vector.x, vector.y, vector.z))


def _draw_screw(part: str, linear: str, angular: str) -> Callable[[Any, Options], Drawing]:
    """Return a function that draws two vectors of a part of a message."""

    def draw(message: Any, options: Options) -> Drawing:
        frame, stamp = header_of(message, options)
        vectors = getattr(message, part)
        description = ScrewShape(
            kind="screw",
            frame=frame,
            stamp=stamp,
            linear=_xyz(getattr(vectors, linear)),
            angular=_xyz(getattr(vectors, angular)),
        )
        return drawing_of_shapes(message, description, NO_NUMBERS)

    return draw


def draw_imu(message: Any, options: Options) -> Drawing:
    """Draw the orientation and the acceleration of an Imu; -1 as the first covariance means that there is none."""
    frame, stamp = header_of(message, options)
    q = message.orientation
    known = message.orientation_covariance[0] != -1 and any((q.x, q.y, q.z, q.w))
    description = ImuShape(
        kind="imu",
        frame=frame,
        stamp=stamp,
        orientation=finite_all((q.x, q.y, q.z, q.w)) if known else None,
        acceleration=_xyz(message.linear_acceleration),
    )
    return drawing_of_shapes(message, description, NO_NUMBERS)


def _screw_options(linear: str, angular: str, colors: tuple[str, str]) -> tuple[Option, ...]:
    return (
        ColorOption(f"{linear} Color", colors[0]),
        ColorOption(f"{angular} Color", colors[1]),
        NumberOption("Alpha", 1.0, 0.0, 1.0, 0.05),
        NumberOption(f"{linear} Arrow Scale", 2.0, 0.0, 1000.0, 0.1),
        NumberOption(f"{angular} Arrow Scale", 2.0, 0.0, 1000.0, 0.1),
        NumberOption("Arrow Width", 0.5, 0.0, 100.0, 0.1),
        FlagOption("Hide Small Values", True),
        NumberOption("History Length", 1.0, 1.0, 1000.0, 1.0, sets="history"),
    )


def _screw_display(
    name: str, ros_type: str, part: str, fields: tuple[str, str], labels: tuple[str, str], guide: str
) -> DisplayRow:
    return DisplayRow(
        name=name,
        messages={f"geometry_msgs/msg/{ros_type}": draw_each_message(_draw_screw(part, *fields))},
        options=_screw_options(*labels, ("#cc3333", "#cccc33")),
        shapes=(ScrewShape,),
        projected=True,
        guide=guide,
    )


_MOTION, _LABELS = ("linear", "angular"), ("Linear", "Angular")
WRENCH = _screw_display(
    "Wrench",
    "WrenchStamped",
    "wrench",
    ("force", "torque"),
    ("Force", "Torque"),
    "WrenchStamped as an arrow for the force, and an arrow in a circle for the torque",
)
TWIST = _screw_display(
    "TwistStamped", "TwistStamped", "twist", _MOTION, _LABELS, "TwistStamped, as Wrench with velocities"
)
ACCEL = _screw_display(
    "AccelStamped", "AccelStamped", "accel", _MOTION, _LABELS, "AccelStamped, as Wrench with accelerations"
)

_BOX, _AXES, _ACCELERATION = (
    "Box properties/Enable box",
    "Axes properties/Enable axes",
    "Acceleration properties/Enable acceleration",
)
IMU = DisplayRow(
    name="Imu",
    messages={"sensor_msgs/msg/Imu": draw_each_message(draw_imu)},
    options=(
        FlagOption(_BOX, False, label="Box"),
        NumberOption("Box properties/x_scale", 0.4, 0.001, 100.0, 0.05, "m", label="Box x", needs=_BOX),
        NumberOption("Box properties/y_scale", 0.3, 0.001, 100.0, 0.05, "m", label="Box y", needs=_BOX),
        NumberOption("Box properties/z_scale", 0.1, 0.001, 100.0, 0.05, "m", label="Box z", needs=_BOX),
        ColorOption("Box properties/Box color", "#ff0000", label="Box color", needs=_BOX),
        NumberOption("Box properties/Box alpha", 1.0, 0.0, 1.0, 0.05, label="Box alpha", needs=_BOX),
        FlagOption(_AXES, True, label="Axes"),
        NumberOption("Axes properties/Axes scale", 0.5, 0.001, 100.0, 0.05, "m", label="Axes scale", needs=_AXES),
        FlagOption(_ACCELERATION, True, label="Acceleration"),
        NumberOption(
            "Acceleration properties/Acc. vector scale",
            0.05,
            0.0,
            100.0,
            0.01,
            label="Acceleration scale",
            needs=_ACCELERATION,
        ),
        ColorOption(
            "Acceleration properties/Acc. vector color", "#ffaa00", label="Acceleration color", needs=_ACCELERATION
        ),
        NumberOption(
            "Acceleration properties/Acc. vector alpha",
            1.0,
            0.0,
            1.0,
            0.05,
            label="Acceleration alpha",
            needs=_ACCELERATION,
        ),
    ),
    shapes=(ImuShape,),
    projected=True,
    guide="Imu: the orientation as axes or a box in the sensor's frame, and the acceleration as an arrow",
)
