# SPDX-License-Identifier: Apache-2.0
"""Curves, the inspected message, the log and the graph of a live ROS graph: real DDS, real WebSockets."""

import re
import threading
import time

import numpy as np
import pytest

pytest.importorskip("dds_library", reason="live panels need DDS")

import coframe
from coframe.messages import find
from coframe.wire.qos import QoS

SECOND = 1_000_000_000


class Robot:
    """Publishes odom -> base_link at 50 Hz, a scan at 25 Hz and a number without a stamp, by a node of its own."""

    def __init__(self, domain):
        self.ros = coframe.connect("robot", domain=domain)
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def _run(self):
        tf_type, stamped = find("tf2_msgs/msg/TFMessage"), find("geometry_msgs/msg/TransformStamped")
        tf = self.ros.publisher("/tf", tf_type)
        scans = self.ros.publisher("/scan", find("sensor_msgs/msg/LaserScan"), QoS(5, reliable=False))
        numbers = self.ros.publisher("/number", find("std_msgs/msg/String"))
        tick = 0
        while not self._ended.wait(0.02):
            now, tick = time.time_ns(), tick + 1
            transform = stamped(child_frame_id="base_link")
            transform.header.frame_id = "odom"
            transform.header.stamp.sec, transform.header.stamp.nanosec = divmod(now, SECOND)
            transform.transform.translation.x = now % SECOND / SECOND
            tf.publish(tf_type(transforms=[transform]))
            if tick % 2 == 0:
                scan = find("sensor_msgs/msg/LaserScan")(ranges=[float(tick), 2.0])
                scan.header.frame_id = "base_link"
                scan.header.stamp.sec, scan.header.stamp.nanosec = divmod(now, SECOND)
                scans.publish(scan)
                numbers.publish(find("std_msgs/msg/String")(data="text"))

    def close(self):
        self._ended.set()
        self._thread.join()
        self.ros.close()


@pytest.fixture
def robot(domain_id):
    robot = Robot(domain_id)
    yield robot
    robot.close()


@pytest.fixture
def ros(domain_id):
    with coframe.connect("coframe_view", domain=domain_id) as connection:
        yield connection


def request(*expressions):
    return [{"id": i, "expression": text} for i, text in enumerate(expressions)]


def topics(node):
    return {endpoint.topic.removeprefix("rt") for endpoint in node.endpoints}


@pytest.mark.usefixtures("robot")
def test_live_curves_are_shared_and_closed_with_the_last_page(ros, view, open_tab, eventually):
    viewer = view(ros)
    tab = open_tab(viewer)
    texts = ["odom:base_link.x", "/scan.ranges[0]", "/scan.rate", "/scan.delay", "odom:base_link.delay"]
    texts += ["odom:base_link.rate", "/number.delay", "/number.data", "/nothing.rate"]
    tab.send("curves", curves=request(*texts))
    many = lambda points: points.shape[1] >= 60  # noqa: E731
    times, x = tab.until_curve(0, many)
    # Each sample is there once, and the value is that of the transform with this stamp.
    np.testing.assert_allclose(x, times % SECOND / SECOND, atol=1e-5)
    assert (np.diff(times) > 1e6).all()
    ticks = tab.until_curve(1, many)[1]
    assert (np.diff(ticks) == 2.0).all(), "no message is missing"
    for values, rates in ((1, 2), (0, 5)):  # the robot publishes at 25 and 50 Hz, more slowly on a busy machine
        published = SECOND / np.diff(tab.until_curve(values, many)[0]).mean()
        assert np.nanmean(tab.until_curve(rates, many)[1]) == pytest.approx(published, rel=0.4)
    for number in (3, 4):
        assert 0.0 < np.median(tab.until_curve(number, many)[1]) < 0.2
    assert tab.until_status(6, "have no stamp and therefore no delay") == "error"
    assert tab.until_status(7, "is a string, not a number") == "error"
    assert tab.until_status(8, "no node publishes /nothing") == "waiting"

    second = open_tab(viewer)
    second.send("curves", curves=request("/scan.rate"))
    assert len(second.until_curve(0)[0]) >= 60, "a later page receives the points that were kept"
    tab.send("curves", curves=[])
    second.close()
    eventually(lambda: topics(ros.node) & {"/scan", "/number"} == set())


@pytest.mark.usefixtures("robot")
def test_the_newest_message_is_inspected(ros, view, open_tab, eventually):
    tab = open_tab(view(ros))
    tab.send("inspect", topic="/scan")
    first, second = (tab.wait("inspection", lambda one: one["state"] == "ok") for _ in range(2))
    assert second["stamp"] > first["stamp"]
    assert second["publishers"] == ["/robot"]
    late = tab.wait("inspection", lambda one: one["rate"] and abs(one["rate"] - 25.0) < 8.0)
    ranges = {row["path"]: row["text"] for row in late["fields"]}["/scan.ranges"]
    assert ranges.startswith("[")
    assert ranges.endswith(" 2]")
    tab.send("inspect", topic="/number")
    assert tab.wait("inspection", lambda one: one["state"] == "ok")["fields"][0]["text"] == "text"
    tab.send("inspect", topic="")
    eventually(lambda: topics(ros.node) & {"/scan", "/number"} == set())


def test_log_messages_from_before_and_after_are_received(domain_id, ros, view, open_tab, eventually):
    log = find("rcl_interfaces/msg/Log")
    with coframe.connect("talker", domain=domain_id) as talker:
        rosout = talker.publisher("/rosout", log, QoS(1000, transient_local=True))
        for i in range(300):
            rosout.publish(log(level=20, name="talker", msg=f"before {i}"))
        viewer = view(ros)
        tab = open_tab(viewer)
        tab.send("log", shown=True)
        entries = []
        while len(entries) < 300:
            entries += tab.wait("log")["entries"]
        assert [entry["text"] for entry in entries] == [f"before {i}" for i in range(300)]
        rosout.publish(log(level=40, name="talker", msg="after"))
        assert tab.wait("log", lambda one: one["entries"])["entries"][0]["level"] == "error"
        tab.send("log", shown=False)
        eventually(lambda: "/rosout" not in topics(ros.node))


@pytest.mark.usefixtures("robot")
def test_connections_beyond_the_limit_of_the_graph_are_counted(ros, view, open_tab, monkeypatch):
    monkeypatch.setattr("coframe.viewer.panels._node_graph.MAX_LINKS", 3)
    tab = open_tab(view(ros))
    tab.send("graph", shown=True)
    graph = tab.wait("graph", lambda graph: graph["text"])
    assert re.fullmatch(r"\d+ more connections are not shown: the graph shows at most 3\.", graph["text"])
    assert len(graph["links"]) <= 3


@pytest.mark.dds_only("over Zenoh, quality of service does not prevent communication")
@pytest.mark.usefixtures("robot")
def test_the_graph_marks_endpoints_that_do_not_match(domain_id, ros, view, open_tab):
    laser = find("sensor_msgs/msg/LaserScan")
    with coframe.connect("listener", domain=domain_id) as listener:
        listener.subscribe("/scan", laser, lambda _scan: None)
        strict = QoS(deadline=SECOND // 2, lease=SECOND)
        listener.subscribe("/number", find("std_msgs/msg/String"), lambda _text: None, qos=strict)
        tab = open_tab(view(ros))
        tab.send("graph", shown=True)

        def complete(graph):
            names = {node["name"] for node in graph["nodes"]}
            return {"/robot", "/listener"} <= names and sum(bool(link["problem"]) for link in graph["links"]) == 4

        graph = tab.wait("graph", complete)
    nodes, topics_ = [node["name"] for node in graph["nodes"]], [topic["topic"] for topic in graph["topics"]]
    links = {(nodes[one["node"]], topics_[one["topic"]], one["publishes"]): one for one in graph["links"]}
    assert links["/listener", "/scan", False]["problem"] == (
        "requests reliable, but /robot offers best-effort: no messages arrive"
    )
    assert links["/robot", "/scan", True]["problem"].startswith("offers best-effort, but /listener requests reliable")
    assert links["/listener", "/number", False]["problem"] == (
        "requests a deadline of 500 ms, automatic liveliness with a lease of 1 s, but /robot offers no deadline, "
        "automatic liveliness: no messages arrive"
    )
    assert links["/robot", "/tf", True]["problem"] == ""
    assert links["/robot", "/tf", True]["qos"] == "reliable, volatile"
    assert {node["name"]: node["infrastructure"] for node in graph["nodes"]}["/coframe_view"]
    assert not next(topic for topic in graph["topics"] if topic["topic"] == "/scan")["infrastructure"]
