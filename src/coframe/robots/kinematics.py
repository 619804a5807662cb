"""Forward kinematics and Jacobians of a tree of joints, for one configuration or many at once."""

from __future__ import annotations

import math
from itertools import groupby
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from coframe import quaternion

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from coframe.quaternion import Array
    from coframe.robots.parts import Joint

__all__ = ["Chain"]

Rows: TypeAlias = "NDArray[np.intp]"


class Chain:
    """Joints as arrays. Row i of everything belongs to joint i and to the link that it moves.

    Args:
        root: The root link.
        joints: Parents before children, level by level.
    """

    def __init__(self, root: str, joints: Sequence[Joint]) -> None:
        self.joints = joints
        row = {joint.child: i for i, joint in enumerate(joints)}
        self.parents = np.array([row.get(joint.parent, -1) for joint in joints], dtype=np.intp)
        self.levels = _levels(root, joints)
        self.translations = np.array([joint.origin.translation for joint in joints]).reshape(-1, 3)
        self.quaternions = np.array([joint.origin.quaternion for joint in joints]).reshape(-1, 4)
        self.axes = np.array([joint.axis for joint in joints]).reshape(-1, 3)
        self.turning = _rows(joints, "revolute", "continuous")
        self.sliding = _rows(joints, "prismatic")
        self.several = _rows(joints, "planar", "floating")

    def local(self, positions: Mapping[str, Array], shape: tuple[int, ...]) -> tuple[Array, Array]:
        """Where each joint's child is, told in its parent.

        Args:
            positions: For every joint that is not fixed: ``shape`` for one number, else (..., 3) or (..., 7).
            shape: The batch axes.

        Returns:
            Translations (J, ..., 3) and quaternions (J, ..., 4).
        """
        t = np.zeros((len(self.joints), *shape, 3))
        q = np.zeros((len(self.joints), *shape, 4))
        q[..., 3] = 1.0
        between = (slice(None), *(None,) * len(shape))
        if self.turning.size:
            half = 0.5 * self._stacked(self.turning, positions, shape)
            q[self.turning, ..., :3] = self.axes[self.turning][between] * np.sin(half)[..., None]
            q[self.turning, ..., 3] = np.cos(half)
        if self.sliding.size:
            slid = self._stacked(self.sliding, positions, shape)
            t[self.sliding] = self.axes[self.sliding][between] * slid[..., None]
        for i in self.several:
            joint = self.joints[i]
            t[i], q[i] = _planar(joint, positions) if joint.type == "planar" else _floating(joint, positions)
        origins = self.quaternions[between]
        return quaternion.rotate(origins, t) + self.translations[between], quaternion.multiply(origins, q)

    def world(self, positions: Mapping[str, Array], shape: tuple[int, ...]) -> tuple[Array, Array]:
        """Like :meth:`local`, but all told in the root link."""
        t, q = self.local(positions, shape)
        for level in self.levels[1:]:
            above = self.parents[level]
            t[level] = t[above] + quaternion.rotate(q[above], t[level])
            q[level] = quaternion.multiply(q[above], q[level])
        return t, q

    def path(self, link: str) -> list[int]:
        """The joints between the root and a link, from the link upwards."""
        i = next((i for i, joint in enumerate(self.joints) if joint.child == link), -1)
        rows = []
        while i >= 0:
            rows.append(i)
            i = int(self.parents[i])
        return rows

    def _stacked(self, rows: Rows, positions: Mapping[str, Array], shape: tuple[int, ...]) -> Array:
        return np.stack([np.broadcast_to(positions[self.joints[i].name], shape) for i in rows.tolist()])


def _rows(joints: Sequence[Joint], *types: str) -> Rows:
    return np.array([i for i, joint in enumerate(joints) if joint.type in types], dtype=np.intp)


def _levels(root: str, joints: Sequence[Joint]) -> list[slice]:
    """Neighbouring joints that are equally far from the root."""
    depth = {root: 0}
    for joint in joints:
        depth[joint.child] = depth[joint.parent] + 1
    levels = [list(rows) for _, rows in groupby(range(len(joints)), key=lambda i: depth[joints[i].child])]
    return [slice(rows[0], rows[-1] + 1) for rows in levels]


def _planar(joint: Joint, positions: Mapping[str, Array]) -> tuple[Array, Array]:
    """Slid by x and y in the plane across the axis, and turned about the axis."""
    x, y, angle = np.moveaxis(positions[joint.name], -1, 0)
    upright = _from_z_to(np.array(joint.axis))
    turn = np.stack([0 * angle, 0 * angle, np.sin(0.5 * angle), np.cos(0.5 * angle)], axis=-1)
    moved = quaternion.rotate(upright, np.stack([x, y, 0 * x], axis=-1))
    return moved, quaternion.multiply(quaternion.multiply(upright, turn), quaternion.inverse(upright))


def _from_z_to(axis: Array) -> Array:
    """The shortest turn that takes z there."""
    x, y, z = axis
    if z < -1.0 + 1e-12:
        return np.array([1.0, 0.0, 0.0, 0.0])
    return np.array([-y, x, 0.0, 1.0 + z]) / math.hypot(x, y, 1.0 + z)


def _floating(joint: Joint, positions: Mapping[str, Array]) -> tuple[Array, Array]:
    pose = positions[joint.name]
    return pose[..., :3], pose[..., 3:] / np.linalg.norm(pose[..., 3:], axis=-1, keepdims=True)
