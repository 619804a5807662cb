# SPDX-License-Identifier: Apache-2.0
"""Autoware sensor kits: sensor_kit_calibration.yaml and sensors_calibration.yaml."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.calibration.rig import Rig
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from coframe.calibration._values import Place

__all__ = ["CONVENTION", "is_autoware", "read_autoware"]

CONVENTION = (
    "parent, child, and the pose of the child in the parent: meters, and roll, pitch, yaw in radians as in URDF"
)
_KEYS = "x y z roll pitch yaw"


def is_autoware(document: Place) -> bool:
    """Return whether a YAML document is a mapping from parents to children to x, y, z, roll, pitch and yaw."""
    return bool(document.value) and all(
        isinstance(children, dict) and children and all(
            isinstance(pose, dict) and set(_KEYS.split()) <= set(pose) for pose in children.values()
        )
        for children in document.value.values()
    )  # fmt: skip


def read_autoware(document: Place) -> Rig:
    """Return the rig."""
    mounts = []
    for parent, children in document.items():
        for child, place in children.items():
            numbers = place.fields(_KEYS)
            mounts.append(Transform.from_rpy(numbers[:3], numbers[3:], target=parent, source=child))
    return Rig(tuple(mounts), format="Autoware sensor kit", convention=CONVENTION)
