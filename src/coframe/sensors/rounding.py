# SPDX-License-Identifier: Apache-2.0
"""The rounding of float32 coordinates far from the origin of their frame, and clouds with float64 instead."""

from __future__ import annotations

import sys
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe._base_error import CoframeWarning
from coframe.sensors import layout

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

__all__ = ["MIN_FAR_DISTANCE", "as_float64", "float32_step", "rounding_text", "warn_of_rounding"]

MIN_FAR_DISTANCE = 16_384.0
"""From this distance in meters on, neighboring float32 numbers differ by more than 1 mm."""
_SAMPLED_POINTS = 64  # points that are looked at: those of a cloud are close to each other
_MIN_MILLIMETERS, _MILLIMETERS_PER_METER = 0.9995, 1000.0


def float32_step(distance: float) -> float:
    """Return the distance in meters between a float32 coordinate and the next one."""
    return float(np.spacing(np.float32(distance)))


def rounding_text(distance: float) -> str:
    """Return a clause about the rounding of float32 coordinates at this distance from the origin."""
    step = float32_step(distance) * _MILLIMETERS_PER_METER
    text = f"{step:.3g} mm" if step < _MILLIMETERS_PER_METER else f"{step / _MILLIMETERS_PER_METER:g} m"
    return f"float32 rounds coordinates of {distance:.0f} m to steps of {text}"


def largest_coordinate(coordinates: Iterable[NDArray[Any]]) -> float:
    """Return the largest coordinate of some of the points in meters; infinite and NaN are ignored."""
    largest = 0.0
    for each in coordinates:
        some = np.abs(each.reshape(-1)[:: max(1, each.size // _SAMPLED_POINTS)].astype(np.float64))
        largest = max(largest, float(some[np.isfinite(some)].max(initial=0.0)))
    return largest


def warn_of_rounding(distance: float, position: tuple[NDArray[Any], ...], advice: str) -> None:
    """Warn if coordinates that are stored as float32 are far from the origin."""
    if distance >= MIN_FAR_DISTANCE and any(each.dtype.itemsize == 4 for each in position):
        message = f"{rounding_text(distance)}. {advice}"
        warnings.warn(message, CoframeWarning, stacklevel=_caller_level())


def as_float64(points: Any) -> Any:
    """Return a copy of a message or an array whose x, y and z are float64. Other fields keep their types.

    Raises:
        ValueError: The message has a field with an unknown type, or its sizes do not match its data.
    """
    if layout.is_message(points):
        return layout.message_with_float64(points)
    if points.dtype.names is None:
        return points.astype(np.float64)
    kinds = [(name, np.float64 if name in {"x", "y", "z"} else points.dtype[name]) for name in points.dtype.names]
    return points.astype(kinds)


def _caller_level() -> int:
    """Return the stack level of the first caller outside of coframe and its ROS packages' conversions."""
    level, frame = 2, sys._getframe(2)  # noqa: SLF001
    while frame.f_back is not None and str(frame.f_globals.get("__name__", "")).startswith(_OWN_MODULES):
        level, frame = level + 1, frame.f_back
    return level


_OWN_MODULES = ("coframe.", "tf2_ros", "tf2_sensor_msgs")
