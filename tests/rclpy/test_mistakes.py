# SPDX-License-Identifier: Apache-2.0
"""Helpful error messages for common mistakes."""

import os
import subprocess
import sys

import pytest

import rclpy
from geometry_msgs.msg import PoseStamped
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time
from std_srvs.srv import Trigger


def test_missing_super_init_is_reported():
    class Forgetful(Node):
        def __init__(self):
            self.timer = self.create_timer(1.0, print)

    class Logging(Forgetful):
        def __init__(self):
            self.get_logger()

    for kind in (Forgetful, Logging):
        with pytest.raises(AttributeError, match=r"Call super\(\).__init__\('node_name'\) first"):
            kind()


def test_unknown_attribute_of_a_node(node):
    with pytest.raises(AttributeError, match="'Node' object has no attribute 'create_subscripton'"):
        node.create_subscripton()
    assert not hasattr(node, "timer")


def test_callback_that_was_called_instead_of_passed(node):
    with pytest.raises(TypeError, match="must be a function, not None"):
        node.create_timer(1.0, print())
    with pytest.raises(TypeError, match="must be a function, not None"):
        node.create_subscription(PoseStamped, "/pose", print(), 10)
    with pytest.raises(TypeError, match="must be a function, not None"):
        node.create_service(Trigger, "trigger", print())


def test_message_instance_instead_of_class_is_accepted_as_in_ros(node):
    assert node.create_publisher(PoseStamped(), "/pose", 10).msg_type is PoseStamped


def test_types_of_another_kind(node):
    with pytest.raises(AttributeError, match="type object 'str' has no attribute '_TYPE_SUPPORT'") as caught:
        node.create_publisher("geometry_msgs/msg/Pose", "/pose", 10)
    assert caught.value.hint == "Expected a class such as std_msgs.msg.String, got 'geometry_msgs/msg/Pose'."
    with pytest.raises(RuntimeError, match="this might be a service or action"):
        node.create_publisher(Trigger, "/pose", 10)
    with pytest.raises(RuntimeError, match="this might be a message or action"):
        node.create_client(PoseStamped, "/pose")


@pytest.mark.parametrize("kind", [Duration, Time])
def test_string_instead_of_number(kind):
    with pytest.raises(TypeError, match="got the string '1'"):
        kind(seconds="1")
    with pytest.raises(TypeError, match="got the string '1'"):
        kind(nanoseconds="1")


@pytest.mark.usefixtures("domain_id")
def test_spinning_a_node_of_a_context_that_was_shut_down():
    rclpy.init(args=[])
    node = rclpy.create_node("old")
    rclpy.shutdown()
    rclpy.init(args=[])
    try:
        with SingleThreadedExecutor() as executor, pytest.raises(RuntimeError, match="context that was shut down"):
            executor.add_node(node)
    finally:
        node.destroy_node()
        rclpy.shutdown()


@pytest.mark.parametrize(
    ("distribution", "text"),
    [
        ("humble", "('Invalid access to undeclared parameter(s)', 'rate')"),
        ("jazzy", "Invalid access to undeclared parameter(s): rate"),
    ],
)
def test_texts_of_exceptions_are_those_of_the_distribution(distribution, text):
    program = "import rclpy.exceptions as e; f = e.ParameterNotDeclaredException('rate'); print(f, f.parameters)"
    environment = {**os.environ, "ROS_DISTRO": distribution}
    done = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=True)
    assert done.stdout == f"{text} ['rate']\n"
