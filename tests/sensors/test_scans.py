# SPDX-License-Identifier: Apache-2.0
"""project_scan compared with values computed by hand and with single lookups."""

import math
from array import array

import numpy as np
import pytest
from sensor_data import PERIOD, SECOND, array_of

import coframe
from coframe.messages import find
from coframe.sensors import project_scan

NAN, INF = float("nan"), float("inf")


def scan_of(ranges, *, intensities=(), stamp=0, time_increment=0.0, frame="lidar"):
    scan = find("sensor_msgs/msg/LaserScan")(
        angle_min=-0.5,
        angle_increment=0.25,
        time_increment=time_increment,
        range_min=0.1,
        range_max=10.0,
        ranges=ranges,
        intensities=intensities,
    )
    scan.header.frame_id = frame
    scan.header.stamp.sec, scan.header.stamp.nanosec = divmod(stamp, SECOND)
    return scan


def test_beams_with_a_valid_range_become_points():
    ranges = [2.0, INF, NAN, 0.05, 10.0, 11.0, -INF, 0.0, 5.0, 0.1]
    found = project_scan(scan_of(ranges, intensities=range(10), stamp=7, time_increment=0.001))
    assert found.beams.tolist() == [0, 8, 9], "the nearest range counts, the farthest does not"
    by_hand = [[r * math.cos(a), r * math.sin(a), 0.0] for r, a in ((2, -0.5), (5, 1.5), (0.1, 1.75))]
    assert np.allclose(found.points, by_hand)
    assert found.intensities.tolist() == [0.0, 8.0, 9.0]
    assert found.times.tolist() == [7, 8_000_007, 9_000_007]
    assert (found.frame, found.stamp) == ("lidar", 7)


def test_intensities_of_another_length_are_ignored():
    assert project_scan(scan_of([1.0, 2.0])).intensities is None
    assert project_scan(scan_of([1.0, 2.0], intensities=[1.0])).intensities is None
    empty = project_scan(scan_of([]))
    assert empty.points.shape == (0, 3)
    assert empty.to_cloud().width == 0


def test_the_cloud_of_a_scan():
    cloud = project_scan(scan_of([1.0, INF, 2.0], intensities=[5.0, 6.0, 7.0], stamp=3 * SECOND + 4)).to_cloud()
    assert type(cloud) is find("sensor_msgs/msg/PointCloud2")
    assert (cloud.header.frame_id, cloud.header.stamp.sec, cloud.header.stamp.nanosec) == ("lidar", 3, 4)
    assert (cloud.height, cloud.width, cloud.is_dense, cloud.row_step) == (1, 2, True, 40)
    points = array_of(cloud)[0]
    assert points.dtype.names == ("x", "y", "z", "intensity", "index")
    assert points["index"].tolist() == [0, 2]
    assert points["intensity"].tolist() == [5.0, 7.0]
    assert np.allclose(points["x"], [math.cos(-0.5), 2.0])


@pytest.mark.parametrize("time_increment", [0.0, 1e-4])
def test_each_beam_is_transformed_at_its_own_time(time_increment, buffer, motion, random):
    stamp = motion.first + PERIOD // 3
    scan = scan_of(array("f", random.uniform(1.0, 9.0, 720)), stamp=stamp, time_increment=time_increment)
    alone = project_scan(scan)
    found = project_scan(scan, buffer, "odom")
    assert (found.frame, found.stamp) == ("odom", stamp)
    for beam in range(0, 720, 50):
        when = stamp + round(beam * time_increment * 1e9)
        assert found.times[beam] == when
        expected = buffer.lookup("odom", "lidar", when) @ alone.points[beam]
        assert np.abs(found.points[beam] - expected).max() < 1e-12


def test_a_target_that_moves(buffer, motion, random):
    """In the frame of the sensor, as if all beams had been measured at once."""
    stamp, increment = motion.first + PERIOD, 1e-4
    scan = scan_of(random.uniform(1.0, 9.0, 360).tolist(), stamp=stamp, time_increment=increment)
    for at in (None, stamp + 3 * PERIOD):
        found = project_scan(scan, buffer, "lidar", fixed="odom", at=at)
        assert (found.frame, found.stamp) == ("lidar", at or stamp)
        last = int(found.times[-1])
        steps = buffer.lookup("lidar", "odom", found.stamp) @ buffer.lookup("odom", "lidar", last)
        assert np.abs(found.points[-1] - steps @ project_scan(scan).points[-1]).max() < 1e-12


def test_beams_without_a_transform(buffer, motion):
    scan = scan_of([1.0] * 10, stamp=motion.last - 4_500_000, time_increment=1e-3)
    with pytest.raises(coframe.ExtrapolationException, match=r"^point 5 of 10, "):
        project_scan(scan, buffer, "odom")
    found = project_scan(scan, buffer, "odom", on_error="nan")
    assert np.isnan(found.points).all(axis=1).tolist() == [False] * 5 + [True] * 5
    assert not found.to_cloud().is_dense


def test_a_buffer_needs_a_target(buffer):
    with pytest.raises(TypeError, match="both a buffer and a target"):
        project_scan(scan_of([1.0]), buffer)
    with pytest.raises(TypeError, match="both a buffer and a target"):
        project_scan(scan_of([1.0]), target="odom")


def test_scans_from_rosbags_are_accepted():
    stores = pytest.importorskip("rosbags.typesys")
    types = stores.get_typestore(stores.Stores.ROS2_HUMBLE).types
    ours = scan_of([1.0, 2.0], intensities=[3.0, 4.0])
    header = types["std_msgs/msg/Header"](
        stamp=types["builtin_interfaces/msg/Time"](sec=0, nanosec=0), frame_id="lidar"
    )
    values = {name: getattr(ours, name) for name in ours.get_fields_and_field_types()}
    arrays = {name: np.array(values[name], np.float32) for name in ("ranges", "intensities")}
    theirs = types["sensor_msgs/msg/LaserScan"](**{**values, **arrays, "header": header})
    assert project_scan(theirs).to_cloud() == project_scan(ours).to_cloud()


def test_scans_of_a_ros_installation_become_its_clouds(monkeypatch):
    """Messages of a ROS installation are recognized by their module."""
    import sensor_msgs.msg

    class Cloud(sensor_msgs.msg.PointCloud2):
        """Replaces PointCloud2 of a ROS installation."""

    class LaserScan(sensor_msgs.msg.LaserScan):
        """A LaserScan of a ROS installation."""

    LaserScan.__module__ = "sensor_msgs.msg._laser_scan"
    monkeypatch.setattr(sensor_msgs.msg, "PointCloud2", Cloud)
    scan = LaserScan(range_max=2.0, ranges=[1.0])
    assert type(project_scan(scan).to_cloud()) is Cloud
