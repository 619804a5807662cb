# SPDX-License-Identifier: Apache-2.0
"""TF021: mounts that look like degrees for radians, millimeters for meters, or a missing optical rotation."""

from __future__ import annotations

from math import degrees, pi
from typing import TYPE_CHECKING

import numpy as np

from coframe import quaternion
from coframe.analysis.static_command import static_command
from coframe.doctor._finding import Finding, Severity

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF021"
_ROUND_DEGREES = (30, 45, 60, 90, 120, 135, 150, 180, 270)
_CLOSE = 2e-4  # radians
_FAR = 10.0  # meters between two frames of a robot
_TOO_FAR = 1e6  # meters; it would be a kilometer in millimeters
_WORLDS = ("world", "map", "odom", "earth", "utm", "ecef", "enu", "global", "ned")


def find(observation: Observation) -> Iterator[Finding]:
    """Yield findings for edges that do not move, on any topic."""
    for edge in observation.edges:
        if edge.static or edge.constant:
            yield from _degrees(edge)
            yield from _millimeters(edge)
            yield from _optical(edge)


def _degrees(edge: Edge) -> Iterator[Finding]:
    """Yield a finding for a rotation about one axis whose angle is a round number of degrees used as radians."""
    axis = np.abs(edge.rotations[-1, :3])
    if np.count_nonzero(axis > 1e-6) != 1:
        return
    about = int(np.argmax(axis))
    x = float(edge.rotations[-1, about])
    angle = 2.0 * np.arctan2(x, float(edge.rotations[-1, 3]))
    for number in (sign * size for size in _ROUND_DEGREES for sign in (1, -1)):
        if abs((angle - number + pi) % (2 * pi) - pi) < _CLOSE:
            name = ("roll", "pitch", "yaw")[about]
            yield _finding(
                edge,
                f"rotated by {degrees(angle) % 360:.1f} degrees about {'xyz'[about]}, which is {name} = {number} "
                f"radians: was {number} degrees intended?",
                f"Use radians: --{name} {number * pi / 180:.6f}; in code math.radians({number}).",
            )
            return


def _millimeters(edge: Edge) -> Iterator[Finding]:
    names = {edge.parent.rpartition("/")[2].lower(), edge.child.rpartition("/")[2].lower()}
    if edge.length < _FAR or any(name.startswith(world) for name in names for world in _WORLDS):
        return
    if edge.length > _TOO_FAR:
        distance = f"the frames are {edge.length:.4g} m apart"
        yield _finding(edge, distance, "Check the values of the translation; they are in meters.")
        return
    x, y, z = (edge.values[-1, :3] / 1000).tolist()
    yield _finding(
        edge,
        f"the frames are {edge.length:.4g} m apart: was {edge.length:.4g} mm intended?",
        f"Use meters: --x {x:g} --y {y:g} --z {z:g}.",
    )


def _optical(edge: Edge) -> Iterator[Finding]:
    """Yield a finding for an optical frame without rotation: by REP-103 its z points forward and its x right."""
    if "optical" not in edge.child.lower() or "optical" in edge.parent.lower():
        return
    if edge.angle < 1e-3:
        rotation = quaternion.from_rpy(np.array([-pi / 2, 0.0, -pi / 2]))
        command = static_command(*edge.key, [*edge.values[-1, :3].tolist(), *rotation.tolist()])
        yield _finding(
            edge,
            f"{edge.child!r} is named optical, but is not rotated relative to {edge.parent!r}: its z axis points up "
            "instead of forward",
            f"Rotate it by roll -90, pitch 0, yaw -90 degrees: `{command}`.",
        )


def _finding(edge: Edge, text: str, fix: str) -> Finding:
    return Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=text,
        fix=fix,
        edge=edge.key,
        first_stamp=edge.first_stamp,
        publishers=edge.publishers,
    )
