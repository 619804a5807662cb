# SPDX-License-Identifier: Apache-2.0
"""transform_cloud compared with SciPy."""

import copy
from array import array

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from sensor_data import SECOND, START, array_of, message_of, xyz

import coframe
from coframe.messages import find
from coframe.sensors import transform_cloud
from tf2_sensor_msgs import do_transform_cloud

ROTATION = Rotation.random(random_state=5)
TRANSLATION = np.array([1.0, -2.0, 3.0])
TRANSFORM = coframe.Transform(TRANSLATION, ROTATION.as_quat(), target="base", source="lidar")
NAN, INF = float("nan"), float("inf")


def moved(points):
    return ROTATION.apply(points.reshape(-1, 3)).reshape(points.shape) + TRANSLATION


def layout(**fields):
    """Return a dtype from name=(kind, offset) with `size` bytes per point."""
    size = fields.pop("size")
    kinds, offsets = zip(*fields.values(), strict=True)
    return np.dtype({"names": list(fields), "formats": kinds, "offsets": offsets, "itemsize": size})


LAYOUTS = {
    "packed": layout(x=("f4", 0), y=("f4", 4), z=("f4", 8), size=12),
    "pcl": layout(x=("f4", 0), y=("f4", 4), z=("f4", 8), intensity=("f4", 16), size=32),
    "ouster": layout(x=("f4", 0), y=("f4", 4), z=("f4", 8), t=("u4", 20), ring=("u2", 26), size=48),
    "unaligned": layout(ring=("u1", 0), x=("f4", 1), y=("f4", 5), z=("f4", 9), size=13),
    "scattered": layout(z=("f4", 0), i=("u2", 4), x=("f4", 6), y=("f4", 12), size=17),
    "doubles": layout(t=("f8", 0), x=("f8", 8), y=("f8", 16), z=("f8", 24), size=32),
    "unaligned doubles": layout(x=("f8", 3), y=("f8", 11), z=("f8", 19), size=27),
    "mixed": layout(x=("f8", 0), y=("f4", 8), z=("f8", 12), size=20),
}


def filled(dtype, shape, seed=2):
    random = np.random.default_rng(seed)
    points = np.zeros(shape, dtype)
    for name in dtype.names:
        points[name] = random.normal(size=shape) * 100 if dtype[name].kind == "f" else random.integers(0, 200, shape)
    return points


def near(got, expected, dtype):
    eps = np.finfo(np.float32 if any(dtype[name].itemsize == 4 for name in "xyz") else np.float64).eps
    return np.allclose(got, expected, rtol=0, atol=1000 * eps)


@pytest.mark.parametrize("big_endian", [False, True])
@pytest.mark.parametrize("shape", [(0,), (1,), (7,), (300,), (4, 100), (100, 1), (3, 1), (50, 7)])
@pytest.mark.parametrize("name", LAYOUTS)
def test_messages_of_any_layout(name, shape, big_endian):
    points = filled(LAYOUTS[name], shape)
    cloud = message_of(points, row_padding=5, big_endian=big_endian)
    before = copy.deepcopy(cloud)
    result = transform_cloud(cloud, TRANSFORM)
    assert cloud == before
    assert result.header.frame_id == "base"
    assert result.header.stamp == cloud.header.stamp
    assert len(result.data) == len(cloud.data)
    got, given = array_of(result), array_of(cloud)
    assert near(xyz(got), moved(xyz(given)), points.dtype)
    for other in set(points.dtype.names) - set("xyz"):
        assert np.array_equal(got[other], given[other])
    between = np.frombuffer(result.data, np.uint8).reshape(result.height, -1)[:, result.width * result.point_step :]
    assert (between == 0xEE).all(), "what changes between rows is not touched"


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("name", LAYOUTS)
def test_structured_arrays_of_any_layout(name, order):
    points = filled(LAYOUTS[name], (40, 3)).astype(LAYOUTS[name].newbyteorder(order))
    for view in (points, points[::2], points[::-1, ::-1], points.T, points[5:6], points[3]):
        before = view.copy()
        result = transform_cloud(view, TRANSFORM)
        assert np.array_equal(view, before)
        assert result.dtype == view.dtype
        assert near(xyz(result), moved(xyz(before)), view.dtype)
        for other in set(view.dtype.names) - set("xyz"):
            assert np.array_equal(result[other], before[other])
    transform_cloud(points[::-2], TRANSFORM, in_place=True)
    original = filled(LAYOUTS[name], (40, 3))
    assert near(xyz(points[::-2]), moved(xyz(original[::-2])), points.dtype)
    assert np.array_equal(points[::2], original[::2].astype(points.dtype))


@pytest.mark.parametrize("dtype", [np.float32, np.float64, ">f4", ">f8"])
@pytest.mark.parametrize("shape", [(0, 3), (1, 3), (1000, 3), (129, 5), (8, 9, 4)])
def test_plain_arrays(shape, dtype, random):
    points = random.normal(size=shape).astype(dtype)
    result = transform_cloud(points, TRANSFORM)
    assert result.dtype == points.dtype
    atol = 1e-6 if result.itemsize == 4 else 1e-14
    assert np.allclose(result[..., :3], moved(points[..., :3].astype(np.float64)), rtol=0, atol=atol)
    assert np.array_equal(result[..., 3:], points[..., 3:])


def test_float64_is_exact_to_1e_12(random):
    points = random.normal(size=(1000, 3))
    assert np.abs(transform_cloud(points, TRANSFORM) - moved(points)).max() < 1e-12
    assert np.abs(TRANSFORM @ points - moved(points)).max() < 1e-12
    half_turn = coframe.Transform([0, 0, 0], [0.6, 0.8, 0, 0])
    by_hand = Rotation.from_quat([0.6, 0.8, 0, 0]).apply(points)
    assert np.abs(transform_cloud(points, half_turn) - by_hand).max() < 1e-12


def test_nan_points_stay_nan():
    points = np.array([[1.0, 2.0, 3.0], [NAN, NAN, NAN], [INF, 0.0, 0.0], [4.0, 5.0, 6.0]], np.float32)
    result = transform_cloud(points, TRANSFORM)
    assert np.isfinite(result).all(axis=1).tolist() == [True, False, False, True]
    assert np.allclose(result[[0, 3]], moved(points[[0, 3]].astype(np.float64)), atol=1e-5)


def test_in_place_changes_the_message_itself():
    points = filled(LAYOUTS["pcl"], (20,))
    cloud = message_of(points)
    data = cloud.data
    result = transform_cloud(cloud, TRANSFORM, in_place=True)
    assert result is cloud
    assert cloud.data is data
    assert cloud.header.frame_id == "base"
    assert near(xyz(array_of(cloud)[0]), moved(xyz(points)), points.dtype)


def test_memory_of_out_is_reused():
    points = filled(LAYOUTS["pcl"], (20,))
    cloud, out = message_of(points), message_of(filled(LAYOUTS["pcl"], (20,), seed=9), frame="other", stamp=7)
    data = out.data
    result = transform_cloud(cloud, TRANSFORM, out=out)
    assert result is out
    assert out.data is data
    assert out == transform_cloud(cloud, TRANSFORM)
    smaller = find("sensor_msgs/msg/PointCloud2")()
    assert transform_cloud(cloud, TRANSFORM, out=smaller) == out
    shallow = copy.copy(cloud)
    assert transform_cloud(cloud, TRANSFORM, out=shallow) == out
    assert np.array_equal(array_of(cloud)[0], points), "a copy that shares the data does not spoil it"


def test_arrays_as_out(random):
    points = random.normal(size=(300, 3)).astype(np.float32)
    wide = np.empty((300, 3))
    assert transform_cloud(points, TRANSFORM, out=wide) is wide
    assert np.abs(wide - moved(points.astype(np.float64))).max() < 1e-12
    strided = np.zeros((300, 8), np.float32)
    transform_cloud(points, TRANSFORM, out=strided[:, 2:5])
    assert np.allclose(strided[:, 2:5], moved(points.astype(np.float64)), atol=1e-5)
    assert (strided[:, [0, 1, 5, 6, 7]] == 0).all()
    overlapping = np.concatenate((points, points[:1]))
    transform_cloud(overlapping[:-1], TRANSFORM, out=overlapping[1:])
    assert np.allclose(overlapping[1:], moved(points.astype(np.float64)), atol=1e-5)
    assert transform_cloud(wide, TRANSFORM.inverse(), out=wide) is wide
    assert np.allclose(wide, points, atol=1e-6)


def test_normals_and_other_vectors_are_only_rotated(random):
    names = ["x", "y", "z", "normal_x", "normal_y", "normal_z", "nx", "ny", "nz", "vx", "vy", "vz", "ax", "ay", "az"]
    points = np.zeros(200, [(name, "f8") for name in names])
    for name in names:
        points[name] = random.normal(size=200)
    result = transform_cloud(points, TRANSFORM, vectors=("vx", "vy", "vz"))
    assert np.abs(xyz(result) - moved(xyz(points))).max() < 1e-12
    for three in (names[3:6], names[6:9], names[9:12]):
        assert np.abs(xyz(result, three) - ROTATION.apply(xyz(points, three))).max() < 1e-12
    assert np.array_equal(result["ax"], points["ax"])
    both = transform_cloud(message_of(points), TRANSFORM, vectors=[names[9:12], names[12:15], names[3:6]])
    turned = ROTATION.apply(xyz(points, names[12:15]))
    assert np.abs(xyz(array_of(both)[0], names[12:15]) - turned).max() < 1e-12
    once = ROTATION.apply(xyz(points, names[3:6]))
    assert np.abs(xyz(array_of(both)[0], names[3:6]) - once).max() < 1e-12, "normals are not turned twice"


def test_columns_as_vectors(random):
    points = random.normal(size=(50, 7))
    result = transform_cloud(points, TRANSFORM, vectors=(4, 5, 6))
    assert np.allclose(result[:, 4:], ROTATION.apply(points[:, 4:]))
    assert np.array_equal(result[:, 3], points[:, 3])


def test_the_lookup_in_a_buffer_uses_the_stamp_of_the_cloud(buffer, motion):
    points = filled(LAYOUTS["doubles"], (10,))
    stamp = START + SECOND // 7
    cloud = message_of(points, stamp=stamp)
    result = transform_cloud(cloud, buffer, "odom")
    assert result.header.frame_id == "odom"
    expected = motion.apply(np.full(10, stamp), xyz(points))
    assert np.abs(xyz(array_of(result)[0]) - expected).max() < 1e-10
    later = transform_cloud(xyz(points), buffer, "odom", source="lidar", stamp=motion.last)
    assert np.allclose(later, motion.apply(np.full(10, motion.last), xyz(points)))
    latest = transform_cloud(xyz(points), buffer, "odom", source="lidar")
    assert np.array_equal(latest, later)
    with pytest.raises(coframe.ExtrapolationException):
        transform_cloud(message_of(points, stamp=motion.last + 1), buffer, "odom")
    with pytest.raises(TypeError, match="needs source="):
        transform_cloud(xyz(points), buffer, "odom")
    with pytest.raises(TypeError, match="needs target="):
        transform_cloud(cloud, buffer)


def test_messages_as_transforms():
    stamped = find("geometry_msgs/msg/TransformStamped")()
    stamped.header.frame_id, stamped.child_frame_id = "base", "lidar"
    t, q = stamped.transform.translation, stamped.transform.rotation
    t.x, t.y, t.z = TRANSLATION.tolist()
    q.x, q.y, q.z, q.w = (2 * ROTATION.as_quat()).tolist()
    cloud = message_of(filled(LAYOUTS["packed"], (10,)))
    assert transform_cloud(cloud, stamped) == transform_cloud(cloud, TRANSFORM)
    assert transform_cloud(cloud, stamped.transform).header.frame_id == "lidar"


def test_a_buffer_of_tf2_ros_is_accepted():
    import tf2_ros

    theirs = tf2_ros.Buffer()
    message = find("geometry_msgs/msg/TransformStamped")()
    message.header.frame_id, message.child_frame_id = "base", "lidar"
    theirs.set_transform_static(message, "test")
    cloud = message_of(filled(LAYOUTS["packed"], (10,)))
    assert transform_cloud(cloud, theirs, "base").data == cloud.data


def test_messages_from_rosbags_are_accepted():
    stores = pytest.importorskip("rosbags.typesys")
    types = stores.get_typestore(stores.Stores.ROS2_HUMBLE).types
    points = filled(LAYOUTS["pcl"], (20,))
    ours = message_of(points)
    stamp = types["builtin_interfaces/msg/Time"](sec=1, nanosec=2)
    field = types["sensor_msgs/msg/PointField"]
    theirs = types["sensor_msgs/msg/PointCloud2"](
        header=types["std_msgs/msg/Header"](stamp=stamp, frame_id="lidar"),
        height=1,
        width=20,
        fields=[field(name=f.name, offset=f.offset, datatype=f.datatype, count=1) for f in ours.fields],
        is_bigendian=False,
        point_step=32,
        row_step=640,
        data=np.frombuffer(ours.data, np.uint8),
        is_dense=True,
    )
    result = transform_cloud(theirs, TRANSFORM)
    assert type(result) is type(theirs)
    assert (result.header.frame_id, theirs.header.frame_id) == ("base", "lidar")
    assert result.data.tobytes() == transform_cloud(ours, TRANSFORM).data.tobytes()
    theirs.data = theirs.data.copy()
    theirs.data.flags.writeable = False
    with pytest.raises(ValueError, match="is read-only"):
        transform_cloud(theirs, TRANSFORM, in_place=True)


@pytest.mark.parametrize("threads", [2, 3, 7])
def test_results_do_not_depend_on_the_number_of_threads(threads, random):
    points = random.normal(size=(10_000, 4)).astype(np.float32)
    assert np.array_equal(transform_cloud(points, TRANSFORM, threads=threads), transform_cloud(points, TRANSFORM))
    organized = filled(LAYOUTS["unaligned"], (13, 77))
    assert np.array_equal(transform_cloud(organized, TRANSFORM, threads=threads), transform_cloud(organized, TRANSFORM))


def test_a_cloud_in_another_frame_is_refused():
    cloud = message_of(filled(LAYOUTS["packed"], (3,)), frame="camera")
    with pytest.raises(coframe.FrameMismatchException, match="points in frame 'camera' by the transform base"):
        transform_cloud(cloud, TRANSFORM)
    cloud.header.frame_id = ""
    assert transform_cloud(cloud, TRANSFORM).header.frame_id == "base"
    anonymous = coframe.Transform(TRANSLATION)
    assert transform_cloud(message_of(filled(LAYOUTS["packed"], (3,))), anonymous).header.frame_id == "lidar"


@pytest.mark.parametrize(
    ("arguments", "error", "text"),
    [
        (([[1.0, 2.0, 3.0]], TRANSFORM), TypeError, "PointCloud2 message or a numpy array, not list"),
        ((np.zeros((3, 2)), TRANSFORM), ValueError, r"shape \(N, 3\)"),
        ((np.zeros(3), TRANSFORM), ValueError, r"shape \(N, 3\)"),
        ((np.zeros((3, 3), np.int32), TRANSFORM), ValueError, "must be float32 or float64, not int32"),
        ((np.zeros((3, 3), np.float16), TRANSFORM), ValueError, "float16"),
        ((np.zeros(3, [("x", "f4"), ("y", "f4")]), TRANSFORM), ValueError, "no field 'z'. Their fields: 'x', 'y'"),
        (
            (np.zeros(3, [("x", "f4", 2), ("y", "f4"), ("z", "f4")]), TRANSFORM),
            ValueError,
            "'x' must have one number per point, not 2",
        ),
        ((np.zeros((3, 3)), "base"), TypeError, "must be a Transform, a TransformStamped or a buffer, not str"),
        ((np.zeros((3, 3)), coframe.Transform(np.zeros((2, 3)))), ValueError, "not a batch"),
        ((np.zeros((3, 3)), TRANSFORM, "base"), TypeError, "can be used only with a buffer"),
    ],
)
def test_invalid_arguments_are_refused(arguments, error, text):
    with pytest.raises(error, match=text):
        transform_cloud(*arguments)


@pytest.mark.parametrize(
    ("options", "error", "text"),
    [
        ({"out": np.zeros((4, 3))}, ValueError, r"out must have the shape of the points, \(3, 3\)"),
        ({"out": [1]}, TypeError, "out must be a NumPy array"),
        ({"out": np.zeros((3, 3)), "in_place": True}, ValueError, "are mutually exclusive"),
        ({"out": np.broadcast_to(np.zeros(3), (3, 3))}, ValueError, "is read-only"),
        ({"threads": 0}, ValueError, "threads must be at least 1"),
        ({"vectors": (3, 4, 5)}, ValueError, "3 columns has no column 3"),
        ({"vectors": "abc"}, TypeError, "three names"),
        ({"vectors": [(0, 1)]}, ValueError, "three fields"),
    ],
)
def test_invalid_options_are_refused(options, error, text):
    points = np.ones((3, 3))
    with pytest.raises(error, match=text):
        transform_cloud(points, TRANSFORM, **options)
    assert (points == 1.0).all()


def test_data_of_bytes_is_copied_into_an_array():
    class Cloud:
        """A message that does not check its data."""

    ours = message_of(filled(LAYOUTS["packed"], (5,)))
    cloud = Cloud()
    for name in ours.get_fields_and_field_types():
        setattr(cloud, name, getattr(ours, name))
    for data in (bytes(ours.data), bytearray(ours.data), list(ours.data), memoryview(ours.data)):
        cloud.data = data
        result = transform_cloud(cloud, TRANSFORM)
        assert result.data == transform_cloud(ours, TRANSFORM).data
        assert isinstance(result.data, array)
        assert bytes(cloud.data) == ours.data.tobytes()


UTM = coframe.Transform([500_000.125, 5_400_000.5, 400.0], target="utm", source="lidar")


@pytest.mark.parametrize("kind", ["message", "structured", "plain", "drop-in"])
def test_float32_far_from_the_origin_is_a_warning(kind):
    """UTM coordinates in float32 are multiples of half a meter."""
    points = np.zeros(3, [(axis, "f4") for axis in "xyz"])
    cloud = {"structured": points, "plain": np.zeros((3, 3), np.float32)}.get(kind, message_of(points))
    stamped = find("geometry_msgs/msg/TransformStamped")()
    stamped.header.frame_id = "utm"
    x, y, z = UTM.translation.tolist()
    stamped.transform.translation.x, stamped.transform.translation.y, stamped.transform.translation.z = x, y, z
    transform = do_transform_cloud if kind == "drop-in" else transform_cloud
    with pytest.warns(coframe.CoframeWarning, match="of 5400000 m to steps of 500 mm. float64=True in") as caught:
        transform(cloud, stamped)
    assert caught[0].filename == __file__


@pytest.mark.parametrize("is_bigendian", [False, True])
def test_float64_on_request(is_bigendian):
    order = ">" if is_bigendian else "<"
    kinds = [("ring", f"{order}u2"), ("z", f"{order}f4"), ("y", f"{order}f4"), ("x", f"{order}f8"), ("i", f"{order}f4")]
    points = np.zeros(5, kinds)
    points["ring"], points["y"], points["i"] = np.arange(5), np.arange(5) / 8, np.arange(5) / 2
    cloud = message_of(points.astype(points.dtype.newbyteorder("<")), big_endian=is_bigendian)
    (result,) = array_of(transform_cloud(cloud, UTM, float64=True))
    assert np.array_equal(result["y"], 5_400_000.5 + points["y"].astype(float))
    assert [result.dtype[name].str[1:] for name in result.dtype.names] == ["u2", "f8", "f8", "f8", "f4"]
    for name in ("ring", "i"):
        assert np.array_equal(result[name], points[name])
    assert np.array_equal(transform_cloud(points, UTM, float64=True)["y"], 5_400_000.5 + points["y"].astype(float))
    with pytest.raises(ValueError, match="omit in_place and out"):
        transform_cloud(points, UTM, float64=True, in_place=True)
