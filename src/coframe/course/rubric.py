# SPDX-License-Identifier: Apache-2.0
"""The criteria of a grade: their names, files and points."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["CRITERIA", "RUBRIC", "Criterion"]


class Criterion(NamedTuple):
    """A criterion.

    Attributes:
        name: The name in reports.
        file: The student's file to check.
        points: The points of all its facts.
        bonus: Whether its points are added to the 100.
    """

    name: str
    file: str
    points: int
    bonus: bool = False


# By module of coframe.course.criteria, in the order of the check; all after the first five are extensions.
RUBRIC = {
    "static": Criterion("Static transforms", "static_tf_broadcaster.py", 20),
    "dynamic": Criterion("Dynamic transforms", "dynamic_tf_broadcaster.py", 25),
    "listener": Criterion("Transform listener", "tf_listener.py", 20),
    "sensor": Criterion("Sensor transform", "sensor_transform.py", 20),
    "visualization": Criterion("Visualization", "complete_tf_tree.py", 15),
    "urdf": Criterion("Extension: URDF", "arm.urdf", 10, bonus=True),
    "time_travel": Criterion("Extension: time travel", "time_travel.py", 10, bonus=True),
    "several_robots": Criterion("Extension: several robots", "multi_robot.py", 10, bonus=True),
    "monitor": Criterion("Extension: transform monitor", "tf_monitor.py", 10, bonus=True),
}
CRITERIA = tuple(RUBRIC)
