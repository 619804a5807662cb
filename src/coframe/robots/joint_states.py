"""What joint_state_publisher tells of a robot: defaults, what other sources say, and joints that follow others."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from coframe.errors import RobotDescriptionError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from coframe.robots.parts import Joint
    from coframe.robots.robot import Robot

__all__ = ["FreeJoint", "JointStates", "Told"]


@dataclass
class FreeJoint:
    """A joint that follows no other one.

    Attributes:
        lower: Radians or metres, to where it can go; a continuous joint from -pi to pi.
        upper: Likewise.
        zero: Where it rests.
        goes_round: Whether it comes out at the other end.
        position: Where it is; None: nobody has said.
        velocity: Likewise.
        effort: Likewise.
        goes_up: The way in which :meth:`JointStates.step` moves it.
    """

    lower: float
    upper: float
    zero: float
    goes_round: bool = False
    position: float | None = None
    velocity: float | None = None
    effort: float | None = None
    goes_up: bool = True


class Told(NamedTuple):
    """The fields of a JointState; empty where nothing is known of any joint."""

    names: list[str]
    positions: list[float]
    velocities: list[float]
    efforts: list[float]


class _Follower(NamedTuple):
    """By which factor and offset a joint follows another one."""

    leader: str
    factor: float = 1.0
    offset: float = 0.0


class JointStates:
    """The states of a robot's joints with one position each.

    Args:
        robot: The robot.
        zeros: By joint, where it rests; the others at 0, or amid their limits where these leave 0 out.
        dependent: By joint, whom it follows: (joint, factor, offset), which wins over its mimic tag.
        use_mimic_tags: Joints with such a tag follow whom it names; else they move by themselves.
        use_smallest_limits: A safety controller's limits count where they are narrower.
        positions: Joints that nobody told of are said to be where they rest,
        velocities: to stand still,
        efforts: and to be without effort.

    Raises:
        RobotDescriptionError: Joints follow each other in a circle, or one that is not there.
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
        followers = {name: _Follower(*whom) for name, whom in (dependent or {}).items() if name in joints}
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

    def take(
        self,
        names: Sequence[str],
        positions: Sequence[float] = (),
        velocities: Sequence[float] = (),
        efforts: Sequence[float] = (),
    ) -> None:
        """Takes over what another source says of joints that follow none; the rest is left out.

        Raises:
            ValueError: One of the fields that are not empty has not as many values as there are names, or one that is
                not finite.
        """
        fields = {"position": positions, "velocity": velocities, "effort": efforts}
        for field, values in fields.items():
            if len(values) not in {0, len(names)}:
                raise ValueError(f"it has {len(names)} names, but {field} has {len(values)} values")
            if not all(math.isfinite(value) for value in values):
                raise ValueError(f"a {field} is not finite")
        for field, values in fields.items():
            for name, value in zip(names, values, strict=False):
                if name in self.free:
                    setattr(self.free[name], field, float(value))

    def step(self, delta: float) -> None:
        """Moves every free joint by so much, to and fro between its limits; what goes round begins anew."""
        for joint in self.free.values():
            position = (joint.zero if joint.position is None else joint.position) + (delta if joint.goes_up else -delta)
            if position > joint.upper:
                position = joint.lower if joint.goes_round else joint.upper
                joint.goes_up = joint.goes_round
            elif position < joint.lower:
                position = joint.lower
                joint.goes_up = True
            joint.position = position

    def told(self) -> Told:
        """What there is to tell of all joints, those that follow others included; 0 for one that nobody told of."""
        pairs = [(self.free[follower.leader], follower) for follower in self._followers.values()]

        def field(values: list[float | None]) -> list[float]:
            known = any(value is not None for value in values)
            return [0.0 if value is None else value for value in values] if known else []

        return Told(
            list(self._followers),
            field([None if j.position is None else j.position * f.factor + f.offset for j, f in pairs]),
            field([None if j.velocity is None else j.velocity * f.factor for j, f in pairs]),
            field([j.effort for j, _ in pairs]),
        )

    def _last_leader(self, name: str, followers: Mapping[str, _Follower]) -> _Follower:
        """Whom a joint follows in the end, itself perhaps."""
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
                f"joint {chain[-2]!r} depends on {found.leader!r}, which is no joint with one position"
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
