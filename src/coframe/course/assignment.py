# SPDX-License-Identifier: Apache-2.0
"""The parameters of the lab: the arm, the sensor mounts and the rates, which can differ between students."""

from __future__ import annotations

import json
import math
import os
import random
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe._files.os_errors import reason
from coframe.course.submitted import read_submitted
from coframe.errors import CourseError

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["ASSIGNMENT_FILE", "Assignment", "Mount", "assignment_of", "read_assignment", "recorded_language"]

ASSIGNMENT_FILE = "lab.json"  # in a student's folder; contains the variant's seed and the language
_LAB = "09-02"
NO_ROTATION = (0.0, 0.0, 0.0, 1.0)
# A rotation of 90 degrees about y: the z axis of the camera points along the gripper.
LOOK_FORWARD = (0.0, math.sqrt(0.5), 0.0, math.sqrt(0.5))


class Mount(NamedTuple):
    """The static transform of a sensor.

    Attributes:
        parent: The frame on which the sensor is mounted.
        frame: The frame of the sensor.
        translation: The position x, y, z relative to the parent, in meters.
        quaternion: The rotation x, y, z, w relative to the parent.
    """

    parent: str
    frame: str
    translation: tuple[float, float, float]
    quaternion: tuple[float, float, float, float] = NO_ROTATION


class Assignment(NamedTuple):
    """The parameters that a student's nodes have to use. The defaults are those of the lab.

    Attributes:
        variant: The seed of the variant, or None for the lab's own parameters.
        base_height: The height of the first joint above base_link, in meters.
        link_lengths: The lengths of the two links, in meters.
        camera: The mount of the camera on the end effector.
        imu: The mount of the IMU on the base.
        lidar: The mount of the lidar on the base.
        dynamic_rate: The rate of the transforms of the arm, in Hz.
        listener_rate: The rate of the poses of the end effector, in Hz.
    """

    variant: int | None = None
    base_height: float = 0.1
    link_lengths: tuple[float, float] = (0.5, 0.4)
    camera: Mount = Mount("end_effector", "camera_link", (0.05, 0.0, 0.02), LOOK_FORWARD)
    imu: Mount = Mount("base_link", "imu_link", (0.0, 0.0, 0.1))
    lidar: Mount = Mount("base_link", "lidar_link", (0.0, 0.0, 0.5))
    dynamic_rate: float = 50.0
    listener_rate: float = 10.0

    @property
    def mounts(self) -> tuple[Mount, Mount, Mount]:
        """The mounts of the three sensors."""
        return self.camera, self.imu, self.lidar


def assignment_of(variant: int | None) -> Assignment:
    """Return the assignment of a variant. The same seed always gives the same assignment.

    Args:
        variant: Any integer, for example a student number. None for the lab's own parameters.
    """
    if variant is None:
        return Assignment()
    choose = random.Random(variant)  # noqa: S311 - not a secret
    step = 0.05  # meters

    def length(minimum: int, most: int) -> float:
        return round(choose.randint(minimum, most) * step, 2)

    return Assignment(
        variant,
        base_height=length(2, 6),
        link_lengths=(length(6, 14), length(5, 12)),
        camera=Mount("end_effector", "camera_link", (length(1, 3), 0.0, length(0, 2)), LOOK_FORWARD),
        imu=Mount("base_link", "imu_link", (length(-2, 2), length(-2, 2), length(1, 4))),
        lidar=Mount("base_link", "lidar_link", (length(-2, 4), 0.0, length(6, 12))),
        dynamic_rate=float(choose.choice((25, 50, 100))),
        listener_rate=float(choose.choice((5, 10, 20))),
    )


def read_assignment(folder: Path) -> Assignment:
    """Return the assignment of a student's folder. The lab's own if it has no file ``lab.json``.

    Raises:
        CourseError: The file is damaged, or belongs to another lab.
    """
    path = folder / ASSIGNMENT_FILE
    if not os.path.lexists(path):
        return Assignment()
    content = _read(path)
    variant = content.get("variant")
    if content.get("lab") != _LAB or not isinstance(variant, int | None):
        raise CourseError(f"{path} does not describe an assignment of lab {_LAB}.", hint=_HINT)
    return assignment_of(variant)


def recorded_language(folder: Path) -> str:
    """Return the code of the language in which a student's folder was created, or "" if ``lab.json`` has none."""
    try:
        code = _read(folder / ASSIGNMENT_FILE).get("language")
    except CourseError:  # The grade says what is wrong with the file.
        return ""
    return code if isinstance(code, str) else ""


def assignment_file(assignment: Assignment, language: str) -> str:
    """Return the text of the file ``lab.json``, with the code of the language of the tasks."""
    return json.dumps({"lab": _LAB, "variant": assignment.variant, "language": language}, indent=2) + "\n"


def _read(path: Path) -> dict[str, Any]:
    """Return the content of ``lab.json``, or an empty one if it is not an object."""
    try:
        content = json.loads(read_submitted(path))
    except (OSError, ValueError, RecursionError) as error:
        raise CourseError(f"Cannot read {path}: {reason(error)}", hint=_HINT) from None
    return content if isinstance(content, dict) else {}


_HINT = "Create the folder again with coframe lab new, and copy your nodes into it."
