# SPDX-License-Identifier: Apache-2.0
"""Transform listener, 20 points: the pose of the end effector at its own stamp, even after transforms were missing."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.course._motion import SimulatedRobot
from coframe.course._sheet import Sheet
from coframe.course._world import STEP
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
from geometry_msgs.msg import PoseStamped

if TYPE_CHECKING:
    from coframe.course._world import Received

__all__ = ["check"]

_TOPIC = "/end_effector_pose"
_LATENCY = STEP  # the transforms arrive one step after their stamps, delayed as on a real robot
_PERIOD = 2 * STEP
# Between two samples, tf2 interpolates linearly; the arm moves on circles, which deviates by less than this.
_INTERPOLATION_TOLERANCE = 1e-4  # meters
_MAX_AGE = 3 * SECOND // 2  # age of a transform that a listener may still use while the broadcaster is missing
_READ = "handbook chapter 4, what lookup_transform(target, source) means"


def check(task: Task) -> Sheet:
    """Check ``tf_listener.py``."""
    sheet = Sheet.of(RUBRIC["listener"])
    world = task.world
    robot = SimulatedRobot(task.assignment)

    def publish(now: int) -> None:
        if now % _PERIOD == 0:
            world.publish_transforms(robot.arm_at(now - _LATENCY), now - _LATENCY)

    with run_program(task, sheet) as program:
        poses = world.watch(_TOPIC, PoseStamped)
        if program is not None:
            world.start(program)
            world.run(1.0)  # no transforms yet
            world.run(4.0, publish)
        steady = [each for each in poses if each.time > world.now - 3 * SECOND]
        names = sorted({info.node_name for info in world.publishers_of(_TOPIC)})
        if program is not None:
            world.run(1.0)  # the broadcaster is missing
        resumed_at = world.now
        if program is not None:
            world.run(1.0, publish)
        is_alive = program is not None and program.is_running()
        _check_topic(sheet, poses, names)
        _check_rate(sheet, task, steady)
        _check_poses(sheet, robot, poses)
        again = [each for each in poses if each.time > resumed_at]
        sheet.check(
            3,
            "the node survives missing transforms",
            is_alive and bool(again),
            expected="no poses without transforms, poses again when they return",
            observed="the node ended" if not is_alive else "no poses after the transforms returned",
            cause="an exception of lookup_transform is not caught: except tf2_ros.TransformException",
            read="handbook chapter 5, time, interpolation, waiting",
        )
    return sheet


def _check_topic(sheet: Sheet, poses: list[Received], names: list[str]) -> None:
    good = bool(poses) and names == ["tf_listener"]
    sheet.check(
        3,
        f"the node tf_listener publishes poses on {_TOPIC}",
        1.0 if good else 0.5 if poses or names == ["tf_listener"] else 0.0,
        expected=f"PoseStamped messages on {_TOPIC} from the node tf_listener",
        observed=f"{len(poses)} messages from {', '.join(names) or 'no node'}",
        cause="publish() is never called" if names and not poses else "a different topic, type or node name",
        read=_READ,
    )


def _check_rate(sheet: Sheet, task: Task, steady: list[Received]) -> None:
    wanted = task.assignment.listener_rate
    rate = mean_rate(steady)
    sheet.check(
        4,
        f"the poses are sent at {wanted:g} Hz",
        abs(rate - wanted) <= 0.1 * wanted,
        expected=f"{wanted:g} Hz, 10 % more or less",
        observed=f"{rate:.1f} Hz",
        cause="a different timer period, or a lookup that blocks in the callback",
        read=_READ,
    )


def _check_poses(sheet: Sheet, robot: SimulatedRobot, poses: list[Received]) -> None:
    frames = sorted({each.message.header.frame_id for each in poses})
    sheet.check(
        3,
        "the poses are relative to base_link",
        frames == ["base_link"],
        expected="header.frame_id is base_link",
        observed=f"header.frame_id is {', '.join(map(repr, frames))}" if frames else "no poses",
        cause="frame_id is the frame in which the pose is expressed: the target of the lookup",
        read=_READ,
    )
    wrong = [text for each in poses if (text := _difference(robot, each))]
    sheet.check(
        7,
        "each pose is correct at its stamp",
        0.0 if not poses else 1.0 if not wrong else 0.5 if _is_correct_at_other_time(robot, poses) else 0.0,
        expected="the analytic pose of the arm at the stamp of the pose",
        observed=f"{len(wrong)} of {len(poses)} poses are wrong: {wrong[-1]}" if wrong else "no poses",
        cause=_cause(robot, poses),
        read="handbook chapter 5, time, interpolation, waiting",
    )


def _difference(robot: SimulatedRobot, received: Received) -> str:
    stamp = stamp_ns(received.message)
    at_sample = (stamp + _LATENCY) % _PERIOD == 0
    return difference_text(
        read_pose(received.message), robot.end_effector(stamp), TOLERANCE if at_sample else _INTERPOLATION_TOLERANCE
    )


def _is_correct_at_other_time(robot: SimulatedRobot, poses: list[Received]) -> bool:
    """Return whether all poses are right at an earlier time instead of at their stamps."""
    return all(_find_pose_time(robot, each) is not None for each in poses)


def _find_pose_time(robot: SimulatedRobot, received: Received) -> int | None:
    pose = read_pose(received.message)
    for age in range(0, _MAX_AGE, STEP):
        moment = received.time - age
        if not difference_text(pose, robot.end_effector(moment), TOLERANCE):
            return moment
    return None


def _cause(robot: SimulatedRobot, poses: list[Received]) -> str:
    if not poses:
        return "see the facts above"
    if _is_correct_at_other_time(robot, poses):
        late = min(stamp_ns(each.message) - (_find_pose_time(robot, each) or 0) for each in poses)
        return (
            f"the stamp is {to_seconds(late) * 1000:.0f} ms later than the transform: "
            "use transform.header.stamp, not now()"
        )
    inverse = [robot.end_effector(stamp_ns(each.message)).inverse() for each in poses]
    if all(
        not difference_text(read_pose(each.message), other, 0.05) for each, other in zip(poses, inverse, strict=True)
    ):
        return "target and source are swapped: lookup_transform('base_link', 'end_effector', ...)"
    return "wrong frames, or a part of the pose is not set"
