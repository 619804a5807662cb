# SPDX-License-Identifier: Apache-2.0
"""TF023: transforms that differ from the robot description and the joint states."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe.analysis.static_command import static_command
from coframe.doctor._edge import angles_between
from coframe.doctor._finding import Finding, Severity
from coframe.doctor._robot_model import model
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation
    from coframe.robots import Robot

__all__ = ["CODE", "find"]

CODE = "TF023"
_METRES = 1e-3
_RADIANS = 1e-3
_MAX_COMPARED = 2000  # transforms per joint


class _Difference(NamedTuple):
    metres: float
    radians: float
    compared: int


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per joint, and one per static transform between rigidly connected links."""
    robot = model(observation)
    if robot is None:
        return
    by_key = {edge.key: edge for edge in observation.edges}
    for name, joint in robot.joints.items():
        edge = by_key.get((observation.link_name(joint.parent), observation.link_name(joint.child)))
        found = _difference(observation, robot, name, edge) if edge is not None else None
        if edge is None or found is None or (found.metres < _METRES and found.radians < _RADIANS):
            continue
        if joint.type == "fixed":
            yield _mount(edge, f"fixed joint {name!r}", robot.joint_transforms()[name], found)
            continue
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"differs from joint {name!r} of the robot description by {found.metres:.3g} m and "
            f"{degrees(found.radians):.3g} degrees (median of {found.compared})",
            fix="Publish the links of the robot description only with robot_state_publisher, and stop the other "
            "publisher of this transform; or correct <origin> in the URDF, and restart robot_state_publisher after "
            "the change.",
            edge=edge.key,
            first_stamp=edge.first_stamp,
            publishers=edge.publishers,
        )
    yield from _other_mounts(observation, robot)
    yield from _other_parents(observation, robot)


def _other_parents(observation: Observation, robot: Robot) -> Iterator[Finding]:
    """Yield findings for links whose parent differs from that of their joint, with a movable joint in between."""
    link_of = {observation.link_name(link): link for link in robot.links}
    rigid = _rigid(robot)
    for joint in robot.joints.values():
        edge = observation.last.get(observation.link_name(joint.child))
        parent = link_of.get(edge.parent) if edge is not None else None
        if edge is None or parent is None or rigid[parent] in {rigid[joint.parent], rigid[joint.child]}:
            continue
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"in the robot description, the parent of {edge.child} is {observation.link_name(joint.parent)} "
            f"(joint {joint.name!r})",
            fix=f"In the publisher: t.header.frame_id = {observation.link_name(joint.parent)!r}; or correct <parent> "
            "in the URDF, and restart robot_state_publisher.",
            edge=edge.key,
            first_stamp=edge.first_stamp,
            publishers=edge.publishers,
        )


def _rigid(robot: Robot) -> dict[str, str]:
    """Return the topmost link to which each link is rigidly connected."""
    joint_above = {joint.child: joint for joint in robot.joints.values()}
    rigid = {}
    for link in robot.links:
        top = link
        while top in joint_above and joint_above[top].type == "fixed":
            top = joint_above[top].parent
        rigid[link] = top
    return rigid


def _other_mounts(observation: Observation, robot: Robot) -> Iterator[Finding]:
    """Yield findings for static transforms between two links that several fixed joints connect."""
    link_of = {observation.link_name(link): link for link in robot.links}
    joint_above = {joint.child: joint for joint in robot.joints.values()}
    rigid = _rigid(robot)
    poses = None
    for edge in observation.static:
        parent, child = link_of.get(edge.parent, ""), link_of.get(edge.child, "")
        if not parent or not child or rigid[parent] != rigid[child] or observation.last[edge.child] is not edge:
            continue
        if child in joint_above and joint_above[child].parent == parent:
            continue  # already compared with the joint itself
        poses = poses or robot.frames()
        expected = poses[parent].inverse() @ poses[child]
        found = _deviation(edge, np.array([edge.count - 1]), expected)
        if found.metres >= _METRES or found.radians >= _RADIANS:
            yield _mount(edge, "the fixed joints between these links", expected, found)


def _mount(edge: Edge, joint: str, expected: Transform, found: _Difference) -> Finding:
    pose = [*expected.translation.tolist(), *expected.quaternion.tolist()]
    published = Transform(edge.values[-1, :3], edge.rotations[-1])
    return Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"differs from {joint} of the robot description by {found.metres:.3g} m and {degrees(found.radians):.3g} "
        f"degrees: published {_described(published)}, described {_described(expected)}",
        fix="Decide which pose is right. If that of the robot description is, let only robot_state_publisher publish "
        f"it (its values: `{static_command(*edge.key, pose)}`); otherwise correct <origin> in the URDF to "
        f"{_origin(published)}, and restart robot_state_publisher.",
        edge=edge.key,
        first_stamp=edge.first_stamp,
        publishers=edge.publishers,
    )


def _described(pose: Transform) -> str:
    x, y, z = _numbers(pose.translation, 4)
    roll, pitch, yaw = _numbers(np.degrees(pose.rpy), 2)
    return f"x {x}, y {y}, z {z} m, roll {roll}, pitch {pitch}, yaw {yaw} degrees"


def _origin(pose: Transform) -> str:
    return f'xyz="{" ".join(_numbers(pose.translation, 6))}" rpy="{" ".join(_numbers(pose.rpy, 6))}"'


def _numbers(values: NDArray[np.float64], digits: int) -> list[str]:
    """Return rounded numbers; adding 0.0 turns -0.0 into 0.0."""
    return [f"{value + 0.0:.12g}" for value in np.round(values, digits).tolist()]


def _difference(observation: Observation, robot: Robot, name: str, edge: Edge) -> _Difference | None:
    """Return the median difference between an edge and its joint; None if nothing can be compared."""
    joint = robot.joints[name]
    if joint.type == "fixed":
        rows = np.array([edge.count - 1])
        expected = robot.joint_transforms()[name]
    else:
        if joint.size != 1:
            return None
        matched = _positions(observation, name, edge.stamp[:_MAX_COMPARED])
        if matched is None:
            return None
        rows, positions = matched
        try:
            expected = robot.joint_transforms({name: positions})[name]
        except ValueError:
            return None
    return _deviation(edge, rows, expected)


def _deviation(edge: Edge, rows: NDArray[np.intp], expected: Transform) -> _Difference:
    """Return the median difference between rows of an edge and the expected pose or poses."""
    rotations = np.broadcast_to(expected.quaternion, (len(rows), 4))
    metres = np.linalg.norm(edge.values[rows, :3] - expected.translation, axis=1)
    radians = angles_between(edge.rotations[rows], rotations)
    return _Difference(float(np.median(metres)), float(np.median(radians)), len(rows))


def _positions(
    observation: Observation, name: str, stamps: NDArray[np.int64]
) -> tuple[NDArray[np.intp], NDArray[np.float64]] | None:
    """Return the rows whose stamp matches exactly one joint state with this joint, and the positions in it."""
    for states in observation.joint_states:
        if name not in states.positions:
            continue
        known, first, count = np.unique(states.stamp, return_index=True, return_counts=True)
        place = np.minimum(np.searchsorted(known, stamps), len(known) - 1)
        positions = states.positions[name][first[place]]
        rows = np.flatnonzero((known[place] == stamps) & (count[place] == 1) & np.isfinite(positions))
        if len(rows):
            return rows, positions[rows]
    return None
