# SPDX-License-Identifier: Apache-2.0
"""TF022: joints without joint states, and joint states without joints."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import join_names
from coframe.doctor._finding import Finding, Severity
from coframe.doctor._robot_model import model

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF022"


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per kind of mismatch."""
    robot = model(observation)
    if robot is None:
        return
    published = {
        name
        for states in observation.joint_states
        for name, positions in states.positions.items()
        if np.isfinite(positions).any()
    }
    movable = {name: joint for name, joint in robot.joints.items() if joint.type != "fixed" and joint.size}
    children = {edge.child for edge in observation.edges}
    missing = [
        name
        for name, joint in movable.items()
        if name not in published and joint.mimic is None and joint.child not in children
    ]
    if missing:
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"no joint state for {len(missing)} of {len(movable)} movable joints: {join_names(missing)}; the "
            "links below them have no transform",
            fix="Publish their positions on /joint_states (joint_state_publisher publishes zeros), or change their "
            "type to fixed in the URDF.",
            topic="/joint_states",
            frames=frozenset(movable[name].child for name in missing),
        )
    unknown = sorted({name for states in observation.joint_states for name in states.positions} - robot.joints.keys())
    if unknown:
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"the joint states contain {join_names(unknown)}, but the robot description has no such joint",
            fix="Use the names of the joints in the URDF"
            + (f": {join_names(missing)}." if missing else ", or load the description that contains these joints."),
            topic="/joint_states",
        )
    mimicking = sorted(name for name, joint in robot.joints.items() if joint.mimic is not None and name in published)
    if mimicking:
        yield Finding(
            code=CODE,
            severity=Severity.NOTE,
            text=f"{join_names(mimicking)}: published on /joint_states, but the URDF defines a mimic joint; the "
            "published position is used",
            fix="Remove the joint from /joint_states, or remove <mimic> from the URDF.",
            topic="/joint_states",
        )
