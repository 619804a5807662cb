# SPDX-License-Identifier: Apache-2.0
"""Messages of nodes that follow another distribution: they are read where that is possible, and a warning explains."""

import logging
import math
import os
import struct
import subprocess
import sys

import pytest

from coframe.errors import DecodeError
from coframe.messages import codec
from coframe.messages.other_forms import convert, difference, has_other_form, other_form
from coframe.messages.type_hash import type_hash
from lifecycle_msgs.msg import TransitionEvent
from rclpy.executors import SingleThreadedExecutor
from sensor_msgs.msg import PointField, Range
from std_msgs.msg import String

PUBLISHER = """
import sys, time
import rclpy
from lifecycle_msgs.msg import TransitionEvent
from sensor_msgs.msg import Range
rclpy.init()
node = rclpy.create_node("other")
event = TransitionEvent()
if hasattr(event, "stamp"):
    event.stamp.sec, event.stamp.nanosec = 5, 7
else:
    event.timestamp = 5_000_000_007
event.transition.label = "configure"
publishers = [node.create_publisher(TransitionEvent, "event", 1), node.create_publisher(Range, "range", 1)]
while True:
    publishers[0].publish(event)
    publishers[1].publish(Range(range=2.5))
    time.sleep(0.05)
"""


@pytest.fixture
def other(domain_id, tmp_path):
    """Return a function that starts a publisher that follows a distribution."""
    processes = []

    def start(distribution):
        environment = {**os.environ, "ROS_DOMAIN_ID": str(domain_id), "COFRAME_DISTRO": distribution}
        processes.append(subprocess.Popen([sys.executable, "-c", PUBLISHER], env=environment, cwd=tmp_path))

    yield start
    for process in processes:
        process.kill()
        process.wait()


@pytest.fixture
def received(context, node, wait_until):
    """Return a function that receives a message of each topic."""
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    events, ranges = [], []
    node.create_subscription(TransitionEvent, "event", events.append, 1)
    node.create_subscription(Range, "range", ranges.append, 1)

    def take():
        wait_until(lambda: events and ranges, lambda: executor.spin_once(timeout_sec=0.1), timeout=30)
        return events[0], ranges[0]

    yield take
    executor.shutdown()


@pytest.mark.dds_only("over Zenoh, the hash of the definition is part of the address")
def test_messages_of_lyrical_are_converted_and_explained(other, received, caplog, wait_until):
    caplog.set_level(logging.WARNING)
    other("lyrical")
    event, range_ = received()
    assert (event.timestamp, event.transition.label) == (5_000_000_007, "configure")
    assert range_.range == 2.5
    wait_until(lambda: "with the definition of ROS 2 Lyrical" in caplog.text)
    text = (
        "Node /other publishes lifecycle_msgs/msg/TransitionEvent on /event with the definition of ROS 2 Lyrical, but "
        "this subscription follows Jazzy. Fields that only one of them has are not transferred. Set COFRAME_DISTRO to "
        "use the same one."
    )
    assert caplog.text.count(text) == 1


@pytest.mark.dds_only("over Zenoh, the hash of the definition is part of the address")
def test_shorter_messages_of_humble_are_read(other, received):
    other("humble")
    event, range_ = received()
    assert event.timestamp == 5_000_000_007
    assert (range_.range, range_.variance) == (2.5, 0.0)


def test_bytes_that_fit_neither_definition_are_an_error():
    with pytest.raises(DecodeError, match="sensor_msgs/msg/Range"):
        codec.deserialize(b"\0\1\0\0\5", Range)


def test_both_directions_of_a_stamp_are_converted():
    other_class = other_form("lifecycle_msgs/msg/TransitionEvent")
    message = other_class()
    message.stamp.sec, message.stamp.nanosec = 3, 4
    assert convert(message, TransitionEvent).timestamp == 3_000_000_004
    back = convert(TransitionEvent(timestamp=3_000_000_004), other_class)
    assert (back.stamp.sec, back.stamp.nanosec) == (3, 4)
    assert convert(TransitionEvent(timestamp=2**64 - 1), other_class).stamp.sec == 2**31 - 1


def test_which_definitions_differ_on_the_wire():
    assert has_other_form(Range)
    assert has_other_form(TransitionEvent)
    assert not has_other_form(PointField)  # only constants
    assert not has_other_form(String)
    assert other_form("std_msgs/msg/String") is None


def test_definitions_are_named_by_their_hash():
    before = type_hash(other_form("sensor_msgs/msg/Range"))
    assert difference("sensor_msgs/msg/Range", before) == "the definition of ROS 2 before Jazzy"
    assert difference("sensor_msgs/msg/Range", "RIHS01_1") == "another definition"
    assert difference("my_msgs/msg/Thing", before) == "another definition"


def test_any_float_of_another_definition_is_read():
    """Programs cannot set a value beyond float32, but rounding lets bytes contain one that is refused."""
    largest = struct.pack("<f", 3.4028234663852886e38)
    before = b"\0\1\0\0" + struct.pack("<iII1sB2xf", 1, 2, 1, b"", 1, 0.5) + largest + struct.pack("<ff", math.inf, 3.0)
    message = codec.deserialize(before, Range)
    assert message.min_range == struct.unpack("<f", largest)[0]
    assert (message.max_range, message.range, message.variance) == (math.inf, 3.0, 0.0)
