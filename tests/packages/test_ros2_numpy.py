# SPDX-License-Identifier: Apache-2.0
"""ros2_numpy, compared with SciPy and sensor_msgs_py."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import ros2_numpy
from geometry_msgs.msg import Point, Pose, Quaternion, Transform, Vector3
from nav_msgs.msg import MapMetaData, OccupancyGrid
from ros2_numpy import msgify, numpify
from sensor_msgs.msg import Image, PointCloud2, PointField
from sensor_msgs_py import point_cloud2
from std_msgs.msg import Header, String

POINTS = np.zeros(5, [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("ring", "<u2"), ("normal", "<f4", (3,))])
for index, name in enumerate(POINTS.dtype.names):
    POINTS[name].T[...] = np.arange(5) + 10 * index


def test_clouds():
    cloud = msgify(PointCloud2, POINTS, frame_id="lidar")
    assert (cloud.header.frame_id, cloud.height, cloud.width, cloud.point_step) == ("lidar", 1, 5, 26)
    read = point_cloud2.read_points(cloud)
    assert np.array_equal(read["ring"], POINTS["ring"])
    assert np.array_equal(read["normal_2"], POINTS["normal"][:, 2])
    points = numpify(cloud)
    assert points.dtype == POINTS.dtype
    assert np.array_equal(np.asarray(points), POINTS)
    assert np.shares_memory(points, np.frombuffer(cloud.data, np.uint8))
    expected = np.column_stack([POINTS[name] for name in "xyz"])
    assert np.array_equal(points["xyz"], expected)
    assert np.array_equal(points["xyz"], ros2_numpy.point_cloud2.pointcloud2_to_xyz_array(cloud))
    assert np.array_equal(points[points["x"] > 2]["xyz"], expected[3:])
    organized = msgify(PointCloud2, POINTS[:4].reshape(2, 2))
    assert (organized.height, organized.width) == (2, 2)
    assert numpify(organized)["xyz"].shape == (2, 2, 3)


def test_clouds_with_gaps_padding_and_other_byte_order():
    cloud = msgify(PointCloud2, POINTS)
    cloud.fields = [field for field in cloud.fields if field.name != "y"]
    cloud.height, cloud.width, cloud.row_step = 2, 2, 60
    cloud.data = POINTS[:2].tobytes() + b"padding." + POINTS[2:4].tobytes() + b"padding."
    assert numpify(cloud)["ring"].tolist() == [[30, 31], [32, 33]]
    swapped = POINTS.astype(POINTS.dtype.newbyteorder(">"))
    cloud = msgify(PointCloud2, POINTS)
    cloud.is_bigendian, cloud.data = True, swapped.tobytes()
    assert np.array_equal(np.asarray(numpify(cloud)["xyz"]), numpify(msgify(PointCloud2, POINTS))["xyz"])
    assert np.array_equal(numpify(msgify(PointCloud2, swapped))["ring"], POINTS["ring"])
    cloud.data = cloud.data[:-1]
    with pytest.raises(ValueError, match="size of buffer"):
        numpify(cloud)


@pytest.mark.parametrize(
    "changes",
    [
        {"datatype": 99},
        {"offset": 24},
        {"offset": 2**32 - 1},
        {"count": 2**32 - 1},
        {"name": "y"},
    ],
)
def test_invalid_fields_are_rejected(changes):
    cloud = msgify(PointCloud2, POINTS)
    for name, value in changes.items():
        setattr(cloud.fields[0], name, value)
    with pytest.raises(ValueError, match=r"."):
        numpify(cloud)


def test_points_that_are_not_finite_are_skipped():
    points = POINTS.copy()
    points["y"][1], points["z"][2] = np.nan, np.inf
    cloud = msgify(PointCloud2, points)
    assert not cloud.is_dense
    assert msgify(PointCloud2, POINTS).is_dense
    assert ros2_numpy.point_cloud2.pointcloud2_to_xyz_array(cloud)[:, 0].tolist() == [0.0, 3.0, 4.0]
    assert len(ros2_numpy.point_cloud2.get_xyz_points(numpify(cloud), remove_nans=False)) == 5
    organized = numpify(msgify(PointCloud2, POINTS[:4].reshape(2, 2)))
    assert ros2_numpy.point_cloud2.get_xyz_points(organized).shape == (4, 3)
    assert ros2_numpy.point_cloud2.get_xyz_points(organized, remove_nans=False).shape == (2, 2, 3)


def test_clouds_from_dictionaries():
    data = {"xyz": np.ones((3, 3)), "rgb": np.full((3, 3), [1, 2, 3], np.uint8), "intensity": np.ones((3, 1))}
    cloud = msgify(PointCloud2, data, "map")
    assert cloud.header.frame_id == "map"
    read = point_cloud2.read_points(cloud)
    assert read["rgb"].tolist() == [0x010203] * 3
    assert read["intensity"].tolist() == [1.0] * 3
    assert msgify(PointCloud2, {"xyz": np.ones((3, 3))}).header.frame_id == "base_link"
    with pytest.raises(ValueError, match="must have an 'xyz' field"):
        msgify(PointCloud2, {"rgb": np.ones((3, 3))})
    with pytest.raises(TypeError, match="structured array"):
        msgify(PointCloud2, np.ones((3, 3)))
    with pytest.raises(TypeError, match="cannot have the field 'a' of type int64"):
        msgify(PointCloud2, np.zeros(1, [("a", "i8")]))


def test_colors_are_split_and_merged():
    points = np.zeros(2, [("x", "f4"), ("r", "u1"), ("g", "u1"), ("b", "u1")])
    points["r"], points["g"], points["b"] = 10, 20, [30, 255]
    merged = ros2_numpy.point_cloud2.merge_rgb_fields(points)
    assert merged.dtype.names == ("x", "rgb")
    assert merged["rgb"].view(np.uint32).tolist() == [0x0A141E, 0x0A14FF]
    assert np.array_equal(ros2_numpy.point_cloud2.split_rgb_field(merged), points)


def test_lists_of_fields():
    fields = [PointField(name="x", offset=4, datatype=PointField.FLOAT32, count=1)]
    dtype = numpify(fields, point_step=12)
    assert (dtype.itemsize, dtype.fields["x"]) == (12, (np.dtype("f4"), 4))
    assert msgify([PointField], dtype) == fields


def test_geometry():
    rotation, translation = Rotation.random(random_state=2), (1.0, 2.0, 3.0)
    x, y, z, w = rotation.as_quat().tolist()
    quaternion = Quaternion(x=x, y=y, z=z, w=w)
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = rotation.as_matrix(), translation
    pose = Pose(position=Point(x=1.0, y=2.0, z=3.0), orientation=quaternion)
    transform = Transform(translation=Vector3(x=1.0, y=2.0, z=3.0), rotation=quaternion)
    for message in (pose, transform):
        assert np.allclose(numpify(message), matrix)
        again = msgify(type(message), matrix)
        assert np.allclose(numpify(again), matrix)
        assert type((again.position if message is pose else again.translation).x) is float
    assert numpify(quaternion).tolist() == [x, y, z, w]
    assert msgify(Quaternion, np.array([x, y, z, w])) == quaternion
    assert numpify(Point(x=1.0)).tolist() == [1.0, 0.0, 0.0]
    assert numpify(Point(x=1.0), hom=True).tolist() == [1.0, 0.0, 0.0, 1.0]
    assert numpify(Vector3(x=1.0), hom=True).tolist() == [1.0, 0.0, 0.0, 0.0]
    assert msgify(Point, np.array([2, 4, 6, 2])) == Point(x=1.0, y=2.0, z=3.0)
    assert msgify(Vector3, np.array([1, 2, 3])) == Vector3(x=1.0, y=2.0, z=3.0)
    with pytest.raises(AssertionError):
        msgify(Vector3, np.array([1, 2, 3, 1]))


def test_images_and_maps():
    pixels = np.arange(24, dtype=np.uint8).reshape(2, 4, 3)
    image = msgify(Image, pixels, encoding="rgb8")
    assert (image.encoding, image.step) == ("rgb8", 12)
    assert np.array_equal(numpify(image), pixels)
    with pytest.raises(TypeError, match="incompatible type"):
        msgify(Image, pixels, encoding="mono8")
    grid = OccupancyGrid(info=MapMetaData(width=3, height=2), data=[0, 1, -1, 100, 5, 6])
    cells = numpify(grid)
    assert cells.mask.tolist() == [[False, False, True], [False, False, False]]
    again = msgify(OccupancyGrid, cells, info=MapMetaData(resolution=0.5))
    assert (again.data.tolist(), again.info.width, again.info.resolution) == (grid.data.tolist(), 3, 0.5)
    with pytest.raises(TypeError, match="Array must be of int8s"):
        msgify(OccupancyGrid, np.zeros((2, 2)))
    with pytest.raises(TypeError, match="Array must be 2D"):
        msgify(OccupancyGrid, np.zeros(2, np.int8))


def test_classes_without_conversion():
    with pytest.raises(ValueError, match=r"Unable to convert message String - only supports .*PointCloud2"):
        numpify(String())
    with pytest.raises(ValueError, match="Unable to convert message String - only supports"):
        msgify(String, np.zeros(1))
    with pytest.raises(ValueError, match="empty Collection"):
        numpify([])
    with pytest.raises(ValueError, match="NoneType"):
        numpify(None)
    try:

        @ros2_numpy.converts_to_numpy(Header)
        def header_to_numpy(message, factor=1):
            return np.array([message.stamp.sec * factor])

        assert numpify(Header(), factor=2).tolist() == [0]
    finally:
        del ros2_numpy.registry._to_numpy[Header, False]
