"""Forward kinematics of a tree of joints, for one configuration or many at once, by the native core."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe import _core

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from coframe.quaternion import Array
    from coframe.robots.parts import Joint
    from coframe.transform import Transform

__all__ = ["Chain"]


class Chain:
    """Joints as the native core has them. Row i of everything belongs to joint i and to the link that it moves.

    Args:
        root: The root link.
        joints: Parents before children.
    """

    def __init__(self, root: str, joints: Sequence[Joint]) -> None:
        self.joints = joints
        self._row = {joint.child: i for i, joint in enumerate(joints)}
        self._tree = _core.JointTree(root, [_described(joint) for joint in joints])

    def transforms(self, positions: Mapping[str, object], *, in_root: bool) -> dict[str, Transform] | None:
        """Where the links are in one configuration.

        Args:
            positions: By joint a float, of a joint of several numbers a list; others are as they follow, or at 0.
            in_root: Told in the root link and by link, the root link included; else by joint in the link before it.

        Returns:
            None where a position is none: not finite, of another size, or of no joint that moves.
        """
        return self._tree.transforms(positions if type(positions) is dict else dict(positions), in_root)

    def poses(
        self, positions: Mapping[str, Array], count: int, out: Array, *, in_root: bool, threads: int = 1
    ) -> str | None:
        """Where the links are in many configurations.

        Args:
            positions: By joint (count,), of a joint of several numbers (count, size).
            count: How many configurations.
            out: Is filled: (J, count, 7) float64, x, y, z, qx, qy, qz, qw.
            in_root: Told in the root link, else in the link before each joint.
            threads: So many share the work.

        Returns:
            The first joint with a position that is not finite, or a quaternion of zero; None if there is none.
        """
        return self._tree.poses_into(list(positions.items()), count, in_root, out, threads)

    def path(self, link: str) -> list[int]:
        """The joints between the root and a link, from the link upwards."""
        rows = []
        while link in self._row:
            rows.append(self._row[link])
            link = self.joints[rows[-1]].parent
        return rows


def _described(joint: Joint) -> tuple[object, ...]:
    mimic = joint.mimic and (joint.mimic.joint, joint.mimic.multiplier, joint.mimic.offset)
    return joint.name, joint.type, joint.parent, joint.child, joint.origin.values, joint.axis, mimic
