# SPDX-License-Identifier: Apache-2.0
"""Forward kinematics of a tree of joints in the native core, for one or many configurations."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe import _core

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from coframe.quaternion import Array
    from coframe.robots.parts import Joint
    from coframe.transform.transform import Transform

__all__ = ["KinematicTree"]


class KinematicTree:
    """A tree of joints in the native core. Row i of all arrays belongs to joint i and its child link.

    Args:
        root: The root link.
        joints: The joints, parents before children.
    """

    def __init__(self, root: str, joints: Sequence[Joint]) -> None:
        self.joints = joints
        self._row = {joint.child: i for i, joint in enumerate(joints)}
        self._tree = _core.JointTree(root, [_joint_tuple(joint) for joint in joints])

    def transforms(self, positions: Mapping[str, object], *, in_root: bool) -> dict[str, Transform] | None:
        """Return the transforms of one configuration.

        Args:
            positions: A float for each joint, or a list for planar and floating joints. Other joints follow the joint
                that they mimic, or are at 0.
            in_root: Whether to return the pose of every link relative to the root link, by link. Otherwise, the pose
                of every child link relative to its parent link is returned, by joint.

        Returns:
            The transforms, or None if a position is not finite, has the wrong size, or belongs to a fixed or unknown
            joint.
        """
        return self._tree.transforms(positions if type(positions) is dict else dict(positions), in_root)

    def poses(
        self, positions: Mapping[str, Array], count: int, out: Array, *, in_root: bool, threads: int = 1
    ) -> str | None:
        """Compute the poses of the links in many configurations.

        Args:
            positions: An array (count,) for each joint, or (count, size) for planar and floating joints.
            count: The number of configurations.
            out: The array for the result, (J, count, 7) float64: x, y, z, qx, qy, qz, qw.
            in_root: Whether the poses are relative to the root link. Otherwise, they are relative to the parent link.
            threads: The number of threads.

        Returns:
            The first joint whose position is not finite or has a zero quaternion, or None if there is none.
        """
        return self._tree.poses_into(list(positions.items()), count, in_root, out, threads)

    def path(self, link: str) -> list[int]:
        """Return the rows of the joints from a link up to the root."""
        rows = []
        while link in self._row:
            rows.append(self._row[link])
            link = self.joints[rows[-1]].parent
        return rows


def _joint_tuple(joint: Joint) -> tuple[object, ...]:
    mimic = joint.mimic and (joint.mimic.joint, joint.mimic.multiplier, joint.mimic.offset)
    # Without an axis, a joint does not move: it slides along nothing.
    kind = "prismatic" if joint.size == 1 and not any(joint.axis) else joint.type
    return joint.name, kind, joint.parent, joint.child, joint.origin.values, joint.axis, mimic
