"""A drawing: what the page needs of a message, and where that is."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from coframe.errors import CoframeError

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["MOST_POINTS", "CannotDrawError", "Drawing", "Options", "finite", "pose_row", "rgba_of"]

ColourBy = Literal["axis", "intensity", "rgb", "distance", "flat"]
_COLOURS: tuple[ColourBy, ...] = ("axis", "intensity", "rgb", "distance", "flat")
MOST_POINTS = 4_000_000
_MOST_KEPT = 1000


class CannotDrawError(CoframeError, ValueError):
    """A message that no drawing can be made of; the text says why."""


@dataclass(eq=False)
class Drawing:
    """What is drawn of a message.

    Attributes:
        frame: The frame that it is told in.
        stamp: When it was there, in nanoseconds; 0 is the latest.
        data: The binary message to the page, without its display and sequence.
        locked: Whether it moves on with its frame after that.
        placed: Whether it is somewhere; what is shown beside the scene is not.
    """

    frame: str
    stamp: int
    data: bytearray
    locked: bool = False
    placed: bool = True

    def take_data(self) -> bytearray:
        """The binary message, which the drawing lets go of: it is sent once, and may be large."""
        data, self.data = self.data, bytearray()
        return data


@dataclass(frozen=True)
class Options:
    """How a display draws.

    Attributes:
        color_by: What the colour of a point tells.
        axis: 0, 1 or 2: the coordinate where the colour tells that.
        decay: For how many seconds messages stay.
        keep: How many messages stay, at most; of Odometry how many poses.
        most_points: How many points of a cloud the page can draw.
        origin: What the times that the page is told are relative to, in nanoseconds.
    """

    color_by: ColourBy | None = None
    axis: int = 2
    decay: float = 0.0
    keep: int = 1
    most_points: int = MOST_POINTS
    origin: int = 0

    @classmethod
    def of(cls, told: Mapping[str, Any], origin: int = 0) -> Options:
        """From what a page sends; what it cannot be is left at its default."""
        colour = told.get("color_by")
        axis = told.get("axis")
        trail = told.get("trail", told.get("keep", 1))
        return cls(
            color_by=colour if colour in _COLOURS else None,
            axis={"x": 0, "y": 1, "z": 2, 0: 0, 1: 1, 2: 2}.get(axis, 2) if isinstance(axis, str | int) else 2,
            decay=_number(told.get("decay"), 0.0, 3600.0),
            keep=int(_number(trail, 1.0, _MOST_KEPT)),
            most_points=int(_number(told.get("most_points", MOST_POINTS), 1.0, MOST_POINTS)),
            origin=origin,
        )


def _number(value: Any, least: float, most: float) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or math.isnan(value):
        return least
    return float(min(max(value, least), most))


def finite(value: Any) -> float | None:
    """A number for JSON, which knows neither NaN nor infinity."""
    return float(value) if math.isfinite(value) else None


def pose_row(pose: Any) -> tuple[float, ...]:
    """x, y, z, qx, qy, qz, qw of a Pose message; a quaternion of zeros, which many programs leave, is no rotation."""
    p, q = pose.position, pose.orientation
    length = math.hypot(q.x, q.y, q.z, q.w)
    if length == 0.0:
        return (p.x, p.y, p.z, 0.0, 0.0, 0.0, 1.0)
    return (p.x, p.y, p.z, q.x / length, q.y / length, q.z / length, q.w / length)


def rgba_of(colour: Any) -> tuple[float | None, ...]:
    """Red, green, blue and alpha of a ColorRGBA message."""
    return tuple(finite(part) for part in (colour.r, colour.g, colour.b, colour.a))
