# SPDX-License-Identifier: Apache-2.0
"""Sensor transform, 20 points: every valid beam of every scan, in base_link, while the arm moves."""

from __future__ import annotations

import math
import time
from array import array
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe.course._motion import SimulatedRobot
from coframe.course._sheet import Sheet
from coframe.course._world import STEP, stamp_of
from coframe.course.criteria.common import Task, run_program, stamp_ns
from coframe.course.rubric import RUBRIC
from coframe.errors import CoframeError
from coframe.sensors.layout import field_of
from coframe.transform.transform import Transform
from sensor_msgs.msg import LaserScan, PointCloud2

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.course._world import Received, World

__all__ = ["check"]

_TOPIC = "/scan_base_frame"
_BEAMS = 120
_RANGE_MIN, _RANGE_MAX = 0.1, 10.0
_SCAN_PERIOD = 10 * STEP
_SCANS = 15  # in each of the two frames
_TOLERANCE = 1e-3  # meters
# Seconds of real time from a scan to the transform of its stamp. On a robot, this is usually 10 to 50 ms.
_TRANSFORM_DELAY = 0.03
_GRIPPER = "gripper_link"
_GRIPPER_OFFSET = (0.1, 0.0, 0.0)
_NO_WAIT_CAUSE = "the lookup does not wait: the transform of a scan arrives after it. Use a timeout or a MessageFilter"
_READ = "handbook chapter 6, sensors in the base frame"


class _Scan(NamedTuple):
    """A scan and the expected cloud in base_link."""

    message: LaserScan
    points: NDArray[np.float64]


def check(task: Task) -> Sheet:
    """Check ``sensor_transform.py``."""
    sheet = Sheet.of(RUBRIC["sensor"])
    world = task.world
    robot = SimulatedRobot(task.assignment)
    scans: dict[int, _Scan] = {}

    def publish(now: int) -> None:
        if now % _SCAN_PERIOD == 0:
            frame = task.assignment.lidar.frame if len(scans) < _SCANS else _GRIPPER
            scans[now] = _scan(robot, now, frame)
            world.publish("/scan", scans[now].message)
            time.sleep(_TRANSFORM_DELAY)
        world.publish_transforms(robot.arm_at(now), now)

    with run_program(task, sheet) as program:
        clouds = world.watch(_TOPIC, PointCloud2)
        if program is not None:
            world.start(program)
            mounts = [*robot.mounts(), Transform(_GRIPPER_OFFSET, target="end_effector", source=_GRIPPER)]
            world.publish_transforms(mounts, world.now, static=True)
            world.run(0.5, lambda now: world.publish_transforms(robot.arm_at(now), now))
            world.run(2 * _SCANS * _SCAN_PERIOD / 1e9, publish)
            world.run(0.5, lambda now: world.publish_transforms(robot.arm_at(now), now))
        _check_messages(sheet, world, scans, clouds)
        _check_points(sheet, scans, clouds)
    return sheet


def _scan(robot: SimulatedRobot, now: int, frame: str) -> _Scan:
    """Return a scan with all kinds of invalid beams, and its valid beams in base_link."""
    angles = -math.pi + 2 * math.pi / _BEAMS * np.arange(_BEAMS)
    ranges = (3.0 + np.cos(3 * angles + now / 1e9)).astype(np.float32)
    ranges[5::17], ranges[7::23], ranges[11::29], ranges[13::31] = np.inf, np.nan, 0.02, 12.0
    message = LaserScan(
        angle_min=-math.pi,
        angle_max=float(angles[-1]),
        angle_increment=2 * math.pi / _BEAMS,
        scan_time=_SCAN_PERIOD / 1e9,
        range_min=_RANGE_MIN,
        range_max=_RANGE_MAX,
        ranges=array("f", ranges.tobytes()),
    )
    message.header.frame_id = frame
    message.header.stamp = stamp_of(now)
    valid = np.isfinite(ranges) & (ranges >= _RANGE_MIN) & (ranges <= _RANGE_MAX)
    flat = ranges[valid, None] * np.column_stack([np.cos(angles[valid]), np.sin(angles[valid]), np.zeros(valid.sum())])
    if frame == _GRIPPER:
        pose = robot.end_effector(now) @ Transform(_GRIPPER_OFFSET, target="end_effector", source=_GRIPPER)
    else:
        mount = robot.assignment.lidar
        pose = Transform(mount.translation, mount.quaternion)
    return _Scan(message, np.asarray(pose @ flat))


def _check_messages(sheet: Sheet, world: World, scans: dict[int, _Scan], clouds: list[Received]) -> None:
    names = sorted({info.node_name for info in world.publishers_of(_TOPIC)})
    is_node = names == ["sensor_transform"]
    sheet.check(
        3,
        f"the node sensor_transform publishes clouds on {_TOPIC}",
        1.0 if clouds and is_node else 0.5 if clouds else 0.0,
        expected=f"PointCloud2 messages on {_TOPIC} from the node sensor_transform",
        observed=f"{len(clouds)} messages from {', '.join(names) or 'no node'}",
        cause="the publisher is created, but publish() is never called"
        if names and not clouds
        else "another topic or node name",
        read=_READ,
    )
    frames = sorted({each.message.header.frame_id for each in clouds})
    sheet.check(
        2,
        "the clouds are in base_link",
        frames == ["base_link"],
        expected="header.frame_id is base_link",
        observed=f"header.frame_id is {', '.join(map(repr, frames))}" if frames else "no clouds",
        cause="the whole header of the scan is copied",
        read=_READ,
    )
    stamps = [stamp_ns(each.message) for each in clouds]
    kept = sum(stamp in scans for stamp in stamps)
    sheet.check(
        3,
        "the clouds keep the stamps of their scans",
        kept / len(stamps) if stamps else 0.0,
        expected="header.stamp is the stamp of the scan",
        observed=f"{len(stamps) - kept} of {len(stamps)} clouds have a different stamp" if stamps else "no clouds",
        cause="the stamp is now(): the points were measured earlier",
        read=_READ,
    )
    answered = min(len(set(stamps)), len(scans))
    sheet.check(
        2,
        "at least 95 % of the scans become clouds",
        bool(scans) and answered >= 0.95 * len(scans),
        expected="a cloud for each scan; 5 % may be missing",
        observed=f"{answered} of {len(scans)} scans",
        cause=_NO_WAIT_CAUSE,
        read="handbook chapter 5, time, interpolation, waiting",
    )


def _check_points(sheet: Sheet, scans: dict[int, _Scan], clouds: list[Received]) -> None:
    compared = [(scan, _points(each)) for each in clouds if (scan := _find_scan(scans, each)) is not None]
    counts = [len(points) == len(scan.points) for scan, points in compared]
    wrong = next((f"{len(p)} points instead of {len(s.points)}" for s, p in compared if len(p) != len(s.points)), "")
    sheet.check(
        3,
        "beams without an echo are dropped",
        sum(counts) / len(counts) if counts else 0.0,
        expected="one point for each range that is finite and from range_min to range_max",
        observed=wrong or "no clouds",
        cause="inf and NaN are not filtered: np.isfinite(ranges)",
        read=_READ,
    )
    on_base = [each for each in compared if each[0].message.header.frame_id != _GRIPPER]
    on_arm = [each for each in compared if each[0].message.header.frame_id == _GRIPPER]
    for points, name, pairs, cause in (
        (
            4,
            "each beam is correct to 1 mm",
            on_base,
            "the mount of the lidar is ignored, or the angles do not begin at angle_min",
        ),
        (
            3,
            "each beam is correct to 1 mm on the moving gripper",
            on_arm,
            "the lookup uses the latest transform (Time()) instead of the stamp of the scan, or a fixed frame name",
        ),
    ):
        distances = [_distance(scan, found) for scan, found in pairs]
        good = [distance <= _TOLERANCE for distance in distances]
        sheet.check(
            points,
            name,
            bool(good) and sum(good) / len(good) >= 0.95,
            expected="all points within 1 mm of the analytic solution",
            observed=f"{good.count(False)} of {len(good)} clouds are up to {max(distances) * 1000:.3g} mm wrong"
            if good
            else "no clouds",
            cause=cause,
            read=_READ,
        )


def _find_scan(scans: dict[int, _Scan], received: Received) -> _Scan | None:
    """Return the scan of a cloud: the one with its stamp, or the last one before its arrival."""
    stamp = stamp_ns(received.message)
    if stamp in scans:
        return scans[stamp]
    before = [moment for moment in scans if moment <= received.time]
    return scans[max(before)] if before else None


def _points(received: Received) -> NDArray[np.float64]:
    try:
        fields = [np.ravel(field_of(received.message, name)) for name in "xyz"]
        return np.column_stack(fields).astype(np.float64)
    except (CoframeError, ValueError, TypeError):
        return np.empty((0, 3))


def _distance(scan: _Scan, points: NDArray[np.float64]) -> float:
    """Return the maximum distance of a point from its correct position, in meters; infinity if points are missing."""
    finite = points[np.isfinite(points).all(axis=1)]
    if len(points) == len(scan.points):
        return float(np.linalg.norm(points - scan.points, axis=1).max()) if len(finite) == len(points) else math.inf
    if not len(finite) or not len(scan.points):
        return math.inf
    # With a different number of points, each correct point needs a point near it.
    gaps = np.linalg.norm(scan.points[:, None, :] - finite[None, :, :], axis=2)
    return float(gaps.min(axis=1).max())
