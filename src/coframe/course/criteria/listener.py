# SPDX-License-Identifier: Apache-2.0
"""Transform listener, 20 points: the pose of the end effector at its own stamp, even after transforms were missing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.course._motion import SimulatedRobot
from coframe.course._sheet import Sheet
from coframe.course._world import STEP
from coframe.course.criteria.causes import log_cause, name_mistake, period_cause
from coframe.course.criteria.common import (
    TOLERANCE,
    Task,
    difference_text,
    mean_rate,
    read_pose,
    run_program,
    stamp_ns,
    to_seconds,
)
from coframe.course.rubric import RUBRIC
from coframe.time import SECOND
from coframe.transform.transform import Transform
from geometry_msgs.msg import PoseStamped

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.course._world import Received

__all__ = ["check"]

_TOPIC, _TYPE = "/end_effector_pose", "geometry_msgs/msg/PoseStamped"
_NODE = "tf_listener"
_LATENCY = STEP  # the transforms arrive one step after their stamps, delayed as on a real robot
_PERIOD = 2 * STEP
# Between two samples, tf2 interpolates linearly; the arm moves on circles, which deviates by less than this.
_INTERPOLATION_TOLERANCE = 1e-4  # meters
_MAX_AGE = 3 * SECOND // 2  # age of a transform that a listener may still use while the broadcaster is missing
_LEAD_TIME = SECOND // 2  # to recognize a node that asks for the current time
# The arm of the check is tilted: only a pose that was looked up is right, not one computed from the assignment.
_TILT_TRANSFORM = Transform.from_rpy((0.03, -0.02, 0.05), roll=0.3, pitch=-0.2)
_NOW_CAUSE = (
    "the lookup asks for the current time, self.get_clock().now(), whose transform has not arrived yet: "
    "ask for Time(), the latest one"
)
_COMPUTED_CAUSE = (
    "the pose is computed from the numbers of the assignment, not looked up: in the check, the arm is tilted"
)
_SWAPPED_CAUSE = "target and source are swapped: lookup_transform('base_link', 'end_effector', ...)"
_READ = "handbook chapter 4, what lookup_transform(target, source) means"
_TIME_CHAPTER = "handbook chapter 5, time, interpolation, waiting"


class _TiltedRobot(SimulatedRobot):
    """The robot of the assignment with a tilted arm."""

    def arm(self, angles: tuple[float, float]) -> list[Transform]:
        """Return the transforms base_link -> link1 -> link2 -> end_effector for two joint angles."""
        first, *others = super().arm(angles)
        tilted = _TILT_TRANSFORM @ Transform(first.translation, first.quaternion)
        return [Transform(tilted.translation, tilted.quaternion, target=first.target, source=first.source), *others]


def check(task: Task) -> Sheet:
    """Check ``tf_listener.py``."""
    sheet = Sheet.of(RUBRIC["listener"])
    world = task.world
    robot = _TiltedRobot(task.assignment)
    poses: list[Received] = []

    def publish(now: int, *, ahead: int = 0) -> None:
        if now % _PERIOD == 0:
            world.publish_transforms(robot.arm_at(now - _LATENCY + ahead), now - _LATENCY + ahead)

    def silence_cause(output: str) -> str:
        if not world.has_subscription("/tf"):
            return "there is no TransformListener, which receives the transforms for the buffer"
        world.run(1.0, lambda now: publish(now, ahead=_LEAD_TIME))
        return _NOW_CAUSE if poses else log_cause(output)

    with run_program(task, sheet, silence_cause=silence_cause) as program:
        topic, steady, names, resumed_at, is_alive = _TOPIC, [], [], 0, False
        if program is not None:
            world.start(program)
            topic = world.output_topic(_TOPIC, _TYPE)
            poses = world.watch(topic, PoseStamped)
            world.run(1.0)  # no transforms yet
            world.run(4.0, publish)
            steady = [each for each in poses if each.time > world.now - 3 * SECOND]
            names = sorted({info.node_name for info in world.publishers_of(topic)})
            world.run(1.0)  # the broadcaster is missing
            resumed_at = world.now
            world.run(1.0, publish)
            is_alive = program.is_running()
        _check_topic(sheet, poses, topic, names)
        _check_rate(sheet, task, steady)
        _check_poses(sheet, task, poses)
        again = [each for each in poses if each.time > resumed_at]
        sheet.check(
            3,
            "the node survives missing transforms",
            is_alive and bool(again),
            expected="no poses without transforms, poses again when they return",
            observed="the node ended" if not is_alive else "no poses after the transforms returned",
            read=_TIME_CHAPTER,
        )
    return sheet


def _check_topic(sheet: Sheet, poses: list[Received], topic: str, names: list[str]) -> None:
    right = topic == _TOPIC, names == [_NODE]
    causes = [] if right[0] else [name_mistake(topic, _TOPIC) or f"the topic is {topic} instead of {_TOPIC}"]
    if names and not right[1]:
        causes.append(f"the node is named {', '.join(names)} instead of {_NODE}")
    sheet.check(
        3,
        f"the node {_NODE} publishes poses on {_TOPIC}",
        1.0 if poses and all(right) else 0.5 if poses and any(right) else 0.0,
        expected=f"PoseStamped messages on {_TOPIC} from the node {_NODE}",
        observed=f"{len(poses)} messages on {topic} from {', '.join(names) or 'no node'}",
        cause="; ".join(causes),
        read=_READ,
    )


def _check_rate(sheet: Sheet, task: Task, steady_messages: list[Received]) -> None:
    expected_rate = task.assignment.listener_rate
    rate = mean_rate(steady_messages)
    sheet.check(
        4,
        f"the poses are sent at {expected_rate:g} Hz",
        abs(rate - expected_rate) <= 0.1 * expected_rate,
        expected=f"{expected_rate:g} Hz, 10 % more or less",
        observed=f"{rate:.3g} Hz",
        cause=period_cause(rate, expected_rate),
        read=_READ,
    )


def _check_poses(sheet: Sheet, task: Task, poses: list[Received]) -> None:
    robot = _TiltedRobot(task.assignment)
    frames = sorted({each.message.header.frame_id for each in poses})
    wrong = [text for each in poses if (text := _difference(robot, each))]
    cause = _pose_cause(task, robot, poses) if wrong else ""
    sheet.check(
        3,
        "the poses are relative to base_link",
        frames == ["base_link"],
        expected="header.frame_id is base_link",
        observed=f"header.frame_id is {', '.join(map(repr, frames))}" if frames else "no poses",
        cause=(cause if cause == _SWAPPED_CAUSE else _frame_cause(frames)) if frames else "",
        read=_READ,
    )
    sheet.check(
        7,
        "each pose is correct at its stamp",
        0.0 if not poses else 1.0 if not wrong else 0.5 if _is_correct_at_other_time(robot, poses) else 0.0,
        expected="the analytic pose of the arm at the stamp of the pose",
        observed=f"{len(wrong)} of {len(poses)} poses are wrong: {wrong[-1]}" if wrong else "no poses",
        cause=cause,
        read=_TIME_CHAPTER,
    )


def _frame_cause(frames: list[str]) -> str:
    if frames == [""]:
        return "header.frame_id is not set: it is the target of the lookup"
    return name_mistake(frames[0], "base_link") or (
        "frame_id is the frame in which the pose is expressed: the target of the lookup"
    )


def _difference(robot: SimulatedRobot, message: Received) -> str:
    stamp = stamp_ns(message.message)
    at_sample = (stamp + _LATENCY) % _PERIOD == 0
    return difference_text(
        read_pose(message.message), robot.end_effector(stamp), TOLERANCE if at_sample else _INTERPOLATION_TOLERANCE
    )


def _is_correct_at_other_time(robot: SimulatedRobot, poses: list[Received]) -> bool:
    """Return whether all poses are right at an earlier time instead of at their stamps."""
    return all(_find_pose_time(robot, each) is not None for each in poses)


def _find_pose_time(robot: SimulatedRobot, message: Received) -> int | None:
    pose = read_pose(message.message)
    for age in range(0, _MAX_AGE, STEP):
        moment = message.time - age
        if not difference_text(pose, robot.end_effector(moment), TOLERANCE):
            return moment
    return None


def _pose_cause(task: Task, robot: SimulatedRobot, poses: list[Received]) -> str:
    """Return the mistake that explains all poses, or ""."""
    if _is_correct_at_other_time(robot, poses):
        late = min(stamp_ns(each.message) - (_find_pose_time(robot, each) or 0) for each in poses)
        if not any(stamp_ns(each.message) for each in poses):
            return "header.stamp is not set: use transform.header.stamp"
        return (
            f"the stamp is {to_seconds(late) * 1000:.0f} ms later than the transform: "
            "use transform.header.stamp, not now()"
        )
    found = [read_pose(each.message) for each in poses]
    for cause, expected in _pose_trials(task, robot, poses):
        if all(
            not difference_text(pose, other, _INTERPOLATION_TOLERANCE)
            for pose, other in zip(found, expected, strict=True)
        ):
            return cause
    return ""


def _pose_trials(task: Task, robot: SimulatedRobot, poses: list[Received]) -> Iterator[tuple[str, list[Transform]]]:
    """Yield each common mistake with the poses that it would give."""
    found = [read_pose(each.message) for each in poses]
    stamps = [stamp_ns(each.message) for each in poses]
    truth = [robot.end_effector(stamp) for stamp in stamps]
    yield _SWAPPED_CAUSE, [one.inverse() for one in truth]
    yield _COMPUTED_CAUSE, [SimulatedRobot(task.assignment).end_effector(stamp) for stamp in stamps]
    yield "pose.orientation is not set", [Transform(one.translation) for one in truth]
    yield "pose.position is not set", [Transform((0.0, 0.0, 0.0), one.quaternion) for one in truth]
    yield "the orientation is inverted", [Transform(one.translation, one.inverse().quaternion) for one in truth]
    yield (
        "the quaternion is in the order w, x, y, z; ROS uses x, y, z, w",
        [Transform(one.translation, np.roll(one.quaternion, 1)) for one in truth],
    )
    yield from _component_trials(truth, found)


def _component_trials(truth: list[Transform], found: list[Transform]) -> list[tuple[str, list[Transform]]]:
    """Return the trials in which one coordinate of the position is not that of the transform."""
    trials = []
    for axis, name in enumerate("xyz"):
        expected = []
        for one, pose in zip(truth, found, strict=True):
            place = np.where(np.arange(3) == axis, pose.translation, one.translation)
            expected.append(Transform(place, one.quaternion))
        trials.append((f"pose.position.{name} is not that of the transform", expected))
    return trials
