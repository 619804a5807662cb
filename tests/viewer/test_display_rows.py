# SPDX-License-Identifier: Apache-2.0
"""Every display of the viewer: its message types, its options in .rviz files, its drawings, its replay and its guide.

`PROMISED` is what users' .rviz files and topics rely on. A display or a part of its row that is missing fails the test
with its name.
"""

import dataclasses
import re
from array import array
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("mcap", reason="the recordings of these tests are written by mcap")

import recordings

import coframe
from coframe.messages import find, serialize
from coframe.viewer.displays import CannotDrawError, Options
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import QUALITY_OPTIONS, DisplayRow, NumberOption
from coframe.viewer.displays.resources import Resources
from coframe.viewer.displays.rows import DISPLAY_OF_TYPE, DISPLAYS, MAX_AUTOMATIC_DISPLAYS, displayable
from coframe.viewer.replay.export import export_replay
from coframe.viewer.robots.robot_message import make_mesh_table
from coframe.viewer.rviz.config import RvizConfig
from coframe.viewer.sources.recorded import RecordedSource

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND
ROOT = Path(__file__).resolve().parents[2]

POSE = {
    "Shape": ("Arrow", "Axes"),
    "Color": "#ff8a1f",
    "Alpha": 1.0,
    "Shaft Length": 0.35,
    "Shaft Radius": 0.02,
    "Head Length": 0.12,
    "Head Radius": 0.045,
    "Axes Length": 0.3,
    "Axes Radius": 0.02,
}
NESTED_POSE = {"Shape/Value" if key == "Shape" else f"Shape/{key}": value for key, value in POSE.items()}
COVARIANCE = {
    "Covariance/Value": True,
    "Covariance/Position/Value": True,
    "Covariance/Position/Scale": 1.0,
    "Covariance/Position/Color": "#cc33cc",
    "Covariance/Position/Alpha": 0.3,
    "Covariance/Orientation/Value": True,
    "Covariance/Orientation/Scale": 1.0,
    "Covariance/Orientation/Offset": 1.0,
    "Covariance/Orientation/Color": "#ffff7f",
    "Covariance/Orientation/Alpha": 0.5,
}
POINTS = {
    "Color Transformer": ("Intensity", "AxisColor", "RGB8", "RGBF32", "FlatColor", "Distance"),
    "Channel Name": "intensity",
    "Use rainbow": True,
    "Invert Rainbow": False,
    "Min Color": "#000000",
    "Max Color": "#ffffff",
    "Autocompute Intensity Bounds": True,
    "Min Intensity": 0.0,
    "Max Intensity": 4096.0,
    "Axis": ("X", "Y", "Z"),
    "Use Fixed Frame": True,
    "Autocompute Value Bounds/Value": True,
    "Autocompute Value Bounds/Min Value": -10.0,
    "Autocompute Value Bounds/Max Value": 10.0,
    "Color": "#ff5a36",
    "Style": ("Points", "Squares", "Flat Squares", "Spheres", "Boxes", "Tiles"),
    "Size (Pixels)": 3.0,
    "Size (m)": 0.01,
    "Alpha": 1.0,
    "Decay Time": 0.0,
}


def value(channel, low, high, *, invert=False):
    """Return the options of a display of a single measured value."""
    bounds = {"Autocompute Intensity Bounds": False, "Min Intensity": low, "Max Intensity": high}
    return POINTS | {"Channel Name": channel, "Invert Rainbow": invert, "Size (m)": 0.1} | bounds


def screw(linear, angular):
    """Return the options of a display of two vectors."""
    colors = {f"{linear} Color": "#cc3333", f"{angular} Color": "#cccc33"}
    scales = {f"{linear} Arrow Scale": 2.0, f"{angular} Arrow Scale": 2.0}
    return colors | scales | {"Alpha": 1.0, "Arrow Width": 0.5, "Hide Small Values": True, "History Length": 1.0}


IMAGE = {
    "Width": 260.0,
    "Normalize Range": True,
    "Min Value": 0.0,
    "Max Value": 1.0,
    "Median window": 5.0,
    "Project Frames": True,
    "Project Clouds": True,
    "Project Shapes": True,
    "Project Detections": True,
    "Far Plane Distance": 100.0,
    "Image Rendering": ("background", "overlay", "background and overlay"),
    "Overlay Alpha": 0.5,
    "Zoom Factor": 1.0,
    "Rectified": ("By topic", "Yes", "No"),
}
BOX = {"Color": "", "Alpha": 0.4, "Only Edge": False, "Line Width": 0.03}
LABELS = {"Show Labels": True, "Show Score": True}
RECTANGLE = {"Color": "", "Line Width": 2.0} | LABELS
FFMPEG = "ffmpeg_image_transport_msgs/msg/FFMPEGPacket"
IMAGES = ("sensor_msgs/msg/CompressedImage", "sensor_msgs/msg/Image")

# The message types of each display; the options with their keys in .rviz files and their defaults, or their choices;
# and whether the page chooses it by itself, draws it above images, finds points on it, and a replay may thin it.
PROMISED = {
    "AccelStamped": (("geometry_msgs/msg/AccelStamped",), screw("Linear", "Angular"), "chosen projected solid"),
    "Axes": ((), {"Length": 1.0, "Radius": 0.1, "Alpha": 1.0, "Reference Frame": "<Fixed Frame>"}, "chosen"),
    "Camera": (IMAGES, IMAGE | {"Project": True}, "large"),
    "CameraInfo": (
        ("sensor_msgs/msg/CameraInfo",),
        {
            "Far clip": 0.5,
            "Show polygons": True,
            "Not show side polygons": False,
            "Color": "#f5d90a",
            "Alpha": 0.15,
            "Show edges": True,
            "Edge color": "#f5d90a",
        },
        "chosen solid",
    ),
    "Grid": (
        (),
        {
            "Cell Size": 1.0,
            "Plane Cell Count": 10.0,
            "Normal Cell Count": 0.0,
            "Line Style/Value": ("Lines", "Billboards"),
            "Line Style/Line Width": 0.03,
            "Offset/X": 0.0,
            "Offset/Y": 0.0,
            "Offset/Z": 0.0,
            "Plane": ("XY", "XZ", "YZ"),
            "Color": "",
            "Alpha": 0.5,
            "Reference Frame": "<Fixed Frame>",
        },
        "chosen",
    ),
    "Image": ((FFMPEG, *IMAGES), IMAGE | {"Project": False}, "large"),
    "LaserScan": (("sensor_msgs/msg/LaserScan",), POINTS | {"Size (m)": 0.03}, "chosen solid"),
    "Map": (
        ("nav_msgs/msg/OccupancyGrid",),
        {
            "Alpha": 0.7,
            "Color Scheme": ("map", "costmap", "raw"),
            "Draw Behind": False,
            "Use Timestamp": False,
            "Update Topic/Value": "",
            "Binary representation": False,
            "Binary threshold": 100.0,
        },
        "chosen solid",
    ),
    "Marker": (("visualization_msgs/msg/Marker",), {}, "chosen projected solid"),
    "MarkerArray": (("visualization_msgs/msg/MarkerArray",), {}, "chosen projected solid"),
    "Odometry": (("nav_msgs/msg/Odometry",), NESTED_POSE | COVARIANCE | {"Keep": 100.0}, "chosen projected solid"),
    "Path": (
        ("nav_msgs/msg/Path",),
        {
            "Color": "#19d245",
            "Alpha": 1.0,
            "Line Style": ("Lines", "Billboards"),
            "Line Width": 0.03,
            "Buffer Length": 1.0,
            "Offset/X": 0.0,
            "Offset/Y": 0.0,
            "Offset/Z": 0.0,
            "Pose Style": ("None", "Axes", "Arrows"),
            "Length": 0.3,
            "Radius": 0.03,
            "Pose Color": "#ff55ff",
            "Shaft Length": 0.1,
            "Shaft Diameter": 0.1,
            "Head Length": 0.2,
            "Head Diameter": 0.3,
        },
        "chosen projected solid",
    ),
    "PointCloud2": (("sensor_msgs/msg/PointCloud2",), POINTS, "chosen large solid"),
    "Pose": (("geometry_msgs/msg/PoseStamped",), POSE, "chosen projected solid"),
    "PoseArray": (
        ("geometry_msgs/msg/PoseArray",),
        POSE | {"Shape": ("Arrow (Flat)", "Arrow (3D)", "Axes"), "Arrow Length": 0.3},
        "chosen projected solid",
    ),
    "PoseWithCovariance": (
        ("geometry_msgs/msg/PoseWithCovarianceStamped",),
        POSE | COVARIANCE,
        "chosen projected solid",
    ),
    "Range": (("sensor_msgs/msg/Range",), {"Color": "#ffffff", "Alpha": 0.5, "Buffer Length": 1.0}, "chosen solid"),
    "RobotModel": (
        (),
        {"Visual Enabled": True, "Collision Enabled": False, "Alpha": 1.0, "TF Prefix": ""},
        "chosen solid",
    ),
    "TF": (
        (),
        {
            "Show Names": True,
            "Show Axes": True,
            "Show Arrows": True,
            "Marker Scale": 1.0,
            "Frame Timeout": 15.0,
            "Filter (whitelist)": "",
            "Filter (blacklist)": "",
        },
        "chosen",
    ),
    "BoundingBox3DArray": (("vision_msgs/msg/BoundingBox3DArray",), BOX, "chosen projected solid"),
    "DepthCloud": (IMAGES, POINTS | {"Color Image Topic": ""}, "large solid"),
    "Detection2D": (("vision_msgs/msg/Detection2D",), RECTANGLE, "chosen"),
    "Detection2DArray": (("vision_msgs/msg/Detection2DArray",), RECTANGLE, "chosen"),
    "Detection3D": (("vision_msgs/msg/Detection3D",), BOX | LABELS, "chosen projected solid"),
    "Detection3DArray": (("vision_msgs/msg/Detection3DArray",), BOX | LABELS, "chosen projected solid"),
    "DiagnosticArray": (
        ("diagnostic_msgs/msg/DiagnosticArray",),
        {"Width": 360.0, "Show": ("All", "Warnings and errors", "Errors")},
        "",
    ),
    "Effort": (("sensor_msgs/msg/JointState",), {"Alpha": 1.0, "Width": 0.02, "Scale": 1.0}, ""),
    "FluidPressure": (
        ("sensor_msgs/msg/FluidPressure",),
        value("fluid_pressure", 98000.0, 105000.0),
        "chosen solid",
    ),
    "GridCells": (("nav_msgs/msg/GridCells",), {"Color": "#19ff00", "Alpha": 1.0}, "chosen solid"),
    "Illuminance": (("sensor_msgs/msg/Illuminance",), value("illuminance", 0.0, 1000.0), "chosen solid"),
    "Imu": (
        ("sensor_msgs/msg/Imu",),
        {
            "Box properties/Enable box": False,
            "Box properties/x_scale": 0.4,
            "Box properties/y_scale": 0.3,
            "Box properties/z_scale": 0.1,
            "Box properties/Box color": "#ff0000",
            "Box properties/Box alpha": 1.0,
            "Axes properties/Enable axes": True,
            "Axes properties/Axes scale": 0.5,
            "Acceleration properties/Enable acceleration": True,
            "Acceleration properties/Acc. vector scale": 0.05,
            "Acceleration properties/Acc. vector color": "#ffaa00",
            "Acceleration properties/Acc. vector alpha": 1.0,
        },
        "chosen projected solid",
    ),
    "InteractiveMarkers": (
        ("visualization_msgs/msg/InteractiveMarkerInit", "visualization_msgs/msg/InteractiveMarkerUpdate"),
        {"Show Descriptions": True, "Show Axes": False, "Show Visual Aids": False, "Enable Transparency": True},
        "chosen solid",
    ),
    "JointTrajectory": (
        ("trajectory_msgs/msg/JointTrajectory",),
        {"Color": "#e93d82", "Alpha": 1.0, "Show End": True},
        "chosen",
    ),
    "NavSatFix": (
        ("sensor_msgs/msg/NavSatFix",),
        {"Color": "#30a46c", "Alpha": 1.0, "Radius": 0.2, "Keep": 500.0, "Covariance": True, "Reference Frame": ""},
        "chosen solid",
    ),
    "ParticleCloud": (
        ("nav2_msgs/msg/ParticleCloud",),
        {
            "Shape": ("Arrow (Flat)", "Arrow (3D)", "Axes"),
            "Color": "#00b400",
            "Alpha": 1.0,
            "Min Arrow Length": 0.02,
            "Max Arrow Length": 0.3,
        },
        "chosen solid",
    ),
    "PointCloud": (("sensor_msgs/msg/PointCloud",), POINTS, "chosen large solid"),
    "PointStamped": (
        ("geometry_msgs/msg/PointStamped",),
        {"Color": "#cc29cc", "Alpha": 1.0, "Radius": 0.2, "History Length": 1.0},
        "chosen projected solid",
    ),
    "Polygon": (
        ("geometry_msgs/msg/PolygonStamped",),
        {"Color": "#19ff00", "Alpha": 1.0},
        "chosen projected solid",
    ),
    "RelativeHumidity": (
        ("sensor_msgs/msg/RelativeHumidity",),
        value("relative_humidity", 0.0, 1.0),
        "chosen solid",
    ),
    "Temperature": (
        ("sensor_msgs/msg/Temperature",),
        value("temperature", 0.0, 100.0, invert=True),
        "chosen solid",
    ),
    "TwistStamped": (("geometry_msgs/msg/TwistStamped",), screw("Linear", "Angular"), "chosen projected solid"),
    "VoxelGrid": (
        ("nav2_msgs/msg/VoxelGrid",),
        {"Color": "#ff8a1f", "Color By": ("Height", "Color"), "Alpha": 1.0, "Show Unknown": False},
        "chosen solid",
    ),
    "Wrench": (("geometry_msgs/msg/WrenchStamped",), screw("Force", "Torque"), "chosen projected solid"),
}
# The definition of FFMPEGPacket is not part of coframe; test_video.py tests its packets.
TYPES = sorted({ros_type for types, _, _ in PROMISED.values() for ros_type in types} - {FFMPEG})
CLOUDS = {"color_by": "intensity", "channel": "intensity", "axis": "z", "decay": 0.0}
SENT = {
    "AccelStamped": {"history": 1},
    "DepthCloud": CLOUDS | {"color_by": "rgb", "second_topic": ""},
    "FluidPressure": CLOUDS | {"channel": "fluid_pressure"},
    "Illuminance": CLOUDS | {"channel": "illuminance"},
    "LaserScan": CLOUDS,
    "Map": {"use_stamp": False, "second_topic": ""},
    "NavSatFix": {"keep": 500, "frame": ""},
    "Odometry": {"keep": 100},
    "Path": {"history": 1},
    "PointCloud": CLOUDS,
    "PointCloud2": CLOUDS | {"color_by": "axis"},
    "PointStamped": {"history": 1},
    "Range": {"history": 1},
    "RelativeHumidity": CLOUDS | {"channel": "relative_humidity"},
    "Temperature": CLOUDS | {"channel": "temperature"},
    "TwistStamped": {"history": 1},
    "Wrench": {"history": 1},
}


def traits(row):
    found = {
        "chosen": row.automatic,
        "large": row.large_in_replay,
        "projected": row.projected,
        "solid": row.has_surfaces,
    }
    return " ".join(sorted(name for name, has in found.items() if has))


@pytest.mark.parametrize("name", PROMISED)
def test_the_row_of_a_display_is_complete(name):
    types, options, properties = PROMISED[name]
    row = DISPLAYS[name]
    assert tuple(sorted(row.messages)) == types
    own = tuple(option for option in row.options if not option.key.startswith("Topic/"))
    defaults = {option.key: getattr(option, "choices", option.value) for option in own}
    assert defaults == options
    has_quality = bool(types) and name not in {"DepthCloud", "InteractiveMarkers"}
    assert row.options == (own + QUALITY_OPTIONS if has_quality else own)
    assert traits(row) == properties
    sent = dataclasses.asdict(row.server_options({}))
    assert sent["display"] == name
    assert {field: sent[field] for field in SENT.get(name, {})} == SENT.get(name, {})
    assert {option.sets for option in own if option.sets} == SENT.get(name, {}).keys()
    assert all(option.minimum <= option.value <= option.maximum for option in row.options if hasattr(option, "minimum"))
    known = {option.key: getattr(option, "choices", None) for option in row.options}
    for condition in (one for option in row.options if option.needs for one in option.needs.split(" & ")):
        key, _, choices = condition.removeprefix("!").partition("=")
        assert set(choices.split("|")) <= set(known[key]) if choices else known[key] is None


def test_no_display_is_forgotten_in_this_test():
    assert DISPLAYS.keys() == PROMISED.keys()


def header(made, stamp=BEGIN + SECOND // 2):
    made.header.frame_id = "base"
    made.header.stamp.sec, made.header.stamp.nanosec = divmod(stamp, SECOND)
    return made


def sample(ros_type):  # noqa: PLR0911 - one per kind of message
    """Return a message of a type with something to draw, and the kind of its drawing."""
    made = find(ros_type)()
    name = ros_type.rsplit("/", 1)[1]
    if name == "MarkerArray":
        made.markers = [sample("visualization_msgs/msg/Marker")[0]]
        return made, "markers"
    if name.startswith("InteractiveMarker"):
        made.markers, made.seq_num = [header(find("visualization_msgs/msg/InteractiveMarker")(name="grip"))], 1
        return made, "interactive"
    header(made)
    if name == "Marker":
        made.type, made.scale.x, made.color.a = 1, 1.0, 1.0
        return made, "markers"
    if name == "LaserScan":
        made.ranges, made.range_max, made.angle_increment = [1.0, 2.0], 10.0, 0.1
        return made, "cloud"
    if name == "PointCloud2":
        field = find("sensor_msgs/msg/PointField")
        made.fields = [field(name=axis, offset=4 * i, datatype=7, count=1) for i, axis in enumerate("xyz")]
        made.height, made.width, made.point_step, made.row_step = 1, 2, 12, 24
        made.data = array("B", np.ones(6, "<f4").tobytes())
        return made, "cloud"
    if name == "OccupancyGrid":
        made.info.width, made.info.height, made.info.resolution = 2, 1, 0.5
        made.data = array("b", [0, 100])
        return made, "grid"
    if name == "Image":
        made.width, made.height, made.step, made.encoding = 2, 1, 2, "mono8"
        made.data = array("B", [1, 2])
        return made, "image"
    if name == "CompressedImage":
        made.data = array("B", b"\x89PNG\r\n\x1a\n" + b"\0\0\0\rIHDR" + b"\0\0\0\2\0\0\0\1" + bytes(8))
        return made, "image"
    if name in {"Path", "PoseArray"}:
        made.poses = [find("geometry_msgs/msg/PoseStamped" if name == "Path" else "geometry_msgs/msg/Pose")()]
    if name in {"BoundingBox3DArray", "Detection2DArray", "Detection3DArray"}:
        boxes = "boxes" if name.startswith("Bounding") else "detections"
        setattr(made, boxes, [find(f"vision_msgs/msg/{name.removesuffix('Array')}")()])
    if name == "JointState":
        made.name, made.effort = ["shoulder"], [1.0]
    if name == "VoxelGrid":
        made.size_x = made.size_y = made.size_z = 1
        made.data = array("I", [0x10001])
    return made, KINDS.get(name, "poses")


KINDS = {
    "AccelStamped": "screw",
    "BoundingBox3DArray": "boxes",
    "CameraInfo": "camera",
    "Detection2D": "rectangles",
    "Detection2DArray": "rectangles",
    "Detection3D": "boxes",
    "Detection3DArray": "boxes",
    "DiagnosticArray": "diagnostics",
    "FluidPressure": "cloud",
    "GridCells": "cells",
    "Illuminance": "cloud",
    "Imu": "imu",
    "JointState": "efforts",
    "JointTrajectory": "trajectory",
    "NavSatFix": "fix",
    "Odometry": "odometry",
    "ParticleCloud": "particles",
    "Path": "path",
    "PointCloud": "cloud",
    "PointStamped": "point",
    "PolygonStamped": "polygon",
    "Range": "range",
    "RelativeHumidity": "cloud",
    "Temperature": "cloud",
    "TwistStamped": "screw",
    "VoxelGrid": "cells",
    "WrenchStamped": "screw",
}


def topic_of(ros_type):
    name = ros_type.rsplit("/", 1)[1].lower()
    return f"/{name}/update" if name.startswith("interactive") else f"/{name}"


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    """Return a recording with a message of each type, and transforms of its frame."""
    rows, types = recordings.messages(), {}
    for ros_type in TYPES:
        types[topic_of(ros_type)] = (ros_type, "ros2msg", b"", "cdr")
        rows.append((topic_of(ros_type), BEGIN + SECOND // 2, serialize(sample(ros_type)[0])))
    rows.sort(key=lambda row: row[1])
    path = recordings.write_mcap(tmp_path_factory.mktemp("rows") / "all.mcap", rows=rows, types=types)
    with coframe.open_bag(path) as bag:
        yield bag


@pytest.mark.parametrize("ros_type", TYPES)
def test_a_tab_shows_messages_of_each_type(recording, view, open_tab, ros_type):
    tab = open_tab(view(recording, fixed="odom"))
    offered = {topic["topic"]: topic["display"] for topic in tab.has("hello")["topics"]}
    (expected,) = (
        name for name, (types, _, _) in PROMISED.items() if ros_type in types and name not in {"Camera", "DepthCloud"}
    )
    assert offered[topic_of(ros_type)] == expected
    tab.send("subscribe", id=7, topic=topic_of(ros_type), options={})
    update = tab.frame_update(lambda update: update.displays)
    (owner,) = update.displays
    drawn = tab.drawings[owner]
    kind = sample(ros_type)[1]
    assert (drawn.head["kind"] if hasattr(drawn, "head") else tab_kind(drawn)) == kind


def tab_kind(drawn):
    return "cloud" if hasattr(drawn, "points") else "grid" if hasattr(drawn, "cells") else "image"


@pytest.fixture(scope="module")
def replayed(recording):
    """Return a replay of all displays that the viewer chooses by itself."""
    displays = [
        {"class": name, "name": ros_type, "enabled": True, "topic": topic_of(ros_type), "options": {}}
        for name, (types, _, _) in PROMISED.items()
        for ros_type in types
        if DISPLAYS[name].automatic
    ]
    config = RvizConfig().merged(displays, {}, {}).with_fixed_frame("odom")
    return export_replay(RecordedSource(recording), make_mesh_table(None, []), rviz=config, rate=2.0).decode()


@pytest.mark.parametrize("ros_type", [one for one in TYPES if DISPLAY_OF_TYPE[one].automatic])
def test_a_replay_contains_messages_of_each_type(replayed, ros_type):
    found = re.search(rf'"topic":"{topic_of(ros_type)}","type":"{ros_type}".*?"drawings":{{"\d+":"', replayed)
    assert found is not None
    assert len(found[0]) < 500, "the drawing belongs to this display"


@pytest.mark.parametrize("name", PROMISED)
def test_a_display_of_an_rviz_file_is_shown(name):
    config = RvizConfig()
    shown = {"class": name, "name": "mine", "enabled": True, "topic": "/t", "options": {}}
    saved = RvizConfig.parse(config.merged([shown], {}, {}).text())
    description = saved.description()
    assert ([one["class"] for one in description["displays"]], description["unknown"]) == ([name], [])


@pytest.mark.parametrize("name", PROMISED)
def test_the_guide_lists_a_display_and_its_messages(name):
    guide = (ROOT / "docs/how-to/viewer.md").read_text()
    (support, content) = re.search(rf"^\| {name} \| (.+?) \| (.+) \|$", guide, re.MULTILINE).groups()
    assert support == "has" or support.startswith("part: without "), "each part has its reason"
    for ros_type in DISPLAYS[name].messages:
        assert re.search(rf"\b{ros_type.rsplit('/', 1)[1]}\b", content)


def test_the_guide_lists_no_other_displays():
    guide = (ROOT / "docs/how-to/viewer.md").read_text()
    table = guide[guide.index("| display | support | messages |") :].split("\n\n")[0]
    assert sorted(re.findall(r"^\| (\w+) \|", table, re.MULTILINE)[1:]) == sorted(PROMISED)


@pytest.mark.parametrize("name", PROMISED)
def test_the_page_has_a_class_for_each_display(name):
    registry = (ROOT / "viewer/src/displays/registry.ts").read_text()
    assert re.search(rf"^  {name}: \w+,$", registry, re.MULTILINE)


def test_values_of_rviz_files_become_valid_options():
    scan = DISPLAYS["LaserScan"]
    odd = {"Color Transformer": ["x"], "Axis": 3, "Decay Time": float("nan")}
    sent = scan.server_options(odd)
    assert (sent.color_by, sent.axis, sent.decay) == ("intensity", "z", 0.0)
    sent = scan.server_options({"Color Transformer": "RGB8", "Axis": "X", "Decay Time": 1e9})
    assert (sent.color_by, sent.axis, sent.decay) == ("rgb", "x", 3600.0)
    assert DISPLAYS["Odometry"].server_options({"Keep": 12.4}).keep == 12


def test_the_topics_that_are_displayed_automatically_are_the_most_useful_ones():
    clouds = [(f"/camera_{letter}/points", "sensor_msgs/msg/PointCloud2") for letter in "abcdef"]
    others = [
        ("/global_costmap", "nav_msgs/msg/OccupancyGrid"),
        ("/odom", "nav_msgs/msg/Odometry"),
        ("/pose", "geometry_msgs/msg/PoseStamped"),
        ("/rosout", "rcl_interfaces/msg/Log"),
        ("/scan", "sensor_msgs/msg/LaserScan"),
        ("/scan_filtered", "sensor_msgs/msg/LaserScan"),
        ("/camera/image", "sensor_msgs/msg/Image"),
        *((f"/plan_{number}", "nav_msgs/msg/Path") for number in range(9)),
    ]
    found = displayable(clouds + others)
    shown = [one["topic"] for one in found if one["automatic"]]
    assert shown[:2] == ["/scan", "/global_costmap"]
    assert len(shown) == MAX_AUTOMATIC_DISPLAYS
    assert {"/odom", "/pose", "/scan_filtered"} <= set(shown)
    assert [topic for topic in shown if "points" in topic] == ["/camera_a/points", "/camera_b/points"]
    assert "/camera/image" not in shown, "images need much bandwidth"
    assert [one["topic"] for one in found if not one["display"]] == ["/rosout"]
    assert {(one["topic"], one["type"]) for one in found} == {*clouds, *others}, "all topics are listed"


def test_a_row_is_all_that_a_new_display_needs(monkeypatch):
    """A module with a row draws messages of its type; no other list in the server contains displays."""
    made, _ = sample("sensor_msgs/msg/Range")

    def refuse(_message, _options):
        raise CannotDrawError("drawn by the new row")

    row = DisplayRow(
        name="Echo",
        messages={"sensor_msgs/msg/Range": draw_each_message(refuse)},
        options=(NumberOption("A", 1, 0, 2, 1),),
    )
    monkeypatch.setitem(DISPLAY_OF_TYPE, "sensor_msgs/msg/Range", row)
    monkeypatch.setitem(DISPLAYS, "Echo", row)
    config = RvizConfig().merged(
        [{"class": "Echo", "name": "mine", "enabled": True, "topic": "/t", "options": {}}], {}, {}
    )
    assert [one["class"] for one in config.description()["displays"]] == ["Echo"]
    from coframe.viewer.displays.rows import make_renderer

    assert displayable([("/r", "sensor_msgs/msg/Range")])[0]["display"] == "Echo"
    messages = type("Messages", (), {"type": "sensor_msgs/msg/Range"})()
    stamped = type("Stamped", (), {"read": lambda _self: made})()
    with pytest.raises(CannotDrawError, match="drawn by the new row"):
        make_renderer(messages, Options(), Resources()).draw(stamped, 0, 0)
