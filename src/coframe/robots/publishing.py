"""From joint states to transforms by the rules of robot_state_publisher; sends nothing itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from coframe.robots.robot import Robot
    from coframe.transform import Transform

__all__ = ["StatePublisher"]

_MILLISECOND = 1_000_000


class StatePublisher:
    """What robot_state_publisher would send for a robot.

    Args:
        robot: The robot.
        frequency: How often at most a joint is told of, in Hz; 0: once.
        ignore_stamps: Tell of every joint state, however close together they are.
    """

    def __init__(self, robot: Robot, frequency: float = 20.0, *, ignore_stamps: bool = False) -> None:
        self.robot = robot
        self.frequency = frequency
        self.ignore_stamps = ignore_stamps
        self._told: dict[str, int] = {}
        self._last_call = 0

    def fixed(self) -> list[Transform]:
        """The transforms that never change: child links told in their parents."""
        transforms = self.robot.joint_transforms()
        return [transforms[name] for name, joint in self.robot.joints.items() if joint.type == "fixed"]

    def turned_back(self, now: int) -> bool:
        """Whether the clock was set back since the last call; then all joints may be told of again."""
        back = now < self._last_call
        self._last_call = now
        if back:
            self._told.clear()
        return back

    def moving(self, stamp: int, names: Sequence[str], positions: Sequence[float]) -> list[Transform]:
        """The transforms of the joints in a joint state, and of those that mimic them.

        Args:
            stamp: Of the joint state, in nanoseconds.
            names: The joints; those that the robot has not, or that have not one position, are left out.
            positions: As many, in radians or metres.

        Returns:
            Child links told in their parents; nothing if these joints were told of too shortly before.

        Raises:
            ValueError: A position is not finite.
        """
        joints = self.robot.joints
        pairs = zip(names, positions, strict=True)
        given = {name: position for name, position in pairs if name in joints and joints[name].size == 1}
        if not given or not self._due(stamp, given):
            return []
        self._told.update(dict.fromkeys(given, stamp))
        transforms = self.robot.joint_transforms(given)
        return [transforms[name] for name in joints if name in given or self._follows(name, given)]

    def _due(self, stamp: int, names: Collection[str]) -> bool:
        if self.ignore_stamps:
            return True
        if any(name not in self._told for name in names):
            return True
        last = min(self._told[name] for name in names)
        return self.frequency > 0 and stamp >= last + int(1000 / self.frequency) * _MILLISECOND

    def _follows(self, name: str, given: dict[str, float]) -> bool:
        joint = self.robot.joints[name]
        while joint.mimic is not None:
            joint = self.robot.joints[joint.mimic.joint]
            if joint.name in given:
                return True
        return False
