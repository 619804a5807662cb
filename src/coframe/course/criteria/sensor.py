# SPDX-License-Identifier: Apache-2.0
"""Sensor transform, 20 points: every valid beam of every scan, in base_link, while the arm moves."""

from __future__ import annotations

import math
import time
from array import array
from typing import TYPE_CHECKING

import numpy as np

from coframe.course._motion import SimulatedRobot
from coframe.course._sheet import Sheet
from coframe.course._world import STEP, stamp_of
from coframe.course.criteria.causes import log_cause, name_mistake
from coframe.course.criteria.common import Task, run_program, stamp_ns
from coframe.course.criteria.scan_mistakes import SentScan, cloud_mistake, filter_mistake
from coframe.course.rubric import RUBRIC
from coframe.errors import CoframeError
from coframe.sensors.layout import field_of
from coframe.transform.transform import Transform
from sensor_msgs.msg import LaserScan, PointCloud2

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from coframe.course._program import StudentProgram
    from coframe.course._world import Received, World

__all__ = ["check"]

_TOPIC, _TYPE = "/scan_base_frame", "sensor_msgs/msg/PointCloud2"
_NODE = "sensor_transform"
_BEAMS = 120
_RANGE_MIN, _RANGE_MAX = 0.1, 10.0
_SCAN_PERIOD = 10 * STEP
_SCANS = 15  # in each of the two frames
_TOLERANCE = 1e-3  # meters
_SCAN_AGE = STEP // 2  # age of a scan and its transform when they are published; no value of the clock is such a stamp
# Seconds of real time from a scan to the transform of its stamp. On a robot, this is usually 10 to 50 ms.
_TRANSFORM_DELAY = 0.03
# Seconds of real time from a scan to the end of the step in which its transform is sent. If the machine is too busy for
# that, a lookup with a usual timeout fails, which is not a mistake of the program.
_MAX_FAIR_TIME = 0.1
_MIN_FAIR_SCANS, _MAX_MORE_SCANS = 10, 30  # on the gripper
_GRIPPER = "gripper_link"
_GRIPPER_MOUNT = Transform.from_rpy(
    (0.1, 0.02, 0.03), roll=0.4, pitch=0.25, yaw=-0.6, source=_GRIPPER, target="end_effector"
)
# In the check, the lidar is also turned on the base: without it, points @ R would be as right as points @ R.T.
_LIDAR_TURN = Transform.from_rpy(roll=0.1, pitch=-0.15, yaw=0.5)
_NO_WAIT_CAUSE = "the lookup does not wait: the transform of a scan arrives after it. Use a timeout or a MessageFilter"
_ONE_THREAD_CAUSE = (
    "the lookup waits in the only thread of the node, which cannot receive the transform: "
    "use rclpy.spin(node, executor=MultiThreadedExecutor()) or a MessageFilter"
)
_READ = "handbook chapter 6, sensors in the base frame"


class _Robot(SimulatedRobot):
    """The robot of the assignment with a turned lidar, and one on the gripper."""

    def mounts(self) -> list[Transform]:
        """Return the static transforms of the sensors."""
        return [*(self._turned(mount) for mount in super().mounts()), _GRIPPER_MOUNT]

    def _turned(self, mount: Transform) -> Transform:
        if mount.source != self.assignment.lidar.frame:
            return mount
        return Transform(mount.translation, _LIDAR_TURN.quaternion, target=mount.target, source=mount.source)

    def lidars(self, stamp: int) -> dict[str, Transform]:
        """Return the pose of each lidar relative to base_link at a stamp in nanoseconds."""
        mounts = {mount.source: mount for mount in self.mounts()}
        frame = self.assignment.lidar.frame
        return {frame: mounts[frame], _GRIPPER: self.end_effector(stamp) @ _GRIPPER_MOUNT}


class _Scans:
    """The published scans.

    Attributes:
        sent: The scans by their stamp.
        responses: Whether the program responded before the transform of each scan on the gripper was published. It does
            not if it waits for the transform in a callback.
    """

    def __init__(self) -> None:
        self.sent: dict[int, SentScan] = {}
        self.responses: list[bool] = []
        self._slow: set[int] = set()
        self._open: tuple[int, float] | None = None

    def add(self, stamp: int, scan: SentScan) -> None:
        """Add the scan that is published now."""
        self.sent[stamp] = scan
        self._open = stamp, time.monotonic()

    def end_step(self) -> None:
        """Note whether the last scan and its transform were sent in time. Call it after the step of the scan."""
        if self._open is not None:
            stamp, begun = self._open
            if time.monotonic() - begun > _MAX_FAIR_TIME:
                self._slow.add(stamp)
            self._open = None

    def fair(self) -> int:
        """Return the number of scans on the gripper whose transform was sent in time."""
        return sum(
            stamp not in self._slow for stamp, scan in self.sent.items() if scan.message.header.frame_id == _GRIPPER
        )

    def judged(self, clouds: list[Received]) -> int:
        """Return the number of scans that should be clouds: those that were sent in time, or became one."""
        answered = {stamp_ns(scan.message) for each in clouds if (scan := self.find(each)) is not None}
        slow = self._slow if self.fair() >= _MIN_FAIR_SCANS else set()
        return len(self.sent.keys() - (slow - answered))

    def find(self, message: Received) -> SentScan | None:
        """Return the scan of a cloud: the one with its stamp, or the last one before its arrival."""
        stamp = stamp_ns(message.message)
        if stamp in self.sent:
            return self.sent[stamp]
        before = [moment for moment in self.sent if moment <= message.time]
        return self.sent[max(before)] if before else None


def check(task: Task) -> Sheet:
    """Check ``sensor_transform.py``."""
    sheet = Sheet.of(RUBRIC["sensor"])
    world = task.world
    robot = _Robot(task.assignment)
    scans = _Scans()

    def publish_arm(now: int) -> None:
        world.publish_transforms(robot.arm_at(now - _SCAN_AGE), now - _SCAN_AGE)

    def publish(now: int) -> None:
        # The clock is ahead of the scan, and the scan of its transform: neither now() nor the latest transform fits.
        scans.end_step()
        if now % _SCAN_PERIOD == 0:
            frame = task.assignment.lidar.frame if len(scans.sent) < _SCANS else _GRIPPER
            scan = _scan(robot, now - _SCAN_AGE, frame)
            scans.add(now - _SCAN_AGE, scan)
            world.publish("/scan", scan.message)
            responded = world.responds(_TRANSFORM_DELAY, _TRANSFORM_DELAY)
            if frame == _GRIPPER:  # The mount of a lidar on the base does not arrive later.
                scans.responses.append(responded)
        publish_arm(now)

    def silence_cause(output: str) -> str:
        if not world.has_subscription("/scan"):
            topics = world.subscribed_topics("sensor_msgs/msg/LaserScan")
            return (
                f"the subscription is to {topics[0]}, not to /scan" if topics else "there is no subscription to /scan"
            )
        if not world.has_subscription("/tf"):
            return "there is no TransformListener, which receives the transforms for the buffer"
        return log_cause(output)

    with run_program(task, sheet, silence_cause=silence_cause) as program:
        topic, clouds, names = _TOPIC, [], []
        if program is not None:
            world.start(program)
            topic = world.output_topic(_TOPIC, _TYPE)
            clouds = world.watch(topic, PointCloud2)
            world.publish_transforms(robot.mounts(), world.now, static=True)
            world.run(0.5, publish_arm)
            _publish_scans(world, program, scans, publish)
            world.run(0.5, publish_arm)
            names = sorted({info.node_name for info in world.publishers_of(topic)})
        _check_messages(sheet, scans, clouds, topic, names)
        _check_points(sheet, scans, clouds)
    return sheet


def _publish_scans(world: World, program: StudentProgram, scans: _Scans, publish: Callable[[int], None]) -> None:
    """Publish the scans, and more of them on the gripper if the machine was too busy for many."""
    world.run(2 * _SCANS * _SCAN_PERIOD / 1e9, publish)
    for _ in range(_MAX_MORE_SCANS):
        if scans.fair() >= _MIN_FAIR_SCANS or not program.is_running():
            return
        world.run(_SCAN_PERIOD / 1e9, publish)


def _scan(robot: _Robot, stamp: int, frame: str) -> SentScan:
    """Return a scan with all kinds of invalid beams."""
    angles = -math.pi + 2 * math.pi / _BEAMS * np.arange(_BEAMS)
    ranges = (3.0 + np.cos(3 * angles + stamp / 1e9)).astype(np.float32)
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
    message.header.stamp = stamp_of(stamp)
    lidars = robot.lidars(stamp)
    return SentScan(message, lidars[frame], robot.lidars(stamp - STEP)[frame], lidars)


def _check_messages(sheet: Sheet, scans: _Scans, clouds: list[Received], topic: str, names: list[str]) -> None:
    right = topic == _TOPIC, names == [_NODE]
    causes = [] if right[0] else [name_mistake(topic, _TOPIC) or f"the topic is {topic} instead of {_TOPIC}"]
    if names and not right[1]:
        causes.append(f"the node is named {', '.join(names)} instead of {_NODE}")
    sheet.check(
        3,
        f"the node {_NODE} publishes clouds on {_TOPIC}",
        1.0 if clouds and all(right) else 0.5 if clouds and any(right) else 0.0,
        expected=f"PointCloud2 messages on {_TOPIC} from the node {_NODE}",
        observed=f"{len(clouds)} messages on {topic} from {', '.join(names) or 'no node'}",
        cause="; ".join(causes),
        read=_READ,
    )
    frames = sorted({each.message.header.frame_id for each in clouds})
    sheet.check(
        2,
        "the clouds are in base_link",
        frames == ["base_link"],
        expected="header.frame_id is base_link",
        observed=f"header.frame_id is {', '.join(map(repr, frames))}" if frames else "no clouds",
        cause=_frame_cause(frames, scans),
        read=_READ,
    )
    stamps = [stamp_ns(each.message) for each in clouds]
    kept = sum(stamp in scans.sent for stamp in stamps)
    later = [each.time >= stamp for each, stamp in zip(clouds, stamps, strict=True) if stamp not in scans.sent]
    sheet.check(
        3,
        "the clouds keep the stamps of their scans",
        kept / len(stamps) if stamps else 0.0,
        expected="header.stamp is the stamp of the scan",
        observed=f"{len(stamps) - kept} of {len(stamps)} clouds have a different stamp" if stamps else "no clouds",
        cause=""
        if not later
        else "header.stamp is not set: use scan.header.stamp"
        if not any(stamps)
        else "the stamp is now(): the points were measured earlier. Use scan.header.stamp",
        read=_READ,
    )
    judged = scans.judged(clouds)
    answered = min(len(clouds), judged)
    sheet.check(
        2,
        "at least 95 % of the scans become clouds",
        bool(scans.sent) and answered >= 0.95 * judged,
        expected="a cloud for each scan; 5 % may be missing",
        observed=f"{answered} of {judged} scans",
        cause=_lost_cause(scans, clouds),
        read="handbook chapter 5, time, interpolation, waiting",
    )


def _frame_cause(frames: list[str], scans: _Scans) -> str:
    if not frames or frames == ["base_link"]:
        return ""
    if set(frames) <= {scan.message.header.frame_id for scan in scans.sent.values()}:
        return "the header of the scan is copied: frame_id must be the target of the lookup"
    if frames == [""]:
        return "header.frame_id is not set"
    return name_mistake(frames[0], "base_link")


def _lost_cause(scans: _Scans, clouds: list[Received]) -> str:
    """Return why the scans on the gripper are lost, whose transforms arrive later than those on the base."""
    found = [scan for each in clouds if (scan := scans.find(each))]
    if not found or any(scan.message.header.frame_id == _GRIPPER for scan in found):
        return ""
    return _NO_WAIT_CAUSE if sum(scans.responses) > len(scans.responses) / 2 else _ONE_THREAD_CAUSE


def _check_points(sheet: Sheet, scans: _Scans, clouds: list[Received]) -> None:
    compared = [(scan, _points(each)) for each in clouds if (scan := scans.find(each)) is not None]
    counts = [len(points) == len(scan.points) for scan, points in compared]
    wrong = next(((s, p) for s, p in compared if len(p) != len(s.points)), None)
    sheet.check(
        3,
        "beams without an echo are dropped",
        sum(counts) / len(counts) if counts else 0.0,
        expected="one point for each range that is finite and from range_min to range_max",
        observed=f"{len(wrong[1])} points instead of {len(wrong[0].points)}" if wrong else "no clouds",
        cause=filter_mistake(wrong[0].message, len(wrong[1])) if wrong else "",
        read=_READ,
    )
    for points, name, frames_on_arm in (
        (4, "each beam is correct to 1 mm", False),
        (3, "each beam is correct to 1 mm on the moving gripper", True),
    ):
        pairs = [each for each in compared if (each[0].message.header.frame_id == _GRIPPER) is frames_on_arm]
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
            cause=cloud_mistake([pair for pair, is_good in zip(pairs, good, strict=True) if not is_good])
            if good
            else _lost_cause(scans, clouds),
            read=_READ,
        )


def _points(message: Received) -> NDArray[np.float64]:
    try:
        fields = [np.ravel(field_of(message.message, name)) for name in "xyz"]
        return np.column_stack(fields).astype(np.float64)
    except (CoframeError, ValueError, TypeError):
        return np.empty((0, 3))


def _distance(scan: SentScan, points: NDArray[np.float64]) -> float:
    """Return the maximum distance of a point from its correct position, in meters; infinity if points are missing."""
    finite = points[np.isfinite(points).all(axis=1)]
    expected = scan.points
    if len(points) == len(expected):
        return float(np.linalg.norm(points - expected, axis=1).max()) if len(finite) == len(points) else math.inf
    if not len(finite) or not len(expected):
        return math.inf
    # With a different number of points, each correct point needs a point near it.
    gaps = np.linalg.norm(expected[:, None, :] - finite[None, :, :], axis=2)
    return float(gaps.min(axis=1).max())
