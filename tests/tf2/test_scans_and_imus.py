# SPDX-License-Identifier: Apache-2.0
"""Laser scans and IMU data in tf2_sensor_msgs, compared with SciPy."""

import copy
import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import tf2_ros
from geometry_msgs.msg import Quaternion, Transform, Vector3
from sensor_msgs.msg import Imu, LaserScan, PointCloud2, PointField
from sensor_msgs_py import point_cloud2
from std_msgs.msg import Header
from tf2_sensor_msgs import do_transform_cloud, do_transform_imu, do_transform_laser_scan

RANDOM = np.random.default_rng(4)
ROTATION = Rotation.random(random_state=5)
TRANSLATION = (1.0, -2.0, 3.0)
NAN, INF = float("nan"), float("inf")


@pytest.fixture
def transform(stamped):
    return stamped("base_link", "sensor", 3.0, TRANSLATION, tuple(ROTATION.as_quat()))


@pytest.fixture
def buffer(transform):
    buffer = tf2_ros.Buffer()
    buffer.set_transform_static(transform, "me")
    return buffer


def header():
    header = Header(frame_id="sensor")
    header.stamp.sec = 9
    return header


def test_normals_are_rotated_with_their_points(transform):
    names = ("x", "y", "z", "normal_x", "normal_y", "normal_z", "curvature")
    fields = [
        PointField(name=name, offset=4 * number, datatype=PointField.FLOAT32, count=1)
        for number, name in enumerate(names)
    ]
    points = RANDOM.normal(size=(20, 7)).astype(np.float32)
    moved = do_transform_cloud(point_cloud2.create_cloud(header(), fields, points), transform)
    result = point_cloud2.read_points_numpy(moved)
    assert np.allclose(result[:, :3], ROTATION.apply(points[:, :3]) + TRANSLATION, atol=1e-6)
    assert np.allclose(result[:, 3:6], ROTATION.apply(points[:, 3:6]), atol=1e-6)
    assert np.array_equal(result[:, 6], points[:, 6])


def scan_of(ranges, intensities=()):
    return LaserScan(
        header=header(),
        angle_min=-0.5,
        angle_increment=0.25,
        range_min=0.1,
        range_max=10.0,
        ranges=ranges,
        intensities=intensities,
    )


def test_scan_is_converted_to_points(buffer):
    ranges = [2.0, INF, NAN, 0.05, 10.0, 11.0, -INF, 0.0, 5.0]
    scan = scan_of(ranges, [float(number) for number in range(9)])
    before = copy.deepcopy(scan)
    cloud = buffer.transform(scan, "base_link")
    assert type(cloud) is PointCloud2
    assert (cloud.header.frame_id, cloud.header.stamp.sec, cloud.is_dense) == ("base_link", 9, True)
    points = point_cloud2.read_points(cloud)
    assert points.dtype.names == ("x", "y", "z", "intensity", "index")
    assert points["index"].tolist() == [0, 8]
    assert points["intensity"].tolist() == [0.0, 8.0]
    in_plane = [[r * math.cos(angle), r * math.sin(angle), 0.0] for r, angle in ((2.0, -0.5), (5.0, 1.5))]
    expected = ROTATION.apply(in_plane) + TRANSLATION
    assert np.allclose(np.stack([points["x"], points["y"], points["z"]], axis=1), expected, atol=1e-6)
    assert repr(scan) == repr(before)  # NaN is not equal to itself


def test_range_min_is_inclusive_and_range_max_exclusive():
    points = point_cloud2.read_points(do_transform_laser_scan(scan_of([0.5, 10.0, 0.1, 0.1]), Transform()))
    assert points["index"].tolist() == [0, 2, 3]


def test_scan_without_intensities_or_valid_ranges():
    empty = do_transform_laser_scan(scan_of([INF] * 4), Transform())
    assert (empty.width, empty.header.frame_id) == (0, "sensor")
    assert [field.name for field in empty.fields] == ["x", "y", "z", "index"]
    assert do_transform_laser_scan(scan_of([]), Transform()).width == 0


def quaternion(rotation):
    x, y, z, w = rotation.as_quat().tolist()
    return Quaternion(x=x, y=y, z=z, w=w)


def covariance(seed):
    factor = np.random.default_rng(seed).normal(size=(3, 3))
    return factor @ factor.T


def xyz(vector):
    return np.array([vector.x, vector.y, vector.z])


@pytest.fixture
def imu():
    """Return the data of an IMU at a fixed position that rotates about the vertical and measures gravity."""
    in_world = Rotation.random(random_state=8)
    imu = Imu(header=header(), orientation=quaternion(in_world))
    for name, vector in (("linear_acceleration", [0.0, 0.0, 9.81]), ("angular_velocity", [0.0, 0.0, 0.5])):
        x, y, z = in_world.inv().apply(vector).tolist()
        setattr(imu, name, Vector3(x=x, y=y, z=z))
    for seed, name in enumerate(("orientation", "angular_velocity", "linear_acceleration")):
        setattr(imu, f"{name}_covariance", covariance(seed).reshape(9))
    return imu


def test_imu_data_relative_to_the_world_do_not_change(imu, buffer):
    before = copy.deepcopy(imu)
    moved = buffer.transform(imu, "base_link")
    assert (moved.header.frame_id, moved.header.stamp.sec) == ("base_link", 9)
    q = moved.orientation
    base_in_world = Rotation.from_quat([q.x, q.y, q.z, q.w])
    assert np.allclose(base_in_world.apply(xyz(moved.linear_acceleration)), [0.0, 0.0, 9.81])
    assert np.allclose(base_in_world.apply(xyz(moved.angular_velocity)), [0.0, 0.0, 0.5])
    s = imu.orientation
    sensor_in_world = Rotation.from_quat([s.x, s.y, s.z, s.w])
    assert np.allclose((base_in_world * ROTATION).as_matrix(), sensor_in_world.as_matrix())
    assert imu == before


def test_covariances_of_an_imu(imu, transform):
    moved = do_transform_imu(imu, transform)
    matrix = ROTATION.as_matrix()
    for seed, name in ((1, "angular_velocity"), (2, "linear_acceleration")):
        expected = matrix @ covariance(seed) @ matrix.T
        assert np.allclose(np.reshape(getattr(moved, f"{name}_covariance"), (3, 3)), expected, atol=1e-14)
    assert np.array_equal(moved.orientation_covariance, imu.orientation_covariance), "it is in the world's axes"


def test_unset_orientation_of_an_imu(imu, transform):
    imu.orientation = Quaternion(w=0.0)
    moved = do_transform_imu(imu, transform)
    assert moved.orientation == imu.orientation
    assert moved.angular_velocity != imu.angular_velocity


def test_quantities_that_an_imu_does_not_measure(imu, transform):
    imu.orientation_covariance[0] = imu.linear_acceleration_covariance[0] = -1.0
    imu.orientation = Quaternion(w=0.0)
    moved = do_transform_imu(imu, transform)
    assert moved.orientation == imu.orientation
    assert moved.linear_acceleration == imu.linear_acceleration
    assert np.array_equal(moved.orientation_covariance, imu.orientation_covariance)
    assert np.array_equal(moved.linear_acceleration_covariance, imu.linear_acceleration_covariance)
    assert moved.angular_velocity != imu.angular_velocity
