# SPDX-License-Identifier: Apache-2.0
"""Dynamic transforms, 25 points: the arm follows the specified motion, or the joint states."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.course._motion import JOINT_PERIOD
from coframe.course._sheet import Sheet
from coframe.course._world import STEP, stamp_of
from coframe.course.criteria.common import TOLERANCE, Task, mean_rate, run_program, stamp_ns, to_seconds
from coframe.course.rubric import RUBRIC
from coframe.time import SECOND
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.course._world import Received, World

__all__ = ["check"]

_EDGES = (("base_link", "link1"), ("link1", "link2"), ("link2", "end_effector"))
_ANGLE = 1e-3  # radians; far below the effect of a wrong amplitude, frequency or phase
_JOINT_STATE_PERIOD = 2 * STEP
_STARTUP_TIME = SECOND // 5
_CHAPTER = "handbook chapter 3, static and dynamic transforms"


def check(task: Task) -> Sheet:
    """Check ``dynamic_tf_broadcaster.py``."""
    sheet = Sheet.of(RUBRIC["dynamic"])
    world = task.world
    with run_program(task, sheet) as program:
        received = world.watch("/tf", TFMessage)
        if program is not None:
            world.start(program)
            world.run(5.0)
        simulated = list(received)
        if program is not None:
            world.run(1.0, lambda now: _publish_joint_states(world, now))
        followed = received[len(simulated) :]
        _check_edges(sheet, simulated)
        _check_dimensions(sheet, task, simulated)
        _check_motion_law(sheet, simulated)
        _check_times(sheet, task, simulated)
        _check_joint_states(sheet, followed)
    return sheet


def _published_angles(seconds: float) -> tuple[float, float]:
    """Return the joint states published by the check: the arm swings slowly, far from the simulated motion."""
    return 1.2 + 0.1 * float(np.sin(seconds)), -0.9 + 0.1 * float(np.cos(seconds))


def _publish_joint_states(world: World, now: int) -> None:
    if now % _JOINT_STATE_PERIOD == 0:
        state = JointState(name=["joint1", "joint2"], position=list(_published_angles(to_seconds(now))))
        state.header.stamp = stamp_of(now)
        world.publish("/joint_states", state)


def _samples(received: list[Received], child: str) -> list[Any]:
    return [each for one in received for each in one.message.transforms if each.child_frame_id == child]


def _angle(message: Any) -> float:
    return float(2.0 * np.arctan2(message.transform.rotation.z, message.transform.rotation.w))


def _check_edges(sheet: Sheet, received: list[Received]) -> None:
    for parent, child in _EDGES:
        parents = {each.header.frame_id for each in _samples(received, child)}
        sheet.check(
            1,
            f"{child} has the parent {parent}",
            parents == {parent},
            expected=f"transforms from {parent} to {child} on /tf",
            observed=f"parents: {', '.join(sorted(parents))}" if parents else f"no transform to {child}",
            cause="header.frame_id is the parent, child_frame_id the child",
            read=_CHAPTER,
        )


def _check_dimensions(sheet: Sheet, task: Task, received: list[Received]) -> None:
    first, second = task.assignment.link_lengths
    for points, child, name, correct in (
        (1, "link1", "the height of the first joint", (0.0, 0.0, task.assignment.base_height)),
        (2, "link2", "the length of the first link", (first, 0.0, 0.0)),
        (2, "end_effector", "the length of the second link", (second, 0.0, 0.0)),
    ):
        moves = [each.transform.translation for each in _samples(received, child)]
        offsets = [max(abs(m.x - correct[0]), abs(m.y - correct[1]), abs(m.z - correct[2])) for m in moves]
        seen = f"[{moves[-1].x:.6g}, {moves[-1].y:.6g}, {moves[-1].z:.6g}]" if moves else "no transform"
        sheet.check(
            points,
            f"{name} is right",
            bool(offsets) and max(offsets) <= TOLERANCE,
            expected=f"translation {list(correct)} m of {child}",
            observed=f"translation {seen}",
            cause="swapped link lengths, or values that differ from the assignment (lab.json, README.md)",
            read="handbook chapter 1, why frames",
        )


def _check_motion_law(sheet: Sheet, received: list[Received]) -> None:
    """Check the joint angles at their stamps. The motion may start at any time."""
    good = [_follows_law(received, index) for index in (0, 1)]
    together = _common_start(received) if all(good) else False
    for index, child in enumerate(("link1", "link2")):
        samples = _samples(received, child)
        tilted = any(abs(each.transform.rotation.x) + abs(each.transform.rotation.y) > TOLERANCE for each in samples)
        law = ("0.5 sin(2 pi 0.2 t)", "0.3 sin(2 pi 0.3 t + pi / 4)")[index]
        fits = good[index] and (index == 0 or together or not good[0])
        sheet.check(
            2.5,
            f"joint {index + 1} follows the specified motion",
            bool(samples) and not tilted and fits,
            expected=f"a rotation about z by {law}",
            observed=_law_observation(samples, tilted),
            cause="sin(q) and cos(q) instead of sin(q / 2) and cos(q / 2), degrees, or another amplitude or frequency",
            read="handbook chapter 2, rotations and quaternions",
        )


def _law_observation(samples: list[Any], tilted: bool) -> str:
    if not samples:
        return "no transform"
    if tilted:
        return "the rotation is not about z"
    angles = [_angle(each) for each in samples]
    return f"angles from {min(angles):.3f} to {max(angles):.3f} rad"


def _angle_at(index: int, seconds: NDArray[np.float64]) -> NDArray[np.float64]:
    angles = (
        0.5 * np.sin(2 * np.pi * 0.2 * seconds) if index == 0 else 0.3 * np.sin(2 * np.pi * 0.3 * seconds + np.pi / 4)
    )
    return np.asarray(angles)


def _residuals(received: list[Received], index: int, starts: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the maximum deviation from the specified motion, in radians, for each possible start time."""
    samples = _remove_startup(_samples(received, ("link1", "link2")[index]))
    times = np.array([to_seconds(stamp_ns(each) % round(JOINT_PERIOD * SECOND)) for each in samples])
    angles = np.array([_angle(each) for each in samples])
    return np.asarray(np.abs(_angle_at(index, times[None, :] - starts[:, None]) - angles[None, :]).max(axis=1))


def _remove_startup(samples: list[Any]) -> list[Any]:
    """Return the samples without the initial ones, when the simulated clock jumps to its start time."""
    return [each for each in samples if stamp_ns(each) - stamp_ns(samples[0]) > _STARTUP_TIME]


def _starts() -> NDArray[np.float64]:
    return np.arange(0.0, JOINT_PERIOD, 0.002)


def _follows_law(received: list[Received], index: int) -> bool:
    if len(_remove_startup(_samples(received, ("link1", "link2")[index]))) < 3:
        return False
    return bool(_residuals(received, index, _starts()).min() <= _ANGLE)


def _common_start(received: list[Received]) -> bool:
    """Return whether both joints began at the same time."""
    both = np.maximum(_residuals(received, 0, _starts()), _residuals(received, 1, _starts()))
    return bool(both.min() <= _ANGLE)


def _check_times(sheet: Sheet, task: Task, received: list[Received]) -> None:
    wanted = task.assignment.dynamic_rate
    arm = [each for each in received if any(edge.child_frame_id == "link1" for edge in each.message.transforms)]
    rate = mean_rate(arm)
    sheet.check(
        3,
        f"the transforms are sent at {wanted:g} Hz",
        abs(rate - wanted) <= 0.1 * wanted,
        expected=f"{wanted:g} Hz, 10 % more or less",
        observed=f"{rate:.1f} Hz",
        cause="a different timer period",
        read=_CHAPTER,
    )
    stamps = [stamp_ns(each) for each in _samples(received, "link1")]
    ahead = [stamp_ns(edge) - each.time for each in arm for edge in each.message.transforms]
    increasing = all(later > earlier for earlier, later in itertools.pairwise(stamps))
    late = max((abs(each) for each in ahead), default=SECOND)
    sheet.check(
        2,
        "the stamps are the current time and increase",
        len(stamps) > 1 and increasing and late <= 5 * STEP,
        expected="stamps from the node's clock, each later than the previous one",
        observed="repeated or decreasing stamps"
        if not increasing
        else f"stamps up to {to_seconds(late):.3g} s off the clock"
        if stamps
        else "no transform",
        cause="the stamp is set once, or is the time of the system: use self.get_clock().now() for each message",
        read="handbook chapter 5, time, interpolation, waiting",
    )
    children = [child for _, child in _EDGES]
    sets = [{stamp_ns(each) for each in _samples(received, child)} for child in children]
    sheet.check(
        1,
        "all three transforms have the same stamp",
        bool(sets[0]) and sets[0] == sets[1] == sets[2],
        expected="one stamp for the whole arm",
        observed="different stamps" if all(sets) else "no transform",
        cause="now() is called once per transform",
        read="handbook chapter 5, time, interpolation, waiting",
    )


def _check_joint_states(sheet: Sheet, received: list[Received]) -> None:
    half = received[len(received) // 2 :]
    followed = [_is_followed(each) for each in half if _angles(each)]
    sheet.check(
        3,
        "the arm follows /joint_states",
        any(followed),
        expected="the angles of the last joint state",
        observed="other angles" if followed else "no transform while joint states are published",
        cause="no subscription to /joint_states, or the positions are not used",
        read=_CHAPTER,
    )
    sheet.check(
        3,
        "no other publisher moves the arm at the same time",
        bool(followed) and all(followed),
        expected="no other angles while joint states are published",
        observed=f"{followed.count(False)} of {len(followed)} messages have other angles"
        if followed
        else "no transform",
        cause="the simulation continues while joint states arrive: two sources of joint angles make the arm flicker",
        read="handbook chapter 10, finding errors",
    )


def _angles(received: Received) -> dict[str, float]:
    return {
        each.child_frame_id: _angle(each)
        for each in received.message.transforms
        if each.child_frame_id in {"link1", "link2"}
    }


def _is_followed(received: Received) -> bool:
    """Return whether the angles match a joint state of the last 100 ms."""
    times = [to_seconds(received.time - age * STEP) for age in range(11)]
    found = _angles(received)
    given = [dict(zip(("link1", "link2"), _published_angles(each), strict=True)) for each in times]
    return any(all(abs(found[child] - each[child]) <= _ANGLE for child in found) for each in given)
