# SPDX-License-Identifier: Apache-2.0
"""Visualization, 15 points: the RViz configuration shows the robot, and the complete tree moves."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe._files.os_errors import explain
from coframe.analysis.tree import FrameTrees
from coframe.course._motion import SimulatedRobot
from coframe.course._sheet import Sheet
from coframe.course.criteria.arm_motion import CHILDREN, Motion
from coframe.course.criteria.causes import edge_cause, name_mistake, pose_cause
from coframe.course.criteria.common import (
    Task,
    difference_text,
    read_edge,
    run_program,
    stamp_ns,
    to_seconds,
    transforms_on_tf,
)
from coframe.course.rubric import RUBRIC
from coframe.course.submitted import read_submitted
from coframe.errors import CourseError, ViewerError
from coframe.transform.transform import Transform
from coframe.viewer.rviz.config import RvizConfig
from tf2_msgs.msg import TFMessage

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from coframe.course._world import Received

__all__ = ["check"]


class _Path(NamedTuple):
    """The specified motion of a frame.

    Attributes:
        text: The specification.
        speed: The speed along x, in m/s.
        pose: Returns the pose at a time since the start, in seconds.
    """

    text: str
    speed: float
    pose: Callable[[float], Transform]


def _drift(t: float) -> Transform:
    return Transform((0.001 * t, 0.0005 * t, 0.0))


def _drive(t: float) -> Transform:
    return Transform.from_rpy((0.1 * t, 0.05 * math.sin(0.5 * t), 0.0), yaw=0.1 * math.sin(0.2 * t))


_PATHS = {
    "odom": _Path("position [0.001 t, 0.0005 t, 0], no rotation", 0.001, _drift),
    "base_link": _Path("position [0.1 t, 0.05 sin(0.5 t), 0], turned by 0.1 sin(0.2 t) about z", 0.1, _drive),
}

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
_PATH_TOLERANCE, _PATH_TIME = 1e-6, 1e-3  # meters and seconds
# Display, its topic, and its points.
_DISPLAYS = (("TF", None, 1), ("LaserScan", "/scan", 1), ("PointCloud2", "/scan_base_frame", 1))
_FILE_NAMES = ("*.rviz", "rviz_config.yaml")
_READ = "handbook chapter 7, the complete tree"


def check(task: Task) -> Sheet:
    """Check the RViz configuration and ``complete_tf_tree.py``."""
    sheet = Sheet.of(RUBRIC["visualization"])
    _check_configuration(sheet, _configuration(task.folder))
    world = task.world
    with run_program(task, sheet) as program:
        static = world.watch("/tf_static", TFMessage, latched=True)
        dynamic = world.watch("/tf", TFMessage), world.watch("/tf", TFMessage, latched=True)
        if program is not None:
            world.start(program)
            world.run(2.0)
        _check_tree(sheet, task, [*static, *transforms_on_tf(*dynamic)])
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
        2,
        "the RViz configuration can be read",
        not problem,
        expected="a file lab.rviz saved by RViz",
        observed=problem,
        read=_READ,
    )
    sheet.check(
        1,
        "the fixed frame exists",
        fixed in _FRAMES,
        expected="a frame of the tree, for example base_link",
        observed=f"fixed frame {fixed!r}",
        cause=next(filter(None, (name_mistake(fixed, frame) for frame in sorted(_FRAMES))), ""),
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
            read=_READ,
        )
    if not problem and not is_begun:
        sheet.withdraw(0, "The RViz configuration does not show the robot yet. Its first lines describe the task.")


def _check_tree(sheet: Sheet, task: Task, messages: list[Received]) -> None:
    edges = [edge for each in messages for edge in each.message.transforms]
    pairs = list(dict.fromkeys((edge.header.frame_id, edge.child_frame_id) for edge in edges))
    expected_edges = [(parent, child) for child, parent in _TREE.items()]
    missing = [f"{parent} -> {child}" for parent, child in expected_edges if (parent, child) not in pairs]
    others = [f"{parent} -> {child}" for parent, child in pairs if _TREE.get(child) != parent]
    causes = [
        edge_cause(parent, child, pairs, _FRAMES) for parent, child in expected_edges if (parent, child) not in pairs
    ]
    sheet.check(
        2,
        "the tree has all transforms of the robot",
        1.0 - len(missing) / len(_TREE),
        expected="world -> map -> odom -> base_link -> arm and sensors",
        observed=f"missing: {', '.join(missing)}" + (f"; received instead: {', '.join(others)}" if others else ""),
        cause=next(filter(None, causes), ""),
        read=_READ,
    )
    parents: dict[str, list[str]] = {}
    for parent, child in pairs:
        parents.setdefault(child, []).append(parent)
    double = {child: found for child, found in parents.items() if len(found) > 1}
    trees = FrameTrees.from_parents({child: found[0] for child, found in parents.items()})
    roots = [trees.names[number] for number in trees.roots]
    sheet.check(
        2,
        "every frame has exactly one parent, in one tree",
        bool(pairs) and not double and len(roots) == 1,
        expected="a single tree with the root world",
        observed="no transforms"
        if not pairs
        else "; ".join(f"{child} has the parents {' and '.join(found)}" for child, found in double.items())
        or f"{len(roots)} trees, with the roots {', '.join(sorted(roots))}",
        cause="two transforms have the same child_frame_id" if double else next(filter(None, causes), ""),
        read=_READ,
    )
    _check_constant(sheet, task, edges)
    for child, name in (("odom", "map -> odom"), ("base_link", "odom -> base_link")):
        _check_path(sheet, messages, child, name)
    _check_arm(sheet, task, messages)


def _check_constant(sheet: Sheet, task: Task, edges: list[Any]) -> None:
    """Check the poses of the static transforms, and the translations of the arm."""
    robot = SimulatedRobot(task.assignment)
    correct = {each.source or "": each for each in [*robot.mounts(), Transform(source="map"), *robot.arm((0.0, 0.0))]}
    wrong: dict[str, tuple[str, str]] = {}
    for edge in edges:
        child = edge.child_frame_id
        if child not in correct or child in wrong or edge.header.frame_id != _TREE[child]:
            continue
        pose, expected = read_edge(edge), correct[child]
        if child in CHILDREN:
            pose = Transform(pose.translation, expected.quaternion)
        if difference := difference_text(pose, expected):
            wrong[child] = difference, pose_cause(pose, edge.transform.rotation, expected)
    found = {edge.child_frame_id for edge in edges} & correct.keys()
    causes = [f"{child}: {cause}" for child, (_, cause) in wrong.items() if cause]
    sheet.check(
        2,
        "the mounts and link lengths are those of the assignment",
        (len(found) - len(wrong)) / len(correct) if found else 0.0,
        expected="the numbers of steps 1 and 2",
        observed="; ".join(f"{child}: {text}" for child, (text, _) in wrong.items())
        or f"missing: {', '.join(sorted(correct.keys() - found))}",
        cause="; ".join(causes),
        read=_READ,
    )


def _check_path(sheet: Sheet, messages: list[Received], child: str, name: str) -> None:
    """Check the motion of the base or of the localization, which begins when the node starts."""
    samples = [(one, each) for one in messages for each in one.message.transforms if each.child_frame_id == child]
    samples = [(one, each) for one, each in samples if each.header.frame_id == _TREE[child]][2:]
    law = _PATHS[child]
    times = [_elapsed(each, child) for _, each in samples]
    starts = [to_seconds(stamp_ns(each)) - time for (_, each), time in zip(samples, times, strict=True)]
    wrong = [
        text
        for (_, each), time in zip(samples, times, strict=True)
        if (text := difference_text(read_edge(each), law.pose(time), _PATH_TOLERANCE))
    ]
    is_moving = len(starts) > 3 and times[-1] - times[0] > 0.5
    is_on_time = is_moving and max(starts) - min(starts) <= _PATH_TIME
    sheet.check(
        1,
        f"{name} moves as specified",
        is_moving and is_on_time and not wrong,
        expected=law.text,
        observed="no transform"
        if not samples
        else "it does not move"
        if len(samples) > 3 and max(times) - min(times) < 1e-6
        else wrong[-1]
        if wrong
        else "its speed is not that of the task",
        cause="the time of the simulation does not advance"
        if len(samples) > 3 and max(times) - min(times) < 1e-6
        else _speed_cause(samples, child),
        read=_READ,
    )


def _speed_cause(samples: list[Any], child: str) -> str:
    """Return by which factor a motion along x is too fast, or "" if that is not what is wrong."""
    if len(samples) < 4:
        return ""
    first, last = samples[0][1], samples[-1][1]
    seconds = to_seconds(stamp_ns(last) - stamp_ns(first))
    speed = (last.transform.translation.x - first.transform.translation.x) / seconds if seconds > 0.0 else 0.0
    factor = speed / _PATHS[child].speed
    is_wrong = abs(factor - 1.0) > 1e-3 and abs(factor) > 1e-3
    return f"the speed along x is {speed:.4g} m/s instead of {_PATHS[child].speed:g} m/s" if is_wrong else ""


def _elapsed(edge: Any, child: str) -> float:
    """Return the time since the start from the position along x, which grows linearly."""
    return float(edge.transform.translation.x) / _PATHS[child].speed


def _check_arm(sheet: Sheet, task: Task, messages: list[Received]) -> None:
    motion = Motion.of(messages, 1.0 / task.assignment.dynamic_rate)
    wrong = [f"joint {joint + 1}" for joint, is_right in enumerate(motion.is_right) if not is_right]
    sheet.check(
        1,
        "the arm moves as in step 2",
        sum(motion.is_right) / 2.0,
        expected="the motion of both joints in step 2",
        observed=f"another motion of {' and '.join(wrong)}",
        cause="; ".join(dict.fromkeys(filter(None, motion.causes))),
        read=_READ,
    )
