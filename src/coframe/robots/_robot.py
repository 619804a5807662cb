# SPDX-License-Identifier: Apache-2.0
"""Robot models: links that are connected by joints, with forward kinematics and Jacobians."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from coframe import quaternion
from coframe._output.formatting import did_you_mean
from coframe.buffer.buffer import Buffer
from coframe.robots._given_positions import by_joint, group_messages, is_joint_state
from coframe.robots._kinematics import KinematicTree
from coframe.transform.values import batch_of

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from numpy.typing import ArrayLike

    from coframe.quaternion import Array
    from coframe.robots._given_positions import Positions
    from coframe.robots.parts import Joint, JointLimits, Link, Material, Mimic
    from coframe.transform.transform import Transform
    from coframe.viewer import Viewer

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
        path: The file of the description, or None if it was not loaded from a file.
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
        self, positions: Positions | None = None, *, out: None = None, threads: int = 1
    ) -> dict[str, Transform]: ...
    @overload
    def frames(self, positions: Positions, *, out: Array, threads: int = 1) -> Array: ...

    def frames(
        self, positions: Positions | None = None, *, out: Array | None = None, threads: int = 1
    ) -> dict[str, Transform] | Array:
        """Return the pose of every link relative to the root link.

        Args:
            positions: The positions by joint, in radians or meters: a number or an array (N,). Planar joints need x,
                y, angle as (3,) or (N, 3), floating joints x, y, z, qx, qy, qz, qw as (7,) or (N, 7). A joint that
                mimics another one follows it unless its own position is given. The default of other joints is 0.
                Limits are not enforced, see :meth:`limit_violations`. Also an array (n,) or (N, n) in the order of the
                :attr:`free_joints`, or a JointState message, whose unknown joints are ignored.
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
        if positions is not None and type(positions) is not dict:
            positions = by_joint(positions, self.joints, self.free_joints)
        found = None if out is not None else self._kinematics.transforms(positions or {}, in_root=True)
        if found is not None:
            return found
        known, shape = self._given_positions(positions)
        if out is None and not shape:
            return self._single_transforms(known, in_root=True)
        poses = np.empty((len(self.links), *shape, 7)) if out is None else _checked_rows(out, (len(self.links), *shape))
        poses[0] = _IDENTITY
        self._fill(poses[1:], known, shape, in_root=True, threads=threads)
        if out is not None:
            return out
        links = [self.root, *(joint.child for joint in self.joints.values())]
        return {link: _batch(rows, self.root, link) for link, rows in zip(links, poses, strict=True)}

    def joint_transforms(self, positions: Positions | None = None) -> dict[str, Transform]:
        """Return the pose of each joint's child link relative to its parent link, as published on /tf.

        Args:
            positions: The positions by joint, see :meth:`frames`.

        Returns:
            The transforms by joint, including fixed joints.

        Raises:
            ValueError: The positions are not valid, see :meth:`frames`.
        """
        positions = by_joint(positions, self.joints, self.free_joints)
        found = self._kinematics.transforms(positions, in_root=False)
        if found is not None:
            return found
        known, shape = self._given_positions(positions)
        if not shape:
            return self._single_transforms(known, in_root=False)
        poses = np.empty((len(self.joints), *shape, 7))
        self._fill(poses, known, shape, in_root=False)
        joints = self.joints.values()
        return {j.name: _batch(rows, j.parent, j.child) for j, rows in zip(joints, poses, strict=True)}

    def jacobian(
        self,
        frame: str,
        positions: Positions | None = None,
        *,
        point: ArrayLike = (0.0, 0.0, 0.0),
        expressed_in: str | None = None,
    ) -> Array:
        """Return the Jacobian of a point of a link.

        Args:
            frame: The link.
            positions: The positions by joint, see :meth:`frames`.
            point: The point in the link, in meters, shape (3,); by default the link's origin.
            expressed_in: The link along whose axes the velocities are expressed: ``frame`` for body velocities; by
                default the root link.

        Returns:
            (6, n), or (N, 6, n) if positions are arrays: the linear velocity of the point in m/s and the angular
            velocity of the link in rad/s, relative to the root link, for a unit velocity of each of the n
            :attr:`free_joints`. Joints that mimic a free joint move with it.

        Raises:
            ValueError: A link does not exist, or the positions are not valid, see :meth:`frames`.
        """
        axes = self.root if expressed_in is None else expressed_in
        for link in (frame, axes):
            if link not in self.links:
                raise ValueError(_unknown_name_error("link", link, list(self.links)))
        known, shape = self._given_positions(positions)
        poses = np.empty((len(self.joints), *shape, 7))
        self._fill(poses, known, shape, in_root=True)
        t, q = poses[..., :3], poses[..., 3:]
        column = {name: i for i, name in enumerate(self.free_joints)}
        result = np.zeros((*shape, 6, len(column)))
        path = self._kinematics.path(frame)
        if path:
            end = t[path[0]] + quaternion.rotate(q[path[0]], np.asarray(point, dtype=np.float64))
        for i in path:
            joint = self._kinematics.joints[i]
            if joint.size != 1:
                continue
            leader, multiplier = self._leader(joint)
            axis = quaternion.rotate(q[i], np.array(joint.axis)) * multiplier
            slides = joint.type == "prismatic"
            result[..., :3, column[leader]] += axis if slides else np.cross(axis, end - t[i])
            result[..., 3:, column[leader]] += 0.0 if slides else axis
        if axes == self.root:
            return result
        back = np.swapaxes(quaternion.to_matrix(q[self._kinematics.path(axes)[0]]), -1, -2)
        return np.concatenate([back @ result[..., :3, :], back @ result[..., 3:, :]], axis=-2)

    def limit_violations(self, positions: Positions | None = None) -> dict[str, Array]:
        """Return how far joints are outside of their limits.

        Args:
            positions: The positions by joint, see :meth:`frames`.

        Returns:
            By joint that violates its limits: radians or meters, shape () or (N,); negative below the lower limit,
            positive above the upper one, 0 within. Joints that mimic others are checked, too.

        Raises:
            ValueError: The positions are not valid, see :meth:`frames`.
        """
        found = {}
        for name, value in self.positions(positions)[0].items():
            limits = self.limits.get(name)
            if limits is None or self.joints[name].size != 1 or self.joints[name].type == "continuous":
                continue
            low, high = _limit_bounds(limits)
            outside = np.minimum(value - low, 0.0) + np.maximum(value - high, 0.0)
            if outside.any():
                found[name] = outside
        return found

    def clip(self, positions: Positions) -> dict[str, Array]:
        """Return positions by joint that are moved into the limits. See :meth:`limit_violations`."""
        known, _ = self._given_positions(positions)
        return {name: value - self.limit_violations({name: value}).get(name, 0.0) for name, value in known.items()}

    def buffer(self, joint_states: Iterable[Any] | Any, stamps: ArrayLike | None = None) -> Buffer:
        """Return a buffer with the transforms of all links over time.

        Args:
            joint_states: JointState messages, with their stamps and in any order; or positions with ``stamps``, see
                :meth:`frames`. Messages may contain only some of the joints. Joints without any position are static,
                at their default.
            stamps: Times of the positions, shape (N,), int64 nanoseconds or datetime64, or None for messages.

        Returns:
            A buffer that keeps everything; ``lookup`` interpolates each joint on its own.

        Raises:
            ValueError: The positions are not valid, or there are none.
        """
        if stamps is not None:
            groups = [(np.asarray(stamps), self._given_positions(joint_states)[0])]
        else:
            messages = [joint_states] if is_joint_state(joint_states) else joint_states
            groups = group_messages(messages, self.joints)
        found = Buffer(None)
        authority = f"robot {self.name}".rstrip()
        moving_joints = set()
        for times, positions in groups:
            for name, poses in self.joint_transforms(positions).items():
                joint = self.joints[name]
                if joint.size and (name in positions or (joint.mimic and self._leader(joint)[0] in positions)):
                    moving_joints.add(name)
                    found.set_many(joint.parent, joint.child, times, poses, authority=authority)
        for name, pose in self.joint_transforms().items():
            if name not in moving_joints:
                joint = self.joints[name]
                found.set(joint.parent, joint.child, pose, static=True, authority=authority)
        return found

    def show(self, positions: Positions | None = None, **options: Any) -> Viewer:
        """Show the robot in the viewer, or below the cell in a notebook.

        Args:
            positions: The positions by joint, see :meth:`frames`; or JointState messages, which are played.
            options: The options of :func:`coframe.show`.
        """
        from coframe.viewer.show import show as show_in_browser  # noqa: PLC0415 - the viewer is above this module

        is_motion = isinstance(positions, list | tuple) and len(positions) > 0 and is_joint_state(positions[0])
        buffer = self.buffer(positions) if is_motion else self._buffer_at(positions)
        return show_in_browser(buffer, robot=self, **options)

    def to_pinocchio(self) -> Any:
        """Return the robot as a ``pinocchio.Model``, for dynamics, inverse kinematics and collisions.

        Its configuration vector has its own order: joint NAME begins at
        ``model.joints[model.getJointId(NAME)].idx_q``.

        Raises:
            ModuleNotFoundError: Pinocchio is not installed.
        """
        try:
            import pinocchio  # noqa: PLC0415 - coframe itself does not need Pinocchio
        except ModuleNotFoundError as error:
            text = "to_pinocchio() needs Pinocchio, which is not installed. Install it with: pip install pin"
            raise ModuleNotFoundError(text, name=error.name) from None
        return pinocchio.buildModelFromXML(self.text)

    def _buffer_at(self, positions: Positions | None) -> Buffer:
        """Return a buffer with the transforms of one configuration."""
        found = Buffer(None)
        for name, pose in self.joint_transforms(positions).items():
            if pose.shape:
                raise ValueError(
                    "show() takes one configuration, or JointState messages. Use buffer(positions, stamps)."
                )
            joint = self.joints[name]
            found.set(joint.parent, joint.child, pose, static=True)
        return found

    def positions(self, given: Positions | None = None) -> tuple[dict[str, Array], tuple[int, ...]]:
        """Return the positions of all joints that are not fixed, including joints that mimic others.

        Args:
            given: The given positions by joint, see :meth:`frames`.

        Returns:
            The positions by joint, and the batch shape: () or (N,).

        Raises:
            ValueError: The positions are not valid, see :meth:`frames`.
        """
        known, shape = self._given_positions(given)
        for name, value in known.items():
            if not np.isfinite(value).all() or (self.joints[name].size == 7 and not value[..., 3:].any(axis=-1).all()):
                raise ValueError(_position_error(name))
        moving_joints = (joint for joint in self.joints.values() if joint.size)
        return {
            joint.name: np.broadcast_to(self._position(joint, known), (*shape, *_axes(joint)))
            for joint in moving_joints
        }, shape

    def _given_positions(self, given: Positions | None) -> tuple[dict[str, Array], tuple[int, ...]]:
        """Return the given positions as arrays, and the batch shape."""
        named = by_joint(given, self.joints, self.free_joints)
        known = {name: self._check_position(name, value) for name, value in named.items()}
        shape = np.broadcast_shapes(*(self._batch_axes(name, value) for name, value in known.items()))
        if len(shape) > 1:
            raise ValueError(f"positions can have one batch axis, (N,), not {shape}")
        return known, shape

    def _check_position(self, name: str, value: ArrayLike) -> Array:
        if name not in self.joints:
            raise ValueError(
                _unknown_name_error("joint", name, [joint.name for joint in self.joints.values() if joint.size])
            )
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

    def _single_transforms(self, known: dict[str, Array], *, in_root: bool) -> dict[str, Transform]:
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
            raise ValueError(_position_error(bad))

    def _batch_axes(self, name: str, value: Array) -> tuple[int, ...]:
        return value.shape[: value.ndim - len(_axes(self.joints[name]))]

    def _position(self, joint: Joint, known: dict[str, Array]) -> Array:
        """Return the position of a joint (given, mimicked or default), and add it to `known`."""
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


def _limit_bounds(limits: JointLimits) -> tuple[float, float]:
    """Return the lower and the upper limit."""
    return -np.inf if limits.lower is None else limits.lower, np.inf if limits.upper is None else limits.upper


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


def _position_error(joint: str) -> str:
    return f"the position of joint {joint!r} is not finite, or its quaternion is zero"


def _unknown_name_error(what: str, name: str, known: list[str]) -> str:
    known_names = ", ".join(map(repr, sorted(known))) or "none"
    return f"No {what} named {name!r}. " + (did_you_mean(name, known) or f"Known {what}s: {known_names}.")
