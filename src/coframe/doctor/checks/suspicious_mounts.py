"""TF021: mounts that look like degrees given for radians, millimetres for metres, or a forgotten optical rotation."""

from __future__ import annotations

from math import degrees, pi
from typing import TYPE_CHECKING

import numpy as np

from coframe import quaternion
from coframe.doctor.finding import Finding, Severity

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF021"
_ROUND_DEGREES = (30, 45, 60, 90, 120, 135, 150, 180, 270)
_CLOSE = 2e-4  # radians
_FAR = 10.0  # metres from a robot's frame to another
_WORLDS = ("world", "map", "odom", "earth", "utm", "ecef", "enu", "global", "ned")


def find(observation: Observation) -> Iterator[Finding]:
    """Links that do not move, whichever topic they come on."""
    for edge in observation.edges:
        if edge.static or edge.constant:
            yield from _degrees(edge)
            yield from _millimetres(edge)
            yield from _optical(edge)


def _degrees(edge: Edge) -> Iterator[Finding]:
    """Turns about one axis by what a round number of degrees is when it is taken as radians."""
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
                f"is turned by {degrees(angle) % 360:.1f} degrees about {'xyz'[about]}, which is {name} = "
                f"{number} taken as radians: were degrees meant?",
                f"Give radians: --{name} {number * pi / 180:.6f}; in code math.radians({number}).",
            )
            return


def _millimetres(edge: Edge) -> Iterator[Finding]:
    names = {edge.parent.rpartition("/")[2].lower(), edge.child.rpartition("/")[2].lower()}
    if edge.length < _FAR or any(name.startswith(world) for name in names for world in _WORLDS):
        return
    x, y, z = (edge.values[-1, :3] / 1000).tolist()
    yield _finding(
        edge,
        f"is {edge.length:.4g} m long: were millimetres meant ({edge.length:.4g} mm)?",
        f"Give metres: --x {x:g} --y {y:g} --z {z:g}.",
    )


def _optical(edge: Edge) -> Iterator[Finding]:
    """By REP-103 an optical frame looks along z, its x to the right: turned against its body by -90, 0, -90 degrees."""
    if "optical" not in edge.child.lower() or "optical" in edge.parent.lower():
        return
    if edge.angle < 1e-3:
        wanted = quaternion.from_rpy(np.array([-pi / 2, 0.0, -pi / 2]))
        values = " ".join(f"--q{axis} {value:g}" for axis, value in zip("xyzw", wanted.tolist(), strict=True))
        yield _finding(
            edge,
            f"{edge.child!r} is called optical, but is not turned against {edge.parent!r}: z would point up instead of "
            "forward",
            f"Turn it by roll -90, pitch 0, yaw -90 degrees: coframe static --frame-id {edge.parent} --child-frame-id "
            f"{edge.child} {values}.",
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
