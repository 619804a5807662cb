# SPDX-License-Identifier: Apache-2.0
"""A replay is one HTML file that contains the poses of the buffer and requests nothing from the network."""

import base64
import html.parser
import json
import urllib.error
import urllib.parse
import urllib.request
from array import array

import numpy as np
import pytest

import coframe
from coframe.messages import find
from coframe.viewer._page_files import STATIC
from coframe.viewer.displays import Options
from coframe.viewer.replay.displays import ReplayDisplay, ReplayTimes, record_displays
from coframe.viewer.sources.topic_messages import StampedMessage

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND
HOSTILE = "</script><script>alert(1)</script><!--"

pytestmark = pytest.mark.skipif(not (STATIC / "replay.html").exists(), reason="the page is not built")


class Scripts(html.parser.HTMLParser):
    """The script elements of a page, and its links."""

    def __init__(self, text):
        super().__init__()
        self.scripts, self.addresses = [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        received = dict(attributes)
        self.addresses += [received[name] for name in ("src", "href") if received.get(name)]
        if tag == "script":
            self.scripts.append([received, ""])

    def handle_data(self, data):
        if self.scripts:
            self.scripts[-1][1] += data


@pytest.fixture
def buffer():
    buffer = coframe.Buffer(None)
    for second in range(11):
        far = coframe.Transform.from_rpy([600_000.0 + second, 5_000_000.0, 0.0], [0.0, 0.0, second / 10])
        buffer.set("utm", "base", far, BEGIN + second * SECOND)
    buffer.set("base", HOSTILE, coframe.Transform([0.0, 0.5, 0.0]), static=True)
    return buffer


def fetch(viewer, **query):
    with urllib.request.urlopen(f"{viewer.url}replay?{urllib.parse.urlencode(query)}") as answer:
        return answer.headers, answer.read().decode()


def test_a_replay_contains_the_poses_of_the_buffer(buffer, view, open_tab):
    viewer = view(buffer, fixed="utm")
    hello = open_tab(viewer).wait("hello")
    first, _ = hello["span"]
    headers, page = fetch(viewer, **{"from": first + SECOND, "to": first + 3 * SECOND, "rate": 10, "fixed": "utm"})
    assert headers["Content-Disposition"].startswith("attachment")
    read = Scripts(page)
    (block,) = [text for received, text in read.scripts if received.get("id") == "replay"]
    assert len(read.scripts) == 2, "the data and the program: no name has become an element"
    assert [address for address in read.addresses if not address.startswith("data:")] == []
    replay = json.loads(block)
    assert (replay["format"], replay["version"], replay["fixed"]) == ("coframe-replay", 1, "utm")
    assert replay["origin"] == hello["origin"]
    assert (replay["from"], replay["to"]) == (first + SECOND, first + 3 * SECOND)
    names = [frame["name"] for frame in replay["frames"]]
    assert sorted(names) == sorted(["utm", "base", HOSTILE])
    times = np.frombuffer(base64.b64decode(replay["times"]), "<f8")
    poses = np.frombuffer(base64.b64decode(replay["poses"]), "<f4").reshape(len(times), len(names), 7)
    states = np.frombuffer(base64.b64decode(replay["states"]), np.uint8).reshape(len(times), len(names))
    assert len(times) == 21
    assert (states == 0).all()
    for row in (0, 7, 20):
        for column, name in enumerate(names):
            expected = buffer.lookup("utm", name, int(times[row]) + int(replay["origin"]))
            world = poses[row, column, :3].astype(np.float64) + replay["origin_xyz"]
            np.testing.assert_allclose(world, expected.translation, atol=1e-5)
            assert abs(abs(poses[row, column, 3:] @ expected.quaternion) - 1.0) < 1e-5


def test_a_replay_contains_robots_with_their_meshes(buffer, view, tmp_path):
    (tmp_path / "a.stl").write_bytes(b"solid")
    link = '<link name="base"><visual><geometry><mesh filename="a.stl"/></geometry></visual></link>'
    (tmp_path / "r.urdf").write_text(f'<robot name="r">{link}</robot>')
    _, page = fetch(view(buffer, robot=tmp_path / "r.urdf"))
    (block,) = [text for received, text in Scripts(page).scripts if received.get("id") == "replay"]
    (robot,) = json.loads(block)["robots"]
    assert (robot["root"], robot["links"][0]["visuals"][0]["mesh"]) == ("base", "a.stl")
    assert robot["meshes"] == {"a.stl": "data:model/stl;base64," + base64.b64encode(b"solid").decode()}


@pytest.mark.parametrize(
    ("query", "reason"),
    [
        ({"rate": "fast"}, "must be numbers"),
        ({"rate": 0}, "at most 100 frames per second"),
        ({"rate": "nan"}, "at most 100 frames per second"),
        ({"from": 5, "to": 1}, "must not end before it begins"),
        ({"from": "inf"}, "must be numbers"),
    ],
)
def test_an_invalid_replay_request_is_rejected_with_a_message(buffer, view, query, reason):
    with pytest.raises(urllib.error.HTTPError, match="400") as refused:
        fetch(view(buffer), **query)
    with refused.value:
        assert reason in refused.value.read().decode()


def test_a_replay_that_is_too_large_is_rejected_with_a_message(view):
    buffer = coframe.Buffer(None)
    for frame in range(1000):
        buffer.set("map", f"f{frame}", coframe.Transform(), BEGIN)
        buffer.set("map", f"f{frame}", coframe.Transform(), BEGIN + 1000 * SECOND)
    with pytest.raises(urllib.error.HTTPError, match="400") as refused:
        fetch(view(buffer), rate=30)
    with refused.value:
        assert "Choose a shorter span or a lower rate." in refused.value.read().decode()


class Replayed:
    """A display of a replay, decoded."""

    def __init__(self, block, decoded):
        def numbers(name, kind):
            return np.frombuffer(base64.b64decode(block[name]), kind)

        self.block = block
        self.changes, counts = numbers("changes", "<u4"), numbers("counts", "<u4")
        self.drawings = {int(key): decoded(base64.b64decode(text)) for key, text in block["drawings"].items()}
        self.bytes = sum(len(base64.b64decode(text)) for text in block["drawings"].values())
        poses = numbers("poses", "<f4").reshape(-1, 7)
        rows = list(zip(numbers("sequences", "<u4").tolist(), poses, numbers("stamps", "<f8"), strict=True))
        ends = np.cumsum(counts)
        self.listings = [rows[end - count : end] for count, end in zip(counts, ends, strict=True)]

    def at(self, sample):
        """Return (drawing, pose, stamp) of all visible drawings."""
        index = np.searchsorted(self.changes, sample, side="right") - 1
        return [(self.drawings[sequence], pose, stamp) for sequence, pose, stamp in self.listings[index]]


@pytest.fixture
def walker(shared):
    """Return the path of a recording of a TurtleBot 3."""
    pytest.importorskip("rosbags", reason="recordings need rosbags")
    return shared / "recordings" / "tb3_gazebo_walker"


def replay_of(viewer, open_tab, *displays, seconds=4, rate=5):
    """Return a replay from the middle of a recording, with the settings of a tab."""
    tab = open_tab(viewer)
    first, last = tab.wait("hello")["span"]
    rviz = {
        "displays": [{"class": "LaserScan", "name": HOSTILE, "enabled": True, "topic": None, "options": {}}],
        "global": {},
        "view": None,
    }
    settings = tab.ask("replay", "replay", displays=list(displays), rviz=rviz)["settings"]
    begin = (first + last) // 2
    span = {"from": begin, "to": begin + seconds * SECOND}
    _, page = fetch(viewer, **span, rate=rate, fixed="odom", settings=settings)
    (block,) = [text for received, text in Scripts(page).scripts if received.get("id") == "replay"]
    assert json.loads(block)["rviz"] == rviz
    return json.loads(block)


def test_a_replay_contains_displays_as_a_tab_shows_them(walker, view, open_tab, decoded):
    replay = replay_of(
        view(walker),
        open_tab,
        {"topic": "/scan", "options": {"color_by": "distance"}},
        {"topic": "/nowhere"},
        {"topic": "/robot_description"},
    )
    (block,) = replay["displays"]
    assert (block["topic"], block["display"], block["every"]) == ("/scan", "LaserScan", 1)
    assert block["statuses"][0][1:] == ["ok", ""]
    scans = Replayed(block, decoded)
    times = np.frombuffer(base64.b64decode(replay["times"]), "<f8")
    origin = int(replay["origin"])
    seen = set()
    with coframe.open_bag(walker) as bag:
        for sample, moment in enumerate(times):
            ((drawing, pose, stamp),) = scans.at(sample)
            expected = bag.message_at("/scan", int(moment) + origin).message.header
            assert int(stamp) + origin == expected.stamp.sec * SECOND + expected.stamp.nanosec
            where = bag.buffer.lookup("odom", expected.frame_id, int(stamp) + origin)
            np.testing.assert_allclose(pose[:3] + replay["origin_xyz"], where.translation, atol=1e-5)
            np.testing.assert_allclose(drawing.scalars, np.linalg.norm(drawing.points, axis=1), rtol=1e-5)
            seen.add(stamp)
    assert len(seen) > 10
    names = [frame["name"] for frame in replay["frames"]]
    assert replay["stats"][names.index("base_footprint")]["rate"] > 1
    (edge,) = [edge for edge in replay["edges"] if names[edge["frame"]] == "base_footprint"]
    assert np.frombuffer(base64.b64decode(edge["counts"]), "<u2").sum() > 10


def test_a_display_that_is_too_large_for_the_file_is_thinned_or_omitted(walker, view, open_tab, decoded, monkeypatch):
    scan = {"topic": "/scan", "options": {}}
    viewer = view(walker)
    for most, left in ((30_000, 2), (2000, 0)):
        monkeypatch.setattr("coframe.viewer.replay.displays.MAX_BYTES", most)
        (block,) = replay_of(viewer, open_tab, scan)["displays"]
        scans = Replayed(block, decoded)
        assert scans.bytes <= most
        assert len(scans.drawings) >= left
        if left:
            assert block["every"] > 1
            assert all(sample % block["every"] == 0 for sample in scans.changes)
        else:
            assert block["statuses"][0][1] == "error"
            assert "omitted from this replay" in block["statuses"][0][2]


class OneMessage:
    """A topic with one message."""

    shortfall = ""

    def __init__(self, message):
        self.type = message.ROS_TYPE
        self._message = StampedMessage(1, BEGIN, lambda: message)

    def frame(self, name):
        return name

    def at(self, time):
        return self._message if time == 0 or time >= BEGIN else None

    def pending(self):
        return False

    def before(self, time, _count):
        return [self._message] if self.at(time) else []


def test_large_clouds_are_thinned_and_contain_the_step(decoded):
    count = 25_000
    field = find("sensor_msgs/msg/PointField")
    cloud = find("sensor_msgs/msg/PointCloud2")(height=1, width=count, point_step=12, row_step=12 * count)
    cloud.fields = [field(name=name, offset=4 * i, datatype=7, count=1) for i, name in enumerate("xyz")]
    cloud.data = array("B", (np.arange(3 * count, dtype="<f4") / 100).tobytes())
    cloud.header.frame_id, cloud.header.stamp.sec = "map", BEGIN // SECOND
    buffer = coframe.Buffer(None)
    buffer.set("map", "base", coframe.Transform(), BEGIN)
    times = np.arange(3) * SECOND + BEGIN - SECOND
    replay_times = ReplayTimes(buffer, "map", times, np.zeros(3))
    (block,) = record_displays([ReplayDisplay("/cloud", Options())], {"/cloud": OneMessage(cloud)}, replay_times)
    replayed = Replayed(block, decoded)
    assert replayed.at(0) == []
    ((drawing, _, _),) = replayed.at(2)
    assert drawing.step == 3
    expected = (np.arange(3 * count, dtype="<f4") / 100).reshape(-1, 3)[::3]
    np.testing.assert_array_equal(drawing.points, expected)
    assert [status[1] for status in block["statuses"]] == ["waiting", "ok"]


@pytest.mark.parametrize(
    ("fields", "reason"),
    [
        ({"displays": [7]}, "displays[0] of a message 'replay' must be an object"),
        ({"displays": [{"topic": "/scan"}] * 101}, "at most"),
        ({"displays": {}}, "must be an array"),
        ({"displays": [], "rviz": {"x": float("nan")}}, "is not valid JSON"),
    ],
)
def test_invalid_replay_settings_are_rejected_with_a_message(buffer, view, open_tab, fields, reason):
    assert reason in open_tab(view(buffer)).ask("problem", "replay", **fields)["text"]


def test_unknown_replay_settings_are_rejected_with_a_message(buffer, view):
    with pytest.raises(urllib.error.HTTPError, match="400") as refused:
        fetch(view(buffer), settings="guessed")
    with refused.value:
        assert "Save the replay again." in refused.value.read().decode()
