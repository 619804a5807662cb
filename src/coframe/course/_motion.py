# SPDX-License-Identifier: Apache-2.0
"""The analytic motion of the simulated robot, which a student's nodes have to publish."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from coframe.course.assignment import Assignment

__all__ = ["JOINT_PERIOD", "SimulatedRobot", "joint_angles"]

JOINT_PERIOD = 10.0  # seconds; common period of both joints, whose frequencies are 0.2 and 0.3 Hz
_SECOND = 1_000_000_000


def joint_angles(seconds: float) -> tuple[float, float]:
    """Return the angles of the two joints in the specified motion, in radians."""
    return (
        0.5 * math.sin(2 * math.pi * 0.2 * seconds),
        0.3 * math.sin(2 * math.pi * 0.3 * seconds + math.pi / 4),
    )


class SimulatedRobot(NamedTuple):
    """The robot of an assignment with the specified motion."""

    assignment: Assignment

    def arm(self, angles: tuple[float, float]) -> list[Transform]:
        """Return the transforms base_link -> link1 -> link2 -> end_effector for two joint angles."""
        first, second = self.assignment.link_lengths
        joints = (
            ("base_link", "link1", (0.0, 0.0, self.assignment.base_height), angles[0]),
            ("link1", "link2", (first, 0.0, 0.0), angles[1]),
            ("link2", "end_effector", (second, 0.0, 0.0), 0.0),
        )
        return [
            Transform.from_rpy(position, yaw=yaw, target=parent, source=child)
            for parent, child, position, yaw in joints
        ]

    def arm_at(self, stamp: int) -> list[Transform]:
        """Return the transforms of the arm at a stamp in nanoseconds."""
        return self.arm(joint_angles(stamp / _SECOND))

    def end_effector(self, stamp: int) -> Transform:
        """Return the pose of the end effector relative to base_link at a stamp in nanoseconds."""
        first, second, third = self.arm_at(stamp)
        return first @ second @ third

    def base(self, stamp: int) -> Transform:
        """Return the pose of base_link relative to odom at a stamp in nanoseconds: it drives a curve."""
        seconds = stamp / _SECOND
        yaw = 0.4 * math.sin(0.5 * seconds)
        return Transform.from_rpy(
            (0.1 * seconds, 0.2 * math.sin(0.3 * seconds), 0.0), yaw=yaw, target="odom", source="base_link"
        )

    def mounts(self) -> list[Transform]:
        """Return the static transforms of the sensors."""
        return [
            Transform(mount.translation, mount.quaternion, target=mount.parent, source=mount.frame)
            for mount in self.assignment.mounts
        ]
