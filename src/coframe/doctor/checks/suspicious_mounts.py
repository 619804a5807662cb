# SPDX-License-Identifier: Apache-2.0
"""TF021: mounts that cannot be right: degrees as radians, other units, impossible axes, sensors below the ground."""

from __future__ import annotations

from math import degrees, pi
from typing import TYPE_CHECKING

import numpy as np

from coframe import quaternion
from coframe.analysis.static_command import static_command
from coframe.doctor._camera_axes import is_optical, wrong_axes
from coframe.doctor._finding import Finding, Severity
from coframe.doctor._rules import replace_mount
from coframe.doctor.pose_mistakes import all_rpy_angles, inverse_poses, rotation_text

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF021"
_ROUND_DEGREES = (30, 45, 60, 90, 120, 135, 150, 180, 270)
_MAX_ERROR_ONE_AXIS = 2e-5  # radians, of a rotation about one axis
_MAX_ERROR_SEVERAL_AXES = 5e-7  # radians, of one of several angles
_UNITS = (("mm", 1e3), ("cm", 1e2), ("in", 1 / 0.0254))
_MIN_MOUNT_DISTANCE = 5e-3  # meters
_MIN_HEIGHT = -0.5  # meters; a sensor cannot be this far below the ground
_MAX_PLANAR_DEVIATION = 0.2  # meters, and twice the sine of half an angle
_MIN_ROTATION = 1e-3  # radians
_CAMERA_AND_LIDAR_TYPES = {
    f"sensor_msgs/msg/{name}"
    for name in ("CameraInfo", "CompressedImage", "Image", "LaserScan", "MultiEchoLaserScan", "PointCloud2")
}
_MAX_DISTANCE = 10.0  # meters between two frames of a robot
_MIN_IMPOSSIBLE_DISTANCE = 1e6  # meters; it would be a kilometer in millimeters
_WORLD_FRAMES = ("world", "map", "odom", "earth", "utm", "ecef", "enu", "global", "ned")


def find(observation: Observation) -> Iterator[Finding]:
    """Yield findings for edges that do not move, on any topic."""
    mounts = [edge for edge in observation.edges if edge.static or edge.constant]
    for edge in mounts:
        turned = list(_wrong_optical_axes(observation, edge)) if is_optical(observation, edge) else []
        yield from turned or _find_degrees_as_radians(edge)
        yield from _find_other_units(edge, mounts)
    yield from _find_below_ground(observation)


def _find_degrees_as_radians(edge: Edge) -> Iterator[Finding]:
    """Yield a finding for an angle that is a round number of degrees used as radians."""
    axes = np.abs(edge.rotations[-1, :3]) > 1e-6
    if np.count_nonzero(axes) == 1:
        x, w = float(edge.rotations[-1, :3][axes][0]), float(edge.rotations[-1, 3])
        angles = [np.where(axes, 2.0 * np.arctan2(x, w), 0.0)]
        limit = _MAX_ERROR_ONE_AXIS
    else:
        angles, limit = [triple[0] for triple in all_rpy_angles(edge.rotations[-1:])], _MAX_ERROR_SEVERAL_AXES
    for triple in angles:
        for name, axis, angle in zip(("roll", "pitch", "yaw"), "xyz", triple.tolist(), strict=True):
            for number in (sign * size for size in _ROUND_DEGREES for sign in (1, -1)):
                if angle != 0.0 and abs((angle - number + pi) % (2 * pi) - pi) < limit:
                    yield _make_finding(
                        edge,
                        f"rotated by {degrees(angle) % 360:.1f} degrees about {axis}, which is {name} = {number} "
                        f"radians: was {number} degrees intended?",
                        f"Use radians: --{name} {number * pi / 180:.6f}; in code math.radians({number}).",
                        pose=_with_angle(edge, triple, "xyz".index(axis), number * pi / 180),
                    )
                    return


def _with_angle(edge: Edge, angles: NDArray[np.float64], axis: int, angle: float) -> NDArray[np.float64]:
    """Return the pose of an edge with another angle about one axis; `angles` are roll, pitch and yaw."""
    angles = np.array(angles, dtype=np.float64)
    angles[axis] = angle
    return np.concatenate([edge.values[-1, :3], quaternion.from_rpy(angles)])


def _find_other_units(edge: Edge, mounts: list[Edge]) -> Iterator[Finding]:
    """Yield a finding for a mount that is farther from its parent than any part of a robot."""
    if edge.length < _MAX_DISTANCE or _is_world_edge(edge):
        return
    if edge.length > _MIN_IMPOSSIBLE_DISTANCE:
        distance = f"the frames are {edge.length:.4g} m apart"
        yield _make_finding(edge, distance, "Check the values of the translation, which must be in meters.")
        return
    units = _likely_units(edge, mounts)
    x, y, z = (edge.values[-1, :3] / units[0][1]).tolist()
    intended = f"{edge.length:.4g} " + " or ".join(unit for unit, _ in units)
    yield _make_finding(
        edge,
        f"the frames are {edge.length:.4g} m apart: was {intended} intended?",
        f"Use meters: --x {x:.6g} --y {y:.6g} --z {z:.6g}" + (f" (for {units[0][0]})." if len(units) > 1 else "."),
        pose=np.concatenate([edge.values[-1, :3] / units[0][1], edge.values[-1, 3:]]),
        is_certain=len(units) == 1,
    )


def _likely_units(edge: Edge, mounts: list[Edge]) -> list[tuple[str, float]]:
    """Return the units in which the distance is similar to the robot's other mounts, or at least possible."""
    possible = [unit for unit in _UNITS if _MIN_MOUNT_DISTANCE < edge.length / unit[1] < _MAX_DISTANCE] or list(
        _UNITS[:1]
    )
    others = [
        other.length for other in mounts if other is not edge and _MIN_MOUNT_DISTANCE < other.length < _MAX_DISTANCE
    ]
    if not others:
        return possible
    alike = [unit for unit in possible if min(others) / 2.0 <= edge.length / unit[1] <= 2.0 * max(others)]
    return alike or possible


def _is_world_edge(edge: Edge) -> bool:
    names = {edge.parent.rpartition("/")[2].lower(), edge.child.rpartition("/")[2].lower()}
    return any(name.startswith(world) for name in names for world in _WORLD_FRAMES)


def _wrong_optical_axes(observation: Observation, edge: Edge) -> Iterator[Finding]:
    """Yield a finding for an optical frame in which no camera can look: by REP-103 its z points forward, x right."""
    found = wrong_axes(observation, edge)
    if found is not None:
        rotation_description = rotation_text(found.pose[3:])
        command = static_command(*found.edge.key, found.pose.tolist())
        fix = f"{found.fix} The rotation is {rotation_description}: `{command}`.".lstrip()
        yield _make_finding(found.edge, found.text, fix, pose=found.pose)


def _find_below_ground(observation: Observation) -> Iterator[Finding]:
    """Yield a note for a camera or lidar below the ground on which its robot drives."""
    seen = set()
    for sensor in observation.sensors:
        if sensor.type not in _CAMERA_AND_LIDAR_TYPES or sensor.frame in seen:
            continue
        seen.add(sensor.frame)
        chain = observation.path(sensor.frame)
        mount = next((edge for edge in chain if edge.static or edge.constant), None)
        moving_edges = [edge for edge in chain if not (edge.static or edge.constant)]
        if len(chain) - len(moving_edges) != 1 or mount is not chain[0] or mount is None:
            continue  # of several mounts, any may be wrong
        is_planar = moving_edges and all(
            np.abs(edge.values[:, 2]).max() < _MAX_PLANAR_DEVIATION
            and np.abs(edge.rotations[:, :2]).max() < _MAX_PLANAR_DEVIATION / 2
            for edge in moving_edges
        )
        if not is_planar or mount.values[-1, 2] > _MIN_HEIGHT:
            continue
        yield from _below_ground_finding(mount)


def _below_ground_finding(mount: Edge) -> Iterator[Finding]:
    pose = mount.last_pose
    inverse = inverse_poses(pose)[0]
    mirrored = pose[0] * np.array([1.0, 1.0, -1.0, 1.0, 1.0, 1.0, 1.0])
    inverted_text = f"the inverse of the transform is {inverse[2]:.3g} m above it; " if inverse[2] > 0.0 else ""
    right = inverse if inverse[2] > 0.0 and mount.angle > _MIN_ROTATION else mirrored
    yield _make_finding(
        mount,
        f"{mount.child!r}, the frame of a camera or lidar, is {-mount.values[-1, 2]:.3g} m below {mount.parent!r}, "
        f"which is on the ground: {inverted_text}with the other sign of z it is {mirrored[2]:.3g} m above it",
        "Check the direction of the transform (the translation is the position of the child in the parent) and the "
        f"sign of z (up is positive), for example `{static_command(*mount.key, np.round(right, 9).tolist())}`.",
        Severity.NOTE,
        pose=np.round(right, 9),
        is_certain=False,
    )


def _make_finding(
    edge: Edge,
    text: str,
    fix: str,
    severity: Severity = Severity.WARNING,
    *,
    pose: NDArray[np.float64] | None = None,
    is_certain: bool = True,
) -> Finding:
    rules = () if pose is None else (replace_mount(edge.child, pose),)
    return Finding(
        code=CODE,
        severity=severity,
        text=text,
        fix=fix,
        edge=edge.key,
        first_stamp=edge.first_stamp,
        publishers=edge.publishers,
        repairs=rules if is_certain else (),
        choices=() if is_certain else rules,
    )
