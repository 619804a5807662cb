"""TF022: joints without joint states, and joint states without joints."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.doctor.phrases import listed
from coframe.doctor.robot_model import model

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF022"


def find(observation: Observation) -> Iterator[Finding]:
    """One finding a kind."""
    robot = model(observation)
    if robot is None:
        return
    told = {
        name
        for states in observation.joint_states
        for name, positions in states.positions.items()
        if np.isfinite(positions).any()
    }
    moving = {name: joint for name, joint in robot.joints.items() if joint.type != "fixed" and joint.size}
    children = {edge.child for edge in observation.edges}
    untold = [
        name
        for name, joint in moving.items()
        if name not in told and joint.mimic is None and joint.child not in children
    ]
    if untold:
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"nobody tells of {len(untold)} of {len(moving)} movable joints: {listed(untold)}; their links "
            "have no "
            "transform",
            fix="Publish their positions on /joint_states (joint_state_publisher fills in zeros), or make them "
            "fixed in the "
            "URDF.",
            topic="/joint_states",
            frames=frozenset(frame for name in untold for frame in (moving[name].child,)),
        )
    unknown = sorted({name for states in observation.joint_states for name in states.positions} - robot.joints.keys())
    if unknown:
        yield Finding(
            code=CODE,
            severity=Severity.WARNING,
            text=f"joint states tell of {listed(unknown)}, which the robot's description does not have",
            fix="Use the names of the URDF's <joint name=...>"
            + (f": {listed(untold)}." if untold else ", or load the description that has them."),
            topic="/joint_states",
        )
    both = sorted(name for name, joint in robot.joints.items() if joint.mimic is not None and name in told)
    if both:
        yield Finding(
            code=CODE,
            severity=Severity.NOTE,
            text=f"{listed(both)}: told on /joint_states although the URDF says that they mimic others; what is "
            "told wins",
            fix="Leave them out of /joint_states, or take <mimic> out of the URDF.",
            topic="/joint_states",
        )
