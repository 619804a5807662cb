# SPDX-License-Identifier: Apache-2.0
"""The maximum error of a relay that thins transforms."""

from __future__ import annotations

import math
import re
from typing import NamedTuple

__all__ = ["MaxError"]

_NUMBER_AND_UNIT = re.compile(r"\s*(\d+(?:\.\d*)?|\.\d+)\s*([a-z]+)\s*", re.ASCII)
_METERS = {"um": 1e-6, "mm": 1e-3, "cm": 1e-2, "m": 1.0}
_RADIANS = {"deg": math.pi / 180, "mrad": 1e-3, "rad": 1.0}
_MAX_ANGLE = math.pi / 4


class MaxError(NamedTuple):
    """The maximum deviation of an interpolated transform of an edge from the original.

    Attributes:
        distance: The distance between the translations, in meters.
        angle: The angle between the rotations, in radians; at most 45 degrees.
    """

    distance: float
    angle: float

    @classmethod
    def of(cls, value: str | tuple[float, float]) -> MaxError:
        """Return a maximum error from a string or from two numbers.

        Args:
            value: A distance and an angle with their units, such as "1mm,0.1deg", or meters and radians. The units
                are um, mm, cm, m and deg, mrad, rad.

        Raises:
            ValueError: A part or a unit is missing, a value is negative, or the angle is larger than 45 degrees.

        Example:
            >>> MaxError.of("5mm,100mrad")
            MaxError(distance=0.005, angle=0.1)
        """
        distance, angle = _parse(value) if isinstance(value, str) else value
        if not (0 <= distance < math.inf and 0 <= angle <= _MAX_ANGLE):
            raise ValueError(
                f"the maximum error must not be negative, and its angle at most 45 degrees, not {value!r}: give for "
                "example 1mm,0.1deg"
            )
        return cls(float(distance), float(angle))


def _parse(text: str) -> tuple[float, float]:
    values: dict[str, float] = {}
    for part in text.split(","):
        match = _NUMBER_AND_UNIT.fullmatch(part)
        for kind, units in (("distance", _METERS), ("angle", _RADIANS)):
            if match and match[2] in units and kind not in values:
                values[kind] = float(match[1]) * units[match[2]]
                break
        else:
            raise ValueError(f"{text[:60]!r} is not a maximum error: give a distance and an angle, such as 1mm,0.1deg")
    if len(values) < 2:
        missing = "angle" if "distance" in values else "distance"
        raise ValueError(f"the maximum error {text[:60]!r} has no {missing}: give both, such as 1mm,0.1deg")
    return values["distance"], values["angle"]
