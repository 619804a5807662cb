# SPDX-License-Identifier: Apache-2.0
"""A message of every type that the viewer displays, on a live graph, drawn in one page: positions, colors and values.

One connection publishes everything, and one page shows everything. Each test reads what is drawn of one display.
"""

import json
import struct
import threading
import time
import zlib
from array import array
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("dds_library", reason="live displays need DDS")

import coframe
from coframe.messages import find
from coframe.viewer.rviz.config import RvizConfig
from coframe.wire.qos import QoS

SECOND = 1_000_000_000
PERIOD = 0.2  # seconds between two publications of everything
LATCHED = QoS(depth=1, transient_local=True)
# A camera whose optical frame looks along x of map, at (0, 0, 2).
OPTICAL = coframe.Transform([0.0, 0.0, 2.0], [-0.5, 0.5, -0.5, 0.5])
URDF = """<robot name="arm">
<link name="base"/><link name="upper"/>
<joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 1"/>
<axis xyz="0 1 0"/><limit lower="-2" upper="2" effort="10" velocity="1"/></joint>
<link name="hand"/>
<joint name="wrist" type="fixed"><parent link="upper"/><child link="hand"/><origin xyz="1 0 0"/></joint>
</robot>"""


def make(ros_type, frame="map", **fields):
    """Return a message in a frame, stamped 0: the newest transform."""
    made = find(ros_type)(**fields)
    if hasattr(made, "header"):
        made.header.frame_id = frame
    return made


def geometry(name, **fields):
    return find(f"geometry_msgs/msg/{name}")(**fields)


def pose(x=0.0, y=0.0, z=0.0):
    made = geometry("Pose")
    made.position.x, made.position.y, made.position.z = x, y, z
    made.orientation.w = 1.0
    return made


def vectors(ros_type, part, first, second):
    made = make(ros_type, "base")
    names = ("force", "torque") if part == "wrench" else ("linear", "angular")
    for name, (x, y, z) in zip(names, (first, second), strict=True):
        vector = getattr(getattr(made, part), name)
        vector.x, vector.y, vector.z = float(x), float(y), float(z)
    return made


def cloud(columns):
    """Return a PointCloud2 from (name, dtype, values)."""
    layout = np.dtype([(name, dtype) for name, dtype, _ in columns])
    values = np.zeros(len(columns[0][2]), layout)
    for name, _, column in columns:
        values[name] = column
    made = make("sensor_msgs/msg/PointCloud2", height=1, width=len(values))
    made.point_step, made.row_step = values.itemsize, values.nbytes
    numbers = {"<f4": 7, "<u2": 4, "u1": 2}
    field = find("sensor_msgs/msg/PointField")
    made.fields = [
        field(name=name, offset=layout.fields[name][1], datatype=numbers[dtype], count=1) for name, dtype, _ in columns
    ]
    made.data = array("B", values.tobytes())
    return made


XYZ = [("x", "<f4", [0.0, 1.0, 2.0]), ("y", "<f4", [0.0, 0.0, 0.0]), ("z", "<f4", [0.0, 1.0, 3.0])]


def image(encoding, pixels):
    made = make("sensor_msgs/msg/Image", "camera", encoding=encoding)
    made.height, made.width, made.step = pixels.shape[0], pixels.shape[1], pixels.strides[0]
    made.data = array("B", pixels.tobytes())
    return made


def depth_png(depths):
    """Return a 16-bit gray PNG, without filters."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + row.astype(">u2").tobytes() for row in depths)
    header = struct.pack(">IIBBBBB", depths.shape[1], depths.shape[0], 16, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


DEPTHS = np.arange(1000, 1048, dtype=np.uint16).reshape(6, 8)
GRAY = np.arange(48, dtype=np.uint8).reshape(6, 8) * 5
COLORS = np.stack([GRAY, np.full_like(GRAY, 60), 255 - GRAY], axis=-1)
WIDE = np.concatenate([COLORS, np.full((6, 8, 1), 255, np.uint8)], axis=-1)
# Encoding, pixels, and the value in the middle (row 3, column 4: GRAY is 140 there).
IMAGES = {
    "mono8": (GRAY, "140"),
    "8UC1": (GRAY, "140"),
    "rgb8": (COLORS, "140 60 115"),
    "bgr8": (COLORS, "115 60 140"),
    "8UC3": (COLORS, "115 60 140"),
    "rgba8": (WIDE, "140 60 115"),
    "bgra8": (WIDE, "115 60 140"),
    "8UC4": (WIDE, "115 60 140"),
    "mono16": (DEPTHS, "1028"),
    "16UC1": (DEPTHS, "1028"),
    "16SC1": (DEPTHS.astype("<i2") - 2000, "-972"),
    "32FC1": (DEPTHS.astype("<f4") / 1000, "1.028"),
    "64FC1": (DEPTHS.astype("<f8") / 1000, "1.028"),
    "rgb16": (COLORS.astype("<u2") * 257, "140 60 115"),
    "bgr16": (COLORS.astype("<u2") * 257, "115 60 140"),
    "32FC3": (COLORS.astype("<f4") / 255, "115 60 140"),
    "bayer_rggb8": (np.full_like(GRAY, 90), "90 90 90"),
    "bayer_bggr8": (np.full_like(GRAY, 90), "90 90 90"),
    "bayer_gbrg8": (np.full_like(GRAY, 90), "90 90 90"),
    "bayer_grbg16": (np.full(GRAY.shape, 90 * 257, "<u2"), "90 90 90"),
    "yuv422": (np.stack([np.full_like(GRAY, 128), np.full_like(GRAY, 126)], -1), "128 128 128"),
    "yuv422_yuy2": (np.stack([np.full_like(GRAY, 126), np.full_like(GRAY, 128)], -1), "128 128 128"),
    "nv12": (np.vstack([np.full_like(GRAY, 126), np.full((3, 8), 128, np.uint8)]), "128 128 128"),
    "nv21": (np.vstack([np.full_like(GRAY, 126), np.full((3, 8), 128, np.uint8)]), "128 128 128"),
}
SENSORS = {"Temperature": 40.0, "RelativeHumidity": 0.5, "Illuminance": 250.0, "FluidPressure": 101325.0}
FIELDS = {"RelativeHumidity": "relative_humidity", "FluidPressure": "fluid_pressure"}


def detection(kind):
    made = make(f"vision_msgs/msg/Detection{kind}", id="7")
    result = find("vision_msgs/msg/ObjectHypothesisWithPose")()
    result.hypothesis.class_id, result.hypothesis.score = "pallet", 0.9
    made.results = [result]
    if kind == "3D":
        made.bbox.center = pose(1.0, 2.0, 3.0)
        made.bbox.size.x, made.bbox.size.y, made.bbox.size.z = 1.0, 2.0, 0.5
    else:
        made.bbox.center.position.x, made.bbox.center.position.y = 4.0, 3.0
        made.bbox.size_x, made.bbox.size_y = 2.0, 2.0
    return made


def trajectory():
    made = make("trajectory_msgs/msg/JointTrajectory", "base", joint_names=["shoulder"])
    point = find("trajectory_msgs/msg/JointTrajectoryPoint")
    made.points = [point(positions=[0.0]), point(positions=[np.pi / 2])]
    return made


def messages():
    """Return (display, topic, message, options) for all displays with one message."""
    yield (
        "PolygonStamped",
        "Polygon",
        make(
            "geometry_msgs/msg/PolygonStamped",
            "base",
            polygon=geometry("Polygon", points=[geometry("Point32", x=x, y=y) for x, y in ((1.0, 0.0), (0.0, 1.0))]),
        ),
        {},
    )
    yield "point", "PointStamped", make("geometry_msgs/msg/PointStamped", "base", point=geometry("Point", z=0.5)), {}
    yield "wrench", "Wrench", vectors("geometry_msgs/msg/WrenchStamped", "wrench", (2.0, 0, 0), (0, 1.0, 0)), {}
    yield "twist", "TwistStamped", vectors("geometry_msgs/msg/TwistStamped", "twist", (1.0, 0, 0), (0, 0, 0.1)), {}
    yield "accel", "AccelStamped", vectors("geometry_msgs/msg/AccelStamped", "accel", (0, 3.0, 0), (0, 0, 1.0)), {}
    yield (
        "cells",
        "GridCells",
        make(
            "nav_msgs/msg/GridCells",
            "base",
            cell_width=0.5,
            cell_height=0.25,
            cells=[geometry("Point", x=1.0), geometry("Point", x=2.0)],
        ),
        {},
    )
    stamped = make("geometry_msgs/msg/PoseStamped", pose=pose(1.0))
    path = make("nav_msgs/msg/Path", "turned", poses=[stamped, make("geometry_msgs/msg/PoseStamped", pose=pose(2.0))])
    arrows = {"Pose Style": "Arrows", "Shaft Length": 0.5, "Head Length": 0.25, "Head Diameter": 0.2}
    yield "path", "Path", path, {"Offset": {"X": 0.0, "Y": 0.0, "Z": 3.0}, **arrows}
    poses = make("geometry_msgs/msg/PoseArray", "base", poses=[pose(1.0)])
    yield "flat_arrows", "PoseArray", poses, {"Shape": "Arrow (Flat)", "Arrow Length": 2.0}
    for name, value in SENSORS.items():
        made = make(f"sensor_msgs/msg/{name}", "base")
        setattr(made, FIELDS.get(name, name.lower()), value)
        yield name.lower(), name, made, {}
    channel = find("sensor_msgs/msg/ChannelFloat32")
    yield (
        "cloud1",
        "PointCloud",
        make(
            "sensor_msgs/msg/PointCloud",
            "base",
            points=[geometry("Point32", x=1.0), geometry("Point32", x=2.0)],
            channels=[channel(name="intensity", values=[5.0, 9.0])],
        ),
        {},
    )
    rings = [
        *XYZ,
        ("ring", "u1", [3, 5, 7]),
        ("r", "<f4", [1.0, 0, 0]),
        ("g", "<f4", [0, 1.0, 0]),
        ("b", "<f4", [0, 0, 1.0]),
    ]
    intensity = {"Color Transformer": "Intensity", "Channel Name": "ring"}
    fixed = {"Autocompute Intensity Bounds": False, "Min Intensity": 0.0, "Max Intensity": 14.0}
    gray = {"Use rainbow": False, "Min Color": "0; 0; 0", "Max Color": "255; 255; 255"}
    yield "ring", "PointCloud2", cloud(rings), intensity
    yield "ring_inverted", "PointCloud2", cloud(rings), intensity | {"Invert Rainbow": True}
    yield "ring_gray", "PointCloud2", cloud(rings), intensity | fixed | gray
    yield "rgbf", "PointCloud2", cloud(rings), {"Color Transformer": "RGBF32", "Style": "Boxes", "Size (m)": 0.4}
    yield "balls", "PointCloud2", cloud(rings), {"Color Transformer": "RGBF32", "Style": "Spheres", "Size (m)": 0.4}
    yield "nothing", "PointCloud2", cloud(XYZ), {"Color Transformer": "Intensity", "Channel Name": "label"}
    limits = {"Value": False, "Min Value": 0.0, "Max Value": 3.0}
    level = cloud([*XYZ[:2], ("z", "<f4", [0.5, 0.5, 0.5])])
    yield "level", "PointCloud2", level, {}
    yield "level_too", "PointCloud2", level, {}
    yield "level_chosen", "PointCloud2", level, {"Color Transformer": "AxisColor"}
    yield "height", "PointCloud2", cloud(XYZ), {"Autocompute Value Bounds": limits}
    for encoding, (pixels, _) in IMAGES.items():
        made = image(encoding, pixels)
        if encoding.startswith("nv"):
            made.height = 6
        yield f"image/e_{encoding}", "Image", made, {"Width": 60}
    compressed = make("sensor_msgs/msg/CompressedImage", "camera", format="16UC1; compressedDepth png")
    compressed.data = array("B", struct.pack("<iff", 0, 0.0, 0.0) + depth_png(DEPTHS))
    yield "image/compressedDepth", "Image", compressed, {"Width": 60}
    video = make("sensor_msgs/msg/CompressedImage", "camera", format="h264")
    video.data = array("B", b"\0\0\0\1\x67\x42\0\x1f" + b"\0\0\1\x65" + bytes(range(20)))
    yield "image/video", "Image", video, {"Width": 60}
    info = make("sensor_msgs/msg/CameraInfo", "camera", width=8, height=6)
    info.k = [8.0, 0.0, 4.0, 0.0, 8.0, 3.0, 0.0, 0.0, 1.0]
    yield "depth/camera_info", "CameraInfo", info, {}
    yield (
        "depth/image_rect",
        "DepthCloud",
        image("16UC1", np.full((6, 8), 2000, "<u2")),
        {"Color Image Topic": "/depth/colors"},
    )
    yield "depth/colors", "Image", image("rgb8", COLORS), {"Width": 60}
    boxes = find("vision_msgs/msg/BoundingBox3D")(center=pose(2.0))
    boxes.size.x = boxes.size.y = boxes.size.z = 1.0
    yield "boxes", "BoundingBox3DArray", make("vision_msgs/msg/BoundingBox3DArray", "base", boxes=[boxes]), {}
    yield "object", "Detection3D", detection("3D"), {}
    yield "objects", "Detection3DArray", make("vision_msgs/msg/Detection3DArray", detections=[detection("3D")]), {}
    flat = detection("2D")
    flat.header.frame_id = "camera"
    yield "rectangle", "Detection2D", flat, {}
    yield (
        "rectangles",
        "Detection2DArray",
        make("vision_msgs/msg/Detection2DArray", "camera", detections=[detection("2D")]),
        {},
    )
    particle = find("nav2_msgs/msg/Particle")
    yield (
        "particles",
        "ParticleCloud",
        make(
            "nav2_msgs/msg/ParticleCloud",
            particles=[particle(pose=pose(1.0), weight=0.5), particle(pose=pose(2.0), weight=1.0)],
        ),
        {"Max Arrow Length": 1.0, "Min Arrow Length": 0.0},
    )
    voxels = make("nav2_msgs/msg/VoxelGrid", size_x=2, size_y=1, size_z=3)
    voxels.data, voxels.resolutions.x = array("I", [0x00010001, 0x00000004]), 0.5
    voxels.resolutions.y = voxels.resolutions.z = 0.5
    yield "voxels", "VoxelGrid", voxels, {"Show Unknown": True}
    imu = make("sensor_msgs/msg/Imu", "base")
    imu.orientation.z = imu.orientation.w = np.sqrt(0.5)
    imu.linear_acceleration.z = 9.8
    yield "imu", "Imu", imu, {}
    yield "joint_states", "Effort", make("sensor_msgs/msg/JointState", "", name=["shoulder"], effort=[5.0]), {}
    yield "trajectory", "JointTrajectory", trajectory(), {}
    status = find("diagnostic_msgs/msg/DiagnosticStatus")
    yield (
        "diagnostics",
        "DiagnosticArray",
        make(
            "diagnostic_msgs/msg/DiagnosticArray",
            "",
            status=[status(level=b"\0", name="camera", message="ok"), status(level=b"\2", name="motor", message="hot")],
        ),
        {},
    )


class Everything:
    """Publishes all messages repeatedly, with the transforms of base and camera."""

    def __init__(self, ros):
        self.ros = ros
        self.displays = []
        self.made = []
        for name, kind, message, options in messages():
            topic = f"/{name}"
            self.made.append((ros.publisher(topic, type(message), 3), message))
            self.displays.append({"class": kind, "name": name, "enabled": True, "topic": topic, "options": options})
        self.grid = make("nav_msgs/msg/OccupancyGrid")
        self.grid.info.width = self.grid.info.height = 10
        self.grid.info.resolution = 0.5
        self.grid.info.origin.orientation.w = 1.0
        self.grid.data = array("b", [0] * 100)
        self.maps = ros.publisher("/map", type(self.grid), LATCHED)
        self.updates = ros.publisher("/map_updates", find("map_msgs/msg/OccupancyGridUpdate"), 10)
        self.displays.append({"class": "Map", "name": "map", "enabled": True, "topic": "/map", "options": {}})
        fix = find("sensor_msgs/msg/NavSatFix")
        self.fixes = ros.publisher("/fix", fix, 3)
        self.displays.append({"class": "NavSatFix", "name": "fix", "enabled": True, "topic": "/fix", "options": {}})
        robot = find("std_msgs/msg/String")
        self.robots = ros.publisher("/robot_description", robot, LATCHED)
        self.robots.publish(robot(data=URDF))
        self.maps.publish(self.grid)
        self.ended = threading.Event()
        self.thread = threading.Thread(target=self._run)
        self.thread.start()

    def close(self):
        self.ended.set()
        self.thread.join()

    def _run(self):
        ros = self.ros
        ros.send_static("map", "camera", OPTICAL)
        ros.send_static("map", "turned", coframe.Transform.from_rpy([0.0, 0.0, 0.0], [np.pi, 0.0, np.pi / 2]))
        count = 0
        while not self.ended.wait(PERIOD):
            now = time.time_ns()
            ros.send("map", "base", coframe.Transform([10.0, 0.0, 0.0]), stamp=now)
            ros.send("base", "upper", coframe.Transform([0.0, 0.0, 1.0]), stamp=now)
            for publisher, message in self.made:
                publisher.publish(message)
            fix = make("sensor_msgs/msg/NavSatFix", "gps", latitude=52.0 + 1e-5 * (count % 2), longitude=13.0)
            self.fixes.publish(fix)
            count += 1

    def update(self, x, y, width, height, value):
        cells = array("b", [value] * (width * height))
        made = make("map_msgs/msg/OccupancyGridUpdate", x=x, y=y, width=width, height=height, data=cells)
        self.updates.publish(made)


@pytest.fixture(scope="module")
def shown(shared_page, claim_domain, tmp_path_factory):
    """Return the page that shows everything, and its publisher."""
    with claim_domain() as domain, coframe.connect("everything", domain=domain) as ros:
        everything = Everything(ros)
        file = tmp_path_factory.mktemp("rviz") / "all.rviz"
        tf = {"class": "TF", "name": "TF", "enabled": True, "topic": None, "options": {}}
        file.write_text(RvizConfig().merged([tf, *everything.displays], {"fixed_frame": "map"}, {}).text())
        viewer = coframe.show(ros, rviz=file, port=0)
        try:
            with shared_page(viewer.url) as page:
                yield SimpleNamespace(page=page.drawn(), everything=everything)
        finally:
            viewer.close()
            everything.close()


def drawn(shown, name):
    """Wait until a display has drawn its message without a problem, and return the newest drawing."""
    found = f"coframe.displays[{json.dumps(name)}]"
    shown.page.until(f"{found}?.state === 'ok' && {found}.messages.length > 0")
    return shown.page.evaluate(f"{found}.messages.at(-1)")


def test_polygons_points_and_vectors(shown):
    assert drawn(shown, "PolygonStamped")["corners"] == [1, 0, 0, 0, 1, 0]
    point = drawn(shown, "point")
    np.testing.assert_allclose([point["min"], point["max"]], [[9.8, -0.2, 0.3], [10.2, 0.2, 0.7]], atol=1e-3)
    assert drawn(shown, "wrench")["lengths"] == [4.0, 2.0], "twice the force and the torque"
    assert drawn(shown, "twist")["lengths"] == [2.0], "small values are hidden"
    assert drawn(shown, "accel")["vectors"] == [[0, 3, 0], [0, 0, 1]]
    imu = drawn(shown, "imu")
    np.testing.assert_allclose(imu["orientation"], [0, 0, np.sqrt(0.5), np.sqrt(0.5)], atol=1e-6)
    assert imu["parts"] == 2, "axes and an acceleration"


def test_paths_and_arrays_of_poses_have_the_options_of_rviz(shown):
    path = drawn(shown, "path")
    low, high = np.array([path["min"], path["max"]])
    np.testing.assert_allclose([low[1], high[1], (low[2] + high[2]) / 2], [1.0, 2.75, 3.0], atol=1e-3)
    np.testing.assert_allclose([low[2], high[2]], [2.9, 3.1], atol=1e-2, err_msg="the offset is in the fixed frame")
    flat = drawn(shown, "flat_arrows")
    np.testing.assert_allclose([flat["min"], flat["max"]], [[11, -0.24, 0], [13, 0.24, 0]], atol=1e-3)


def test_cells_and_voxels(shown):
    cells = drawn(shown, "cells")
    assert cells["counts"] == [2]
    np.testing.assert_allclose([cells["min"], cells["max"]], [[10.75, -0.125, 0], [12.25, 0.125, 0]], atol=1e-3)
    voxels = drawn(shown, "voxels")
    assert voxels["counts"] == [1, 1], "one is marked, one unknown"
    np.testing.assert_allclose([voxels["min"], voxels["max"]], [[0, 0, 0], [1.0, 0.5, 1.5]], atol=1e-3)


@pytest.mark.parametrize("name", SENSORS)
def test_measured_values_are_colored_points(shown, name):
    point = drawn(shown, name.lower())
    assert point["points"] == 1
    np.testing.assert_allclose(point["position"], [10, 0, 0], atol=1e-4)
    low, high = point["colors"]
    assert low < SENSORS[name] < high


def rgb(text):
    return [int(part) for part in text[4:-1].split()]


def test_clouds_are_colored_by_any_channel(shown):
    assert drawn(shown, "cloud1")["colors"] == [5, 9]
    rings = drawn(shown, "ring")
    assert rings["colors"] == [3, 7]
    red, _, blue = map(rgb, rings["shades"])
    assert red[0] > max(red[1:]), "the smallest value is red, as in RViz"
    assert blue[0] < red[0]
    assert drawn(shown, "ring_inverted")["shades"] == rings["shades"][::-1]
    assert [rgb(shade)[0] for shade in drawn(shown, "ring_gray")["shades"]] == [55, 91, 127]
    assert drawn(shown, "height")["colors"] == [0, 3]
    assert drawn(shown, "rgbf")["shades"] == ["rgb(255 0 0)", "rgb(0 255 0)", "rgb(0 0 255)"]
    shown.page.until("coframe.displays.nothing.state === 'error'")
    assert "no channel 'label'. Channels: x, y, z" in shown.page.evaluate("coframe.displays.nothing.text")


def test_flat_clouds_have_different_colors_unless_the_user_chooses_them(shown):
    first, second, chosen = (set(drawn(shown, name)["shades"]) for name in ("level", "level_too", "level_chosen"))
    assert len(first) == len(second) == len(chosen) == 1
    assert first != second
    assert chosen == {"rgb(150 250 80)"}, "the middle of the scale"


@pytest.mark.parametrize("encoding", IMAGES)
def test_images_of_every_encoding_have_their_values(shown, encoding):
    found = drawn(shown, f"image/e_{encoding}")
    assert (found["width"], found["height"], found["value"]) == (8, 6, IMAGES[encoding][1])
    shown.page.until(f"coframe.displays['image/e_{encoding}'].messages.at(-1)?.painted")


def test_a_video_that_the_browser_cannot_decode_is_reported_in_one_sentence(shown):
    status = shown.page.until(
        "coframe.displays['image/video']?.state === 'error' && coframe.displays['image/video'].text"
    )
    assert "decode the video" in status
    assert status.count(". ") == 0


def test_depths_have_a_range_and_become_clouds(shown):
    found = drawn(shown, "image/compressedDepth")
    assert (found["value"], found["range"]) == ("1028", [1000, 1047])
    points = drawn(shown, "depth/image_rect")
    assert points["points"] == 48
    np.testing.assert_allclose(points["first"][:3], [-1.0, -0.75, 2.0], atol=1e-5)
    assert rgb(points["shades"][1]) == COLORS[0, 1].tolist()


def test_detected_objects(shown):
    for name in ("object", "objects"):
        (box,) = drawn(shown, name)["boxes"]
        np.testing.assert_allclose(box["center"], [1, 2, 3], atol=1e-4)
        assert (box["size"], box["label"]) == ([1, 2, 0.5], "pallet 90 % #7")
    (box,) = drawn(shown, "boxes")["boxes"]
    np.testing.assert_allclose(box["center"], [12, 0, 0], atol=1e-4)
    assert drawn(shown, "rectangle")["rectangles"] == [[4, 3, 0, 2, 2]]
    shown.page.until("coframe.displays['image/e_mono8'].messages.at(-1)?.rectangles === 2")


def test_particles_show_their_weights(shown):
    found = drawn(shown, "particles")
    assert found["particles"] == 2
    np.testing.assert_allclose([found["min"][0], found["max"][0]], [1.0, 3.0], atol=1e-3)


def test_joints_are_drawn_on_the_robot(shown):
    (joint,) = (
        shown.page.until("coframe.displays.joint_states.messages?.at(-1)?.joints.length === 1")
        and drawn(shown, "joint_states")["joints"]
    )
    assert (joint["name"], joint["link"], joint["part"]) == ("shoulder", "upper", 0.5)
    shown.page.until("Object.keys(coframe.displays.trajectory.messages?.at(-1)?.paths ?? {}).length > 0")
    path = drawn(shown, "trajectory")["paths"]["hand"]
    np.testing.assert_allclose(path, [1, 0, 1, 0, 0, 0], atol=1e-6)


def test_positions_are_meters_from_the_first_one(shown):
    shown.page.until("coframe.displays.fix.messages?.at(-1)?.points.length >= 6")
    points = np.reshape(drawn(shown, "fix")["points"], (-1, 3))
    np.testing.assert_allclose(points[0], [0, 0, 0], atol=1e-3)
    np.testing.assert_allclose(np.abs(points[1]), [0, 1.1127, 0], atol=1e-3)


def test_diagnostics_are_a_table_with_errors_first(shown):
    assert drawn(shown, "diagnostics")["rows"] == [[2, "motor", "hot"], [0, "camera", "ok"]]
    shown.page.wait(lambda: shown.page.texts(".diagnostics tr td:first-child") == ["Error", "OK"], "the table")


def test_updates_change_a_part_of_a_map(shown):
    counts = "coframe.displays.map?.messages?.at(-1)?.counts"
    shown.page.until(f"{counts}?.[0] === 100")
    shown.everything.update(0, 2, 5, 2, 100)
    shown.page.until(f"{counts}?.[100] === 10")
    shown.everything.update(0, 4, 5, 1, -1)
    shown.page.until(f"{counts}?.[100] === 10 && {counts}[-1] === 5 && {counts}[0] === 85")
    shown.everything.update(8, 8, 5, 5, 1)
    shown.page.until("coframe.displays.map.state === 'error' && coframe.displays.map.text.includes('does not fit')")
