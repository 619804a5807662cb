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
from coframe.doctor.pose_mistakes import Explanation, explain
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import NDArray

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation
    from coframe.robots import Robot

__all__ = ["CODE", "find"]

CODE = "TF023"
_CONSEQUENCE = "The published pose is wrong: collision checks and displays show a robot that differs from the real one."
_ONE_PUBLISHER = (
    "Publish the links of the robot description only with robot_state_publisher, and stop the other publisher of this "
    "transform; or correct <origin> in the URDF, and restart robot_state_publisher after the change."
)
_METERS = 1e-3
_RADIANS = 1e-3
_MAX_COMPARED = 2000  # transforms per joint


# Mistakes in joint positions: the clause after "if", what to do, and the positions that were used.
_WrongPositions = tuple[str, str, "Callable[[NDArray[np.float64]], NDArray[np.float64]]"]
_WRONG_POSITIONS: tuple[_WrongPositions, ...] = (
    (
        "the joint positions are used in radians: their values in degrees were used as radians",
        "Use the positions of /joint_states as they are: they are in radians.",
        np.degrees,
    ),
    (
        "the joint positions are used as they are: they were converted from degrees to radians twice",
        "Use the positions of /joint_states as they are: they are in radians.",
        np.radians,
    ),
    (
        "the joint positions have the opposite sign",
        "Check the sign of the angle, or <axis> in the URDF.",
        np.negative,
    ),
    (
        "the angle in the quaternion is halved: sin(angle) was used for sin(angle / 2)",
        "Use half the angle in a quaternion: z = math.sin(angle / 2), w = math.cos(angle / 2).",
        lambda positions: 2.0 * positions,
    ),
    (
        "the angle in the quaternion is doubled: it was halved twice",
        "Use half the angle in a quaternion: z = math.sin(angle / 2), w = math.cos(angle / 2).",
        lambda positions: 0.5 * positions,
    ),
)
# For prismatic joints.
_WRONG_DISTANCES: tuple[_WrongPositions, ...] = (
    (
        "the joint positions are used in meters: their values in millimeters were used",
        "Use the positions of /joint_states as they are: they are in meters.",
        lambda positions: 1e3 * positions,
    ),
    (
        "the joint positions are used as they are: they were divided by 1000",
        "Use the positions of /joint_states as they are: they are in meters.",
        lambda positions: 1e-3 * positions,
    ),
    _WRONG_POSITIONS[2],
)


class _Difference(NamedTuple):
    """The median difference between the rows of an edge and the expected poses, and the mistake that explains it."""

    meters: float
    radians: float
    compared: int
    mistake: Explanation | None

    @property
    def text(self) -> str:
        """The size of the difference, as a clause."""
        return f"{self.meters:.3g} m and {degrees(self.radians):.3g} degrees"


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per joint, and one per static transform between rigidly connected links."""
    robot = model(observation)
    if robot is None:
        return
    by_key = {edge.key: edge for edge in observation.edges}
    for name, joint in robot.joints.items():
        edge = by_key.get((observation.link_name(joint.parent), observation.link_name(joint.child)))
        found = _difference(observation, robot, name, edge) if edge is not None else None
        if edge is None or found is None or not _is_different(found):
            continue
        if joint.type == "fixed":
            yield _mount(edge, f"fixed joint {name!r}", robot.joint_transforms()[name], found)
            continue
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"differs from joint {name!r} of the robot description by {found.text} (median of {found.compared})"
            + _agreement_text(found),
            fix=_ONE_PUBLISHER if found.mistake is None else f"{found.mistake.fix} Or: {_ONE_PUBLISHER}",
            harm=_CONSEQUENCE if found.mistake else "",
            edge=edge.key,
            first_stamp=edge.first_stamp,
            publishers=edge.publishers,
        )
    yield from _other_mounts(observation, robot)
    yield from _other_parents(observation, robot)


def _other_parents(observation: Observation, robot: Robot) -> Iterator[Finding]:
    """Yield findings for links whose parent differs from that of their joint, with a movable joint in between."""
    link_of = {observation.link_name(link): link for link in robot.links}
    rigid = _rigid_parents(robot)
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


def _rigid_parents(robot: Robot) -> dict[str, str]:
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
    rigid = _rigid_parents(robot)
    poses = None
    for edge in observation.static:
        parent, child = link_of.get(edge.parent, ""), link_of.get(edge.child, "")
        if not parent or not child or rigid[parent] != rigid[child] or observation.last[edge.child] is not edge:
            continue
        if child in joint_above and joint_above[child].parent == parent:
            continue  # already compared with the joint itself
        poses = poses or robot.frames()
        expected_pose = poses[parent].inverse() @ poses[child]
        found = _deviation(edge, np.array([edge.count - 1]), expected_pose)
        if _is_different(found):
            yield _mount(edge, "the fixed joints between these links", expected_pose, found)


def _mount(edge: Edge, joint: str, expected_pose: Transform, difference: _Difference) -> Finding:
    pose = [*expected_pose.translation.tolist(), *expected_pose.quaternion.tolist()]
    published = Transform(edge.values[-1, :3], edge.rotations[-1])
    return Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"differs from {joint} of the robot description by {difference.text}: published {_pose_text(published)}, "
        f"described {_pose_text(expected_pose)}{_agreement_text(difference)}",
        fix=(difference.mistake.fix if difference.mistake else "Decide which pose is correct.")
        + " If the pose of the robot description is correct, publish it only with "
        f"robot_state_publisher (its values: `{static_command(*edge.key, pose)}`); otherwise correct <origin> in "
        f"the URDF to "
        f"{_origin_attributes(published)}, and restart robot_state_publisher.",
        harm=_CONSEQUENCE if difference.mistake else "",
        edge=edge.key,
        first_stamp=edge.first_stamp,
        publishers=edge.publishers,
    )


def _agreement_text(difference: _Difference) -> str:
    return f"; {difference.mistake.text('it')}" if difference.mistake is not None else ""


def _pose_text(pose: Transform) -> str:
    x, y, z = _numbers(pose.translation, 4)
    roll, pitch, yaw = _numbers(np.degrees(pose.rpy), 2)
    return f"x {x}, y {y}, z {z} m, roll {roll}, pitch {pitch}, yaw {yaw} degrees"


def _origin_attributes(pose: Transform) -> str:
    return f'xyz="{" ".join(_numbers(pose.translation, 6))}" rpy="{" ".join(_numbers(pose.rpy, 6))}"'


def _numbers(values: NDArray[np.float64], digits: int) -> list[str]:
    """Return rounded numbers; adding 0.0 turns -0.0 into 0.0."""
    return [f"{value + 0.0:.12g}" for value in np.round(values, digits).tolist()]


def _difference(observation: Observation, robot: Robot, name: str, edge: Edge) -> _Difference | None:
    """Return the median difference between an edge and its joint, or None if nothing can be compared."""
    joint = robot.joints[name]
    if joint.type == "fixed":
        return _deviation(edge, np.array([edge.count - 1]), robot.joint_transforms()[name])
    if joint.size != 1:
        return None
    matched = _positions(observation, name, edge.stamp[:_MAX_COMPARED])
    if matched is None:
        return None
    rows, positions = matched
    try:
        found = _deviation(edge, rows, robot.joint_transforms({name: positions})[name])
        if _is_different(found):
            found = found._replace(mistake=_wrong_position(edge, rows, robot, name, positions) or found.mistake)
    except ValueError:
        return None
    return found


def _is_different(difference: _Difference) -> bool:
    return difference.meters >= _METERS or difference.radians >= _RADIANS


def _wrong_position(
    edge: Edge, rows: NDArray[np.intp], robot: Robot, name: str, positions: NDArray[np.float64]
) -> Explanation | None:
    """Return the mistake in the joint positions that explains the published transforms."""
    for reading, fix, wrong in _WRONG_DISTANCES if robot.joints[name].type == "prismatic" else _WRONG_POSITIONS:
        left = _deviation(edge, rows, robot.joint_transforms({name: wrong(positions)})[name], explained=False)
        if not _is_different(left):
            return Explanation(reading, fix, left.meters, left.radians)
    return None


def _deviation(edge: Edge, rows: NDArray[np.intp], expected_pose: Transform, *, explained: bool = True) -> _Difference:
    """Return the median difference between rows of an edge and the expected poses, and its explanation."""
    published = edge.poses(rows)
    right = np.empty_like(published)
    right[:, :3], right[:, 3:] = expected_pose.translation, expected_pose.quaternion
    meters = float(np.median(np.linalg.norm(published[:, :3] - right[:, :3], axis=1)))
    radians = float(np.median(angles_between(published[:, 3:], right[:, 3:])))
    found = _Difference(meters, radians, len(rows), None)
    return found._replace(mistake=explain(published, right)) if explained and _is_different(found) else found


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
