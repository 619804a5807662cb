"""Robot: links tied together by joints, and where they all are."""

from __future__ import annotations

import difflib
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, overload

import numpy as np

from coframe import quaternion
from coframe.robots.kinematics import Chain
from coframe.transform import batch_of

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import ArrayLike

    from coframe.quaternion import Array
    from coframe.robots.parts import Joint, Limits, Link, Material, Mimic
    from coframe.transform import Transform

__all__ = ["Robot"]

# By the size of a joint's position.
_AT_REST: dict[int, float | list[float]] = {1: 0.0, 3: [0.0] * 3, 7: [0.0] * 6 + [1.0]}
_UNMOVED = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True, eq=False)
class Robot:
    """A tree of links and joints.

    Attributes:
        name: May be empty.
        links: By name, in the order of the description.
        joints: By name, parents before children.
        materials: Those with a name, by it.
        text: The description as URDF.
        warnings: What it says that means nothing, one sentence each.
        path: The file it came from, or None.
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
        """The link that has no parent."""
        children = {joint.child for joint in self.joints.values()}
        return next(link for link in self.links if link not in children)

    @property
    def limits(self) -> dict[str, Limits]:
        """By joint, of those that have limits."""
        return {name: joint.limits for name, joint in self.joints.items() if joint.limits is not None}

    @property
    def free_joints(self) -> tuple[str, ...]:
        """The joints with one position each that do not follow others: the columns of :meth:`jacobian`."""
        return tuple(name for name, joint in self.joints.items() if joint.size == 1 and joint.mimic is None)

    def zeros(self) -> dict[str, float]:
        """Where each of the :attr:`free_joints` rests: at 0, or amid its limits if these leave 0 out."""
        return {name: _rest(self.joints[name]) for name in self.free_joints}

    @overload
    def frames(
        self, positions: Mapping[str, ArrayLike] | None = None, *, out: None = None, threads: int = 1
    ) -> dict[str, Transform]: ...
    @overload
    def frames(self, positions: Mapping[str, ArrayLike], *, out: Array, threads: int = 1) -> Array: ...

    def frames(
        self, positions: Mapping[str, ArrayLike] | None = None, *, out: Array | None = None, threads: int = 1
    ) -> dict[str, Transform] | Array:
        """Where every link is, told in the root link.

        Args:
            positions: By joint, in radians or metres: a number or an array (N,). A planar joint takes x, y, angle,
                (3,) or (N, 3); a floating one x, y, z, qx, qy, qz, qw, (7,) or (N, 7). A joint that mimics another
                follows it unless it is given itself; others that are left out are at 0. Limits are not enforced.
            out: With arrays: filled and returned instead of new transforms, which is faster. (L, N, 7) float64 gets
                x, y, z, qx, qy, qz, qw of the L links, the root link first and then as the joints move them.
            threads: So many share the work.

        Returns:
            By link, the root link first. With arrays all are batches of shape (N,).

        Raises:
            ValueError: There is no such joint, it does not move, a position is not finite or of the wrong shape, or
                ``out`` is of another shape.
        """
        found = None if out is not None else self._chain.transforms(positions or {}, in_root=True)
        if found is not None:
            return found
        known, shape = self._known(positions)
        if out is None and not shape:
            return self._of_one(known, in_root=True)
        poses = np.empty((len(self.links), *shape, 7)) if out is None else _checked_rows(out, (len(self.links), *shape))
        poses[0] = _UNMOVED
        self._fill(poses[1:], known, shape, in_root=True, threads=threads)
        if out is not None:
            return out
        links = [self.root, *(joint.child for joint in self.joints.values())]
        return {link: _batch(rows, self.root, link) for link, rows in zip(links, poses, strict=True)}

    def joint_transforms(self, positions: Mapping[str, ArrayLike] | None = None) -> dict[str, Transform]:
        """Where every joint's child link is, told in its parent link: what is published as tf.

        Args:
            positions: As of :meth:`frames`.

        Returns:
            By joint; fixed ones included.

        Raises:
            ValueError: As of :meth:`frames`.
        """
        found = self._chain.transforms(positions or {}, in_root=False)
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
        """How fast a link moves when joints do.

        Args:
            frame: The link.
            positions: As of :meth:`frames`.

        Returns:
            (6, n), or (N, 6, n) with arrays: along the axes of the root link, the velocity of the link's origin in
            metres and its angular velocity in radians, for each of the n :attr:`free_joints` in their order. Joints
            that mimic one of these move with it.

        Raises:
            ValueError: There is no such link, or as of :meth:`frames`.
        """
        if frame not in self.links:
            raise ValueError(_unknown("link", frame, list(self.links)))
        known, shape = self._known(positions)
        poses = np.empty((len(self.joints), *shape, 7))
        self._fill(poses, known, shape, in_root=True)
        t, q = poses[..., :3], poses[..., 3:]
        column = {name: i for i, name in enumerate(self.free_joints)}
        result = np.zeros((*shape, 6, len(column)))
        path = self._chain.path(frame)
        for i in path:
            joint = self._chain.joints[i]
            if joint.size != 1:
                continue
            leader, share = self._leader(joint)
            axis = quaternion.rotate(q[i], np.array(joint.axis)) * share
            slides = joint.type == "prismatic"
            result[..., :3, column[leader]] += axis if slides else np.cross(axis, t[path[0]] - t[i])
            result[..., 3:, column[leader]] += 0.0 if slides else axis
        return result

    def positions(self, given: Mapping[str, ArrayLike] | None = None) -> tuple[dict[str, Array], tuple[int, ...]]:
        """The position of every joint that moves, those of joints that follow others included.

        Args:
            given: As of :meth:`frames`.

        Returns:
            By joint, and the batch axes: () or (N,).

        Raises:
            ValueError: As of :meth:`frames`.
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
        """What was given as arrays of the right shape, and the batch axes."""
        known = {name: self._checked(name, value) for name, value in (given or {}).items()}
        shape = np.broadcast_shapes(*(self._batch_axes(name, value) for name, value in known.items()))
        if len(shape) > 1:
            raise ValueError(f"positions have one batch axis at most, (N,), not {shape}")
        return known, shape

    def _checked(self, name: str, value: ArrayLike) -> Array:
        if name not in self.joints:
            raise ValueError(_unknown("joint", name, [joint.name for joint in self.joints.values() if joint.size]))
        size = self.joints[name].size
        if not size:
            raise ValueError(f"joint {name!r} is fixed: it has no position")
        try:
            array = np.asarray(value, dtype=np.float64)
        except (OverflowError, TypeError) as error:
            raise ValueError(f"the position of joint {name!r}: {error}") from None
        if size > 1 and array.shape[-1:] != (size,):
            raise ValueError(f"joint {name!r} is {self.joints[name].type}: it takes (..., {size}), not {array.shape}")
        return array

    def _of_one(self, known: dict[str, Array], *, in_root: bool) -> dict[str, Transform]:
        found = self._chain.transforms({name: value.tolist() for name, value in known.items()}, in_root=in_root)
        if found is None:  # their shapes are right
            self.positions(known)
            raise ValueError("the position of a joint that follows another is not finite")
        return found

    def _fill(
        self, poses: Array, known: dict[str, Array], shape: tuple[int, ...], *, in_root: bool, threads: int = 1
    ) -> None:
        """Poses (J, ..., 7) of the links behind the joints."""
        rows = shape or (1,)
        columns = {name: np.broadcast_to(value, (*rows, *_axes(self.joints[name]))) for name, value in known.items()}
        bad = self._chain.poses(columns, rows[0], poses, in_root=in_root, threads=threads)
        if bad is not None:
            raise ValueError(_no_position(bad))

    def _batch_axes(self, name: str, value: Array) -> tuple[int, ...]:
        return value.shape[: value.ndim - len(_axes(self.joints[name]))]

    def _position(self, joint: Joint, known: dict[str, Array]) -> Array:
        """The one that is known, or what it follows, or rest; whom it follows is known afterwards."""
        followers: list[tuple[str, Mimic]] = []
        while joint.name not in known and joint.mimic is not None:
            followers.append((joint.name, joint.mimic))
            joint = self.joints[joint.mimic.joint]
        position = known.setdefault(joint.name, np.array(_AT_REST[joint.size]))
        for name, mimic in reversed(followers):
            position = known[name] = mimic.multiplier * position + mimic.offset
        return position

    def _leader(self, joint: Joint) -> tuple[str, float]:
        """Whom a joint follows in the end, and how many times as fast."""
        share = 1.0
        while joint.mimic is not None:
            share *= joint.mimic.multiplier
            joint = self.joints[joint.mimic.joint]
        return joint.name, share

    @cached_property
    def _chain(self) -> Chain:
        return Chain(self.root, list(self.joints.values()))

    def __repr__(self) -> str:
        return f"Robot({self.name!r}, {len(self.links)} links, {len(self.joints)} joints)"


def _axes(joint: Joint) -> tuple[int, ...]:
    """Those of one position."""
    return () if joint.size == 1 else (joint.size,)


def _rest(joint: Joint) -> float:
    limits = joint.limits
    if joint.type == "continuous" or limits is None or limits.lower is None or limits.upper is None:
        return 0.0
    return 0.0 if limits.lower <= 0.0 <= limits.upper else 0.5 * (limits.lower + limits.upper)


def _batch(rows: Array, target: str, source: str) -> Transform:
    return batch_of(rows[:, :3], rows[:, 3:], target, source, None)


def _checked_rows(out: Array, shape: tuple[int, ...]) -> Array:
    wanted = (*shape, 7)
    if len(wanted) != 3 or out.shape != wanted or out.dtype != np.float64 or not out.flags.carray:
        raise ValueError(
            f"out must be a contiguous float64 array (L, N, 7), here {wanted}, not {out.dtype} {out.shape}"
        )
    return out


def _no_position(joint: str) -> str:
    return f"the position of joint {joint!r} is not finite, or its quaternion is zero"


def _unknown(what: str, name: str, known: list[str]) -> str:
    close = difflib.get_close_matches(name, known, n=1)
    guess = f": did you mean {close[0]!r}?" if close else f"; there are {', '.join(map(repr, sorted(known))) or 'none'}"
    return f"there is no {what} {name!r}{guess}"
