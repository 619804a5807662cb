# SPDX-License-Identifier: Apache-2.0
"""What a user meets who explores coframe at the prompt or in a notebook."""

import base64
import html
import io
import re
from html.parser import HTMLParser

import numpy as np
import pytest
import yaml
from PIL import Image
from recordings import write_mcap

import coframe
from coframe.bags import RecordedMessage, RepairReport, summarize
from coframe.contract import Result, Verdict
from coframe.doctor import Finding, Severity, diagnose, observe_recording
from coframe.errors import DecodeError
from coframe.messages import Message, find, serialize, to_yaml
from coframe.messages.message import complete_repr
from coframe.trajectories import compare_trajectories

SECOND = 1_000_000_000
PNG_HEAD = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"
HOSTILE = "<img src=x onerror=alert(1)>\x1b[31m\n\u202e\"'&"


class Tags(HTMLParser):
    """Checks that the tags are balanced, and collects them and the text."""

    def __init__(self):
        super().__init__()
        self.open, self.seen, self.text = [], set(), []

    def handle_starttag(self, tag, _attributes):
        self.seen.add(tag)
        self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text.append(data)


def shown(value):
    """Return the text of a value's HTML, after checks that it contains only our own tags and no control characters."""
    text = value._repr_html_()
    tags = Tags()
    tags.feed(text)
    tags.close()
    assert tags.open == []
    assert tags.seen <= {"div", "table", "thead", "tbody", "tr", "th", "td", "pre"}
    assert all(c.isprintable() or c == "\n" for c in text)
    assert not re.search(r"#[0-9a-f]{3}|background: (?!transparent)", html.unescape(text))
    return "|".join(tags.text)


def rows(value):
    return value._repr_html_().count("<tr>") - value._repr_html_().count("<thead>")


@pytest.fixture
def hostile():
    """A buffer whose names come from an attacker."""
    buffer = coframe.Buffer(cache=None)
    for stamp in (1, 2):
        buffer.set(f"odom{HOSTILE}", f"base{HOSTILE}", coframe.Transform(), stamp * SECOND, authority=HOSTILE)
    buffer.set(f"base{HOSTILE}", "lidar", coframe.Transform(), static=True)
    return buffer


def test_transforms_in_notebooks():
    single = coframe.Transform.from_rpy([1, 2, 3], yaw=0.5, target=HOSTILE, source="base", stamp=7)
    assert "|7|1|2|3|0|0|0.5" in shown(single)
    batch = coframe.Transform(np.zeros((4, 30, 3)), target="map", source="base")
    assert rows(batch) == 50
    assert "and 70 more transforms" in shown(batch)
    assert "batch (4, 30)" in shown(batch)
    assert rows(coframe.Transform(np.zeros((0, 3)))) == 0
    assert rows(coframe.Transform(np.zeros((50, 3)), stamp=np.arange(50))) == 50


def test_buffers_in_notebooks(hostile):
    text = shown(hostile)
    assert "odom<img src=x onerror=alert(1)>\\x1b[31m\\n\\u202e" in text
    assert "|static|" in text
    assert "|1 Hz|1.000000000|2.000000000|" in text
    for index in range(120):
        hostile.set("lidar", f"part{index}", coframe.Transform(), static=True)
    assert rows(hostile) == 50
    assert "and 72 more edges" in shown(hostile)
    assert shown(coframe.Buffer()) == "Buffer(cache=10s, frames=0)"


def test_a_very_long_name_is_shortened():
    buffer = coframe.Buffer()
    buffer.set("map", "x" * 1_000_000, coframe.Transform(), static=True)
    assert len(shown(buffer)) < 3_000


def test_explanations_in_notebooks(hostile):
    possible = hostile.why("lidar", f"odom{HOSTILE}")
    assert "yes: there is a transform" in shown(possible)
    assert "no: there is no transform" in shown(hostile.why("lidar", f"odom{HOSTILE}", 9 * SECOND))
    unknown = hostile.why("lidar", HOSTILE)
    assert "do:  " in shown(unknown)
    assert "tf2: " in shown(unknown)
    for index in range(120):
        hostile.set("lidar" if index == 0 else f"part{index - 1}", f"part{index}", coframe.Transform(), static=True)
    assert rows(hostile.why("lidar", "part119")) == 50


def test_recordings_and_reports_in_notebooks(tmp_path):
    path = tmp_path / "run.mcap"
    write_mcap(path)
    with coframe.open_bag(path) as recording:
        text = shown(recording)
        assert "|/tf|tf2_msgs/msg/TFMessage|" in text
        assert re.search(r"The buffer has \d+ frames?\.", text)
    (observation,) = observe_recording(path).values()
    report = diagnose(observation)
    assert shown(report).startswith(f"{len(report.every_finding())} finding")


def test_findings_in_notebooks():
    consequence = Finding("TF001", Severity.WARNING, HOSTILE, "do this", frames=frozenset())
    finding = Finding("TF013", Severity.ERROR, HOSTILE, "do that", edge=("map", HOSTILE), explains=(consequence,) * 60)
    text = shown(finding)
    assert text.startswith("TF013 error: map -> <img")
    assert "do that" in text
    assert "and 10 more consequences" in text


ALL_TYPES = [
    "geometry_msgs/msg/TransformStamped",
    "nav_msgs/msg/Odometry",
    "sensor_msgs/msg/PointCloud2",
    "visualization_msgs/msg/MarkerArray",
    "std_msgs/msg/Empty",
    "std_msgs/msg/Byte",
    "std_msgs/msg/ByteMultiArray",
]


def plain(value):
    """Return a message as dicts, lists and numbers, as YAML can hold them."""
    if isinstance(value, Message):
        return {name: plain(getattr(value, name)) for name in value.get_fields_and_field_types()}
    if isinstance(value, bytes) and len(value) == 1:
        return value[0]
    if isinstance(value, str | int | float | bool):
        return value
    return [plain(item) for item in value.tolist()] if hasattr(value, "tolist") else [plain(item) for item in value]


@pytest.mark.parametrize("name", ALL_TYPES)
def test_messages_as_yaml_are_read_back_equal(name):
    message = find(name)()
    assert yaml.safe_load(to_yaml(message)) == plain(message)


@pytest.mark.parametrize(
    "text", ["map", "", "yes", "Null", "1", "a: b", "- x", "# no", HOSTILE, "\U0001f916\ufeff", "~"]
)
def test_texts_in_yaml_are_read_back_equal(text):
    message = find("std_msgs/msg/String")(data=text)
    assert yaml.safe_load(to_yaml(message)) == {"data": text}
    assert "\n" not in to_yaml(message)[:-1]


@pytest.mark.parametrize("number", [0.0, 1e-5, 1e22, -1.5e-7, np.inf, -np.inf, 0.1])
def test_numbers_in_yaml_are_read_back_equal(number):
    message = find("std_msgs/msg/Float64")(data=float(number))
    assert yaml.safe_load(to_yaml(message)) == {"data": number}


def test_nested_sequences_in_yaml():
    marker, point = find("visualization_msgs/msg/Marker"), find("geometry_msgs/msg/Point")
    message = find("visualization_msgs/msg/MarkerArray")(
        markers=[marker(ns="a", points=[point(x=1.0), point(y=2.0)]), marker(ns="b")]
    )
    assert yaml.safe_load(to_yaml(message)) == plain(message)
    short = yaml.safe_load(to_yaml(message, max_items=1))
    assert [one["ns"] for one in short["markers"]] == ["a"]
    assert "# and 1 more item\n" in to_yaml(message, max_items=1)


def test_messages_in_notebooks():
    text = shown(find("std_msgs/msg/String")(data=HOSTILE))
    assert text.startswith("std_msgs/msg/String|data: ")
    cloud = find("sensor_msgs/msg/PointCloud2")(data=bytes(1_000_000))
    assert len(cloud._repr_html_()) < 5_000
    assert "# and 999950 more items" in shown(cloud)
    transforms = [find("geometry_msgs/msg/TransformStamped")() for _ in range(80)]
    assert "more lines" in shown(find("tf2_msgs/msg/TFMessage")(transforms=transforms))


def test_the_repr_of_an_image_is_one_short_line():
    image = find("sensor_msgs/msg/Image")(height=480, width=640, data=bytes(range(256)) * 3600)
    assert repr(image).endswith("data=[0, 1, 2, ...] (921600 items))")
    assert len(repr(image)) < 300
    assert complete_repr(image).endswith(" 254, 255])")
    transforms = find("tf2_msgs/msg/TFMessage")(transforms=[find("geometry_msgs/msg/TransformStamped")()] * 100)
    assert repr(transforms).endswith(", ...] (100 items))")
    nested = find("std_msgs/msg/Float64MultiArray")(data=[0.5] * 37)
    assert repr(nested).endswith("data=[0.5, 0.5, 0.5, ...] (37 items))")
    nested.data = [0.5] * 36  # as long as a covariance
    assert repr(nested) == complete_repr(nested)


def picture_in(message):
    """Return the picture in a message's HTML, decoded by another library, or None."""
    found = re.search(r'<img [^>]*src="data:image/(?:png|jpeg);base64,([^"]*)">', message._repr_html_())
    return found and np.asarray(Image.open(io.BytesIO(base64.b64decode(found[1]))))


@pytest.mark.parametrize("encoding", ["rgb8", "bgr8", "mono8"])
def test_an_image_has_its_picture_in_notebooks(encoding):
    colors = np.zeros((2, 4, 3), np.uint8)
    colors[0, 0], colors[1, 3] = (255, 10, 0), 200
    pixels = {"rgb8": colors, "bgr8": colors[:, :, ::-1], "mono8": colors[:, :, 0]}[encoding]
    step = pixels[0].size + 3  # with padding
    data = np.pad(pixels.reshape(2, -1), ((0, 0), (0, 3))).tobytes()
    message = find("sensor_msgs/msg/Image")(height=2, width=4, encoding=encoding, step=step, data=data)
    assert np.array_equal(picture_in(message), colors[:, :, 0] if encoding == "mono8" else colors)


def test_depths_are_scaled_and_large_images_thinned():
    depths = np.full((2, 2000), 1000, "<u2")
    depths[0, 0], depths[0, 4] = 500, 2000
    message = find("sensor_msgs/msg/Image")(height=2, width=2000, encoding="16UC1", step=4000, data=depths.tobytes())
    picture = picture_in(message)
    assert picture.shape == (1, 500)
    assert picture[0, :3].tolist() == [0, 255, 85]
    meters = np.array([[np.nan, 1.0, np.inf, 3.0]], "<f4")
    message = find("sensor_msgs/msg/Image")(height=1, width=4, encoding="32FC1", step=16, data=meters.tobytes())
    assert picture_in(message).tolist() == [[0, 0, 255, 255]]


def test_compressed_images_in_notebooks():
    stream = io.BytesIO()
    Image.fromarray(np.full((8, 8), 7, np.uint8)).save(stream, "JPEG")
    compressed = find("sensor_msgs/msg/CompressedImage")
    assert picture_in(compressed(format="jpeg", data=stream.getvalue())).shape == (8, 8)
    assert picture_in(compressed(format="jpeg", data=b"<script>")) is None


@pytest.mark.parametrize(
    ("fields", "reason"),
    [
        ({}, ""),
        (
            {"height": 2**31, "width": 2**31, "encoding": "rgb8", "step": 3, "data": b"123"},
            "There is no picture: an image of 2147483648 x 2147483648 pixels has only 3 bytes, 3 per row|",
        ),
        (
            {"height": 1, "width": 1, "encoding": HOSTILE, "step": 3, "data": b"123"},
            "There is no picture: image encoding ",
        ),
    ],
    ids=["empty", "too large", "unknown encoding"],
)
def test_images_that_cannot_be_read_have_no_picture_but_a_reason(fields, reason):
    assert shown(find("sensor_msgs/msg/Image")(**fields)).startswith(f"sensor_msgs/msg/Image|{reason or 'header'}")


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"\0\0\1h264", "the data is neither JPEG nor PNG"),
        (PNG_HEAD + b"\xff" * 8 + b"\x08\x02", "4294967295 x 4294967295 pixels exceed the maximum of 33554432"),
        (PNG_HEAD + b"\0\0\0\1" * 2 + b"\x08\x02" + bytes(2 << 20), "2097178 bytes exceed the maximum of 2097152 for"),
    ],
    ids=["video", "many pixels", "many bytes"],
)
def test_compressed_images_that_cannot_be_shown_have_a_reason(data, reason):
    assert f"There is no picture: {reason}" in shown(find("sensor_msgs/msg/CompressedImage")(format="x", data=data))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("encoding", ["32FC1", "64FC1", "64FC3"])
def test_infinite_values_have_a_picture_without_warnings(encoding):
    dtype = np.dtype(f"<f{int(encoding[:2]) // 8}")
    values = np.array([np.inf, -np.inf, np.finfo(dtype).max, np.finfo(dtype).min, np.nan, 1.0], dtype)
    channels = int(encoding[-1])
    columns = values.size // channels
    message = find("sensor_msgs/msg/Image")(
        height=1, width=columns, encoding=encoding, step=values.nbytes, data=values.tobytes()
    )
    assert picture_in(message).shape[:2] == (1, columns)


def test_recorded_topics_and_messages_in_notebooks(tmp_path):
    path = write_mcap(
        tmp_path / "run.mcap",
        rows=[("/text", SECOND, serialize(find("std_msgs/msg/String")(data=HOSTILE)))],
        types={"/text": ("std_msgs/msg/String", "ros2msg", b"string data", "cdr")},
    )
    with coframe.open_bag(path) as recording:
        assert "|/text|std_msgs/msg/String|1|" in shown(recording.topics)
        assert "|/text|" in shown(recording.topics["/text"])
        (message,) = recording.messages("/text")
        text = shown(message)
        assert "received" in text
        assert "data: " in text
        assert "|format|MCAP|" in shown(summarize(recording))
    assert "damaged<img" in shown(RecordedMessage("/text", "std_msgs/msg/String", 0, 0, b"\0", damaged))


def damaged(_data):
    raise DecodeError(f"damaged{HOSTILE}")


def test_reports_in_notebooks(tmp_path):
    report = RepairReport(tmp_path, 3, [HOSTILE], ["a change"], [])
    text = shown(report)
    assert "|messages|3|" in text
    assert "|problems|<img src=x onerror=alert(1)>" in text
    verdict = Verdict("run.mcap", (Result("topic", HOSTILE, ("too slow",)), Result("clock", "", ())))
    assert "1 of 2 requirements are met" in shown(verdict)
    assert "|too slow|" in shown(verdict)
    path = coframe.Transform(np.arange(30.0).reshape(10, 3), stamp=np.arange(10) * SECOND)
    assert "10 pairs of poses" in shown(compare_trajectories(path, path))


def test_str_of_a_message_is_its_repr_as_in_rclpy():
    message = find("std_msgs/msg/String")(data="hello")
    assert str(message) == repr(message) == "std_msgs.msg.String(data='hello')"


MODULES = ["bags", "doctor", "frame_names", "messages", "quaternion", "recorder", "robots", "sensors", "time"]


@pytest.mark.parametrize("name", [*MODULES, "tree_drawing", "viewer"])
def test_completion_of_a_module_lists_its_public_names(name):
    module = getattr(coframe, name)
    assert dir(module) == sorted(module.__all__)
    assert all(hasattr(module, public) for public in dir(module))


@pytest.mark.parametrize("value", [coframe.Transform(), coframe.Buffer()], ids=["Transform", "Buffer"])
def test_completion_of_an_instance_lists_the_names_of_its_class(value):
    of_class = {name for name in dir(type(value)) if not name.startswith("_")}
    assert {name for name in dir(value) if not name.startswith("_")} == of_class
