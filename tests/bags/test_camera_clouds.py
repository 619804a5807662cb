# SPDX-License-Identifier: Apache-2.0
"""Clouds with the colors of a camera, and depth images as clouds, of a robot that drives towards a colored wall.

A box stands in front of the wall. The lidar is above the camera, so that it measures the wall behind the box.
"""

import struct

import numpy as np
import pytest
import recordings
from click.testing import CliRunner
from recordings import SECOND, START

import coframe
from coframe.bags import Clouds, write_clouds
from coframe.cameras import CameraModel, color_points
from coframe.cli.app import app
from coframe.messages import find, serialize
from coframe.sensors import depth_points
from coframe.sensors.layout import field_of

CLOUD, IMAGE, INFO = "sensor_msgs/msg/PointCloud2", "sensor_msgs/msg/Image", "sensor_msgs/msg/CameraInfo"
RED, GREEN, BLUE, NONE = (200, 0, 0), (0, 150, 0), (0, 0, 250), (0, 0, 0)
WALL_X, BOX_X = 10.0, 6.0
BOX = (-1.0, 1.0, 0.0, 1.5)  # y and z
TAKEN = START + SECOND + 37_000_000  # between two sweeps
SWEEP = SECOND // 10


def truth():
    """Return the transforms of a robot that drives at 2 m/s, swerves and pitches."""
    buffer = coframe.Buffer(None)
    for i in range(101):
        moved = coframe.Transform.from_rpy([i / 25, 0.2 * np.sin(i / 20), 0], [0, 0.05 * np.sin(i / 8), i / 800])
        buffer.set("map", "base", moved, START + i * SECOND // 50)
    optical = coframe.Transform.from_rpy([0.3, 0.0, 0.5], [-np.pi / 2, 0, -np.pi / 2])
    buffer.set("base", "camera", optical, static=True)
    buffer.set("base", "lidar", coframe.Transform([0.2, 0.0, 2.5]), static=True)
    return buffer


def transforms():
    """Return times and messages of the transforms; the mounts of the sensors are repeated like all others."""
    buffer, times = truth(), [START + i * SECOND // 50 for i in range(101)]
    edges = (("map", "base"), ("base", "camera"), ("base", "lidar"))
    return [(at, recordings.cdr(*edge, buffer.lookup(*edge, at), at)) for at in times for edge in edges]


def camera_info(stamp, model="plumb_bob", d=(-0.2, 0.05, 0.001, 0.0, 0.0), **fields):
    info = find(INFO)(width=320, height=200, distortion_model=model, d=list(d), **fields)
    info.k = [200.0, 0.0, 160.0, 0.0, 200.0, 100.0, 0.0, 0.0, 1.0]
    info.header.frame_id = "camera"
    info.header.stamp.sec, info.header.stamp.nanosec = divmod(stamp, SECOND)
    return info


def hit(origin, rays):
    """Return distances along rays of the map, and the color at their ends."""
    with np.errstate(all="ignore"):
        to_box, to_wall = ((x - origin[..., 0]) / rays[..., 0] for x in (BOX_X, WALL_X))
        at = origin + rays * to_box[..., None]
    y, z = at[..., 1], at[..., 2]
    on_box = (to_box > 0) & (y > BOX[0]) & (y < BOX[1]) & (z > BOX[2]) & (z < BOX[3])
    distance = np.where(on_box, to_box, np.where(to_wall > 0, to_wall, np.nan))
    end = origin + rays * distance[..., None]
    colors = np.where((end[..., 1] > 0.0)[..., None], RED, GREEN)
    return distance, np.where(on_box[..., None], BLUE, colors).astype(np.uint8)


def seen(info, stamp):
    """Return the depths and the colors of all pixels."""
    camera = CameraModel.from_info(info)
    width, height = camera.image_size
    rays = camera.rays(np.stack(np.meshgrid(np.arange(width), np.arange(height)), axis=-1))
    pose = truth().lookup("map", "camera", stamp)
    distance, colors = hit(np.asarray(pose.translation), rays @ pose.matrix[:3, :3].T)
    return distance * rays[..., 2], colors


def image_message(encoding, pixels, stamp, frame="camera"):
    message = find(IMAGE)(height=pixels.shape[0], width=pixels.shape[1], encoding=encoding, data=pixels.tobytes())
    message.step = pixels.nbytes // pixels.shape[0]
    message.header.frame_id = frame
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, SECOND)
    return message


def sweep(stamp):
    """Return a cloud whose columns are measured one after the other, as float32 with the field t."""
    azimuth = np.repeat(np.linspace(-0.6, 0.6, 240), 64)
    elevation = np.tile(np.linspace(-0.7, 0.05, 64), 240)
    rays = np.stack(
        [np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)], axis=-1
    )
    offsets = np.repeat(np.arange(240) * SWEEP // 240, 64)
    poses = truth().lookup_many("map", "lidar", stamp + offsets)
    ahead = poses.transform_point(rays) - poses.translation
    distance, _ = hit(np.asarray(poses.translation), ahead)
    points = np.zeros(len(rays), [("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("t", "<u4")])
    for axis, values in zip("xyz", (rays * distance[:, None]).T, strict=True):
        points[axis] = values
    points["t"] = offsets
    message = find(CLOUD)(height=1, width=len(points), point_step=16, row_step=points.nbytes, data=points.tobytes())
    message.header.frame_id = "lidar"
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, SECOND)
    for offset, (name, kind) in enumerate((("x", 7), ("y", 7), ("z", 7), ("t", 6))):
        message.fields.append(find("sensor_msgs/msg/PointField")(name=name, offset=4 * offset, datatype=kind, count=1))
    return message


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    """Return a recording with clouds, color images and depth images."""
    rows = [("/tf", at, data) for at, data in transforms()]
    info = camera_info(TAKEN)
    depths, colors = seen(info, TAKEN)
    messages = [
        ("/points", START + SECOND, sweep(START + SECOND)),
        ("/late/points", START + 9 * SECOND // 5, sweep(START + 9 * SECOND // 5)),
        ("/cam/camera_info", TAKEN, info),
        ("/cam/image_raw", TAKEN, image_message("rgb8", colors, TAKEN)),
        ("/depth/camera_info", TAKEN, info),
        ("/depth/image_raw", TAKEN, image_message("16UC1", np.rint(np.nan_to_num(1e3 * depths)).astype("<u2"), TAKEN)),
        ("/depth/meters", TAKEN, image_message("32FC1", depths.astype("<f4"), TAKEN)),
        ("/small/camera_info", TAKEN, info),
        ("/small/image_raw", TAKEN, image_message("rgb8", np.ascontiguousarray(colors[::2, ::2]), TAKEN)),
        ("/alone/image_raw", TAKEN, image_message("rgb8", colors, TAKEN)),
    ]
    types = {topic: (type(message).ROS_TYPE, "ros2msg", b"", "cdr") for topic, _, message in messages}
    rows += [(topic, at, serialize(message)) for topic, at, message in messages]
    return recordings.write_mcap(tmp_path_factory.mktemp("bag") / "run.mcap", rows=rows, types=types)


def xyz(points):
    return np.stack([points[axis] for axis in "xyz"], axis=1)


def rgb(points):
    return np.stack([points[name] for name in ("red", "green", "blue")], axis=1)


def expected_colors(points):
    """Return the color of points of the map, NONE for those that the camera does not see."""
    pose = truth().lookup("map", "camera", TAKEN)
    origin = np.asarray(pose.translation)
    distance, colors = hit(origin, points - origin)
    pixels = CameraModel.from_info(camera_info(TAKEN)).project(pose.inverse() @ points)
    with np.errstate(invalid="ignore"):
        inside = ((pixels > -0.5) & (pixels < [319.5, 199.5])).all(axis=1)
    return np.where((inside & (distance > 0.99))[:, None], colors, NONE)


def test_points_get_the_color_of_their_place_and_hidden_ones_get_none(path):
    with coframe.open_bag(path) as recording:
        clouds = Clouds(recording, "/points", "map", color="/cam/image_raw")
        (cloud,) = clouds
    expected, found = expected_colors(xyz(cloud.points)), rgb(cloud.points)
    wrong = (expected != found).any(axis=1)
    y, z = cloud.points["y"], cloud.points["z"]
    behind = (expected == NONE).all(axis=1) & (cloud.points["x"] > 9.0) & (abs(y) < 1.4) & (z < 2.2)
    assert behind.sum() > 300  # points of the wall that only the lidar sees
    assert wrong.mean() < 0.03, wrong.mean()  # at the edges
    assert (found[behind] == NONE).all(axis=1).mean() > 0.85
    visible = (expected != NONE).any(axis=1)
    assert (found[visible] != NONE).any(axis=1).mean() > 0.99
    assert (cloud.points["colored"] == (found != NONE).any(axis=1)).all()
    assert clouds.colored == cloud.points["colored"].sum()


def test_the_points_are_moved_to_the_time_of_the_image(path):
    """Without it, the colors of a robot at 2 m/s are those of other places."""
    with coframe.open_bag(path) as recording:
        (cloud,) = Clouds(recording, "/points", "map", color="/cam/image_raw")
        (skewed,) = Clouds(recording, "/points", "map", color="/cam/image_raw", deskew="off")
    shifted = (expected_colors(xyz(cloud.points)) != rgb(skewed.points)).any(axis=1).mean()
    assert shifted > 2 * (expected_colors(xyz(cloud.points)) != rgb(cloud.points)).any(axis=1).mean()


def test_colors_are_written_as_each_format_has_them(path, tmp_path):
    ply, folder, bag = (tmp_path / name for name in ("out.ply", "pcd", "out.mcap"))
    with coframe.open_bag(path) as recording:
        clouds = Clouds(recording, "/points", "map", color="/cam/image_raw")
        (cloud,) = clouds
        for target, kind in ((ply, None), (folder, "pcd"), (bag, None)):
            write_clouds(clouds, target, format_=kind)
    assert b"property uchar red\nproperty uchar green\nproperty uchar blue\n" in ply.read_bytes()[:400]
    header = next(folder.iterdir()).read_bytes()[:400].decode("latin-1")
    assert "FIELDS x y z deskewed_t colored rgb" in header
    assert "TYPE F F F U U F" in header
    with coframe.open_bag(bag) as recording:
        message = next(recording.messages("/points")).message
    packed = np.ascontiguousarray(field_of(message, "rgb")).reshape(-1).view("<u4")
    color = np.stack([packed >> 16, packed >> 8 & 255, packed & 255], axis=1)
    np.testing.assert_array_equal(color, rgb(cloud.points))


@pytest.mark.parametrize(("topic", "accuracy"), [("/depth/image_raw", 6e-4), ("/depth/meters", 1e-5)])
def test_depth_images_are_clouds(path, topic, accuracy):
    with coframe.open_bag(path) as recording:
        (cloud,) = Clouds(recording, topic, "map", color="/cam/image_raw")
    assert len(cloud.points) > 50_000
    x = cloud.points["x"]
    assert np.minimum(abs(x - WALL_X), abs(x - BOX_X)).max() < 2 * accuracy
    assert (x < 7).sum() > 2000
    assert (rgb(cloud.points)[x < 7] == BLUE).all(axis=1).mean() > 0.98
    assert cloud.points["colored"].mean() > 0.99


def test_rectified_depth_images_use_p():
    info = camera_info(TAKEN, r=[1.0, 0, 0, 0, 1, 0, 0, 0, 1])
    info.p = [100.0, 0, 150, -5, 0, 100, 90, 0, 0, 0, 1, 0]
    points = depth_points(np.full((200, 320), 2.0), CameraModel.from_info(info), rectified=True)
    np.testing.assert_allclose(points[90, 150], [0, 0, 2])
    np.testing.assert_allclose(points[90, 250], [2, 0, 2])
    coarse = depth_points(np.full((200, 320), 2.0), CameraModel.from_info(info), rectified=True, step=10)
    np.testing.assert_allclose(coarse, points[::10, ::10])


def test_a_grazing_plane_hides_nothing():
    """The ground before a camera gets nearer quickly below each point; the points there do not hide it."""
    camera = CameraModel.from_info(camera_info(0, d=()))
    z, x = np.meshgrid(np.geomspace(2, 60, 200), np.linspace(-1, 1, 200))
    for ground in ([x * z, np.full(z.shape, 0.8), z], [np.full(z.shape, 0.8), x * z / 2, z]):
        points = np.stack(ground, axis=-1).reshape(-1, 3)
        inside = camera.contains(camera.project(points))
        image = np.full((200, 320), 9, np.uint8)
        assert (color_points(points, image, camera).visible == inside).all()


def test_what_cannot_be_colored_is_reported(path, tmp_path):
    def run(*arguments):
        result = CliRunner().invoke(app, ["cloud", str(path), *arguments, "-o", str(tmp_path / "out.ply")])
        return result.exit_code, result.output

    colored = run("/points", "--frame", "map", "--color", "cam/image_raw")
    assert colored[0] == 0
    assert "points colored)" in colored[1]
    for arguments, sentence in {
        ("/late/points", "--color", "/cam/image_raw"): "no image of /cam/image_raw is within 0.5 s",
        ("/points", "--color", "/small/image_raw"): "160 x 100 pixels, but its CameraInfo describes 320 x 200",
    }.items():
        code, output = run(*arguments, "--frame", "map")
        assert code == 0, output
        assert sentence in output
    for arguments, sentence in {
        ("/points", "--color", "/alone/image_raw"): "There is no CameraInfo on /alone/camera_info",
        ("/points", "--color", "/points"): "/points has type sensor_msgs/msg/PointCloud2, not Image or CompressedImage",
        ("/points", "--color", "/nowhere"): "/nowhere",
        ("/cam/image_raw",): "'rgb8' is not an encoding of depths",
    }.items():
        code, output = run(*arguments, "--frame", "map")
        assert code == 1, output
        assert sentence in output
    assert run("/points", "--frame", "map", "--color", "/alone/image_raw", "--color-info", "/cam/camera_info")[0] == 0


def test_compressed_images_of_any_size_are_safe(path, tmp_path):
    """A small file that claims to be an image of 3.6 gigapixels is not decoded."""
    cv2 = pytest.importorskip("cv2")
    _, colors = seen(camera_info(TAKEN), TAKEN)
    whole = cv2.imencode(".png", colors[:, :, ::-1])[1].tobytes()
    huge = whole[:16] + struct.pack(">II", 60_000, 60_000) + whole[24:]
    with coframe.open_bag(path) as recording:
        reference = Clouds(recording, "/points", "map", color="/cam/image_raw")
        (expected,) = reference
    for data, colored in ((whole, reference.colored), (huge, 0), (whole[:300], 0), (b"GIF89a", 0)):
        image = find("sensor_msgs/msg/CompressedImage")(format="png", data=data)
        image.header = image_message("rgb8", colors, TAKEN).header
        messages = [
            ("/points", sweep(START + SECOND)),
            ("/c/camera_info", camera_info(TAKEN)),
            ("/c/i/compressed", image),
        ]
        types = {topic: (type(message).ROS_TYPE, "ros2msg", b"", "cdr") for topic, message in messages}
        rows = [(topic, TAKEN, serialize(message)) for topic, message in messages]
        rows += [("/tf", at, cdr) for at, cdr in transforms()]
        with coframe.open_bag(recordings.write_mcap(tmp_path / "run.mcap", rows=rows, types=types)) as recording:
            clouds = Clouds(recording, "/points", "map", color="/c/i/compressed", color_info="/c/camera_info")
            (cloud,) = clouds
        assert clouds.colored == colored
        assert bool(clouds.not_colored) == (colored == 0)
        np.testing.assert_array_equal(xyz(cloud.points), xyz(expected.points))
