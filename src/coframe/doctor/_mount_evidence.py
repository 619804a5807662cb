# SPDX-License-Identifier: Apache-2.0
"""Mounts that gravity or the points of a lidar contradict, and the common mistakes that make them agree."""

from __future__ import annotations

from itertools import islice
from math import degrees
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe import quaternion
from coframe.analysis.missing_edges import is_base_frame
from coframe.doctor.pose_mistakes import Correction, corrections
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation, ObservedImu, ObservedPoints

    Array = NDArray[np.float64]

__all__ = ["Contradiction", "gravity_contradictions", "points_contradictions"]

_GRAVITY = 9.81
_MAX_STILL_RATE = 0.05  # rad/s
_MAX_GRAVITY_ERROR = 0.5  # m/s^2
_MIN_STILL_MESSAGES = 50  # messages
_MAX_STILL_TILT = np.radians(3.0)
_MIN_WRONG_TILT, _MAX_RIGHT_TILT = np.radians(20.0), np.radians(3.0)  # of gravity from up
_MAX_CANDIDATES = 4  # With more, gravity does not show which one it is.
_MIN_SCANS = 4
_MIN_POINTS = 500
_WINDOW_DURATION = 10 * SECOND
_CELL_SIZES = (0.03, 0.01)  # of the usual range: sparse scans overlap in large cells, and small ones show small errors
_MIN_CELL = 0.1  # meters
_MIN_REMAINING_SHARE = (
    0.35  # share of the cells of all scans that remain when they are joined; below it, the scans fit together
)
_MAX_CORRECTED_RATIO = 0.8  # of the cells that remain
_MIN_ROTATION = 1e-3  # radians


class Contradiction(NamedTuple):
    """A mount that other data contradicts.

    Attributes:
        edge: The mount.
        text: What contradicts it, and what makes it agree, with the number.
        fix: What to do.
        pose: The pose that agrees, (7,).
    """

    edge: Edge
    text: str
    fix: str
    pose: Array


def gravity_contradictions(observation: Observation) -> Iterator[Contradiction]:
    """Yield mounts with which the acceleration of an IMU at rest points up only if a mistake is corrected."""
    seen: set[str] = set()
    for imu in observation.imus:
        up = _acceleration_at_rest(imu)
        chain = observation.mounts(imu.frame)
        if up is None or imu.frame in seen or not chain or not is_base_frame(chain[-1].parent):
            continue
        seen.add(imu.frame)

        def tilt_angle(turns: Sequence[Array], up: Array = up) -> float:
            for rotation in turns:
                up = quaternion.rotate(rotation, up)
            return float(np.arccos(np.clip(up[2], -1.0, 1.0)))

        turns = [edge.rotations[-1] for edge in chain]
        tilt = tilt_angle(turns)
        if tilt < _MIN_WRONG_TILT:
            continue
        for number, edge in enumerate(chain):
            if edge.angle < _MIN_ROTATION:
                continue  # The sign of the acceleration is more likely to be wrong than a mount of zeros.
            candidates = [
                (tilt_angle([*turns[:number], correction.pose[3:], *turns[number + 1 :]]), correction)
                for correction in _distinct_corrections(edge)
            ]
            right = [(angle, correction) for angle, correction in candidates if angle < _MAX_RIGHT_TILT]
            if 0 < len(right) <= _MAX_CANDIDATES:
                angle, best = right[0]
                readings = " or ".join(f"if {one.reading}" for _, one in right)
                text = (
                    f"at rest, the acceleration of {imu.topic} points {degrees(tilt):.3g} degrees away from up in "
                    f"{chain[-1].parent}; it points up within {degrees(angle):.2g} degrees {readings}"
                )
                yield Contradiction(edge, text, best.fix, best.pose)
                break


def points_contradictions(observation: Observation) -> Iterator[Contradiction]:
    """Yield mounts with which the scans of a moving lidar match only if a mistake is corrected."""
    for sensor in observation.sensors:
        chain = observation.mounts(sensor.frame)
        scans = _window(sensor.points)
        moving_edges = [edge for edge in observation.path(sensor.frame) if edge not in chain]
        if not chain or len(scans) < _MIN_SCANS or not any(not edge.constant for edge in moving_edges):
            continue
        found = (_find_by_overlap(sensor.topic, chain, moving_edges, scans, share) for share in _CELL_SIZES)
        yield from islice((one for one in found if one is not None), 1)


def _find_by_overlap(
    topic: str, chain: list[Edge], moving_edges: list[Edge], scans: Sequence[ObservedPoints], cell: float
) -> Contradiction | None:
    """Return the mount whose correction makes scans overlap in cells of a size, given as a share of the usual range."""
    times = np.concatenate([scan.times for scan in scans])
    points = np.concatenate([scan.points for scan in scans])
    number = np.repeat(np.arange(len(scans)), [len(scan.points) for scan in scans])
    carried = _base_poses(moving_edges, times)
    if len(points) < _MIN_POINTS or carried is None:
        return None
    rotation, place, known = carried
    size = max(_MIN_CELL, cell * float(np.median(np.linalg.norm(points, axis=1))))

    def remaining(mounts: Sequence[Array]) -> float:
        """Return the share of the cells of all scans that remain when the scans are joined."""
        moved_points = points[known]
        for pose in mounts:
            moved_points = quaternion.rotate(pose[3:], moved_points) + pose[:3]
        moved_points = quaternion.rotate(rotation[known], moved_points) + place[known]
        cells = np.floor(moved_points / size).astype(np.int64)
        cells -= cells.min(axis=0)
        keys = (cells[:, 0] << 42) + (cells[:, 1] << 21) + cells[:, 2]
        single = np.unique(keys * 64 + number[known])
        return len(np.unique(single // 64)) / len(single)

    poses = [edge.last_pose[0] for edge in chain]
    published = remaining(poses)
    if published < _MIN_REMAINING_SHARE:
        return None
    for position, edge in enumerate(chain):
        candidates = [
            (remaining([*poses[:position], correction.pose, *poses[position + 1 :]]), correction)
            for correction in _distinct_corrections(edge)
        ]
        share, best = min(candidates, key=lambda pair: pair[0])
        if share < _MAX_CORRECTED_RATIO * published:
            text = (
                f"the scans of {topic} do not fit together while the robot moves: joined, {published:.0%} of their "
                f"cells of {size:.2g} m remain, and {share:.0%} if {best.reading}"
            )
            return Contradiction(edge, text, best.fix, best.pose)
    return None


def _distinct_corrections(edge: Edge) -> list[Correction]:
    """Return the corrections of a mount with different poses, the most common mistakes first."""
    found: dict[tuple[float, ...], Correction] = {}
    for correction in corrections(edge.last_pose[0]):
        if "camera" in correction.reading and "cam" not in edge.child.lower():
            continue
        sign = np.where(np.arange(7) < 3, 1.0, np.sign(correction.pose[3:] @ _HEMISPHERE_AXIS))
        found.setdefault(tuple(np.round(correction.pose * sign, 4).tolist()), correction)
    return list(found.values())


_HEMISPHERE_AXIS = np.array([0.1234, 0.3456, 0.5678, 1.0])  # A quaternion and its negative are the same rotation.


def _acceleration_at_rest(imu: ObservedImu) -> Array | None:
    """Return the direction of the acceleration of an IMU at rest, in its frame, or None if it was not at rest."""
    size = np.linalg.norm(imu.acceleration, axis=1)
    still = (np.linalg.norm(imu.rates, axis=1) < _MAX_STILL_RATE) & (np.abs(size - _GRAVITY) < _MAX_GRAVITY_ERROR)
    if np.count_nonzero(still) < max(_MIN_STILL_MESSAGES, len(still) // 2):
        return None
    directions = imu.acceleration[still] / size[still, None]
    up = np.median(directions, axis=0)
    length = float(np.linalg.norm(up))
    if length < 1.0 - _MAX_STILL_TILT:
        return None
    angles = np.arccos(np.clip(directions @ (up / length), -1.0, 1.0))
    return np.asarray(up / length) if float(np.median(angles)) < _MAX_STILL_TILT else None


def _window(scans: Sequence[ObservedPoints]) -> Sequence[ObservedPoints]:
    """Return the scans of a short time, in which the position of the robot hardly drifts."""
    return [scan for scan in scans if scan.stamp <= scans[0].stamp + _WINDOW_DURATION]


def _base_poses(moving_edges: list[Edge], times: NDArray[np.int64]) -> tuple[Array, Array, NDArray[np.bool_]] | None:
    """Return the pose of the robot in the root at given times: rotations, positions, and where all edges have data."""
    rotation, place = np.tile([0.0, 0.0, 0.0, 1.0], (len(times), 1)), np.zeros((len(times), 3))
    known = np.ones(len(times), dtype=bool)
    for edge in moving_edges:
        order = np.unique(edge.stamp, return_index=True)[1]
        if edge.static or len(order) < 2:
            between = np.repeat(edge.last_pose, len(times), axis=0)
        else:
            between, inside = _interpolate_poses(edge.stamp[order], edge.poses(order), times)
            known &= inside
        place = quaternion.rotate(between[:, 3:], place) + between[:, :3]
        rotation = quaternion.multiply(between[:, 3:], rotation)
    return (rotation, place, known) if np.count_nonzero(known) >= _MIN_POINTS else None


def _interpolate_poses(
    stamps: NDArray[np.int64], poses: Array, times: NDArray[np.int64]
) -> tuple[Array, NDArray[np.bool_]]:
    """Return poses between samples, and whether each time is between two of them."""
    after = np.clip(np.searchsorted(stamps, times), 1, len(stamps) - 1)
    before = after - 1
    share = ((times - stamps[before]) / (stamps[after] - stamps[before]))[:, None]
    first, second = poses[before], poses[after]
    sign = np.where(np.sum(first[:, 3:] * second[:, 3:], axis=1, keepdims=True) < 0.0, -1.0, 1.0)
    found = (1.0 - share) * first + share * np.concatenate([second[:, :3], sign * second[:, 3:]], axis=1)
    found[:, 3:] /= np.linalg.norm(found[:, 3:], axis=1, keepdims=True)
    return found, (times >= stamps[0]) & (times <= stamps[-1])
