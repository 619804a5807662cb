# SPDX-License-Identifier: Apache-2.0
"""easy_handeye2 (.calib) and easy_handeye of ROS 1 (YAML)."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from coframe.calibration.rig import Rig
from coframe.errors import CalibrationError

if TYPE_CHECKING:
    from coframe.calibration._values import Place

__all__ = ["CONVENTION", "hand_eye_text", "is_hand_eye", "read_hand_eye"]

CONVENTION = (
    "the pose of the tracking base (the camera) in the effector (eye in hand) or in the robot's base (eye on base); "
    "meters, quaternion by its names"
)


def is_hand_eye(document: Place) -> bool:
    """Return whether a YAML document is a result of easy_handeye."""
    return "parameters" in document and ("transform" in document or "transformation" in document)


def read_hand_eye(document: Place) -> Rig:
    """Return the rig with one mount."""
    parameters = document["parameters"]
    if "calibration_type" in parameters:
        on_hand = parameters["calibration_type"].text() == "eye_in_hand"
    else:
        on_hand = parameters["eye_on_hand"].value is True
    parent = parameters["robot_effector_frame" if on_hand else "robot_base_frame"].text()
    child = parameters["tracking_base_frame"].text()
    if "transform" in document:
        place = document["transform"]
        translation, turn = place["translation"].fields("x y z"), place["rotation"].fields("x y z w")
    else:
        place = document["transformation"]
        translation, turn = place.fields("x y z"), place.fields("qx qy qz qw")
    mount = place.pose(translation, turn).replace(target=parent, source=child)
    return Rig((mount,), format="easy_handeye2" if "transform" in document else "easy_handeye", convention=CONVENTION)


def hand_eye_text(rig: Rig) -> str:
    """Return the .calib file of easy_handeye2 for the only mount; a parent named like a base is the robot's base.

    Raises:
        CalibrationError: There are several mounts.
    """
    if len(rig.transforms) != 1:
        raise CalibrationError(f"easy_handeye2 has one mount, and the calibration has {len(rig.transforms)}")
    (mount,) = rig.transforms
    on_base = any(word in str(mount.target) for word in ("base", "world", "map", "odom"))
    base, effector = (json.dumps(mount.target if each else "") for each in (on_base, not on_base))
    xyz, xyzw = ((repr(float(value) + 0.0) for value in part) for part in (mount.translation, mount.quaternion))
    lines = [
        "parameters:",
        f"  calibration_type: {'eye_on_base' if on_base else 'eye_in_hand'}",
        f"  name: {json.dumps(mount.source)}",
        f"  robot_base_frame: {base}",
        f"  robot_effector_frame: {effector}",
        f"  tracking_base_frame: {json.dumps(mount.source)}",
        '  tracking_marker_frame: ""',
        "transform:",
        "  rotation:",
        *(f"    {key}: {value}" for key, value in zip("xyzw", xyzw, strict=True)),
        "  translation:",
        *(f"    {key}: {value}" for key, value in zip("xyz", xyz, strict=True)),
    ]
    return "\n".join([*lines, ""])
