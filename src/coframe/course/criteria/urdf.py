# SPDX-License-Identifier: Apache-2.0
"""Extension 1, 10 points: the arm as a robot description."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._files.os_errors import explain
from coframe.course._motion import SimulatedRobot
from coframe.course._sheet import Sheet
from coframe.course.criteria.common import Task, difference_text, expanded_xacro
from coframe.course.rubric import RUBRIC
from coframe.course.submitted import MISSING_FILE, is_submitted, read_submitted
from coframe.errors import CoframeError
from coframe.robots.urdf import parse_urdf

if TYPE_CHECKING:
    from coframe.robots import Robot as Description

__all__ = ["check"]

_ANGLES = ((0.0, 0.0), (0.5, -0.3), (-0.4, 0.2), (1.0, 1.0), (-1.2, 0.7))
_READ = "handbook chapter 8, URDF"
_FILES = ("arm.urdf.xacro", RUBRIC["urdf"].file)


def check(task: Task) -> Sheet:
    """Check ``arm.urdf`` or ``arm.urdf.xacro``."""
    names = [name for name in _FILES if is_submitted(task.folder, name)]
    sheet = Sheet.of(RUBRIC["urdf"])
    description: Description | None = None
    problem, attempt = f"{MISSING_FILE} {sheet.file}.", ""
    if names:
        sheet.file = names[0]
        file = task.folder / sheet.file
        try:
            text = read_submitted(file)
            if file.suffix == ".xacro":
                text, attempt = expanded_xacro(task, file)
            description, problem = parse_urdf(text), ""
        except (CoframeError, OSError, ValueError) as error:
            problem = explain(error)
    sheet.check(
        2,
        "the description can be read",
        description is not None,
        expected="a URDF or xacro file without errors",
        observed=problem,
        read=_READ,
    )
    _check_joints(sheet, description)
    _check_kinematics(sheet, task, description)
    if attempt or not names:
        sheet.withdraw(0, attempt or problem)
    elif description is not None and not description.joints:
        sheet.withdraw(0, f"{sheet.file} does not describe any joints yet. The comment in it describes the task.")
    return sheet


def _check_joints(sheet: Sheet, description: Description | None) -> None:
    names = [] if description is None else [each.name for each in description.joints.values() if each.type != "fixed"]
    sheet.check(
        2,
        "the robot has the joints joint1 and joint2",
        sorted(names) == ["joint1", "joint2"],
        expected="two movable joints, joint1 and joint2",
        observed=f"movable joints: {', '.join(names) or 'none'}",
        read=_READ,
    )


def _check_kinematics(sheet: Sheet, task: Task, description: Description | None) -> None:
    robot = SimulatedRobot(task.assignment)
    wrong: list[str] = []
    frames = {"end_effector": 3.0, **{mount.frame: 1.0 for mount in task.assignment.mounts}}
    for frame, points in frames.items():
        difference = _difference(robot, description, frame)
        wrong.append(difference)
        sheet.check(
            points,
            f"{frame} is at the correct position for all joint angles",
            not difference,
            expected="the analytic pose for five pairs of joint angles",
            observed=difference,
            read=_READ,
        )


def _difference(robot: SimulatedRobot, description: Description | None, frame: str) -> str:
    if description is None:
        return "no description"
    mounts = {mount.source: mount for mount in robot.mounts()}
    for angles in _ANGLES:
        first, second, third = robot.arm(angles)
        tip = first @ second @ third
        mount = mounts.get(frame)
        correct = tip if mount is None else tip @ mount if mount.target == "end_effector" else mount
        try:
            frames = description.frames({"joint1": angles[0], "joint2": angles[1]})
            root = frames["base_link"].inverse() if "base_link" in frames else None
            found = frames[frame] if root is None else root @ frames[frame]
        except (CoframeError, KeyError, ValueError) as error:
            return f"{frame} cannot be computed: {error}"
        if difference := difference_text(found, correct):
            return f"with joint angles {angles}: {difference}"
    return ""
