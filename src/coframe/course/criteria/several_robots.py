# SPDX-License-Identifier: Apache-2.0
"""Extension 3, 10 points: two robots in one tree, each with its prefix."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.analysis.tree import FrameTrees
from coframe.course._sheet import Sheet
from coframe.course.criteria.common import Task, read_edge, run_program
from coframe.course.rubric import RUBRIC
from tf2_msgs.msg import TFMessage

if TYPE_CHECKING:
    from coframe.course._world import Received

__all__ = ["check"]

_ROBOTS = ("robot1/", "robot2/")
_ARM_PARENTS = {"link1": "base_link", "link2": "link1", "end_effector": "link2"}
_READ = "handbook chapter 7, the complete tree"


def check(task: Task) -> Sheet:
    """Check ``multi_robot.py``."""
    sheet = Sheet.of(RUBRIC["several_robots"])
    world = task.world
    with run_program(task, sheet) as program:
        static = world.watch("/tf_static", TFMessage, latched=True)
        dynamic = world.watch("/tf", TFMessage)
        if program is not None:
            world.start(program)
            world.run(1.0)
        edges = _edges([*static, *dynamic])
        parents = {edge.child_frame_id: edge.header.frame_id for edge in edges}
        for prefix in _ROBOTS:
            right = [child for child, parent in _ARM_PARENTS.items() if parents.get(prefix + child) == prefix + parent]
            sheet.check(
                2.5,
                f"the arm of {prefix[:-1]} has prefixed frames",
                len(right) / len(_ARM_PARENTS),
                expected=f"{prefix}base_link -> {prefix}link1 -> {prefix}link2 -> {prefix}end_effector",
                observed=f"{len(right)} of 3 transforms",
                cause=_prefix_cause(parents, prefix),
                read=_READ,
            )
        unprefixed_frames = sorted(name for name in parents if name in {*_ARM_PARENTS, "base_link"})
        sheet.check(
            2,
            "no frame without a prefix is published twice",
            bool(parents) and not unprefixed_frames,
            expected="only frames shared by both robots, such as map, have no prefix",
            observed=f"frames without a prefix: {', '.join(unprefixed_frames)}"
            if unprefixed_frames
            else "no transforms",
            cause="these frame names have no prefix" if unprefixed_frames else "",
            read=_READ,
        )
        trees = FrameTrees.from_parents(parents)
        sheet.check(
            3,
            "both robots are in one tree, at different places",
            len(trees.roots) == 1 and _have_different_poses(edges),
            expected="map -> robot1/... and map -> robot2/... with different poses",
            observed=f"{len(trees.roots)} trees" if len(trees.roots) != 1 else "both robots are at the same place",
            cause=_separate_cause(parents),
            read=_READ,
        )
    return sheet


def _edges(messages: list[Received]) -> list[Any]:
    return [edge for each in messages for edge in each.message.transforms]


def _have_different_poses(edges: list[Any]) -> bool:
    """Return whether the transforms from a shared frame to frames of the two robots differ."""
    into = {}
    for edge in edges:
        for prefix in _ROBOTS:
            if edge.child_frame_id.startswith(prefix) and not edge.header.frame_id.startswith(prefix):
                into[prefix] = read_edge(edge).translation
    return len(into) == 2 and abs(into[_ROBOTS[0]] - into[_ROBOTS[1]]).max() > 0.01


def _prefix_cause(parents: dict[str, str], prefix: str) -> str:
    """Return the mistake in the names of a robot, or ""."""
    without = prefix.rstrip("/")
    for child, parent in _ARM_PARENTS.items():
        if parents.get(prefix + child) == parent:
            return f"the parent {parent!r} has no prefix: use {prefix + parent!r}"
        if parents.get(child) == prefix + parent:
            return f"the child {child!r} has no prefix: use {prefix + child!r}"
    if any(name.startswith(without) and not name.startswith(prefix) for name in parents):
        return f"the prefix must end with a slash: {prefix!r}"
    return ""


def _separate_cause(parents: dict[str, str]) -> str:
    missing = [f"{prefix}base_link" for prefix in _ROBOTS if f"{prefix}base_link" not in parents]
    return f"no transform to {' and '.join(missing)}" if missing and parents else ""
