# SPDX-License-Identifier: Apache-2.0
"""Joint states computed like in joint_state_publisher: defaults, values from other sources, and mimic joints."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from coframe.errors import RobotDescriptionError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from coframe.robots._robot import Robot
    from coframe.robots.parts import Joint

__all__ = ["FreeJoint", "JointStateFields", "JointStates"]


@dataclass
class FreeJoint:
    """A joint that does not follow another joint. Units are radians or meters.

    Attributes:
        lower: The lower limit; -pi for a continuous joint.
        upper: The upper limit; pi for a continuous joint.
        zero: The default position.
        continuous: Whether the joint is continuous.
        position: The position, or None if it is unknown.
        velocity: The velocity, or None if it is unknown.
        effort: The effort, or None if it is unknown.
        increasing: Whether :meth:`JointStates.step` increases the position.
    """

    lower: float
    upper: float
    zero: float
    continuous: bool = False
    position: float | None = None
    velocity: float | None = None
    effort: float | None = None
    increasing: bool = True


class JointStateFields(NamedTuple):
    """The fields of a JointState message. A field is empty if it is unknown for all joints."""

    names: list[str]
    positions: list[float]
    velocities: list[float]
    efforts: list[float]


class _Follower(NamedTuple):
    """The joint that a joint follows, with factor and offset."""

    leader: str
    factor: float = 1.0
    offset: float = 0.0


class JointStates:
    """The states of a robot's revolute, continuous and prismatic joints.

    Args:
        robot: The robot whose joints are stored.
        zeros: The default positions by joint. The default of other joints is 0, or the middle of their limits if 0 is
            not within the limits.
        dependent: The joints that follow another joint: {joint: (other joint, factor, offset)}. This overrides mimic
            tags.
        use_mimic_tags: Whether joints with a mimic tag follow the joint in the tag.
        use_smallest_limits: Whether the soft limits of a safety controller apply if they are narrower.
        positions: Whether joints have their default position until another source sets it.
        velocities: Whether joints have the velocity 0 until another source sets it.
        efforts: Whether joints have the effort 0 until another source sets it.

    Raises:
        RobotDescriptionError: Joints follow each other in a circle, or follow a joint that does not exist.
    """

    def __init__(
        self,
        robot: Robot,
        *,
        zeros: Mapping[str, float] | None = None,
        dependent: Mapping[str, tuple[str, float, float]] | None = None,
        use_mimic_tags: bool = True,
        use_smallest_limits: bool = True,
        positions: bool = True,
        velocities: bool = False,
        efforts: bool = False,
    ) -> None:
        joints = {name: joint for name, joint in robot.joints.items() if joint.size == 1}
        followers = {name: _Follower(*rule) for name, rule in (dependent or {}).items() if name in joints}
        if use_mimic_tags:
            tags = {name: joint.mimic for name, joint in joints.items() if joint.mimic is not None}
            followers |= {
                name: _Follower(tag.joint, tag.multiplier, tag.offset)
                for name, tag in tags.items()
                if name not in followers
            }
        self.free = {
            name: _free(joint, (zeros or {}).get(name), use_smallest_limits=use_smallest_limits)
            for name, joint in joints.items()
            if name not in followers
        }
        for state in self.free.values():
            state.position = state.zero if positions else None
            state.velocity = 0.0 if velocities else None
            state.effort = 0.0 if efforts else None
        self._followers = {name: self._last_leader(name, followers) for name in joints}

    def update(
        self,
        names: Sequence[str],
        positions: Sequence[float] = (),
        velocities: Sequence[float] = (),
        efforts: Sequence[float] = (),
    ) -> None:
        """Set values of joints from another source, except for unknown joints and mimic joints.

        Args:
            names: The joints.
            positions: A position for each name, in radians or meters; empty if unknown.
            velocities: A velocity for each name; empty if unknown.
            efforts: An effort for each name; empty if unknown.

        Raises:
            ValueError: A field that is not empty has the wrong number of values, or a value is not finite.
        """
        fields = {"position": positions, "velocity": velocities, "effort": efforts}
        for field, values in fields.items():
            if len(values) not in {0, len(names)}:
                raise ValueError(f"a joint state with {len(names)} names has {len(values)} values of {field}")
            if not all(math.isfinite(value) for value in values):
                raise ValueError(f"a value of {field} is not finite")
        for field, values in fields.items():
            for name, value in zip(names, values, strict=False):
                if name in self.free:
                    setattr(self.free[name], field, float(value))

    def step(self, delta: float) -> None:
        """Move every free joint by `delta`, back and forth between its limits; continuous joints wrap around."""
        for joint in self.free.values():
            position = (joint.zero if joint.position is None else joint.position) + (
                delta if joint.increasing else -delta
            )
            if position > joint.upper:
                position = joint.lower if joint.continuous else joint.upper
                joint.increasing = joint.continuous
            elif position < joint.lower:
                position = joint.lower
                joint.increasing = True
            joint.position = position

    def fields(self) -> JointStateFields:
        """Return the values of all joints, including those that follow others. Unknown values are 0."""
        pairs = [(self.free[follower.leader], follower) for follower in self._followers.values()]

        def field(values: list[float | None]) -> list[float]:
            known = any(value is not None for value in values)
            return [0.0 if value is None else value for value in values] if known else []

        return JointStateFields(
            list(self._followers),
            field([None if j.position is None else j.position * f.factor + f.offset for j, f in pairs]),
            field([None if j.velocity is None else j.velocity * f.factor for j, f in pairs]),
            field([j.effort for j, _ in pairs]),
        )

    def _last_leader(self, name: str, followers: Mapping[str, _Follower]) -> _Follower:
        """Return the free joint that a joint follows, directly or indirectly, or the joint itself if it is free."""
        found = _Follower(name)
        chain = [name]
        while found.leader in followers:
            leader, factor, offset = followers[found.leader]
            found = _Follower(leader, found.factor * factor, found.offset + found.factor * offset)
            if leader in chain:
                raise RobotDescriptionError(f"Found an infinite recursive mimic chain: {[*chain, leader]}")
            chain.append(leader)
        if found.leader not in self.free:
            raise RobotDescriptionError(
                f"joint {chain[-2]!r} depends on {found.leader!r}, "
                "which is not a revolute, continuous or prismatic joint"
            )
        return found


def _free(joint: Joint, zero: float | None, *, use_smallest_limits: bool) -> FreeJoint:
    limits = joint.limits
    lower, upper = -math.pi, math.pi
    if limits is not None and joint.type != "continuous":
        lower, upper = limits.lower or 0.0, limits.upper or 0.0
    if limits is not None and use_smallest_limits:
        lower = lower if limits.soft_lower is None else max(lower, limits.soft_lower)
        upper = upper if limits.soft_upper is None else min(upper, limits.soft_upper)
    if zero is None:
        zero = 0.0 if lower <= 0.0 <= upper else 0.5 * (lower + upper)
    return FreeJoint(lower, upper, zero, joint.type == "continuous")
