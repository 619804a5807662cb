# SPDX-License-Identifier: Apache-2.0
"""One bad name, request or message affects one display: the tab stays connected, and the log has one traceback."""

import logging

import pytest

import coframe
from coframe.viewer import _failures
from coframe.viewer.clients import _requests
from coframe.viewer.displays.display import Display
from coframe.viewer.protocol import client_messages
from coframe.viewer.sources.topic_names import NodeName, resolve_topic

RVIZ = """
Visualization Manager:
  Displays:
    - {Class: rviz_default_plugins/LaserScan, Name: Relative, Topic: {Value: scan}}
    - {Class: rviz_default_plugins/LaserScan, Name: Private, Topic: {Value: ~/scan}}
    - {Class: rviz_default_plugins/LaserScan, Name: Invalid, Topic: {Value: 'bad name'}}
    - {Class: rviz_default_plugins/RobotModel, Name: Robot, Description Topic: {Value: robot_description}}
    - {Class: rviz_default_plugins/RobotModel, Name: Bad robot, Description Topic: {Value: '1/2'}}
  Global Options: {Fixed Frame: map}
"""


@pytest.fixture(autouse=True)
def no_earlier_failures():
    _failures._counts.clear()


@pytest.fixture
def live(domain_id):
    pytest.importorskip("dds_library", reason="live sources need DDS")
    with coframe.connect("coframe_view", node_namespace="/", domain=domain_id) as ros:
        yield ros


def buffer():
    made = coframe.Buffer(None)
    made.set("map", "base", coframe.Transform([1.0, 0.0, 0.0]), 1)
    return made


@pytest.fixture
def recorded_scan(tmp_path):
    """Write a recording with a transform and a scan."""
    from coframe.bags import Writer
    from coframe.messages import find, serialize

    transform = find("geometry_msgs/msg/TransformStamped")(child_frame_id="base")
    transform.header.frame_id = "map"
    scan = find("sensor_msgs/msg/LaserScan")(ranges=[1.0, 2.0], range_max=10.0)
    scan.header.frame_id = "base"
    with Writer(tmp_path / "run") as writer:
        tf = writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        scans = writer.add_topic("/scan", "sensor_msgs/msg/LaserScan")
        for second in range(1, 4):
            transform.header.stamp.sec = scan.header.stamp.sec = second
            stamp = second * 1_000_000_000
            writer.write(tf, serialize(find("tf2_msgs/msg/TFMessage")(transforms=[transform])), received=stamp)
            writer.write(scans, serialize(scan), received=stamp)
    return tmp_path / "run"


@pytest.mark.parametrize(
    ("name", "full"),
    [
        ("scan", "/robot1/scan"),
        ("ns/scan", "/robot1/ns/scan"),
        ("~/scan", "/robot1/view/scan"),
        ("{ns}/scan", "/robot1/scan"),
        ("{namespace}/a", "/robot1/a"),
        ("/{node}/scan", "/view/scan"),
        ("/scan", "/scan"),
    ],
)
def test_names_resolve_as_in_ros(name, full):
    assert resolve_topic(name, NodeName("/robot1", "view")) == full


@pytest.mark.parametrize("name", ["bad name", "/a//b", "/1a", "", "~scan", "{x}/scan", "/scan/", "/ä"])
def test_invalid_names_are_refused(name):
    with pytest.raises(coframe.ViewerError, match="not a valid topic name"):
        resolve_topic(name)


def test_names_in_rviz_files_affect_one_display_each(live, view, open_tab, tmp_path, caplog):
    file = tmp_path / "names.rviz"
    file.write_text(RVIZ)
    tab = open_tab(view(live, rviz=file))
    shown = {one["name"]: one["topic"] for one in tab.has("hello")["rviz"]["displays"]}
    assert shown["Relative"] == "/scan"
    assert shown["Private"] == "/coframe_view/scan"
    assert shown["Robot"] == "/robot_description"
    for number, name in enumerate(("Relative", "Private", "Invalid")):
        tab.send("subscribe", id=number, topic=shown[name])
    statuses = {}
    while len(statuses) < 3:
        status = tab.wait("display")
        statuses[status["id"]] = status
    assert statuses[0]["text"] == "no node publishes /scan"
    assert statuses[1]["text"] == "no node publishes /coframe_view/scan"
    assert statuses[2]["state"] == "error"
    assert "'bad name' is not a valid topic name" in statuses[2]["text"]
    assert "1/2" in tab.has("problem")["text"]
    received = len(tab.received)
    for _ in range(40):
        tab.read()
    assert "problem" not in tab.received[received:], "nothing is reported again"
    assert not [record for record in caplog.records if record.levelno >= logging.ERROR]


def test_a_request_that_fails_unexpectedly_is_answered_and_logged_once(view, open_tab, monkeypatch, caplog):
    async def broken(_client, _request):
        raise ZeroDivisionError("no such luck")

    monkeypatch.setitem(_requests._HANDLERS, client_messages.SetFixedFrame, broken)
    monkeypatch.setitem(_requests._HANDLERS, client_messages.Subscribe, broken)
    tab = open_tab(view(buffer()))
    for _ in range(15):
        tab.send("fixed", frame="map")
        assert "ZeroDivisionError: no such luck" in tab.wait("problem")["text"]
    tab.send("subscribe", id=4, topic="/scan")
    status = tab.wait("display")
    assert (status["id"], status["state"]) == (4, "error")
    assert tab.ask("relation", "relate", id=7, target="map", source="base")["id"] == 7, "the tab is still connected"
    errors = [record for record in caplog.records if record.levelno >= logging.ERROR]
    with_traceback = [record for record in errors if record.exc_info]
    assert len(with_traceback) == 2, "one for each kind of request"
    assert [record.getMessage() for record in errors if "10 times" in record.getMessage()]
    assert len(errors) == 3


def test_a_display_that_fails_unexpectedly_does_not_stop_the_others(view, open_tab, monkeypatch, caplog, recorded_scan):
    update = Display.update

    def sometimes_broken(self, *args):
        if self.number == 1:
            raise KeyError("broken")
        update(self, *args)

    monkeypatch.setattr(Display, "update", sometimes_broken)
    tab = open_tab(view(recorded_scan))
    for number in (1, 2):
        tab.send("subscribe", id=number, topic="/scan")
    statuses = {}
    while statuses.get(2, "waiting") == "waiting" or 1 not in statuses or statuses[1] != "error":
        status = tab.wait("display")
        statuses[status["id"]] = status["state"]
    assert statuses == {1: "error", 2: "ok"}
    assert sum(record.exc_info is not None for record in caplog.records if record.levelno >= logging.ERROR) == 1
