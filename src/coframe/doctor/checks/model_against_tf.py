"""TF023: transforms that differ from the robot description and the joint states."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe.doctor.edge import angles_between
from coframe.doctor.finding import Finding, Severity
from coframe.doctor.robot_model import model

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from coframe.doctor.edge import Edge
    from coframe.doctor.observation import Observation
    from coframe.robots import Robot

__all__ = ["CODE", "find"]

CODE = "TF023"
_METRES = 1e-3
_RADIANS = 1e-3
_MOST_COMPARED = 2000  # transforms per joint


class _Difference(NamedTuple):
    metres: float
    radians: float
    compared: int


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per joint."""
    robot = model(observation)
    if robot is None:
        return
    by_key = {edge.key: edge for edge in observation.edges}
    for name, joint in robot.joints.items():
        edge = by_key.get((observation.link_name(joint.parent), observation.link_name(joint.child)))
        found = _difference(observation, robot, name, edge) if edge is not None else None
        if edge is None or found is None or (found.metres < _METRES and found.radians < _RADIANS):
            continue
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"differs from joint {name!r} of the robot description by {found.metres:.3g} m and "
            f"{degrees(found.radians):.3g} degrees (median of {found.compared})",
            fix="Publish the links of the robot description with robot_state_publisher only, and stop the other "
            "publisher of this transform; or correct <origin> in the URDF, and restart robot_state_publisher after "
            "the change.",
            edge=edge.key,
            first_stamp=edge.first_stamp,
            publishers=edge.publishers,
        )


def _difference(observation: Observation, robot: Robot, name: str, edge: Edge) -> _Difference | None:
    """Return the median difference between an edge and its joint; None if nothing can be compared."""
    joint = robot.joints[name]
    if joint.type == "fixed":
        rows = np.array([edge.count - 1])
        expected = robot.joint_transforms()[name]
        translation, rotation = expected.translation[None], expected.quaternion[None]
    else:
        if joint.size != 1:
            return None
        matched = _positions(observation, name, edge.stamp[:_MOST_COMPARED])
        if matched is None:
            return None
        rows, positions = matched
        try:
            expected = robot.joint_transforms({name: positions})[name]
        except ValueError:
            return None
        translation, rotation = expected.translation, expected.quaternion
    metres = np.linalg.norm(edge.values[rows, :3] - translation, axis=1)
    radians = angles_between(edge.rotations[rows], rotation)
    return _Difference(float(np.median(metres)), float(np.median(radians)), len(rows))


def _positions(
    observation: Observation, name: str, stamps: NDArray[np.int64]
) -> tuple[NDArray[np.intp], NDArray[np.float64]] | None:
    """Return the rows whose stamp is that of exactly one joint state with this joint, and the positions there."""
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
