# SPDX-License-Identifier: Apache-2.0
"""Faults of real processes, found by the command."""

import itertools
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import textwrap
import time
from subprocess import PIPE

import numpy as np
import pytest
from nodes import ROBOT
from recordings import START
from runs import MS, stamp_message, yaw
from test_cameras import INVERSE, stereo  # of this folder

import coframe
from coframe.connection.listener_config import ListenerConfig
from coframe.doctor import diagnose
from coframe.doctor.live import LiveObserver
from coframe.messages import deserialize, find
from coframe.wire.qos import TF_STATIC_WRITER

# Replaces the function by which a process reads the clock.
CLOCK = """
#define _GNU_SOURCE
#include <dlfcn.h>
#include <time.h>

int clock_gettime(clockid_t which, struct timespec *time) {
  int (*real)(clockid_t, struct timespec *) = dlsym(RTLD_NEXT, "clock_gettime");
  const int result = real(which, time);
  if (result == 0 && which == CLOCK_REALTIME) {
    time->tv_nsec += 350000000;
    time->tv_sec += time->tv_nsec / 1000000000;
    time->tv_nsec %= 1000000000;
  }
  return result;
}
"""


def observer(domain, **options):
    return LiveObserver(ListenerConfig.of(domain=domain), **options)


@pytest.fixture
def only(inside):
    """Return the only finding, as soon as the processes have started."""

    def only(*options):
        *durations, code = options
        findings = []
        for _ in range(5):
            findings = inside.doctor("--duration", *(durations or ["2s"]))["findings"]
            if [finding["code"] for finding in findings] == [code]:
                return findings[0]
        pytest.fail(f"not {code} alone: {findings}")

    return only


def test_two_publishers_of_one_edge_are_named(start, only):
    start("wheel_odometry", ROBOT)
    start(
        "filter",
        'b = TransformBroadcaster(node)\nevery(0.03, lambda: b.sendTransform(stamped("odom", "base_link", 5.0)))',
    )
    finding = only("TF003")
    assert finding["edge"] == ["odom", "base_link"]
    assert sorted(finding["publishers"]) == ["/filter", "/wheel_odometry"]
    assert "Stop /" in finding["fix"]
    assert finding["severity"] == "error"


@pytest.mark.slow
def test_topic_without_messages_is_named_with_its_publisher(start, only):
    start("robot", ROBOT)
    start(
        "lidar_driver",
        """
from nav_msgs.msg import OccupancyGrid
from sensor_msgs.msg import JointState, LaserScan
scans, points = node.create_publisher(LaserScan, "/scan", 10), node.create_publisher(LaserScan, "/rear/scan", 10)
commands, grid = node.create_publisher(JointState, "/arm", 10), node.create_publisher(OccupancyGrid, "/grid", 1)
""",
    )
    finding = only("6s", "TF026")
    assert finding["publishers"] == ["/lidar_driver"]
    assert "no message was received in" in finding["text"]
    assert "/rear/scan" in finding["text"]
    assert "/scan" in finding["text"]
    assert "Look at the output of /lidar_driver" in finding["fix"]


def test_cameras_imus_and_odometry_are_compared_with_the_transforms(domain_id, eventually, examine):
    pytest.importorskip("dds_library", reason="messages are received over DDS")
    upside_down = (1.0, 0.0, 0.0, 0.0)
    run = stereo(right=INVERSE)
    run.tf("base_link", "imu", START, (0.1, 0.0, 0.2), upside_down, static=True)
    imu, odometry = find("sensor_msgs/msg/Imu")(), find("nav_msgs/msg/Odometry")(child_frame_id="base_link")
    imu.header.frame_id, imu.linear_acceleration.z = "imu", 9.81
    odometry.header.frame_id = "odom"
    for step in range(60):
        imu.header.stamp = odometry.header.stamp = stamp_message(START + step * 20 * MS)
        turn, place = odometry.pose.pose.orientation, odometry.pose.pose.position
        *_, turn.z, turn.w = yaw(step / 150)  # the rotation of Run.drive
        place.x, place.y = 1000 * np.cos(step / 150), 1000 * np.sin(step / 150)
        run.message("/imu", imu.ROS_TYPE, imu, START + step * 20 * MS)
        run.message("/odom", odometry.ROS_TYPE, odometry, START + step * 20 * MS)

    def contradictions(report):
        found = [one.text for one in report.every_finding() if one.code in {"TF029", "TF030"}]
        return {re.sub(r" \(\d+ compared\)", "", text) for text in found}

    recorded = contradictions(examine(run))
    assert len(recorded) == 3, recorded
    with observer(domain_id) as listening, coframe.connect("rig", domain=domain_id) as ros:
        publishers = {
            topic: ros.publisher(topic, find(type_), TF_STATIC_WRITER if "static" in topic else 100)
            for topic, (type_, *_) in run.types.items()
        }
        rows = [(topic, deserialize(data, find(run.types[topic][0]))) for topic, _, data in run.rows]
        statics = [transform for topic, each in rows if topic == "/tf_static" for transform in each.transforms]
        publishers["/tf_static"].publish(find("tf2_msgs/msg/TFMessage")(transforms=statics))
        others = itertools.cycle([row for row in rows if row[0] != "/tf_static"])

        def received():
            for topic, message in itertools.islice(others, 20):
                publishers[topic].publish(message)
            listening.poll()
            seen = listening.observe()
            edges = {edge.key for edge in seen.edges}
            measured = seen.imus and len(seen.imus[0].rates) > 50 and seen.poses and len(seen.poses[0].stamp) > 50
            return measured and len(seen.cameras) == 2 and edges >= {("odom", "base_link"), ("base_link", "imu")}

        eventually(received)
        live = contradictions(diagnose(listening.observe()))
    assert live == recorded


def test_departed_publisher_is_removed_with_its_transforms(domain_id, eventually):
    pytest.importorskip("dds_library", reason="transforms are received over DDS")
    message = find("tf2_msgs/msg/TFMessage")
    with observer(domain_id, window=300_000_000) as listening:

        def observed():
            listening.poll()
            seen = listening.observe()
            return "/brief" in seen.travel, "/brief" in seen.transforms.publishers

        with coframe.connect("brief", domain=domain_id) as ros:
            publisher = ros.publisher("/tf", message)
            transform = find("geometry_msgs/msg/TransformStamped")(child_frame_id="base_link")
            transform.header.frame_id = "odom"
            transform.transform.rotation.w = 1.0
            eventually(lambda: publisher.publish(message(transforms=[transform])) or observed() == (True, True))
        eventually(lambda: observed() == (False, False))


def test_what_is_older_than_the_window_is_removed(domain_id, eventually):
    pytest.importorskip("cyclonedds", reason="messages are received over DDS")
    transforms, joints = find("tf2_msgs/msg/TFMessage"), find("sensor_msgs/msg/JointState")
    sent = transforms(transforms=[find("geometry_msgs/msg/TransformStamped")(child_frame_id="base_link")])
    with (
        observer(domain_id, window=100_000_000) as listening,
        coframe.connect("arm", domain=domain_id) as ros,
    ):
        tf, states = ros.publisher("/tf", transforms), ros.publisher("/joint_states", joints)

        def counts():
            travel = listening.observe().travel.get("/arm", ())
            return len(travel), sum(len(topic.decoded) for topic in listening._topics.values())

        def received():
            tf.publish(sent)
            states.publish(joints())
            listening.poll()
            return min(counts()) > 0

        eventually(received)
        eventually(lambda: listening.poll() or counts() == (0, 0))


def test_topics_have_a_limit_and_departed_ones_are_forgotten(domain_id, eventually, monkeypatch):
    pytest.importorskip("dds_library", reason="transforms are received over DDS")
    monkeypatch.setattr("coframe.doctor.live.MAX_TOPICS", 3)
    with observer(domain_id, window=200_000_000) as listening:

        def topics():
            listening.poll()
            return sorted(set(listening.observe().topics) - {"/tf", "/tf_static"})

        for letter in "ab":
            with coframe.connect(f"node_{letter}", domain=domain_id) as ros:
                for number in range(5):
                    ros.publisher(f"/{letter}{number}", find("sensor_msgs/msg/Imu"))
                eventually(lambda: len(topics()) == 3 and listening.observe().topics_ignored >= 2)
                assert {name[1] for name in topics()} == {letter}
            eventually(lambda: not topics())
        assert listening.observe().topics_ignored == 0


def test_transforms_and_messages_beyond_the_limits_are_reported(domain_id, eventually, monkeypatch):
    pytest.importorskip("dds_library", reason="transforms are received over DDS")
    monkeypatch.setattr("coframe.doctor.live.MAX_TRANSFORMS", 40)
    monkeypatch.setattr("coframe.doctor.live.MAX_MESSAGES", 20)
    stamped, transforms, imu = (
        find(name) for name in ("geometry_msgs/msg/TransformStamped", "tf2_msgs/msg/TFMessage", "sensor_msgs/msg/Imu")
    )
    with (
        observer(domain_id) as listening,
        coframe.connect("arm", domain=domain_id) as ros,
    ):
        tf, rates = ros.publisher("/tf", transforms), ros.publisher("/imu", imu)
        link, reading = stamped(child_frame_id="link"), imu()
        link.header.frame_id = reading.header.frame_id = "base"

        def found():
            tf.publish(transforms(transforms=[link]))
            rates.publish(reading)
            listening.poll()
            return [
                finding.text for finding in diagnose(listening.observe()).findings if "memory limit" in finding.text
            ]

        eventually(lambda: len(found()) == 2)
        since, incomplete = found()
        assert re.fullmatch(
            r"only the transforms of the last [\d.]+ m?s were examined, because more exceed the memory limit", since
        )
        assert incomplete == "some messages of /imu were not examined, because they exceed the memory limit"
        assert len(listening.observe().transforms) <= 41


def test_a_pause_does_not_enlarge_the_arrays_of_transforms(domain_id, eventually):
    pytest.importorskip("dds_library", reason="transforms are received over DDS")
    stamped, transforms = find("geometry_msgs/msg/TransformStamped"), find("tf2_msgs/msg/TFMessage")
    message = transforms(transforms=[stamped(child_frame_id=f"link{i}") for i in range(100)])
    for one in message.transforms:
        one.header.frame_id = "base"
    with (
        observer(domain_id, window=1_000_000_000) as listening,
        coframe.connect("arm", domain=domain_id) as ros,
    ):
        tf = ros.publisher("/tf", transforms)
        eventually(lambda: tf.publish(message) or listening.poll() or len(listening.observe().transforms) >= 1000)
        time.sleep(1.1)  # longer than the window, so that these rows are too old
        for _ in range(10):
            tf.publish(message)
        time.sleep(0.2)
        listening.poll()
        capacity = len(listening._collector._dynamic_rows._columns["stamp"])
        assert capacity < 2000, "old rows and new ones were stored at the same time"


@pytest.mark.slow
def test_two_drivers_that_publish_scans_on_one_topic_are_named(start, only):
    start("robot", ROBOT)
    driver = """
    from sensor_msgs.msg import LaserScan
    publisher = node.create_publisher(LaserScan, "/scan", 10)
    def scan():
        message = LaserScan()
        message.header.stamp, message.header.frame_id = node.get_clock().now().to_msg(), "lidar_link"
        publisher.publish(message)
    every(0.05, scan)
    """
    for name in ("front_driver", "rear_driver"):
        start(name, textwrap.dedent(driver))
    finding = only("TF028")
    assert sorted(finding["publishers"]) == ["/front_driver", "/rear_driver"]
    assert "alternate between 2 publishers" in finding["text"]


@pytest.mark.slow
def test_misspelled_frame_gives_the_line_to_change(start, only):
    start("robot", ROBOT)
    start("mounts", 'StaticTransformBroadcaster(node).sendTransform(stamped("base_lnk", "camera_link"))')
    finding = only("TF001")
    assert finding["publishers"] == ["/mounts"]
    assert "t.header.frame_id = 'base_link'" in finding["fix"]


@pytest.mark.slow
def test_lookup_at_now_without_waiting_gives_the_line_to_change(start, only):
    start("robot", ROBOT)
    body = """
buffer = Buffer()
listener = TransformListener(buffer, node)
def query():
    try:
        buffer.lookup_transform("odom", "lidar_link", node.get_clock().now())
    except TransformException as error:
        node.get_logger().warn(f"Transform lookup failed: {error}")
every(0.1, query)
"""
    start("tf_listener", body)
    finding = only("TF025")
    assert finding["publishers"] == ["/tf_listener"]
    assert "extrapolation into the future" in finding["text"]
    assert "lookup_transform(target, source, rclpy.time.Time())" in finding["fix"]
    assert "timeout=Duration(seconds=0.1)" in finding["fix"]


@pytest.mark.slow
def test_durability_volatile_on_both_sides(start, inside):
    start("robot", ROBOT)
    start("own_publisher", 'p = node.create_publisher(TFMessage, "/tf_static", 10)')
    start("own_listener", 's = node.create_subscription(TFMessage, "/tf_static", lambda m: None, 10)')
    expected = {("TF016", "error", "/own_publisher"), ("TF016", "warning", "/own_listener")}
    for _ in range(5):
        findings = inside.doctor("--duration", "2s")["findings"]
        if {(f["code"], f["severity"], *f["publishers"]) for f in findings} == expected:
            return
    pytest.fail(f"{findings}")


@pytest.mark.slow
def test_static_transforms_that_one_process_overwrites(start, only):
    start("robot", ROBOT)
    body = """
p = node.create_publisher(TFMessage, "/tf_static", QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL))
state = {"sent": 0}
def send():
    state["sent"] += 1
    name = "camera_link" if state["sent"] % 2 else "imu_link"
    p.publish(TFMessage(transforms=[stamped("base_link", name, 0.2)]))
every(0.5, send)
"""
    start("mounts", body)
    finding = only("TF016")
    assert "/mounts has published" in finding["text"]
    assert "sendTransform([t1, t2, ...])" in finding["fix"]


def test_empty_graph_is_not_healthy(inside):
    data = inside.doctor("--duration", "1s")
    assert data["findings"] == []
    assert not data["healthy"]


@pytest.fixture
def clock_ahead(tmp_path):
    """Return the environment of a process whose clock, also that of DDS, is 350 ms ahead, as on another machine."""
    compiler = shutil.which("cc")
    if not compiler or sys.platform != "linux":
        pytest.skip("the library that changes the clock needs Linux and a C compiler")
    library = tmp_path / "clock.so"
    subprocess.run([compiler, "-shared", "-fPIC", "-o", library, "-x", "c", "-"], input=CLOCK, text=True, check=True)
    return {**os.environ, "LD_PRELOAD": str(library)}


@pytest.mark.slow
def test_process_whose_clock_is_ahead(start, only, clock_ahead):
    start("wheels", ROBOT)
    arm = 'b = TransformBroadcaster(node)\nevery(0.02, lambda: b.sendTransform(stamped("base_link", "arm", at())))'
    start("arm_driver", f"import time\ndef at():\n    return time.monotonic() % 100\n{arm}", env=clock_ahead)
    finding = only("TF010")
    assert finding["publishers"] == ["/arm_driver"]
    assert re.search(r"the clock of the machine of /arm_driver is at least 3[45]\d ms ahead", finding["text"])
    assert "chrony" in finding["fix"]
    assert [effect["code"] for effect in finding["explains"]] == ["TF008"]


@pytest.mark.slow
def test_watch_prints_repeatedly_and_ends_by_a_signal(start, inside):
    start("robot", ROBOT)
    options = ("--watch", "--json", "--duration", "5s")
    with inside.start("-m", "coframe.cli", "doctor", *options, stdout=PIPE, stderr=PIPE, text=True) as process:
        reports = [json.loads(process.stdout.readline())]
        while not reports[-1]["healthy"]:
            reports.append(json.loads(process.stdout.readline()))
        process.send_signal(signal.SIGINT)
        assert process.wait(20) == 0
        assert "Traceback" not in process.stderr.read()
    assert set(reports[-1]["frames"]) == {"odom", "base_link", "lidar_link"}
    assert reports[0]["end_ns"] - reports[0]["start_ns"] >= 1_000_000_000, "not before the nodes are discovered"


@pytest.mark.slow
@pytest.mark.timeout(200)
@pytest.mark.parametrize("options", [*[""] * 5, "--urdf", "--robots 3", "--robots 3 --own-topics"])
def test_demo_has_no_findings(inside, options, tmp_path):
    log = (tmp_path / "demo.log").open("wb")
    command = ("-m", "coframe.cli", "demo", "--no-browser", "--duration", "150", *options.split())
    demo = inside.start(*command, stdout=log, stderr=log)
    try:
        deadline = time.monotonic() + 60
        while inside.doctor("--duration", "2s")["transforms"] < 50:
            assert time.monotonic() < deadline, (demo.poll(), (tmp_path / "demo.log").read_text())
        data = inside.doctor("--duration", "30s")
    finally:
        demo.terminate()
        demo.wait(20)
        log.close()
    assert data["findings"] == []
    assert data["healthy"]
