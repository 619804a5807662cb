# SPDX-License-Identifier: Apache-2.0
"""Curves, the inspected message and the log of a recording, as a page receives them."""

import csv
import http.client
import io
import logging
from urllib.parse import urlencode, urlsplit

import numpy as np
import pytest
from recordings import START
from runs import MS, SECOND, Run

import coframe
from coframe.messages import find
from coframe.plotting import evaluate
from coframe.plotting.thinning import extremes
from coframe.viewer.panels._ring import Ring
from coframe.viewer.panels.message_fields import message_rows

EVIL = "<img src=x onerror=alert(1)>"


def run_with_log(seconds=4):
    run = Run.healthy(seconds=seconds)
    log = find("rcl_interfaces/msg/Log")
    for i, level in enumerate((10, 20, 30, 40, 50, 77)):
        entry = log(level=level, name="planner", msg=f"{EVIL} {i}", file="plan.cpp", function="run", line=7)
        entry.stamp.sec, entry.stamp.nanosec = divmod(START + i * SECOND // 2, SECOND)
        run.message("/rosout", "rcl_interfaces/msg/Log", entry, START + i * SECOND // 2 + MS)
    return run


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    with coframe.open_bag(run_with_log().write(tmp_path_factory.mktemp("panels"))) as recording:
        yield recording


def request(*expressions):
    return [{"id": i, "expression": text} for i, text in enumerate(expressions)]


def test_the_curves_of_a_recording_are_those_of_coframe_plot(view, open_tab, recording):
    texts = ["odom:base_link.x", "odom:base_link.yaw", "/scan.angle_max", "/tf.rate", "odom:base_link.delay"]
    viewer = view(recording)
    tab = open_tab(viewer)
    tab.send("curves", curves=request(*texts), points=20_000)
    for number, expected in enumerate(evaluate(texts, recording)):
        times, values = tab.until_curve(number)
        np.testing.assert_array_equal(times, expected.stamps, err_msg=expected.label)
        np.testing.assert_array_equal(values, expected.values, err_msg=expected.label)
    tab.send("curves", curves=[*request(*texts), {"id": 9, "expression": "/scan.ranges[0]"}], points=20_000)
    failed = tab.wait("curve", lambda status: status["id"] == 9 and status["state"] == "error")
    assert "no message on /scan has an element with this index" in failed["text"]
    address = urlsplit(viewer.url)
    connection = http.client.HTTPConnection(address.hostname, address.port, timeout=20)
    connection.request("GET", "/curves.csv?" + urlencode([("curve", texts[0]), ("curve", texts[3])]))
    rows = list(csv.reader(io.StringIO(connection.getresponse().read().decode())))
    assert rows[0] == ["stamp_ns", texts[0], texts[3]]
    x, rate = evaluate([texts[0], texts[3]], recording)
    assert {int(row[0]): float(row[1]) for row in rows[1:] if row[1]} == dict(
        zip(x.stamps.tolist(), x.values.tolist(), strict=True)
    )
    assert [float(row[2]) for row in rows[1:] if row[2]] == rate.values[np.isfinite(rate.values)].tolist()
    connection.request("GET", "/curves.csv?curve=%2Ftf.other")
    answer = connection.getresponse()
    assert (answer.status, answer.read()) == (400, b"/tf.other is not shown. Add the curve to the plot first.\n")
    connection.close()


def test_a_part_of_a_curve_has_its_own_detail(view, open_tab, recording):
    tab = open_tab(view(recording))
    origin = int(tab.has("hello")["origin"])
    tab.send("curves", curves=request("odom:base_link.x"), points=100)
    times, _ = tab.until_curve(0)
    assert 50 <= len(times) <= 102, "thinned"
    assert (times[0], times[-1]) == (START, START + 4 * SECOND - 20 * MS)
    span = [START + SECOND - origin, START + SECOND + 200 * MS - origin]
    tab.send("curves", curves=request("odom:base_link.x"), points=100, span=span)
    times, _ = tab.until_curve(0, lambda points: points.shape[1] < 50)
    assert times.tolist() == [START + i * 20 * MS for i in range(49, 62)], "one point more on each side"


@pytest.mark.parametrize(
    ("expression", "text"),
    [
        ("odom:base_link.color", "must end with a quantity, not 'color'"),
        ("odom:nowhere.x", "nowhere"),
        ("/nothing.rate", "has no topic '/nothing'"),
        ("/scan.header", "is a message, not a number"),
        ("<script>", "is neither two frames nor a topic"),
    ],
)
def test_a_curve_without_values_says_why(view, open_tab, recording, expression, text):
    tab = open_tab(view(recording))
    tab.send("curves", curves=request(expression))
    assert text in tab.wait("curve", lambda status: status["state"] == "error")["text"]


def test_hostile_requests_are_refused(view, open_tab, recording):
    tab = open_tab(view(recording))
    assert "at most 32 curves" in tab.ask("problem", "curves", curves=request(*["/tf.rate"] * 33))["text"]
    assert "at most 1000 characters" in tab.ask("problem", "curves", curves=request("/" + "a" * 1001))["text"]
    assert "at most 1000 characters" in tab.ask("problem", "complete", id=1, subject="topic", text="a" * 1001)["text"]
    assert "shown of a message 'log' must be" in tab.ask("problem", "log", shown="yes")["text"]
    for _ in range(3):  # The state is the same however often it is requested.
        tab.send("log", shown=True)
        tab.send("graph", shown=False)
    assert tab.wait("log", lambda log: log["entries"])["entries"][0]["text"].endswith("0")


def test_the_inspected_message_follows_the_time(view, open_tab, recording):
    tab = open_tab(view(recording))
    origin = int(tab.has("hello")["origin"])
    tab.send("time", mode="at", at=START + 2 * SECOND - origin)
    tab.send("inspect", topic="/scan")
    found = tab.wait("inspection", lambda inspection: inspection["state"] == "ok")
    assert (found["message_type"], found["publishers"]) == ("sensor_msgs/msg/LaserScan", [])
    assert found["stamp"] + origin == pytest.approx(START + 2 * SECOND - 5 * MS, abs=1000)
    assert found["rate"] == pytest.approx(10.0)
    rows = {row["path"]: row for row in found["fields"]}
    assert (rows["/scan.header.frame_id"]["text"], rows["/scan.header.frame_id"]["depth"]) == ("lidar", 1)
    assert rows["/scan.angle_max"]["is_number"]
    tab.send("time", mode="at", at=START - SECOND - origin)
    assert tab.wait("inspection")["text"] == "no message before this time"
    tab.send("inspect", topic="/none")
    assert tab.wait("inspection", lambda one: one["topic"] == "/none")["text"] == "there are no messages on /none"


def test_arrays_of_a_message_are_shortened():
    scan = find("sensor_msgs/msg/LaserScan")(ranges=[float(i) for i in range(1000)])
    rows = message_rows("/scan", scan)
    ranges = next(row for row in rows if row["name"] == "ranges")
    assert ranges["text"] == "[0 1 2 … 997 998 999] (1000)"
    after = rows[rows.index(ranges) + 1 :]
    assert (after[3]["path"], after[3]["text"], after[3]["is_number"]) == ("/scan.ranges[3]", "3", True)
    assert after[16]["text"] == "984 more"
    joints = find("sensor_msgs/msg/JointState")(name=["a" * 1000])
    assert len(next(row for row in message_rows("/j", joints) if row["name"] == "[0]")["text"]) < 340
    many = find("visualization_msgs/msg/MarkerArray")(markers=[find("visualization_msgs/msg/Marker")()] * 100)
    assert len(message_rows("/m", many)) == 401
    assert message_rows("/data", {"a": {"b": [1.5, True]}})[-1]["path"] == "/data.a.b[1]", "JSON"


def test_the_log_of_a_recording_and_of_the_viewer(view, open_tab, recording):
    tab = open_tab(view(recording))
    origin = int(tab.has("hello")["origin"])
    tab.send("log", shown=True)
    entries = tab.wait("log", lambda log: len(log["entries"]) == 6)["entries"]
    assert [entry["level"] for entry in entries] == ["debug", "info", "warning", "error", "fatal", "info"]
    assert entries[2] == {
        "stamp": START + SECOND - origin,
        "level": "warning",
        "node": "planner",
        "text": f"{EVIL} 2",
        "place": "plan.cpp:run:7",
    }
    logging.getLogger("coframe.viewer").warning("one %s", "problem")
    entries = tab.wait("log", lambda log: log["entries"])["entries"]
    assert [(entry["node"], entry["text"]) for entry in entries] == [("coframe.viewer", "one problem")]


def test_what_a_source_does_not_contain_is_explained(view, open_tab, recording, tmp_path):
    tab = open_tab(view(recording))
    assert "does not contain which nodes" in tab.ask("graph", "graph", shown=True)["text"]
    tab = open_tab(view(Run.healthy(seconds=1).write(tmp_path)))
    tab.send("log", shown=True)
    assert tab.wait("log")["text"] == "The recording contains no messages on /rosout."
    buffer = coframe.Buffer()
    buffer.set("map", "base", coframe.Transform([1.0, 2.0, 3.0]), 5 * SECOND)
    tab = open_tab(view(buffer))
    tab.send("curves", curves=request("map:base.z", "/scan.rate", "map:base.delay", "base:base.distance"))
    for number in (1, 2):
        assert tab.until_status(number, "a buffer contains only transforms") == "error"
    assert tab.until_curve(0)[1].tolist() == [3.0]
    assert tab.until_curve(3)[1].tolist() == [0.0], "a frame relative to itself"
    assert "no nodes and topics" in tab.ask("graph", "graph", shown=True)["text"]


@pytest.mark.parametrize(
    ("text", "first", "others"),
    [
        ("od", "odom:", set()),
        ("odom:ba", "odom:base_link.", set()),
        ("odom->base_link.", "odom->base_link.delay", {"odom->base_link.yaw", "odom->base_link.rate"}),
        ("/sc", "/scan.", set()),
        ("/scan.", "/scan.angle_increment", {"/scan.ranges[0]", "/scan.header", "/scan.rate"}),
        ("/scan.header.st", "/scan.header.stamp", set()),
        ("/tf.transforms[0].transform.tr", "/tf.transforms[0].transform.translation", set()),
        ("/none.", None, set()),
    ],
)
def test_expressions_are_completed(view, open_tab, recording, text, first, others):
    items = open_tab(view(recording)).ask("completions", "complete", id=1, subject="expression", text=text)["items"]
    assert (items[0] if items else None) == first
    assert others <= {*items}


def test_topics_are_completed(view, open_tab, recording):
    tab = open_tab(view(recording))
    items = tab.ask("completions", "complete", id=7, subject="topic", text="s")["items"]
    assert items == ["/rosout", "/scan", "/tf_static"]


def test_a_ring_keeps_the_last_points_and_begins_again_after_a_jump():
    ring = Ring(capacity=100)
    for start in range(0, 1000, 30):
        ring.add(np.arange(start, start + 30), np.arange(start, start + 30.0))
    assert (len(ring), ring.total, ring.last) == (100, 1020, 1019)
    assert ring.since(0).values.tolist() == list(range(920, 1020))
    assert ring.since(1018).times.tolist() == [1018, 1019]
    ring.add(np.array([1010, 1030]), np.zeros(2))
    assert ring.since(1019).times.tolist() == [1019, 1019, 1030], "times do not decrease"
    ring.add(np.array([5 * SECOND]), np.ones(1))
    ring.add(np.array([7]), np.ones(1))
    assert (ring.restarts, ring.since(0).times.tolist()) == (1, [7])
    ring.add(np.arange(1000), np.arange(1000.0))
    assert ring.since(0).values.tolist() == list(range(900, 1000))


def test_thinning_keeps_peaks_and_ends():
    values = np.zeros(100_000)
    values[[12_345, 67_890]] = 5.0, -5.0
    values[500:600] = np.nan
    kept = extremes(values, 1000)
    assert len(kept) <= 1002
    assert {0, 12_345, 67_890, 99_999} <= {*kept.tolist()}
    assert extremes(values[:1000], 1000).tolist() == list(range(1000))
