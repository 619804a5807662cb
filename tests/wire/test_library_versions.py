# SPDX-License-Identifier: Apache-2.0
"""Processes that use different releases of the DDS library, on one graph."""

import os
import shlex

import pytest

from coframe.wire.dds import library

LAB = ["static_tf_broadcaster", "dynamic_tf_broadcaster", "tf_listener", "sensor_transform", "complete_tf_tree"]

# A robot: transforms, a static transform that is published before the other side starts, and a service.
ROBOT = """
import threading, rclpy, tf2_ros
from geometry_msgs.msg import TransformStamped
from std_srvs.srv import SetBool
from coframe.wire.dds import library

def transform(parent, child, x):
    stamped = TransformStamped(child_frame_id=child)
    stamped.header.frame_id = parent
    stamped.header.stamp = node.get_clock().now().to_msg()
    stamped.transform.translation.x = x
    stamped.transform.rotation.w = 1.0
    return stamped

def answer(request, response):
    response.success, response.message = request.data, "from the robot"
    return response

rclpy.init()
node = rclpy.create_node("robot")
statics = tf2_ros.StaticTransformBroadcaster(node)
statics.sendTransform(transform("base_link", "lidar", 0.25))
moving = tf2_ros.TransformBroadcaster(node)
timer = node.create_timer(0.05, lambda: moving.sendTransform(transform("odom", "base_link", 2.0)))
service = node.create_service(SetBool, "/enable", answer)
threading.Thread(target=lambda: (input(), rclpy.shutdown()), daemon=True).start()
print(library.load().release, flush=True)
rclpy.spin(node)
"""
STATION = """
import rclpy, tf2_ros
from rclpy.time import Time
from std_srvs.srv import SetBool
from coframe.wire.dds import library

rclpy.init()
node = rclpy.create_node("station")
buffer = tf2_ros.Buffer()
listener = tf2_ros.TransformListener(buffer, node, spin_thread=False)
future = buffer.wait_for_transform_async("odom", "lidar", Time())
rclpy.spin_until_future_complete(node, future, timeout_sec=20)
x = buffer.lookup_transform("odom", "lidar", Time()).transform.translation.x
client = node.create_client(SetBool, "/enable")
assert client.wait_for_service(20.0), "no service"
reply = client.call_async(SetBool.Request(data=True))
rclpy.spin_until_future_complete(node, reply, timeout_sec=20)
answer = reply.result()
names = sorted(node.get_node_names())
print(library.load().release, x, answer.success, answer.message, ",".join(names), flush=True)
rclpy.shutdown()
"""


@pytest.fixture(scope="module")
def libraries() -> dict[str, str]:
    """One library of each supported release: its path by its release."""
    found = {}
    for place in library.places({}):
        if place.path is not None:
            release = "11" if place.version.startswith("11") else "0.10" if place.version.startswith("0.10") else ""
            found.setdefault(release, str(place.path))
    for release, package in (("11", "pip install 'coframe[dds]'"), ("0.10", "apt-get install libddsc0debian")):
        if release not in found:
            pytest.skip(f"no DDS library of release {release} on this machine: {package}")
    return found


@pytest.mark.parametrize(("robot", "station"), [("0.10", "11"), ("11", "0.10")])
def test_transforms_late_statics_and_services(libraries, child, robot, station):
    publisher = child(ROBOT, COFRAME_DDS_LIBRARY=libraries[robot])
    assert publisher.read() == robot
    listener = child(STATION, COFRAME_DDS_LIBRARY=libraries[station])
    assert listener.read() == f"{station} 2.25 True from the robot robot,station"
    assert publisher.finish()[0] == 0
    assert listener.finish()[0] == 0


@pytest.mark.slow
@pytest.mark.parametrize(("nodes", "observer"), [("0.10", "11"), ("11", "0.10")])
def test_the_lab_nodes(libraries, child, nodes, observer):
    for module in LAB:
        child(f"from coframe.lab import {module}; {module}.main()", COFRAME_DDS_LIBRARY=libraries[nodes])
    other = child(OBSERVER, COFRAME_DDS_LIBRARY=libraries[observer])
    assert other.read() == observer
    seen = other.read().split(",")
    assert [name for name in LAB if name not in seen] == []


@pytest.fixture
def other_python() -> list[str]:
    """The command of another Python in which coframe is installed; scripts/test_in_root.sh sets it."""
    command = shlex.split(os.environ.get("COFRAME_TEST_OTHER_PYTHON", ""))
    if not command:
        pytest.skip("there is no other Python: scripts/test_in_root.sh --sdist --suite sid")
    return command


@pytest.mark.slow
def test_transforms_and_services_of_another_python(other_python, child):
    publisher = child(ROBOT, python=other_python)
    other = publisher.read()
    listener = child(STATION)
    here, *received = listener.read().split(" ", 1)
    assert received == ["2.25 True from the robot robot,station"]
    print(f"published with Cyclone DDS {other}, received with {here}")
    assert publisher.finish()[0] == listener.finish()[0] == 0


@pytest.mark.slow
def test_transforms_and_services_in_another_python(other_python, child):
    publisher = child(ROBOT)
    publisher.read()
    listener = child(STATION, python=other_python)
    assert listener.read().split(" ", 1)[1] == "2.25 True from the robot robot,station"
    assert publisher.finish()[0] == listener.finish()[0] == 0


@pytest.mark.slow
@pytest.mark.parametrize("nodes_are_here", [True, False])
def test_the_lab_nodes_of_another_python(other_python, child, nodes_are_here):
    here: dict[str, list[str]] = {}
    there = {"python": other_python}
    nodes, observer = (here, there) if nodes_are_here else (there, here)
    for module in LAB:
        child(f"from coframe.lab import {module}; {module}.main()", **nodes)
    other = child(OBSERVER, **observer)
    other.read()
    seen = other.read().split(",")
    assert [name for name in LAB if name not in seen] == []


OBSERVER = """
import time, coframe
from coframe.wire import Participant
from coframe.wire.dds import library
participant = Participant.get()
print(library.load().release, flush=True)
expected = {"static_tf_broadcaster", "dynamic_tf_broadcaster", "tf_listener", "sensor_transform", "complete_tf_tree"}
deadline = time.monotonic() + 60
names = set()
while not expected <= names and time.monotonic() < deadline:
    names = {name for _, name in participant.nodes()}
    time.sleep(0.1)
print(",".join(sorted(names)), flush=True)
"""
