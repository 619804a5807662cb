# SPDX-License-Identifier: Apache-2.0
"""Positions of satellite navigation on a plain local grid: east, north and up from the first position."""

from __future__ import annotations

import math
from collections import deque
from typing import TYPE_CHECKING, Any, Literal, TypedDict

import numpy as np

from coframe.time import stamp_ns
from coframe.viewer.displays._drawing import FIXED_FRAME, CannotDrawError, Drawing, Options, finite_all, header_of
from coframe.viewer.displays._renderers import NewMessages
from coframe.viewer.displays._row import ColorOption, DisplayRow, FlagOption, NumberOption, TextOption
from coframe.viewer.protocol.common import PayloadRows  # noqa: TC001 - the protocol evaluates annotations
from coframe.viewer.protocol.encoding import encode_shapes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.viewer.displays.resources import Resources
    from coframe.viewer.sources.topic_messages import StampedMessage, TopicMessages

__all__ = ["NAV_SAT_FIX", "FixShape"]

_NO_FIX = -1
_SEMI_MAJOR_AXIS, _FLATTENING = 6378137.0, 1 / 298.257223563  # WGS 84
_ECCENTRICITY = _FLATTENING * (2 - _FLATTENING)


class FixShape(TypedDict):
    """Positions, oldest first, in meters: x to the east, y to the north, z up, from a latitude and longitude.

    ``covariance`` is that of the newest position, 3x3 in row-major order, or None.
    """

    kind: Literal["fix"]
    frame: str
    stamp: float
    points: PayloadRows
    covariance: list[float | None] | None
    latitude: float
    longitude: float


class FixRenderer:
    """Draws the last positions."""

    def __init__(self, messages: TopicMessages, options: Options, _resources: Resources) -> None:
        self._messages = messages
        self._new_messages = NewMessages(messages, options.keep)
        self._options = options
        self._trail: deque[Any] = deque(maxlen=options.keep)
        self._origin: Any = None

    def draw(self, message: StampedMessage, time: int, at: int) -> list[Drawing]:
        """Return the drawing of the message and of the trail that ends there."""
        del time, at
        continues, new = self._new_messages.until(message)
        if not continues:
            self._trail.clear()
        self._trail.extend(fix for one in new if _is_valid(fix := one.read()))
        if self._origin is None:
            known = (fix for one in self._messages.after(0, message.key) if _is_valid(fix := one.read()))
            self._origin = next(known, None)
        newest = message.read()
        if not self._trail or self._origin is None or not _is_valid(newest):
            raise CannotDrawError("the receiver has no position fix")
        return [self._draw(newest)]

    def has_changed(self, time: int, at: int) -> bool:
        """Return False."""
        del time, at
        return False

    def _draw(self, newest: Any) -> Drawing:
        options, origin = self._options, self._origin
        points = np.array([east_north_up(fix, origin) for fix in self._trail])
        frame, stamp = header_of(newest, options)
        covariance = finite_all(newest.position_covariance) if newest.position_covariance_type else None
        description = FixShape(
            kind="fix",
            frame=frame,
            stamp=stamp,
            points=(0, len(points)),
            covariance=covariance,
            latitude=origin.latitude,
            longitude=origin.longitude,
        )
        note = f"meters from {origin.latitude:.6f}°, {origin.longitude:.6f}°"
        data = encode_shapes(description, points.astype(np.float32))
        return Drawing(options.frame or FIXED_FRAME, stamp_ns(newest.header.stamp), data, locked=True, note=note)


def _is_valid(fix: Any) -> bool:
    numbers = (fix.latitude, fix.longitude)
    return fix.status.status != _NO_FIX and all(map(math.isfinite, numbers)) and abs(fix.latitude) <= 90


def east_north_up(fix: Any, origin: Any) -> NDArray[np.float64]:
    """Return the position of a fix on the plane that touches the ellipsoid at the origin, in meters, (3,)."""
    latitude, longitude = math.radians(origin.latitude), math.radians(origin.longitude)
    east = [-math.sin(longitude), math.cos(longitude), 0.0]
    up = [math.cos(latitude) * math.cos(longitude), math.cos(latitude) * math.sin(longitude), math.sin(latitude)]
    north = np.cross(up, east)
    local: NDArray[np.float64] = np.array([east, north, up]) @ (_geocentric(fix) - _geocentric(origin))
    return local


def _geocentric(fix: Any) -> NDArray[np.float64]:
    latitude, longitude = math.radians(fix.latitude), math.radians(fix.longitude)
    altitude = fix.altitude if math.isfinite(fix.altitude) else 0.0
    radius = _SEMI_MAJOR_AXIS / math.sqrt(1 - _ECCENTRICITY * math.sin(latitude) ** 2)
    across = (radius + altitude) * math.cos(latitude)
    height = (radius * (1 - _ECCENTRICITY) + altitude) * math.sin(latitude)
    return np.array([across * math.cos(longitude), across * math.sin(longitude), height])


NAV_SAT_FIX = DisplayRow(
    name="NavSatFix",
    messages={"sensor_msgs/msg/NavSatFix": FixRenderer},
    options=(
        ColorOption("Color", "#30a46c"),
        NumberOption("Alpha", 1.0, 0.0, 1.0, 0.05),
        NumberOption("Radius", 0.2, 0.001, 1000.0, 0.1, "m"),
        NumberOption("Keep", 500.0, 1.0, 1000.0, 10.0, sets="keep"),
        FlagOption("Covariance", True),
        TextOption("Reference Frame", "", sets="frame"),
    ),
    shapes=(FixShape,),
    guide="NavSatFix on a plain local grid: x to the east and y to the north of the first position, without a map",
)
