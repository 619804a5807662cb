# SPDX-License-Identifier: Apache-2.0
"""tf2_sensor_msgs and sensor_msgs_py."""

import copy
import sys
from array import array

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import tf2_ros
from geometry_msgs.msg import Transform
from sensor_msgs.msg import PointCloud2, PointField
from sensor_msgs_py import point_cloud2
from sensor_msgs_py.numpy_compat import structured_to_unstructured
from std_msgs.msg import Header
from tf2_sensor_msgs import do_transform_cloud, transform_points

ROTATION = Rotation.random(random_state=5)
TRANSLATION = (1.0, -2.0, 3.0)


def field(name, offset, datatype=PointField.FLOAT32, count=1):
    return PointField(name=name, offset=offset, datatype=datatype, count=count)


XYZI = [field("x", 0), field("y", 4), field("z", 8), field("intensity", 12)]
# Fields of several types with padding between and after them.
MIXED = [
    field("ring", 0, PointField.UINT16),
    field("x", 4, PointField.FLOAT64),
    field("y", 12, PointField.FLOAT64),
    field("z", 20, PointField.FLOAT64),
    field("rgb", 28, PointField.UINT8, 3),
]


@pytest.fixture
def transform(stamped):
    return stamped("target", "source", 3.0, TRANSLATION, tuple(ROTATION.as_quat()))


def points_of(cloud):
    return np.asarray(point_cloud2.read_points_numpy(cloud, ["x", "y", "z"]), dtype=np.float64)


def test_cloud_is_transformed_and_other_fields_are_kept(transform):
    points = np.random.default_rng(1).normal(size=(50, 4)).astype(np.float32)
    header = Header(frame_id="source")
    header.stamp.sec = 9
    cloud = point_cloud2.create_cloud(header, XYZI, points)
    before = copy.deepcopy(cloud)
    moved = do_transform_cloud(cloud, transform)
    expected = ROTATION.apply(points[:, :3].astype(np.float64)) + TRANSLATION
    assert np.array_equal(points_of(moved), expected.astype(np.float32))
    assert np.array_equal(point_cloud2.read_points(moved)["intensity"], points[:, 3])
    assert (moved.header.frame_id, moved.header.stamp.sec) == ("target", 9)
    assert cloud == before


def test_transform_without_a_header_keeps_the_frame(transform):
    cloud = point_cloud2.create_cloud_xyz32(Header(frame_id="source"), [(1.0, 2.0, 3.0)])
    moved = do_transform_cloud(cloud, transform.transform)
    assert moved.header.frame_id == "source"
    assert np.allclose(points_of(moved), ROTATION.apply([1.0, 2.0, 3.0]) + TRANSLATION, atol=1e-6)


def test_organized_clouds_with_padding_keep_their_layout(transform):
    dtype = point_cloud2.dtype_from_fields(MIXED, 32)
    rows = np.zeros((2, 3), dtype)
    for axis in "xyz":
        rows[axis] = np.random.default_rng(2).normal(size=(2, 3))
    rows["rgb_1"] = 7
    padded_rows = b"".join(row.tobytes() + b"\xff" * 16 for row in rows)
    cloud = PointCloud2(height=2, width=3, fields=MIXED, point_step=32, row_step=3 * 32 + 16, is_bigendian=False)
    cloud.data = array("B", padded_rows)
    moved = do_transform_cloud(cloud, transform)
    assert (moved.height, moved.width, moved.row_step) == (2, 3, 112)
    expected = ROTATION.apply(np.stack([rows[axis].ravel() for axis in "xyz"], axis=1)) + TRANSLATION
    assert np.allclose(points_of(moved), expected, atol=1e-14)
    assert np.all(point_cloud2.read_points(moved)["rgb_1"] == 7)


def test_big_endian_clouds(transform):
    cloud = PointCloud2(height=1, width=1, fields=XYZI[:3], point_step=12, row_step=12, is_bigendian=True)
    cloud.data = array("B", np.array([1.0, 2.0, 3.0], ">f4").tobytes())
    assert point_cloud2.read_points_list(cloud) == [(1.0, 2.0, 3.0)]
    assert np.allclose(
        points_of(do_transform_cloud(cloud, transform)), ROTATION.apply([1.0, 2.0, 3.0]) + TRANSLATION, atol=1e-6
    )


def test_cloud_without_z_is_rejected(transform):
    cloud = point_cloud2.create_cloud(Header(), XYZI[:2], [(1.0, 2.0)])
    text = "^Point cloud needs the fields x, y, and z for the transformation$"
    with pytest.raises(AssertionError, match=text):
        do_transform_cloud(cloud, transform)


def test_empty_cloud(transform):
    cloud = point_cloud2.create_cloud_xyz32(Header(frame_id="source"), [])
    assert do_transform_cloud(cloud, transform).width == 0


def test_transform_points():
    assert np.array_equal(transform_points(np.ones((2, 3)), Transform()), np.ones((2, 3)))


def test_buffer_transform(transform):
    buffer = tf2_ros.Buffer()
    buffer.set_transform_static(transform, "me")
    cloud = point_cloud2.create_cloud_xyz32(Header(frame_id="source"), [(0.0, 0.0, 0.0)])
    assert points_of(buffer.transform(cloud, "target")).tolist() == [list(TRANSLATION)]


def test_reading_some_fields_without_nans():
    cloud = point_cloud2.create_cloud_xyz32(Header(), [(1.0, 2.0, 3.0), (float("nan"), 5.0, 6.0), (7.0, 8.0, 9.0)])
    points = point_cloud2.read_points(cloud, ["y", "z"], skip_nans=True)
    assert points.dtype.names == ("y", "z")
    assert len(points) == 3
    assert point_cloud2.read_points(cloud, skip_nans=True)["x"].tolist() == [1.0, 7.0]
    assert point_cloud2.read_points_numpy(cloud, ["z", "y"], uvs=[2, 0]).tolist() == [[9.0, 8.0], [3.0, 2.0]]
    assert point_cloud2.read_points_list(cloud, ["x"], uvs=[0])[0].x == 1.0
    with pytest.raises(AssertionError, match="Requests field is not in the fields of the PointCloud!"):
        point_cloud2.read_points(cloud, ["w"])


def test_fields_of_different_types():
    points = [(1, 1.0, 2.0, 3.0, 4, 5, 6)]
    cloud = point_cloud2.create_cloud(Header(), MIXED, points)
    assert cloud.point_step == 31
    assert [tuple(point) for point in point_cloud2.read_points_list(cloud)] == points
    assert point_cloud2.create_cloud(Header(), MIXED, points, 40).point_step == 40
    with pytest.raises(AssertionError, match="All fields need to have the same datatype"):
        point_cloud2.read_points_numpy(cloud)
    with pytest.raises(AssertionError, match="All fields need to have the same datatype"):
        point_cloud2.create_cloud(Header(), MIXED, np.zeros((1, 7)))


def test_round_trip_of_structured_arrays():
    dtype = point_cloud2.dtype_from_fields(MIXED)
    points = np.zeros(3, dtype)
    points["ring"] = [1, 2, 3]
    cloud = point_cloud2.create_cloud(Header(frame_id="a"), MIXED, points)
    assert (cloud.width, cloud.height, cloud.is_bigendian) == (3, 1, sys.byteorder == "big")
    assert np.array_equal(point_cloud2.read_points(cloud), points)
    with pytest.raises(AssertionError, match="do not match"):
        point_cloud2.create_cloud(Header(), XYZI, points)


@pytest.mark.timeout(5)
def test_clouds_of_any_number_of_points_and_elements_are_errors_at_once():
    cloud = PointCloud2(height=1, width=1, fields=[field("x", 0), field("y", 4, count=2_000_000)], point_step=16)
    cloud.data = bytes(16)
    with pytest.raises(ValueError, match="more than the maximum of 10000 elements"):
        point_cloud2.read_points(cloud)
    cloud = PointCloud2(height=2**32 - 1, width=1)
    with pytest.raises(ValueError, match="4294967295 x 1 points, but 0 bytes"):
        point_cloud2.read_points(cloud)


def test_shape_of_organized_clouds():
    points = np.arange(24, dtype=np.float32).reshape(2, 3, 4)
    cloud = point_cloud2.create_cloud(Header(), XYZI, points)
    assert (cloud.width, cloud.height) == (2, 3)
    shaped = point_cloud2.read_points(cloud, reshape_organized_cloud=True)
    assert shaped.shape == (2, 3)
    assert np.array_equal(structured_to_unstructured(shaped), points)


def test_invalid_fields():
    with pytest.raises(AssertionError, match="count = 0"):
        point_cloud2.dtype_from_fields([field("x", 0, count=0)])
    with pytest.raises(AssertionError, match="Duplicate"):
        point_cloud2.dtype_from_fields([field("x", 0), field("x", 4)])
    assert point_cloud2.dtype_from_fields([field("", 0)]).names == ("unnamed_field_0",)
