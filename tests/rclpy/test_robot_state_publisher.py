# SPDX-License-Identifier: Apache-2.0
"""robot_state_publisher as a node, and as a command in a separate process."""

import subprocess
import sys

import pytest

from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.utilities import get_default_context  # noqa: F401 - the executors' default
from robot_state_publisher import RobotStatePublisher
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

URDF = """<robot name="arm">
  <link name="base"/> <link name="upper"/> <link name="tool"/>
  <joint name="turn" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/></joint>
  <joint name="mount" type="fixed"><parent link="upper"/><child link="tool"/><origin xyz="1 0 0"/></joint>
</robot>"""
LATCHED = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


@pytest.fixture
def received(make_node):
    """A node that listens, and what it has received by topic."""
    node = make_node("listener")
    found = {"/tf": [], "/tf_static": [], "/robot_description": []}
    for topic, kind, qos in (
        ("/tf", TFMessage, 10),
        ("/tf_static", TFMessage, LATCHED),
        ("/robot_description", String, LATCHED),
    ):
        node.create_subscription(kind, topic, found[topic].append, qos)
    return node, found


def frames(messages):
    return [(t.header.frame_id, t.child_frame_id) for message in messages for t in message.transforms]


def test_node(context, received, wait_until):
    listener, found = received
    overrides = [Parameter("robot_description", value=URDF), Parameter("frame_prefix", value="r1/")]
    node = RobotStatePublisher(context=context, parameter_overrides=overrides, start_parameter_services=False)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    executor.add_node(listener)
    spin = lambda: executor.spin_once(timeout_sec=0.05)  # noqa: E731
    states = listener.create_publisher(JointState, "joint_states", 10)
    try:
        wait_until(
            lambda: found["/tf_static"] and found["/robot_description"] and states.get_subscription_count(), spin
        )
        assert frames(found["/tf_static"]) == [("r1/upper", "r1/tool")]
        assert found["/robot_description"][0].data == URDF
        state = JointState(name=["turn"], position=[0.5])
        state.header.stamp.sec = 7
        states.publish(JointState(name=["turn"], position=[0.5, 0.6]))  # Invalid: more positions than names.
        states.publish(state)
        wait_until(lambda: found["/tf"], spin)
        (transform,) = found["/tf"][0].transforms
        assert (transform.header.frame_id, transform.child_frame_id, transform.header.stamp.sec) == (
            "r1/base",
            "r1/upper",
            7,
        )
        assert transform.transform.rotation.z == pytest.approx(0.247403959)

        for text, reason in (
            ("", "Empty URDF is not allowed"),
            ("<robot name='x'/>", "line 1: the robot has no links"),
        ):
            (result,) = node.set_parameters([Parameter("robot_description", value=text)])
            assert (result.successful, result.reason) == (False, reason)
        (result,) = node.set_parameters([Parameter("publish_frequency", value=2000.0)])
        assert not result.successful
        other = URDF.replace("tool", "gripper")
        (result,) = node.set_parameters([Parameter("robot_description", value=other)])
        assert result.successful
        # Late-joining subscriptions receive the transforms of the new robot only.
        wait_until(lambda: frames(found["/tf_static"][-1:]) == [("r1/upper", "r1/gripper")], spin)
        wait_until(lambda: found["/robot_description"][-1].data == other, spin)

        changes = {
            "frame_prefix": "r2/",
            "frame_prefix_keep": "base",
            "ignore_timestamp": True,
            "publish_frequency": 1.0,
        }
        results = node.set_parameters([Parameter(name, value=value) for name, value in changes.items()])
        assert all(result.successful for result in results)
        found["/tf"].clear()
        for _ in range(3):  # Without ignore_timestamp, equal stamps would be published once.
            states.publish(state)
        wait_until(lambda: len(found["/tf"]) == 3, spin)
        assert frames(found["/tf"]) == [("base", "r2/upper")] * 3
    finally:
        node.destroy_node()


def test_a_description_from_the_topic(context, received, wait_until):
    listener, found = received
    overrides = [Parameter("use_robot_description_topic", value=True)]
    node = RobotStatePublisher(context=context, parameter_overrides=overrides, start_parameter_services=False)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    executor.add_node(listener)
    spin = lambda: executor.spin_once(timeout_sec=0.05)  # noqa: E731
    states = listener.create_publisher(JointState, "joint_states", 10)
    descriptions = listener.create_publisher(String, "robot_description", LATCHED)
    try:
        wait_until(states.get_subscription_count, spin)
        for text in ("no robot", URDF):
            descriptions.publish(String(data=text))
        wait_until(lambda: frames(found["/tf_static"]) == [("upper", "tool")], spin)
        wait_until(lambda: found["/tf"] or states.publish(JointState(name=["turn"], position=[0.5])), spin)
        assert frames(found["/tf"])[0] == ("base", "upper")
        assert node.count_publishers("/robot_description") == 1, "only the one of the test"
    finally:
        node.destroy_node()


def test_command(context, received, wait_until, tmp_path):
    listener, found = received
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(listener)
    argument = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:arg name="reach" default="1"/>'
    text = URDF.replace('<robot name="arm">', argument).replace('xyz="1 0 0"', 'xyz="$(arg reach) 0 0"')
    (tmp_path / "arm.xacro").write_text(text)
    command = [sys.executable, "-m", "coframe.cli", "robot", str(tmp_path / "arm.xacro"), "--prefix", "x/", "reach:=2"]
    process = subprocess.Popen(
        [*command, "--ros-args", "-r", "__node:=publisher_of_x", "-p", "frame_prefix_keep:=tool"],
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        wait_until(lambda: found["/tf_static"], lambda: executor.spin_once(timeout_sec=0.05), timeout=30.0)
        assert frames(found["/tf_static"]) == [("x/upper", "tool")]
        assert found["/tf_static"][0].transforms[0].transform.translation.x == 2.0
        wait_until(lambda: "publisher_of_x" in [name for name, _ in listener.get_node_names_and_namespaces()])
    finally:
        process.terminate()
        _, errors = process.communicate(timeout=20)
    assert process.returncode == 0
    assert "got segment tool" in errors
    assert "Traceback" not in errors


def test_invalid_description(tmp_path):
    (tmp_path / "bad.urdf").write_text("<robot name='r'>\n<link/></robot>")
    for command in (["coframe.cli", "robot"], ["robot_state_publisher"]):
        result = subprocess.run(
            [sys.executable, "-m", *command, str(tmp_path / "bad.urdf")], capture_output=True, text=True, check=False
        )
        assert result.returncode == 1
        assert "bad.urdf, line 2: <link> needs the attribute name" in result.stderr
        assert "Traceback" not in result.stderr
