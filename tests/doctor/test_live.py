"""Faults made by real processes, found by the real command."""

import json
import subprocess
import sys
import time

import pytest

pytest.importorskip("cyclonedds", reason="the processes speak DDS")

# A node in a few lines: NODE's body runs with `node` and `stamped(parent, child, x)`.
NODE = """
import sys, rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from tf2_msgs.msg import TFMessage
from tf2_ros import Buffer, StaticTransformBroadcaster, TransformBroadcaster, TransformException, TransformListener

rclpy.init()
node = Node(sys.argv[1])

def stamped(parent, child, x=0.0, stamp=None):
    t = TransformStamped()
    t.header.stamp = (stamp or node.get_clock().now()).to_msg()
    t.header.frame_id, t.child_frame_id = parent, child
    t.transform.translation.x, t.transform.rotation.w = x, 1.0
    return t

def every(period, call):
    node.create_timer(period, call)

{body}
rclpy.spin(node)
"""
ROBOT = """
broadcaster, statics = TransformBroadcaster(node), StaticTransformBroadcaster(node)
statics.sendTransform(stamped("base_link", "lidar_link", 0.1))
begun = node.get_clock().now()
def move():
    now = node.get_clock().now()
    broadcaster.sendTransform(stamped("odom", "base_link", (now - begun).nanoseconds * 1e-10, now))
every(0.02, move)
"""


class Nodes:
    def __init__(self):
        self._running = []

    def start(self, name, body):
        source = NODE.replace("{body}", body)
        self._running.append(
            subprocess.Popen([sys.executable, "-c", source, name], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        )

    def close(self):
        for process in self._running:
            process.kill()
            process.wait()


@pytest.fixture
def nodes():
    started = Nodes()
    yield started
    started.close()


def verdict(*arguments):
    """The finding of each code, as JSON."""
    command = [sys.executable, "-m", "coframe.cli", "doctor", "--json", *arguments]
    result = subprocess.run(command, capture_output=True, text=True, check=False, timeout=90)
    assert "Traceback" not in result.stderr, result.stderr
    data = json.loads(result.stdout)
    assert result.returncode == (0 if data["healthy"] else 1)
    return data


def only(code):
    """The one finding there is, once the processes have come up."""
    findings = []
    for _ in range(5):
        findings = verdict("--duration", "3s")["findings"]
        if [finding["code"] for finding in findings] == [code]:
            return findings[0]
    pytest.fail(f"not {code} alone: {findings}")


@pytest.mark.usefixtures("domain_id")
def test_two_publishers_of_one_link_are_named(nodes):
    nodes.start("wheel_odometry", ROBOT)
    nodes.start(
        "filter",
        'b = TransformBroadcaster(node)\nevery(0.03, lambda: b.sendTransform(stamped("odom", "base_link", 5.0)))',
    )
    finding = only("TF003")
    assert finding["edge"] == ["odom", "base_link"]
    assert sorted(finding["publishers"]) == ["/filter", "/wheel_odometry"]
    assert "Stop one of the two" in finding["fix"]
    assert finding["severity"] == "error"


@pytest.mark.usefixtures("domain_id")
def test_a_misspelt_frame_is_answered_with_the_line_to_change(nodes):
    nodes.start("robot", ROBOT)
    nodes.start("mounts", 'StaticTransformBroadcaster(node).sendTransform(stamped("base_lnk", "camera_link"))')
    finding = only("TF001")
    assert finding["publishers"] == ["/mounts"]
    assert "t.header.frame_id = 'base_link'" in finding["fix"]


@pytest.mark.usefixtures("domain_id")
def test_a_look_up_at_now_without_waiting_is_answered_with_the_line_to_change(nodes):
    nodes.start("robot", ROBOT)
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
    nodes.start("tf_listener", body)
    finding = only("TF025")
    assert finding["publishers"] == ["/tf_listener"]
    assert "extrapolation into the future" in finding["text"]
    assert "lookup_transform(target, source, rclpy.time.Time())" in finding["fix"]
    assert "timeout=Duration(seconds=0.1)" in finding["fix"]


@pytest.mark.usefixtures("domain_id")
def test_volatile_statics_on_both_sides(nodes):
    nodes.start("robot", ROBOT)
    nodes.start("own_publisher", 'p = node.create_publisher(TFMessage, "/tf_static", 10)')
    nodes.start("own_listener", 's = node.create_subscription(TFMessage, "/tf_static", lambda m: None, 10)')
    expected = {("TF016", "error", "/own_publisher"), ("TF016", "warning", "/own_listener")}
    for _ in range(5):
        findings = verdict("--duration", "2s")["findings"]
        if {(f["code"], f["severity"], *f["publishers"]) for f in findings} == expected:
            return
    pytest.fail(f"{findings}")


@pytest.mark.usefixtures("domain_id")
def test_statics_that_one_process_overwrites(nodes):
    nodes.start("robot", ROBOT)
    body = """
p = node.create_publisher(TFMessage, "/tf_static", QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL))
state = {"sent": 0}
def send():
    state["sent"] += 1
    name = "camera_link" if state["sent"] % 2 else "imu_link"
    p.publish(TFMessage(transforms=[stamped("base_link", name, 0.2)]))
every(0.5, send)
"""
    nodes.start("mounts", body)
    finding = only("TF016")
    assert "/mounts has sent" in finding["text"]
    assert "sendTransform([t1, t2, ...])" in finding["fix"]


@pytest.mark.usefixtures("domain_id")
def test_nobody_there_is_not_healthy():
    data = verdict("--duration", "1s")
    assert data["findings"] == []
    assert not data["healthy"]


@pytest.mark.usefixtures("domain_id")
def test_watch_tells_again_and_again_and_ends_by_a_signal(nodes):
    nodes.start("robot", ROBOT)
    command = [sys.executable, "-m", "coframe.cli", "doctor", "--watch", "--json", "--duration", "5s"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        heard = [json.loads(process.stdout.readline()) for _ in range(4)]
        process.terminate()
        assert process.wait(20) == 0
    assert heard[-1]["healthy"]
    assert set(heard[-1]["frames"]) == {"odom", "base_link", "lidar_link"}


@pytest.mark.slow
@pytest.mark.parametrize("_run", range(5))
@pytest.mark.usefixtures("domain_id")
def test_a_healthy_demo_has_no_finding_at_all(_run):
    command = [sys.executable, "-m", "coframe.cli", "demo", "--no-browser", "--duration", "60"]
    demo = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        deadline = time.monotonic() + 20
        while verdict("--duration", "1s")["transforms"] < 50:
            assert time.monotonic() < deadline
        data = verdict("--duration", "30s")
    finally:
        demo.terminate()
        demo.wait(20)
    assert data["findings"] == []
    assert data["healthy"]
