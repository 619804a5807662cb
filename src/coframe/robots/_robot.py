# SPDX-License-Identifier: Apache-2.0
"""Robot models: links that are connected by joints, with forward kinematics and Jacobians."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, overload

import numpy as np

from coframe import quaternion
from coframe._output.formatting import did_you_mean
from coframe.robots._kinematics import KinematicTree
from coframe.transform.values import batch_of

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import ArrayLike

    from coframe.quaternion import Array
    from coframe.robots.parts import Joint, JointLimits, Link, Material, Mimic
    from coframe.transform.transform import Transform

__all__ = ["Robot"]

# The default position of a joint, by the size of its position.
_DEFAULT_POSITIONS: dict[int, float | list[float]] = {1: 0.0, 3: [0.0] * 3, 7: [0.0] * 6 + [1.0]}
_IDENTITY = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True, eq=False)
class Robot:
    """A tree of links and joints.

    Attributes:
        name: The name, which can be empty.
        links: The links by name, in the order of the description.
        joints: The joints by name, parents before children.
        materials: The named materials by name.
        text: The description as URDF, which is well-formed XML even if the file is not.
        warnings: A message for each fault of the description that does not prevent its use, with its line.
        path: The file of the description; None if it was not loaded from a file.
    """

    name: str
    links: dict[str, Link]
    joints: dict[str, Joint]
    materials: dict[str, Material] = field(default_factory=dict)
    text: str = ""
    warnings: tuple[str, ...] = ()
    path: Path | None = None

    @cached_property
    def root(self) -> str:
        """The root link, which has no parent."""
        children = {joint.child for joint in self.joints.values()}
        return next(link for link in self.links if link not in children)

    @property
    def limits(self) -> dict[str, JointLimits]:
        """The limits by joint, for the joints that have limits."""
        return {name: joint.limits for name, joint in self.joints.items() if joint.limits is not None}

    @property
    def free_joints(self) -> tuple[str, ...]:
        """The revolute, continuous and prismatic joints that do not mimic others: the columns of :meth:`jacobian`."""
        return tuple(name for name, joint in self.joints.items() if joint.size == 1 and joint.mimic is None)

    def zeros(self) -> dict[str, float]:
        """Return the default position of each of the :attr:`free_joints`: 0, or the middle of limits that exclude 0."""
        return {name: _default_position(self.joints[name]) for name in self.free_joints}

    @overload
    def frames(
        self, positions: Mapping[str, ArrayLike] | None = None, *, out: None = None, threads: int = 1
    ) -> dict[str, Transform]: ...
    @overload
    def frames(self, positions: Mapping[str, ArrayLike], *, out: Array, threads: int = 1) -> Array: ...

    def frames(
        self, positions: Mapping[str, ArrayLike] | None = None, *, out: Array | None = None, threads: int = 1
    ) -> dict[str, Transform] | Array:
        """Return the pose of every link relative to the root link.

        Args:
            positions: The positions by joint, in radians or meters: a number or an array (N,). Planar joints need x,
                y, angle as (3,) or (N, 3), floating joints x, y, z, qx, qy, qz, qw as (7,) or (N, 7). A joint that
                mimics another one follows it unless its own position is given. The default of other joints is 0.
                Limits are not enforced.
            out: An array for the result of a batch, which is faster than new transforms: (L, N, 7) float64 with x, y,
                z, qx, qy, qz, qw of the L links, the root link first, then the child links in the order of the joints.
            threads: The number of threads.

        Returns:
            The transforms by link, the root link first, or `out`. If positions are arrays, the transforms are batches
            of shape (N,).

        Raises:
            ValueError: A joint does not exist or is fixed, a position is not finite or has the wrong shape, or `out`
                has the wrong shape.
        """
        found = None if out is not None else self._kinematics.transforms(positions or {}, in_root=True)
        if found is not None:
            return found
        known, shape = self._known(positions)
        if out is None and not shape:
            return self._of_one(known, in_root=True)
        poses = np.empty((len(self.links), *shape, 7)) if out is None else _checked_rows(out, (len(self.links), *shape))
        poses[0] = _IDENTITY
        self._fill(poses[1:], known, shape, in_root=True, threads=threads)
        if out is not None:
            return out
        links = [self.root, *(joint.child for joint in self.joints.values())]
        return {link: _batch(rows, self.root, link) for link, rows in zip(links, poses, strict=True)}

    def joint_transforms(self, positions: Mapping[str, ArrayLike] | None = None) -> dict[str, Transform]:
        """Return the pose of each joint's child link relative to its parent link, as published on /tf.

        Args:
            positions: The positions by joint, see :meth:`frames`.

        Returns:
            The transforms by joint, including fixed joints.

        Raises:
            ValueError: The positions are not valid, see :meth:`frames`.
        """
        found = self._kinematics.transforms(positions or {}, in_root=False)
        if found is not None:
            return found
        known, shape = self._known(positions)
        if not shape:
            return self._of_one(known, in_root=False)
        poses = np.empty((len(self.joints), *shape, 7))
        self._fill(poses, known, shape, in_root=False)
        joints = self.joints.values()
        return {j.name: _batch(rows, j.parent, j.child) for j, rows in zip(joints, poses, strict=True)}

    def jacobian(self, frame: str, positions: Mapping[str, ArrayLike] | None = None) -> Array:
        """Return the Jacobian of a link.

        Args:
            frame: The link.
            positions: The positions by joint, see :meth:`frames`.

        Returns:
            (6, n), or (N, 6, n) if positions are arrays: the linear velocity of the link's origin in m/s and its
            angular velocity in rad/s, expressed in the root link, for a unit velocity of each of the n
            :attr:`free_joints`.
            Joints that mimic a free joint move with it.

        Raises:
            ValueError: The link does not exist, or the positions are not valid, see :meth:`frames`.
        """
        if frame not in self.links:
            raise ValueError(_unknown("link", frame, list(self.links)))
        known, shape = self._known(positions)
        poses = np.empty((len(self.joints), *shape, 7))
        self._fill(poses, known, shape, in_root=True)
        t, q = poses[..., :3], poses[..., 3:]
        column = {name: i for i, name in enumerate(self.free_joints)}
        result = np.zeros((*shape, 6, len(column)))
        path = self._kinematics.path(frame)
        for i in path:
            joint = self._kinematics.joints[i]
            if joint.size != 1:
                continue
            leader, multiplier = self._leader(joint)
            axis = quaternion.rotate(q[i], np.array(joint.axis)) * multiplier
            slides = joint.type == "prismatic"
            result[..., :3, column[leader]] += axis if slides else np.cross(axis, t[path[0]] - t[i])
            result[..., 3:, column[leader]] += 0.0 if slides else axis
        return result

    def positions(self, given: Mapping[str, ArrayLike] | None = None) -> tuple[dict[str, Array], tuple[int, ...]]:
        """Return the positions of all joints that are not fixed, including joints that mimic others.

        Args:
            given: The given positions by joint, see :meth:`frames`.

        Returns:
            The positions by joint, and the batch shape: () or (N,).

        Raises:
            ValueError: The positions are not valid, see :meth:`frames`.
        """
        known, shape = self._known(given)
        for name, value in known.items():
            if not np.isfinite(value).all() or (self.joints[name].size == 7 and not value[..., 3:].any(axis=-1).all()):
                raise ValueError(_no_position(name))
        moving = (joint for joint in self.joints.values() if joint.size)
        return {
            joint.name: np.broadcast_to(self._position(joint, known), (*shape, *_axes(joint))) for joint in moving
        }, shape

    def _known(self, given: Mapping[str, ArrayLike] | None) -> tuple[dict[str, Array], tuple[int, ...]]:
        """Return the given positions as arrays, and the batch shape."""
        known = {name: self._checked(name, value) for name, value in (given or {}).items()}
        shape = np.broadcast_shapes(*(self._batch_axes(name, value) for name, value in known.items()))
        if len(shape) > 1:
            raise ValueError(f"positions can have one batch axis, (N,), not {shape}")
        return known, shape

    def _checked(self, name: str, value: ArrayLike) -> Array:
        if name not in self.joints:
            raise ValueError(_unknown("joint", name, [joint.name for joint in self.joints.values() if joint.size]))
        size = self.joints[name].size
        if not size:
            raise ValueError(f"joint {name!r} is fixed and has no position")
        try:
            array = np.asarray(value, dtype=np.float64)
        except (OverflowError, TypeError) as error:
            raise ValueError(f"the position of joint {name!r}: {error}") from None
        if size > 1 and array.shape[-1:] != (size,):
            kind = self.joints[name].type
            raise ValueError(f"the position of {kind} joint {name!r} must have shape (..., {size}), not {array.shape}")
        return array

    def _of_one(self, known: dict[str, Array], *, in_root: bool) -> dict[str, Transform]:
        found = self._kinematics.transforms({name: value.tolist() for name, value in known.items()}, in_root=in_root)
        if found is None:  # the shapes were already checked
            self.positions(known)
            raise ValueError("the position of a joint that follows another is not finite")
        return found

    def _fill(
        self, poses: Array, known: dict[str, Array], shape: tuple[int, ...], *, in_root: bool, threads: int = 1
    ) -> None:
        """Fill `poses`, (J, ..., 7), with the poses of the child links."""
        rows = shape or (1,)
        columns = {name: np.broadcast_to(value, (*rows, *_axes(self.joints[name]))) for name, value in known.items()}
        bad = self._kinematics.poses(columns, rows[0], poses, in_root=in_root, threads=threads)
        if bad is not None:
            raise ValueError(_no_position(bad))

    def _batch_axes(self, name: str, value: Array) -> tuple[int, ...]:
        return value.shape[: value.ndim - len(_axes(self.joints[name]))]

    def _position(self, joint: Joint, known: dict[str, Array]) -> Array:
        """Return the position of a joint (given, by its mimic rule, or the default), and add it to `known`."""
        followers: list[tuple[str, Mimic]] = []
        while joint.name not in known and joint.mimic is not None:
            followers.append((joint.name, joint.mimic))
            joint = self.joints[joint.mimic.joint]
        position = known.setdefault(joint.name, np.array(_DEFAULT_POSITIONS[joint.size]))
        for name, mimic in reversed(followers):
            position = known[name] = mimic.multiplier * position + mimic.offset
        return position

    def _leader(self, joint: Joint) -> tuple[str, float]:
        """Return the free joint that a joint follows, directly or indirectly, and the total multiplier."""
        multiplier = 1.0
        while joint.mimic is not None:
            multiplier *= joint.mimic.multiplier
            joint = self.joints[joint.mimic.joint]
        return joint.name, multiplier

    @cached_property
    def _kinematics(self) -> KinematicTree:
        return KinematicTree(self.root, list(self.joints.values()))

    def __repr__(self) -> str:
        return f"Robot({self.name!r}, {len(self.links)} links, {len(self.joints)} joints)"


def _axes(joint: Joint) -> tuple[int, ...]:
    """Return the shape of one position."""
    return () if joint.size == 1 else (joint.size,)


def _default_position(joint: Joint) -> float:
    limits = joint.limits
    if joint.type == "continuous" or limits is None or limits.lower is None or limits.upper is None:
        return 0.0
    return 0.0 if limits.lower <= 0.0 <= limits.upper else 0.5 * (limits.lower + limits.upper)


def _batch(rows: Array, target: str, source: str) -> Transform:
    translation, rotation = rows[:, :3], rows[:, 3:]
    translation.flags.writeable = rotation.flags.writeable = False
    return batch_of(translation, rotation, target, source, None)


def _checked_rows(out: Array, shape: tuple[int, ...]) -> Array:
    expected = (*shape, 7)
    if len(expected) != 3 or out.shape != expected or out.dtype != np.float64 or not out.flags.carray:
        raise ValueError(
            f"out must be a contiguous float64 array (L, N, 7), here {expected}, not {out.dtype} {out.shape}"
        )
    return out


def _no_position(joint: str) -> str:
    return f"the position of joint {joint!r} is not finite, or its quaternion is zero"


def _unknown(what: str, name: str, known: list[str]) -> str:
    known_names = ", ".join(map(repr, sorted(known))) or "none"
    return f"No {what} named {name!r}. " + (did_you_mean(name, known) or f"Known {what}s: {known_names}.")
