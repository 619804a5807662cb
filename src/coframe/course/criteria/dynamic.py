# SPDX-License-Identifier: Apache-2.0
"""Dynamic transforms, 25 points: the arm follows the specified motion, or the joint states."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.course._sheet import Sheet
from coframe.course._world import STEP, stamp_of
from coframe.course.criteria.arm_motion import ANGLE, CHILDREN, Formula, Motion, angle_of
from coframe.course.criteria.causes import edge_cause, name_mistake, period_cause, quaternion_values
from coframe.course.criteria.common import (
    TOLERANCE,
    Task,
    mean_rate,
    run_program,
    stamp_ns,
    to_seconds,
    transforms_on_tf,
)
from coframe.course.rubric import RUBRIC
from coframe.time import SECOND
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

if TYPE_CHECKING:
    from coframe.course._program import StudentProgram
    from coframe.course._world import Received, World

__all__ = ["check"]

_EDGES = (("base_link", "link1"), ("link1", "link2"), ("link2", "end_effector"))
_FRAMES = ("base_link", "link1", "link2", "end_effector")
_JOINTS = ("joint1", "joint2")
_TOPIC = "/joint_states"
_JOINT_STATE_PERIOD = 2 * STEP
_MAX_AGE = 10 * STEP  # of the joint state that the arm follows
_PAUSE_DURATION = 0.13  # seconds by which the timer of the program is late once
_MIN_SETS = 3
_SLOW_STEP, _SLOW_STEPS = 1.0, 100  # seconds; the clock runs faster if the program has published almost nothing
_REAL_SECONDS, _REAL_SETS = 2.0, 3  # for the stamps with the clock of the system
_STATIC_BROADCASTER = (
    "StaticTransformBroadcaster sends on /tf_static, where each message replaces the past: use TransformBroadcaster"
)
_CHAPTER = "handbook chapter 3, static and dynamic transforms"
_TIME_CHAPTER = "handbook chapter 5, time, interpolation, waiting"


class _Published(NamedTuple):
    """What the program has published.

    Attributes:
        simulated: The messages without joint states.
        in_order: Those while the joint states had the order joint1, joint2.
        reversed: Those while they had the order joint2, joint1.
        real: Those with the clock of the system.
        topic: The topic of the messages.
        subscriptions: The topics of joint states to which the program subscribes.
    """

    simulated: list[Received]
    in_order: list[Received]
    reversed: list[Received]
    real: list[Received]
    topic: str
    subscriptions: list[str]


def check(task: Task) -> Sheet:
    """Check ``dynamic_tf_broadcaster.py``."""
    sheet = Sheet.of(RUBRIC["dynamic"])
    with run_program(task, sheet, outputs=["/tf_static"]) as program:
        nothing = _Published([], [], [], [], "/tf", [])
        published = nothing if program is None else _run(task.world, program)
        motion = Motion.of(published.simulated, 1.0 / task.assignment.dynamic_rate)
        _check_edges(sheet, published)
        _check_dimensions(sheet, task, published.simulated)
        _check_motion(sheet, published.simulated, motion)
        _check_times(sheet, task, published)
        _check_joint_states(sheet, published, motion)
    return sheet


def _run(world: World, program: StudentProgram) -> _Published:
    """Run the program, first without joint states, then with both orders of joints, then with the system clock."""
    volatile, stored = world.watch("/tf", TFMessage), world.watch("/tf", TFMessage, latched=True)
    static = world.watch("/tf_static", TFMessage, latched=True)

    def received() -> list[Received]:
        return transforms_on_tf(volatile, stored) or static

    def during(seconds: float, joints: tuple[str, ...]) -> list[Received]:
        first = len(received())
        world.run(seconds, lambda now: _publish_joint_states(world, now, joints))
        return received()[first:]

    world.start(program)
    world.run(2.5)
    world.jump(_PAUSE_DURATION)
    world.run(2.5)
    for _ in range(_SLOW_STEPS):
        if len(received()) > _MIN_SETS * len(_EDGES):
            break
        world.jump(_SLOW_STEP)
    simulated = list(received())
    in_order, swapped = during(0.6, _JOINTS), during(0.6, _JOINTS[::-1])
    subscriptions = world.subscribed_topics("sensor_msgs/msg/JointState")
    first = len(received())

    def has_enough() -> bool:
        _publish_joint_states(world, world.now - world.now % _JOINT_STATE_PERIOD, _JOINTS)
        return len(received()) >= first + _REAL_SETS * len(_EDGES)

    world.use_system_time(_REAL_SECONDS, has_enough)
    topic = "/tf" if volatile or stored else "/tf_static"
    return _Published(simulated, in_order, swapped, received()[first:], topic, subscriptions)


def _published_angles(seconds: float) -> tuple[float, float]:
    """Return the joint states published by the check: the arm swings slowly, far from the simulated motion."""
    return 1.2 + 0.1 * float(np.sin(seconds)), -0.9 + 0.1 * float(np.cos(seconds))


def _publish_joint_states(world: World, now: int, joints: tuple[str, ...]) -> None:
    if now % _JOINT_STATE_PERIOD == 0:
        angles = dict(zip(_JOINTS, _published_angles(to_seconds(now)), strict=True))
        state = JointState(name=list(joints), position=[angles[joint] for joint in joints])
        state.header.stamp = stamp_of(now)
        world.publish(_TOPIC, state)


def _samples(messages: list[Received], child: str) -> list[Any]:
    return [each for one in messages for each in one.message.transforms if each.child_frame_id == child]


def _check_edges(sheet: Sheet, published_messages: _Published) -> None:
    sent = [each for one in published_messages.simulated for each in one.message.transforms]
    edges = [(each.header.frame_id, each.child_frame_id) for each in sent]
    others = [f"{parent} -> {child}" for parent, child in dict.fromkeys(edges) if child not in _FRAMES]
    for parent, child in _EDGES:
        parents = {each.header.frame_id for each in sent if each.child_frame_id == child}
        is_dynamic = published_messages.topic == "/tf"
        where = "" if is_dynamic else f" on {published_messages.topic}"
        missing = f"no transform to {child}" + (f"; received: {', '.join(others[:3])}" if others else "")
        sheet.check(
            1,
            f"{child} has the parent {parent}",
            parents == {parent} and is_dynamic,
            expected=f"transforms from {parent} to {child} on /tf",
            observed=f"parents{where}: {', '.join(sorted(parents))}" if parents else missing,
            cause=edge_cause(parent, child, edges, _FRAMES) if parents != {parent} else _STATIC_BROADCASTER,
            read=_CHAPTER,
        )


def _check_dimensions(sheet: Sheet, task: Task, messages: list[Received]) -> None:
    first, second = task.assignment.link_lengths
    rows = (
        (1, "link1", "the height of the first joint", (0.0, 0.0, task.assignment.base_height)),
        (2, "link2", "the length of the first link", (first, 0.0, 0.0)),
        (2, "end_effector", "the length of the second link", (second, 0.0, 0.0)),
    )
    seen = {child: _offsets(messages, child) for _, child, _, _ in rows}
    for points, child, name, correct in rows:
        offsets = seen[child]
        sheet.check(
            points,
            f"{name} is right",
            bool(len(offsets)) and bool(np.abs(offsets - correct).max() <= TOLERANCE),
            expected=f"translation {list(correct)} m of {child}",
            observed=f"translation {[round(value, 6) for value in offsets[-1].tolist()]} m"
            if len(offsets)
            else f"no transform to {child}",
            cause=_dimension_cause(offsets, correct, first, second),
            read="handbook chapter 1, why frames",
        )


def _offsets(messages: list[Received], child: str) -> np.ndarray[Any, np.dtype[np.float64]]:
    translations = [each.transform.translation for each in _samples(messages, child)]
    return np.array([[each.x, each.y, each.z] for each in translations]).reshape(-1, 3)


def _dimension_cause(offsets: Any, correct: tuple[float, ...], first: float, second: float) -> str:
    """Return the mistake in the constant translation of a joint."""
    if not len(offsets):
        return ""
    last = offsets[-1]
    swapped = {first: second, second: first}.get(correct[0])
    for values, cause in (
        ((swapped, 0.0, 0.0), "the lengths of the two links are exchanged"),
        ([1000.0 * value for value in correct], "the length is in millimeters; ROS uses meters"),
        ([100.0 * value for value in correct], "the length is in centimeters; ROS uses meters"),
        ([-value for value in correct], "the sign of the translation is changed"),
        ((0.0, 0.0, 0.0), "the translation is not set"),
        ((0.0, max(correct), 0.0), "the length is in y: the link points along x"),
        ((0.0, 0.0, correct[0]), "the length is in z: the link points along x"),
        ((correct[2], 0.0, 0.0), "the height is in x instead of z"),
    ):
        if None not in values and np.abs(last - np.array(values)).max() <= TOLERANCE:
            return cause
    return ""


def _check_motion(sheet: Sheet, messages: list[Received], motion: Motion) -> None:
    """Check the joint angles at their stamps."""
    for joint, child in enumerate(CHILDREN):
        law = ("0.5 sin(2 pi 0.2 t)", "0.3 sin(2 pi 0.3 t + pi / 4)")[joint]
        sheet.check(
            2.5,
            f"joint {joint + 1} follows the specified motion",
            motion.is_right[joint],
            expected=f"a rotation about z by {law}",
            observed=_motion_observation(_samples(messages, child), motion.causes[joint]),
            cause=motion.causes[joint],
            read="handbook chapter 2, rotations and quaternions",
        )


def _motion_observation(samples: list[Any], cause: str) -> str:
    if len(samples) < 3:
        return f"{len(samples)} transforms" if samples else "no transform"
    if "same time" in cause:
        return "each joint follows the motion, but not from a common start"
    tilts = [max(abs(each.transform.rotation.x), abs(each.transform.rotation.y)) for each in samples]
    if max(tilts) > TOLERANCE:
        return "the rotation is not about z"
    angles = [angle_of(each) for each in samples]
    return f"another motion, with angles from {min(angles):.3f} to {max(angles):.3f} rad"


def _check_times(sheet: Sheet, task: Task, published_messages: _Published) -> None:
    expected_rate, received = task.assignment.dynamic_rate, published_messages.simulated
    arm = [each for each in received if any(edge.child_frame_id == "link1" for edge in each.message.transforms)]
    rate = mean_rate(arm)
    sheet.check(
        3,
        f"the transforms are sent at {expected_rate:g} Hz",
        abs(rate - expected_rate) <= 0.1 * expected_rate,
        expected=f"{expected_rate:g} Hz, 10 % more or less",
        observed=f"{rate:.3g} Hz",
        cause=period_cause(rate, expected_rate),
        read=_CHAPTER,
    )
    _check_stamps(sheet, arm)
    _check_common_stamp(sheet, published_messages)


def _check_stamps(sheet: Sheet, arm: list[Received]) -> None:
    stamps = [stamp_ns(each) for each in _samples(arm, "link1")]
    ahead = [stamp_ns(edge) - each.time for each in arm for edge in each.message.transforms]
    increasing = all(later > earlier for earlier, later in itertools.pairwise(stamps))
    offset = max(ahead, key=abs, default=0)
    sheet.check(
        2,
        "the stamps are the current time and increase",
        bool(stamps) and increasing and abs(offset) <= 5 * STEP,
        expected="stamps from the node's clock, each later than the previous one",
        observed="no transform"
        if not stamps
        else f"stamps that are up to {to_seconds(abs(offset)):.3g} s {'ahead of' if offset > 0 else 'behind'} the clock"
        if abs(offset) > 5 * STEP
        else "repeated or decreasing stamps",
        cause=_stamp_cause(stamps, offset),
        read=_TIME_CHAPTER,
    )


def _stamp_cause(stamps: list[int], offset: int) -> str:
    if not stamps:
        return ""
    if not any(stamps):
        return "header.stamp is not set: use self.get_clock().now().to_msg()"
    if len(set(stamps)) == 1 and len(stamps) > 1:
        return "the stamp is read once, and used for all messages: read the clock in each call of the timer"
    if offset > 1_000_000 * SECOND:
        return "the stamp is the time of the system: use the clock of the node, self.get_clock().now()"
    return ""


def _check_common_stamp(sheet: Sheet, published_messages: _Published) -> None:
    """Check the stamps with the clock of the system, on which two calls of now() never return the same time."""
    sets = [{stamp_ns(each) for each in _samples(published_messages.simulated, child)} for _, child in _EDGES]
    real = [{stamp_ns(each) for each in _samples(published_messages.real, child)} for _, child in _EDGES]
    in_simulation = bool(sets[0]) and sets[0] == sets[1] == sets[2]
    common = set.intersection(*real) if all(real) else set()
    differ = bool(all(real)) and not common
    sheet.check(
        1,
        "all three transforms have the same stamp",
        in_simulation and not differ,
        expected="one stamp for the whole arm",
        observed="different stamps" if all(sets) else "no transform",
        cause="the clock is read for each transform: call now() once, and use its result for all three"
        if differ
        else "",
        read=_TIME_CHAPTER,
    )


def _check_joint_states(sheet: Sheet, published_messages: _Published, motion: Motion) -> None:
    formula = motion.formula
    first = _second_half(published_messages.in_order)
    followed = [_is_followed(each, formula) for each in first]
    sheet.check(
        2,
        "the arm follows /joint_states",
        any(followed),
        expected="the angles of the last joint state",
        observed="other angles" if followed else "no transform while joint states are published",
        cause=_following_cause(published_messages, formula, any(followed)),
        read=_CHAPTER,
    )
    swapped = _second_half(published_messages.reversed)
    by_name = [_is_followed(each, formula) for each in swapped]
    sheet.check(
        1,
        "the arm finds the joints by name",
        any(by_name),
        expected="the same motion when /joint_states has the order joint2, joint1",
        observed="other angles" if by_name else "no transform while joint states are published",
        cause="the angles are taken by position: use dict(zip(message.name, message.position))"
        if any(followed) and any(_is_followed(each, formula, exchanged=True) for each in swapped)
        else _following_cause(published_messages, formula, any(by_name)),
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
        cause="the simulation continues while joint states arrive: two sources of joint angles make the arm flicker"
        if any(followed)
        else _following_cause(published_messages, formula, any(followed)),
        read="handbook chapter 10, finding errors",
    )


def _second_half(messages: list[Received]) -> list[Received]:
    """Return the later messages with the angles of the arm, after the node has had time to react."""
    arm = [each for each in messages if _rotations(each)]
    return arm[len(arm) // 2 :]


def _following_cause(published_messages: _Published, formula: Formula, is_followed: bool) -> str:
    """Return why the arm does not follow the joint states."""
    topics = published_messages.subscriptions
    if is_followed or not published_messages.simulated:
        return ""
    if not topics:
        return "there is no subscription to /joint_states"
    if _TOPIC not in topics:
        return name_mistake(topics[0], _TOPIC) or f"the subscription is to {topics[0]}, not to {_TOPIC}"
    if any(_is_followed(each, formula, exchanged=True) for each in _second_half(published_messages.in_order)):
        return "the angles of the two joints are exchanged"
    return ""


def _rotations(message: Received) -> dict[str, np.ndarray[Any, np.dtype[np.float64]]]:
    return {
        each.child_frame_id: quaternion_values(each.transform.rotation)
        for each in message.message.transforms
        if each.child_frame_id in CHILDREN
    }


def _is_followed(message: Received, formula: Formula, *, exchanged: bool = False) -> bool:
    """Return whether the angles match a joint state of the last 100 ms.

    Args:
        message: A message of the arm.
        formula: The formula of its quaternions. Its mistake has lost points for the motion already.
        exchanged: Whether each joint has the angle of the other one.
    """
    found = _rotations(message)
    for age in range(0, _MAX_AGE + 1, STEP):
        angles = np.array(_published_angles(to_seconds(message.time - age)))
        expected = dict(zip(CHILDREN, formula.quaternions(angles[::-1] if exchanged else angles), strict=True))
        cosines = [abs(float(found[child] @ expected[child])) for child in found]
        if all(2.0 * np.sqrt(max(2.0 * (1.0 - cosine), 0.0)) <= ANGLE for cosine in cosines):
            return True
    return False
