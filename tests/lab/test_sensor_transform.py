# SPDX-License-Identifier: Apache-2.0
"""sensor_transform and simulated_lidar."""

import math
from array import array
from collections import defaultdict

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

import tf2_ros
from coframe.lab.sensor_transform import SensorTransformNode
from coframe.lab.simulated_lidar import HALL_HALF_WIDTH, HALL_START, PILLAR_OFFSET, PILLAR_RADIUS, measure
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import LaserScan, PointCloud2
from sensor_msgs_py import point_cloud2


def nanoseconds(stamp):
    return stamp.sec * 10**9 + stamp.nanosec


class Reference:
    """An independent reference: the transforms of a recording, interpolated by SciPy."""

    def __init__(self, dynamic, static):
        self.samples = defaultdict(dict)
        self.parents = {}
        self.static = set()
        for is_static, messages in ((False, dynamic), (True, static)):
            for message in messages:
                for t in message.transforms:
                    self.parents[t.child_frame_id] = t.header.frame_id
                    v, q = t.transform.translation, t.transform.rotation
                    pose = ([v.x, v.y, v.z], [q.x, q.y, q.z, q.w])
                    self.samples[t.child_frame_id][nanoseconds(t.header.stamp)] = pose
                    if is_static:
                        self.static.add(t.child_frame_id)

    def pose(self, child, stamp):
        samples = self.samples[child]
        times = sorted(samples)
        if child in self.static:
            position, quaternion = samples[times[-1]]
            return np.array(position), Rotation.from_quat(quaternion)
        after = next(index for index, time in enumerate(times) if time >= stamp)
        assert after > 0, "the scan is older than the first received transform"
        before, later = times[after - 1], times[after]
        fraction = (stamp - before) / (later - before)
        (p0, q0), (p1, q1) = samples[before], samples[later]
        position = (1 - fraction) * np.array(p0) + fraction * np.array(p1)
        return position, Slerp([0, 1], Rotation.from_quat([q0, q1]))(fraction)

    def covers(self, stamp):
        return all(
            min(samples) < stamp <= max(samples) for child, samples in self.samples.items() if child not in self.static
        )

    def to_root(self, frame, stamp):
        position, rotation = np.zeros(3), Rotation.identity()
        while frame in self.parents:
            p, r = self.pose(frame, stamp)
            position, rotation = r.apply(position) + p, r * rotation
            frame = self.parents[frame]
        return position, rotation

    def transform(self, points, source, target, stamp):
        p_source, r_source = self.to_root(source, stamp)
        p_target, r_target = self.to_root(target, stamp)
        return r_target.inv().apply(r_source.apply(points) + p_source - p_target)


def expected_points(scan, reference, target):
    points, intensities = [], []
    for index, distance in enumerate(scan.ranges):
        if math.isfinite(distance) and scan.range_min <= distance <= scan.range_max:
            angle = scan.angle_min + index * scan.angle_increment
            points.append([distance * math.cos(angle), distance * math.sin(angle), 0.0])
            intensities.append(scan.intensities[index])
    stamp = nanoseconds(scan.header.stamp)
    return reference.transform(np.array(points), scan.header.frame_id, target, stamp), np.array(intensities)


@pytest.mark.parametrize(
    ("frame", "target"),
    [
        pytest.param("lidar_link", "base_link", marks=pytest.mark.slow),
        pytest.param("lidar_link", "odom", marks=pytest.mark.slow),
        ("gripper_link", "base_link"),
    ],
)
def test_scans_are_transformed_correctly_while_the_robot_moves(start, run, frame, target):
    observer = start()
    scans = observer.hear(LaserScan, "/scan")
    clouds = observer.hear(PointCloud2, "/scan_base_frame")
    dynamic, static = observer.hear_tf()
    run("complete_tf_tree")
    run("sensor_transform", f"target_frame:={target}")
    run("simulated_lidar", f"frame:={frame}")
    # Every compared scan needs transforms before and after it.
    observer.until(lambda: len(clouds) >= 25)
    first, last = (nanoseconds(clouds[index].header.stamp) for index in (0, 24))
    observer.until(lambda: dynamic and nanoseconds(dynamic[-1].transforms[0].header.stamp) > last)

    reference = Reference(dynamic, static)
    by_stamp = {nanoseconds(cloud.header.stamp): cloud for cloud in clouds}
    between = [scan for scan in scans if first <= nanoseconds(scan.header.stamp) <= last]
    assert len(between) == 25
    assert {nanoseconds(scan.header.stamp) for scan in between} <= set(by_stamp)
    assert reference.covers(nanoseconds(between[5].header.stamp))
    for scan in between:
        if not reference.covers(nanoseconds(scan.header.stamp)):
            continue  # the first scans can be older than the first received transform
        cloud = by_stamp[nanoseconds(scan.header.stamp)]
        assert cloud.header.frame_id == target
        points, intensities = expected_points(scan, reference, target)
        assert 100 < len(points) < len(scan.ranges)
        assert cloud.width == len(points)
        got = point_cloud2.read_points(cloud)
        assert got.dtype.names == ("x", "y", "z", "intensity")
        for column, axis in enumerate("xyz"):
            assert np.abs(got[axis] - points[:, column]).max() < 1e-6
        assert np.array_equal(got["intensity"], intensities.astype(np.float32))


def make_scan(sec, frame="laser", ranges=(1.0, math.inf, math.nan, 2.0, 0.0, 99.0), intensities=()):
    scan = LaserScan(range_min=0.5, range_max=10.0, angle_min=0.0, angle_increment=math.pi / 2)
    scan.header.frame_id = frame
    scan.header.stamp.sec, scan.header.stamp.nanosec = divmod(round(sec * 1e9), 10**9)
    scan.ranges, scan.intensities = array("f", ranges), array("f", intensities)
    return scan


def make_transform(sec, x):
    transform = TransformStamped()
    transform.header.frame_id, transform.child_frame_id = "base_link", "laser"
    transform.header.stamp.sec, transform.header.stamp.nanosec = divmod(round(sec * 1e9), 10**9)
    transform.transform.translation.x = float(x)
    transform.transform.rotation.w = 1.0
    return transform


@pytest.fixture
def lab(start):
    """Return the node, its clouds and its observer. The tests insert the transforms."""

    def make(*parameters):
        observer = start(*parameters)
        node = observer.add(SensorTransformNode())
        clouds = observer.hear(PointCloud2, "/scan_base_frame")
        observer.until(node.points_pub.get_subscription_count)
        return node, clouds, observer

    return make


def test_a_scan_waits_for_its_transform(lab):
    node, clouds, observer = lab("wait:=30.0")
    node.tf_buffer.set_transform(make_transform(10.0, 0.0), "test")
    node.scan_callback(make_scan(10.5))
    observer.spin_for(0.05)
    assert clouds == []
    node.tf_buffer.set_transform(make_transform(11.0, 1.0), "test")
    observer.until(lambda: clouds)
    assert nanoseconds(clouds[0].header.stamp) == 10_500_000_000
    assert clouds[0].header.frame_id == "base_link"
    points = point_cloud2.read_points_numpy(clouds[0])
    assert points == pytest.approx(np.array([[1.5, 0.0, 0.0], [0.5, -2.0, 0.0]]), abs=1e-6)
    assert node.retry_timer.is_canceled()


def test_a_scan_that_cannot_be_transformed_does_not_delay_others(lab, monkeypatch):
    node, clouds, observer = lab("wait:=0.2")
    reasons = []
    monkeypatch.setattr(node, "drop", reasons.append)
    node.tf_buffer.set_transform(make_transform(10.0, 0.0), "test")
    node.scan_callback(make_scan(10.0, frame="nowhere"))
    node.scan_callback(make_scan(10.0))
    observer.until(lambda: clouds)
    assert reasons == []
    observer.until(lambda: reasons)
    assert reasons == ['"nowhere" passed to lookupTransform argument source_frame does not exist. ']
    assert len(clouds) == 1
    assert not node.waiting


def test_scans_that_arrive_out_of_order_keep_their_own_stamps(lab):
    node, clouds, observer = lab("wait:=30.0")
    node.tf_buffer.set_transform(make_transform(10.0, 0.0), "test")
    for sec in (10.3, 10.1, 10.2):
        node.scan_callback(make_scan(sec))
    node.tf_buffer.set_transform(make_transform(10.2, 2.0), "test")
    observer.until(lambda: len(clouds) == 2)
    node.tf_buffer.set_transform(make_transform(10.4, 4.0), "test")
    observer.until(lambda: len(clouds) == 3)
    got = {nanoseconds(cloud.header.stamp): point_cloud2.read_points_numpy(cloud)[0, 0] for cloud in clouds}
    assert got == pytest.approx({10_100_000_000: 2.0, 10_200_000_000: 3.0, 10_300_000_000: 4.0}, abs=1e-6)


def test_the_queue_is_limited_and_dropped_scans_are_logged_once(lab, capfd):
    node, _, _ = lab("wait:=30.0", "queue_size:=3")
    for number in range(10):
        node.scan_callback(make_scan(10.0 + number))
    assert [waiting.scan.header.stamp.sec for waiting in node.waiting] == [17, 18, 19]
    warnings = [line for line in capfd.readouterr().err.splitlines() if "Scan transform failed" in line]
    assert len(warnings) == 1
    assert "more than 3 scans are waiting for their transforms" in warnings[0]
    assert "dropped 1 of 4 scans" in warnings[0]


def test_a_scan_without_echoes_gives_an_empty_cloud(lab):
    node, clouds, observer = lab()
    node.tf_buffer.set_transform_static(make_transform(0.0, 0.0), "test")
    node.scan_callback(make_scan(10.0, ranges=(math.inf, math.nan), intensities=(1.0, 2.0)))
    observer.until(lambda: clouds)
    assert clouds[0].width == 0
    assert [field.name for field in clouds[0].fields] == ["x", "y", "z", "intensity"]


def test_ranges_at_the_limits_are_valid_and_intensities_need_one_value_per_range(lab):
    node, clouds, observer = lab()
    node.tf_buffer.set_transform_static(make_transform(0.0, 0.0), "test")
    node.scan_callback(make_scan(10.0, ranges=(0.5, 10.0, -1.0), intensities=(1.0,)))
    observer.until(lambda: clouds)
    assert clouds[0].width == 2
    assert [field.name for field in clouds[0].fields] == ["x", "y", "z"]


@pytest.mark.parametrize(("x", "y", "yaw"), [(0.0, 0.0, 0.0), (3.3, 0.4, 0.2), (57.1, -0.8, -3.0)])
def test_measured_points_are_on_walls_and_pillars(x, y, yaw):
    headings = yaw + np.linspace(-np.pi, np.pi, 720, endpoint=False)
    ranges, intensities = measure(x, y, headings, 10.0)
    again = measure(x, y, headings, 10.0)
    assert np.array_equal(ranges, again[0])
    assert np.array_equal(intensities, again[1])
    assert np.any(np.isinf(ranges))
    assert np.any(ranges == 11.0)
    assert np.any(ranges == 0.0)
    hit = (ranges > 0.1) & (ranges <= 10.0)
    assert np.count_nonzero(hit) > 360
    px, py = x + ranges[hit] * np.cos(headings[hit]), y + ranges[hit] * np.sin(headings[hit])
    number = np.round(px / 4.0)
    pillar_y = np.where(number % 2 == 0, PILLAR_OFFSET, -PILLAR_OFFSET)
    on_pillar = np.isclose(np.hypot(px - 4.0 * number, py - pillar_y), PILLAR_RADIUS)
    on_wall = np.isclose(np.abs(py), HALL_HALF_WIDTH) | np.isclose(px, HALL_START)
    assert np.all(on_pillar | on_wall)
    assert np.any(on_pillar)
    assert np.array_equal(intensities[hit] == 200.0, on_pillar)


def test_the_lidar_measures_from_the_pose_of_the_robot(start, run):
    observer = start()
    scans = observer.hear(LaserScan, "/scan")
    run("simulated_lidar")
    observer.until(lambda: len(scans) >= 2)
    # The pose of the robot is not available, so every scan is measured from the origin.
    assert scans[0].ranges == scans[1].ranges
    assert (scans[0].header.frame_id, len(scans[0].ranges), len(scans[0].intensities)) == ("lidar_link", 360, 360)
    moved = TransformStamped()
    moved.header.frame_id, moved.child_frame_id = "odom", "lidar_link"
    moved.transform.translation.x = 1.0
    moved.transform.rotation.z, moved.transform.rotation.w = 1.0, 0.0
    tf2_ros.StaticTransformBroadcaster(observer.node).sendTransform(moved)
    observer.until(lambda: scans[-1].ranges != scans[0].ranges)
    expected, _ = measure(1.0, 0.0, np.linspace(-np.pi, np.pi, 360, endpoint=False) + np.pi, 10.0)
    got = np.array(scans[-1].ranges)
    assert np.mean(np.isclose(got, expected, atol=1e-5)) > 0.98  # a beam may just miss an edge
    intervals = np.diff([nanoseconds(scan.header.stamp) for scan in scans])
    assert np.median(intervals) == pytest.approx(0.1e9, rel=0.1)
