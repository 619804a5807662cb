# SPDX-License-Identifier: Apache-2.0
"""The robot of the lab from its description, which gives the same transforms as the hand-written nodes."""

import subprocess
import sys

import numpy as np
import pytest

import rclpy
from coframe.lab import robot_state_publisher as described
from coframe.lab.complete_tf_tree import CompleteTFTree
from coframe.lab.dynamic_tf_broadcaster import DynamicFramePublisher
from coframe.lab.launcher import COMPLETE_LAB, DESCRIBED_LAB
from coframe.robots import load
from rclpy.parameter import Parameter
from robot_state_publisher import RobotStatePublisher
from rosgraph_msgs.msg import Clock

pytest.importorskip("xacro", reason="the lab's robot is described in xacro")
NS = 1_000_000_000
START, PERIOD, TICKS = 100 * NS, NS // 50, 40
STATIC_COUNT = 5  # map, imu, lidar, camera, gripper
CLASSES = {"complete_tf_tree": CompleteTFTree, "dynamic_tf_broadcaster": DynamicFramePublisher}


def arm(**arguments):
    return load(described.ARM, arguments=arguments)


def arm_publisher():
    return RobotStatePublisher(parameter_overrides=[Parameter("robot_description", value=arm().text)])


def values(transform):
    t, r = transform.transform.translation, transform.transform.rotation
    return [t.x, t.y, t.z, r.x, r.y, r.z, r.w]


def broadcast(start, commands):
    """Return the transforms of a lab in simulated time: dynamic ones by frames and stamp, static ones by frames."""
    parameters = [word for command in commands for word in command.arguments if word != "-p"]
    observer = start("use_sim_time:=true", *parameters)
    nodes = [observer.add(CLASSES[command.name]()) for command in commands if command.name in CLASSES]
    if any(command.name == "robot_state_publisher" for command in commands):
        nodes.append(observer.add(arm_publisher()))
    received, received_static = observer.hear_tf()
    clock = observer.node.create_publisher(Clock, "/clock", 10)
    observer.until(lambda: clock.get_subscription_count() == len(nodes) + 1)
    dynamic = {}

    def stamps_of(child):
        for message in received:
            for t in message.transforms:
                stamp = t.header.stamp.sec * NS + t.header.stamp.nanosec
                dynamic[t.header.frame_id, t.child_frame_id, stamp] = values(t)
        received.clear()
        return {stamp for _, name, stamp in dynamic if name == child}

    for tick in range(TICKS):
        now = START + tick * PERIOD
        message = Clock()
        message.clock.sec, message.clock.nanosec = divmod(now, NS)
        clock.publish(message)
        observer.until(lambda now=now: now in stamps_of("base_link") & stamps_of("end_effector"))

    def static_by_frames():
        return {(t.header.frame_id, t.child_frame_id): values(t) for m in received_static for t in m.transforms}

    observer.until(lambda: len(static_by_frames()) >= STATIC_COUNT)  # Latched messages can arrive late.
    static = static_by_frames()
    observer.close()
    rclpy.try_shutdown()
    return dynamic, static


def test_the_description_gives_the_same_transforms_as_the_hand_written_nodes(start):
    by_hand, by_hand_static = broadcast(start, COMPLETE_LAB)
    from_description, from_description_static = broadcast(start, DESCRIBED_LAB)
    assert len(by_hand) == 5 * TICKS  # odom, base_link, link1, link2, end_effector
    assert from_description.keys() == by_hand.keys()
    for key, expected in by_hand.items():
        np.testing.assert_allclose(from_description[key], expected, rtol=0, atol=1e-12, err_msg=str(key))
    assert len(by_hand_static) == STATIC_COUNT
    assert from_description_static.keys() == by_hand_static.keys()
    for key, expected in by_hand_static.items():
        np.testing.assert_allclose(from_description_static[key], expected, rtol=0, atol=1e-12, err_msg=str(key))


def test_the_dimensions_of_the_last_step_of_the_lab():
    frames = arm(first_length="0.4", second_length="0.3", base_height="0.2").frames({"joint1": 0.3, "joint2": -0.5})
    expected = [0.4 * np.cos(0.3) + 0.3 * np.cos(-0.2), 0.4 * np.sin(0.3) + 0.3 * np.sin(-0.2), 0.2]
    np.testing.assert_allclose(frames["end_effector"].translation, expected, atol=1e-15)
    assert arm().free_joints == ("joint1", "joint2")
    assert arm().warnings == ()


def test_without_xacro_the_error_says_what_to_install():
    code = "import sys; sys.modules['xacro'] = None; from coframe.lab.robot_state_publisher import main; main([])"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert result.returncode == 1
    assert "the package xacro is not installed" in result.stderr
    assert "pip install 'coframe[robots]'" in result.stderr
    assert "Traceback" not in result.stderr
