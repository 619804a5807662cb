# SPDX-License-Identifier: Apache-2.0
"""Extension 2, 10 points: the pose of the end effector one second ago, relative to the robot's current pose."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.course._motion import SimulatedRobot
from coframe.course._sheet import Sheet
from coframe.course._world import STEP
from coframe.course.criteria.common import Task, difference_text, mean_rate, read_pose, run_program, stamp_ns
from coframe.course.rubric import RUBRIC
from coframe.time import SECOND
from geometry_msgs.msg import PoseStamped

if TYPE_CHECKING:
    from coframe.course._world import Received

__all__ = ["check"]

_TOPIC = "/past_end_effector_pose"
_AGE = SECOND
_PERIOD = 2 * STEP
_INTERPOLATION_TOLERANCE = 2e-4  # meters
_READ = "handbook chapter 9, recordings and time travel"


def check(task: Task) -> Sheet:
    """Check ``time_travel.py``."""
    sheet = Sheet.of(RUBRIC["time_travel"])
    world = task.world
    robot = SimulatedRobot(task.assignment)

    def publish(now: int) -> None:
        if now % _PERIOD == 0:
            world.publish_transforms([robot.base(now), *robot.arm_at(now)], now)

    with run_program(task, sheet) as program:
        poses = world.watch(_TOPIC, PoseStamped)
        if program is not None:
            world.start(program)
            world.run(4.0, publish)
        rate = mean_rate([each for each in poses if each.time > world.now - 2 * SECOND])
        sheet.check(
            3,
            f"poses are published on {_TOPIC} at 10 Hz",
            abs(rate - 10.0) <= 1.0,
            expected="PoseStamped messages at 10 Hz",
            observed=f"{rate:.1f} Hz",
            read=_READ,
        )
        frames = sorted({each.message.header.frame_id for each in poses})
        sheet.check(
            2,
            "the poses are relative to base_link",
            frames == ["base_link"],
            expected="header.frame_id is base_link",
            observed=", ".join(map(repr, frames)) or "no poses",
            read=_READ,
        )
        wrong = []
        for each in poses:
            now = stamp_ns(each.message)
            past = now - _AGE
            correct = robot.base(now).inverse() @ robot.base(past) @ robot.end_effector(past)
            wrong.append(difference_text(read_pose(each.message), correct, _INTERPOLATION_TOLERANCE))
        bad = [text for text in wrong if text]
        sheet.check(
            5,
            "each pose is one second older than its stamp",
            bool(wrong) and not bad,
            expected="lookup_transform_full(base_link now, end_effector 1 s ago, fixed frame odom)",
            observed=f"{len(bad)} of {len(wrong)} poses are wrong: {bad[-1]}" if bad else "no poses",
            cause="the motion of the base is ignored: odom must be the fixed frame"
            if _ignores_base(robot, poses)
            else "",
            read=_READ,
        )
    return sheet


def _ignores_base(robot: SimulatedRobot, poses: list[Received]) -> bool:
    """Return whether each pose is relative to the base of one second ago."""
    expected = [robot.end_effector(stamp_ns(each.message) - _AGE) for each in poses]
    found = [read_pose(each.message) for each in poses]
    return all(
        not difference_text(pose, other, _INTERPOLATION_TOLERANCE) for pose, other in zip(found, expected, strict=True)
    )
