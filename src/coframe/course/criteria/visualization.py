# SPDX-License-Identifier: Apache-2.0
"""Visualization, 15 points: the RViz configuration shows the robot, and the complete tree moves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe._files.os_errors import explain
from coframe.analysis.tree import FrameTrees
from coframe.course._sheet import Sheet
from coframe.course.criteria.common import Task, read_edge, run_program
from coframe.course.rubric import RUBRIC
from coframe.course.submitted import read_submitted
from coframe.errors import CourseError, ViewerError
from coframe.viewer.rviz.config import RvizConfig
from tf2_msgs.msg import TFMessage

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["check"]

# Each frame of the complete tree and its parent.
_TREE = {
    "map": "world",
    "odom": "map",
    "base_link": "odom",
    "link1": "base_link",
    "link2": "link1",
    "end_effector": "link2",
    "imu_link": "base_link",
    "lidar_link": "base_link",
    "camera_link": "end_effector",
}
_FRAMES = {*_TREE, "world"}
_MOVING_FRAMES = ("base_link", "link1", "link2")
# Display, its topic, and its points.
_DISPLAYS = (("TF", None, 2), ("LaserScan", "/scan", 2), ("PointCloud2", "/scan_base_frame", 2))
_FILE_NAMES = ("*.rviz", "rviz_config.yaml")
_READ = "handbook chapter 7, the complete tree"


def check(task: Task) -> Sheet:
    """Check the RViz configuration and ``complete_tf_tree.py``."""
    sheet = Sheet.of(RUBRIC["visualization"])
    _check_configuration(sheet, _configuration(task.folder))
    world = task.world
    with run_program(task, sheet) as program:
        static = world.watch("/tf_static", TFMessage, latched=True)
        dynamic = world.watch("/tf", TFMessage)
        if program is not None:
            world.start(program)
            world.run(1.0)
        edges = [edge for each in (*static, *dynamic) for edge in each.message.transforms]
        _check_tree(sheet, edges)
        _check_motion(sheet, edges)
    return sheet


def _configuration(folder: Path) -> RvizConfig | str:
    """Return the configuration in a folder, or an error message."""
    files = sorted(path for pattern in _FILE_NAMES for path in folder.glob(pattern))
    if not files:
        return "there is no file *.rviz or rviz_config.yaml"
    try:
        return RvizConfig.parse(read_submitted(files[0]), files[0].name)
    except (CourseError, ViewerError, OSError) as error:
        return explain(error)


def _check_configuration(sheet: Sheet, config: RvizConfig | str) -> None:
    fixed = "" if isinstance(config, str) else config.fixed_frame
    displays = [] if isinstance(config, str) else config.description()["displays"]
    kinds = {kind for kind, _, _ in _DISPLAYS}
    is_begun = fixed in _FRAMES or any(each["class"] in kinds for each in displays)
    problem = config if isinstance(config, str) else ""
    sheet.check(
        3,
        "the RViz configuration can be read",
        not problem,
        expected="a file lab.rviz saved by RViz",
        observed=problem,
        cause="errors from manual editing: YAML needs correct indentation",
        read=_READ,
    )
    sheet.check(
        2,
        "the fixed frame exists",
        fixed in _FRAMES,
        expected="a frame of the tree, for example base_link",
        observed=f"fixed frame {fixed!r}",
        cause="a misspelled frame",
        read=_READ,
    )
    for kind, topic, points in _DISPLAYS:
        found = [each for each in displays if each["class"] == kind and each["enabled"]]
        right = [each for each in found if topic is None or each["topic"] == topic]
        what = f"{kind} display" if topic is None else f"{kind} display of {topic}"
        topics = ", ".join(str(each["topic"]) for each in found)
        sheet.check(
            points,
            f"it has a {what}",
            bool(right),
            expected=f"an enabled {what}",
            observed=f"its topic is {topics}" if found else f"no enabled {kind} display",
            cause="Add > By display type, then set the topic, and save the configuration",
            read=_READ,
        )
    if not problem and not is_begun:
        sheet.withdraw(0, "The RViz configuration does not show the robot yet. Its first lines describe the task.")


def _check_tree(sheet: Sheet, edges: list[Any]) -> None:
    parents = {edge.child_frame_id: edge.header.frame_id for edge in edges}
    right = [child for child, parent in _TREE.items() if parents.get(child) == parent]
    wrong = [f"{child} has the parent {parents[child]}" for child in _TREE if child in parents and child not in right]
    missing = [child for child in _TREE if child not in parents]
    trees = FrameTrees.from_parents(parents)
    sheet.check(
        2,
        "the complete tree is connected",
        len(right) / len(_TREE),
        expected="world -> map -> odom -> base_link -> arm and sensors",
        observed="; ".join([*wrong, *([f"missing: {', '.join(missing)}"] if missing else [])])
        + (f"; {len(trees.roots)} trees" if len(trees.roots) > 1 else ""),
        cause="a misspelled frame, or a parent that is not published",
        read=_READ,
    )


def _check_motion(sheet: Sheet, edges: list[Any]) -> None:
    moving = []
    for child in _MOVING_FRAMES:
        poses = [read_edge(edge).matrix for edge in edges if edge.child_frame_id == child]
        if len(poses) > 10 and abs(poses[-1] - poses[0]).max() > 1e-4:
            moving.append(child)
    sheet.check(
        2,
        "its frames move",
        len(moving) / len(_MOVING_FRAMES),
        expected=f"new poses of {', '.join(_MOVING_FRAMES)}",
        observed=f"only {', '.join(moving)} moves" if moving else "no frame moves",
        cause="the time of the simulation does not advance, or the timer is missing",
        read=_READ,
    )
