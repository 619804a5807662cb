# SPDX-License-Identifier: Apache-2.0
"""Quantities of poses with a name: coordinates, angles and the distance."""

from __future__ import annotations

from typing import TYPE_CHECKING

import coframe.lazy_numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.transform.transform import Transform

__all__ = ["ANGLES", "POSE_QUANTITIES", "coordinate"]

ANGLES = ("roll", "pitch", "yaw")
POSE_QUANTITIES = ("x", "y", "z", *ANGLES, "distance")


def coordinate(poses: Transform, quantity: str) -> NDArray[np.float64]:
    """Return a quantity of each of N poses: x, y, z and distance in meters, roll, pitch and yaw in radians, (N,)."""
    if quantity in ANGLES:
        return poses.rpy[:, ANGLES.index(quantity)]
    if quantity == "distance":
        with np.errstate(over="ignore"):  # hypot is infinite only if the distance is
            return np.asarray(np.hypot.reduce(poses.translation, axis=1))
    return poses.translation[:, "xyz".index(quantity)]
