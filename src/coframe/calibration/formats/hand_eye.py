# SPDX-License-Identifier: Apache-2.0
"""easy_handeye2 (.calib) and easy_handeye of ROS 1 (YAML)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.calibration.rig import Rig

if TYPE_CHECKING:
    from coframe.calibration._values import Place

__all__ = ["CONVENTION", "is_hand_eye", "read_hand_eye"]

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
