"""Robot: links tied together by joints, and where they all are."""

from __future__ import annotations

import difflib
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from coframe import quaternion
from coframe.robots.kinematics import Chain
from coframe.transform import Transform, batch_of

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import ArrayLike

    from coframe.quaternion import Array
    from coframe.robots.parts import Joint, Limits, Link, Material, Mimic

__all__ = ["Robot"]

# By the size of a joint's position.
_AT_REST: dict[int, float | list[float]] = {1: 0.0, 3: [0.0] * 3, 7: [0.0] * 6 + [1.0]}


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

    def frames(self, positions: Mapping[str, ArrayLike] | None = None) -> dict[str, Transform]:
        """Where every link is, told in the root link.

        Args:
            positions: By joint, in radians or metres: a number or an array (N,). A planar joint takes x, y, angle,
                (3,) or (N, 3); a floating one x, y, z, qx, qy, qz, qw, (7,) or (N, 7). A joint that mimics another
                follows it unless it is given itself; others that are left out are at 0. Limits are not enforced.

        Returns:
            By link, the root link included. With arrays all are batches of shape (N,).

        Raises:
            ValueError: There is no such joint, it does not move, or a position is not finite or of the wrong shape.
        """
        full, shape = self.positions(positions)
        t, q = self._chain.world(full, shape)
        found = {self.root: _transform(*_unmoved(shape), self.root, self.root)}
        for i, joint in enumerate(self._chain.joints):
            found[joint.child] = _transform(t[i], q[i], self.root, joint.child)
        return found

    def joint_transforms(self, positions: Mapping[str, ArrayLike] | None = None) -> dict[str, Transform]:
        """Where every joint's child link is, told in its parent link: what is published as tf.

        Args:
            positions: As of :meth:`frames`.

        Returns:
            By joint; fixed ones included.

        Raises:
            ValueError: As of :meth:`frames`.
        """
        full, shape = self.positions(positions)
        t, q = self._chain.local(full, shape)
        return {
            joint.name: _transform(t[i], q[i], joint.parent, joint.child) for i, joint in enumerate(self._chain.joints)
        }

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
        full, shape = self.positions(positions)
        t, q = self._chain.world(full, shape)
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
        known = {name: self._checked(name, value) for name, value in (given or {}).items()}
        shape = np.broadcast_shapes(*(self._batch_axes(name, value) for name, value in known.items()))
        if len(shape) > 1:
            raise ValueError(f"positions have one batch axis at most, (N,), not {shape}")
        moving = (joint for joint in self.joints.values() if joint.size)
        return {
            joint.name: np.broadcast_to(self._position(joint, known), (*shape, *_axes(joint))) for joint in moving
        }, shape

    def _checked(self, name: str, value: ArrayLike) -> Array:
        if name not in self.joints:
            raise ValueError(_unknown("joint", name, [joint.name for joint in self.joints.values() if joint.size]))
        size = self.joints[name].size
        if not size:
            raise ValueError(f"joint {name!r} is fixed: it has no position")
        array = np.asarray(value, dtype=np.float64)
        if size > 1 and array.shape[-1:] != (size,):
            raise ValueError(f"joint {name!r} is {self.joints[name].type}: it takes (..., {size}), not {array.shape}")
        if not np.isfinite(array).all() or (size == 7 and not array[..., 3:].any(axis=-1).all()):
            raise ValueError(f"the position of joint {name!r} is not finite, or its quaternion is zero")
        return array

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


def _unmoved(shape: tuple[int, ...]) -> tuple[Array, Array]:
    return np.zeros((*shape, 3)), np.broadcast_to(np.array([0.0, 0.0, 0.0, 1.0]), (*shape, 4))


def _transform(t: Array, q: Array, target: str, source: str) -> Transform:
    if t.ndim > 1:
        return batch_of(t, q, target, source, None)
    return Transform(t, q, target=target, source=source)


def _unknown(what: str, name: str, known: list[str]) -> str:
    close = difflib.get_close_matches(name, known, n=1)
    guess = f": did you mean {close[0]!r}?" if close else f"; there are {', '.join(map(repr, sorted(known))) or 'none'}"
    return f"there is no {what} {name!r}{guess}"
