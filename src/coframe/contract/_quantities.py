# SPDX-License-Identifier: Apache-2.0
"""Quantities with units, as contracts and options contain them: ``5mm, 0.2deg``, ``300ms``, ``99%``."""

from __future__ import annotations

import math
import re

from coframe.time import MICROSECOND, MILLISECOND, SECOND

__all__ = ["DEFAULT_TOLERANCE", "duration_text", "parse_share", "parse_tolerance", "tolerance_text"]

_QUANTITY = re.compile(r"(\d+(?:\.\d+)?(?:[eE][-+]?\d+)?)\s*([a-z]+)", re.ASCII)
_METERS = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6}
_RADIANS = {"rad": 1.0, "mrad": 1e-3, "deg": math.pi / 180}
_DURATIONS = (("s", SECOND), ("ms", MILLISECOND), ("us", MICROSECOND), ("ns", 1))
_MAX_LENGTH = 100
DEFAULT_TOLERANCE = (0.001, math.radians(0.1))  # meters and radians


def parse_tolerance(text: str) -> tuple[float, float]:
    """Return the meters and the radians of a string such as ``5mm, 0.2deg``.

    Raises:
        ValueError: The text is not a distance and an angle with their units.
    """
    parts = [_QUANTITY.fullmatch(part.strip()) for part in str(text)[:_MAX_LENGTH].split(",")]
    if len(parts) == 2 and parts[0] and parts[1]:
        (size, meters), (angle, radians) = parts[0].groups(), parts[1].groups()
        if meters in _METERS and radians in _RADIANS:
            return float(size) * _METERS[meters], float(angle) * _RADIANS[radians]
    raise ValueError(
        f"{str(text)[:_MAX_LENGTH]!r} is not a distance and an angle with their units, such as '5mm, 0.2deg'"
    )


def tolerance_text(tolerance: tuple[float, float]) -> str:
    """Return a tolerance as :func:`parse_tolerance` reads it."""
    return f"{tolerance[0] * 1e3:.6g}mm, {math.degrees(tolerance[1]):.6g}deg"


def parse_share(text: str) -> float:
    """Return the fraction of a percentage such as ``99%``.

    Raises:
        ValueError: The text is not a percentage from 0% to 100%.
    """
    match = re.fullmatch(r"(\d{1,3}(?:\.\d{1,9})?)\s*%", str(text)[:_MAX_LENGTH].strip(), re.ASCII)
    if match is None or float(match[1]) > 100:
        raise ValueError(f"{str(text)[:_MAX_LENGTH]!r} is not a percentage from 0% to 100%")
    return float(match[1]) / 100


def duration_text(nanoseconds: int) -> str:
    """Return a duration as an integer with the largest unit that gives one."""
    unit, size = next((unit, size) for unit, size in _DURATIONS if nanoseconds % size == 0)
    return f"{nanoseconds // size}{unit}"
