# SPDX-License-Identifier: Apache-2.0
"""Compute transforms from joint states by the rules of robot_state_publisher. This module does not publish them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.time import MILLISECOND

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from coframe.robots._robot import Robot
    from coframe.transform.transform import Transform

__all__ = ["StatePublisher"]


class StatePublisher:
    """Computes the transforms that robot_state_publisher would publish for a robot.

    Args:
        robot: The description of the robot.
        frequency: The maximum rate for each joint, in Hz. If 0, each joint is published once.
        ignore_stamps: Whether every joint state is published, regardless of `frequency`.
    """

    def __init__(self, robot: Robot, frequency: float = 20.0, *, ignore_stamps: bool = False) -> None:
        self.robot = robot
        self.frequency = frequency
        self.ignore_stamps = ignore_stamps
        self._published: dict[str, int] = {}
        self._last_call = 0

    def fixed(self) -> list[Transform]:
        """Return the transforms of the fixed and planar joints: the pose of each child link relative to its parent.

        Upstream has no planar joints and treats them as fixed; it does not publish floating joints.
        """
        transforms = self.robot.joint_transforms()
        return [transforms[name] for name, joint in self.robot.joints.items() if joint.type in {"fixed", "planar"}]

    def has_jumped_back(self, now: int) -> bool:
        """Return whether the clock has jumped back since the last call. If so, all joints may be published again."""
        back = now < self._last_call
        self._last_call = now
        if back:
            self._published.clear()
        return back

    def moving(self, stamp: int, names: Sequence[str], positions: Sequence[float]) -> list[Transform]:
        """Return the transforms of the joints in a joint state, and of the joints that mimic them.

        Args:
            stamp: The stamp of the joint state, in nanoseconds.
            names: The joints. Unknown, fixed, planar and floating joints are skipped.
            positions: A position for each name, in radians or meters.

        Returns:
            The pose of each child link relative to its parent link; nothing if the joints were published less than one
            period ago.

        Raises:
            ValueError: A position is not finite.
        """
        joints = self.robot.joints
        pairs = zip(names, positions, strict=True)
        given = {name: position for name, position in pairs if name in joints and joints[name].size == 1}
        if not given or not self._are_joints_due(stamp, given):
            return []
        self._published.update(dict.fromkeys(given, stamp))
        transforms = self.robot.joint_transforms(given)
        return [transforms[name] for name in joints if name in given or self._is_follower(name, given)]

    def _are_joints_due(self, stamp: int, names: Collection[str]) -> bool:
        if self.ignore_stamps:
            return True
        if any(name not in self._published for name in names):
            return True
        last = min(self._published[name] for name in names)
        return self.frequency > 0 and stamp >= last + int(1000 / self.frequency) * MILLISECOND

    def _is_follower(self, name: str, given: dict[str, float]) -> bool:
        joint = self.robot.joints[name]
        while joint.mimic is not None:
            joint = self.robot.joints[joint.mimic.joint]
            if joint.name in given:
                return True
        return False
