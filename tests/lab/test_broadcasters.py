# SPDX-License-Identifier: Apache-2.0
"""static_tf_broadcaster, dynamic_tf_broadcaster and complete_tf_tree."""

import math
import os
import subprocess
import sys

import numpy as np
import pytest

import tf2_ros
from coframe.lab.complete_tf_tree import CompleteTFTree
from coframe.lab.dynamic_tf_broadcaster import DynamicFramePublisher
from coframe.lab.static_tf_broadcaster import StaticFramePublisher
from rclpy.duration import Duration
from rclpy.time import Time
from sensor_msgs.msg import JointState

ROOT_HALF = math.sqrt(0.5)
ARM = ["link1", "link2", "end_effector"]


def children(message):
    return [transform.child_frame_id for transform in message.transforms]


def by_child(message):
    return {transform.child_frame_id: transform for transform in message.transforms}


def numbers(transform):
    t, q = transform.transform.translation, transform.transform.rotation
    return [t.x, t.y, t.z, q.x, q.y, q.z, q.w]


def nanoseconds(stamp):
    return stamp.sec * 10**9 + stamp.nanosec


def angle(transform):
    return 2 * math.atan2(transform.transform.rotation.z, transform.transform.rotation.w)


def test_sensor_mounts_have_the_default_values_of_the_lab(start):
    observer = start()
    observer.add(StaticFramePublisher())
    _, received = observer.hear_tf()
    observer.until(lambda: received)
    assert len(received) == 1
    mounts = by_child(received[0])
    assert numbers(mounts["camera_link"]) == pytest.approx([0.05, 0, 0.02, 0, ROOT_HALF, 0, ROOT_HALF], abs=1e-15)
    assert numbers(mounts["imu_link"]) == [0, 0, 0.1, 0, 0, 0, 1]
    assert numbers(mounts["lidar_link"]) == [0, 0, 0.5, 0, 0, 0, 1]
    assert [mounts[child].header.frame_id for child in ("camera_link", "imu_link", "lidar_link")] == [
        "end_effector",
        "base_link",
        "base_link",
    ]


def test_sensor_mounts_can_be_set_by_parameters(start):
    observer = start("lidar_translation:=[0.1, 0.2, 0.3]", "lidar_rotation:=[0.0, 0.0, 2.0, 0.0]", "lidar_frame:=laser")
    observer.add(StaticFramePublisher())
    _, received = observer.hear_tf()
    observer.until(lambda: received)
    assert numbers(by_child(received[0])["laser"]) == [0.1, 0.2, 0.3, 0, 0, 1, 0]


def test_the_arm_is_simulated_without_joint_states(start):
    observer = start()
    observer.add(DynamicFramePublisher())
    received, _ = observer.hear_tf()
    observer.until(lambda: len(received) >= 50)
    assert all(children(message) == ARM for message in received)
    first, second, third = received[0].transforms
    assert [t.header.frame_id for t in received[0].transforms] == ["base_link", "link1", "link2"]
    assert numbers(first)[:3] == [0, 0, 0.1]
    assert numbers(second)[:3] == [0.5, 0, 0]
    assert numbers(third) == [0.4, 0, 0, 0, 0, 0, 1]

    def stamps():
        return np.array([nanoseconds(message.transforms[0].header.stamp) for message in received])

    # A busy machine delays timers, so this waits until the last 25 periods are right.
    observer.until(lambda: np.median(np.diff(stamps())[-25:]) == pytest.approx(20e6, rel=0.1))
    assert np.all(np.diff(stamps()) > 0)
    # The motion of the lab, whose start time is unknown.
    q1 = np.array([angle(message.transforms[0]) for message in received])
    q2 = np.array([angle(message.transforms[1]) for message in received])
    begins = np.linspace(-0.1, 3.0, 31001)
    elapsed = (stamps() - stamps()[0]) * 1e-9
    begin = begins[np.argmin([np.abs(0.5 * np.sin(0.4 * np.pi * (b + elapsed)) - q1).max() for b in begins])]
    assert np.allclose(q1, 0.5 * np.sin(0.4 * np.pi * (begin + elapsed)), atol=1e-4)
    assert np.allclose(q2, 0.3 * np.sin(0.6 * np.pi * (begin + elapsed) + np.pi / 4), atol=1e-4)


def test_joint_states_replace_the_simulation_until_they_stop(start):
    observer = start("joint_timeout:=0.3")
    node = observer.add(DynamicFramePublisher())
    received, _ = observer.hear_tf()
    robot = observer.node.create_publisher(JointState, "/joint_states", 10)
    observer.until(lambda: robot.get_subscription_count() and len(received) > 5)

    sent: list[int] = []

    def send() -> None:
        now = observer.node.get_clock().now()
        sent.append(now.nanoseconds)
        state = JointState(name=["gripper", "joint2", "joint1"], position=[0.0, -0.7, 1.1])
        state.header.stamp = now.to_msg()
        robot.publish(state)

    timer = observer.node.create_timer(0.05, send)
    observer.until(lambda: any(angle(message.transforms[0]) > 1.0 for message in received))
    begin = len(received)
    paused_at = node.sim_time
    observer.until(lambda: len(received) >= begin + 15)
    timer.cancel()
    driven = received[begin : begin + 15]
    # No simulated transforms are in between.
    assert all(angle(message.transforms[0]) == pytest.approx(1.1) for message in driven)
    assert all(angle(message.transforms[1]) == pytest.approx(-0.7) for message in driven)
    assert all(children(message) == ARM for message in driven)
    assert {nanoseconds(t.header.stamp) for message in driven for t in message.transforms} <= set(sent)
    assert node.sim_time == paused_at

    observer.until(lambda: angle(received[-1].transforms[0]) < 1.0)
    resumed = received[-1].transforms[0]
    assert nanoseconds(resumed.header.stamp) - sent[-1] >= 0.3e9
    # The simulation resumes at the position where it stopped.
    assert angle(resumed) == pytest.approx(0.5 * math.sin(0.4 * math.pi * (paused_at + 0.02)), abs=0.1)


def arm_after(start, *states):
    """Return a function that passes a joint state to the node and returns the angles and stamps of the arm."""
    observer = start()
    node = DynamicFramePublisher()
    node.timer.cancel()  # before anything runs its callback
    observer.add(node)
    received, _ = observer.hear_tf()
    observer.until(node.tf_broadcaster.pub_tf.get_subscription_count)
    for state in states:
        node.joint_callback(state)
    observer.until(lambda: received)
    return [
        (round(angle(m.transforms[0]), 9), round(angle(m.transforms[1]), 9), m.transforms[0].header.stamp.sec)
        for m in received
    ]


def state(*positions, names=(), sec=5):
    message = JointState(name=list(names), position=[float(position) for position in positions])
    message.header.stamp.sec = sec
    return message


def test_without_joint_names_the_first_two_positions_are_used(start):
    assert arm_after(start, state(0.1, 0.2, 0.3)) == [(0.1, 0.2, 5)]


def test_with_other_joint_names_the_first_two_positions_are_used(start):
    assert arm_after(start, state(0.1, 0.2, names=["shoulder", "elbow"])) == [(0.1, 0.2, 5)]


def test_a_joint_state_without_a_stamp_gets_the_current_time(start):
    [(q1, q2, sec)] = arm_after(start, state(0.1, 0.2, sec=0))
    assert (q1, q2) == (0.1, 0.2)
    assert sec > 1_600_000_000


def test_invalid_joint_states_are_ignored_with_a_warning(start, capfd):
    broken = [
        state(0.1),
        state(),
        state(math.nan, 0.2),
        state(0.1, math.inf),
        state(0.1, 0.2, names=["joint1", "wheel"]),
        state(0.1, names=["joint2", "joint1"]),
    ]
    assert arm_after(start, *broken, state(0.3, 0.4)) == [(0.3, 0.4, 5)]
    warnings = [line for line in capfd.readouterr().err.splitlines() if "Joint state ignored" in line]
    assert len(warnings) == 1  # not one for each
    assert "[WARN]" in warnings[0]


def test_the_complete_tree(start):
    observer = start()
    observer.add(CompleteTFTree())
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(buffer, observer.node)
    received, received_static = observer.hear_tf()
    observer.until(lambda: len(received) >= 10 and received_static)
    assert all(children(message) == ["odom", "base_link", *ARM] for message in received)
    mounts = by_child(received_static[0])
    assert {child: mount.header.frame_id for child, mount in mounts.items()} == {
        "map": "world",
        "imu_link": "base_link",
        "lidar_link": "base_link",
        "camera_link": "end_effector",
        "gripper_link": "end_effector",
    }
    assert numbers(mounts["lidar_link"]) == [0.1, 0, 0.3, 0, 0, 0, 1]
    assert numbers(mounts["camera_link"]) == pytest.approx([0.05, 0, 0.02, 0, ROOT_HALF, 0, ROOT_HALF], abs=1e-15)
    for frame in ("imu_link", "lidar_link", "camera_link", "gripper_link"):
        assert buffer.can_transform("world", frame, Time(), Duration(seconds=10))

    transforms = by_child(received[-1])
    # The forward motion of 0.1 m/s gives the simulated time, from which everything else follows.
    time = transforms["base_link"].transform.translation.x / 0.1
    assert numbers(transforms["odom"])[:3] == pytest.approx([0.001 * time, 0.0005 * time, 0])
    assert transforms["base_link"].transform.translation.y == pytest.approx(0.05 * math.sin(0.5 * time))
    assert angle(transforms["base_link"]) == pytest.approx(0.1 * math.sin(0.2 * time))
    assert angle(transforms["link1"]) == pytest.approx(0.5 * math.sin(0.3 * time))
    assert angle(transforms["link2"]) == pytest.approx(0.3 * math.sin(0.4 * time + 0.5))
    assert numbers(transforms["link1"])[:3] == [0, 0, 0.2]
    assert numbers(transforms["link2"])[:3] == [0.4, 0, 0]
    assert numbers(transforms["end_effector"])[:3] == [0.3, 0, 0]


def test_arm_and_mounts_can_be_disabled(start):
    observer = start("publish_arm:=false", "publish_mounts:=false")
    observer.add(CompleteTFTree())
    received, received_static = observer.hear_tf()
    observer.until(lambda: received and received_static)
    assert children(received[0]) == ["odom", "base_link"]
    assert children(received_static[0]) == ["map", "gripper_link"]


@pytest.mark.parametrize(
    ("node", "parameter", "sentence"),
    [
        (
            "static_tf_broadcaster",
            "imu_translation:=[0.0, 1.0]",
            "parameter 'imu_translation' must have 3 finite numbers",
        ),
        ("static_tf_broadcaster", "imu_rotation:=[0.0, 0.0, 0.0, 0.0]", "parameter 'imu_rotation'"),
        ("static_tf_broadcaster", "imu_rotation:=upwards", "of type 'STRING', expecting type 'DOUBLE_ARRAY'"),
        ("dynamic_tf_broadcaster", "link_lengths:=[0.5]", "'link_lengths' must have two entries"),
        ("dynamic_tf_broadcaster", "rate:=0.0", "parameter 'rate' must be greater than 0 Hz"),
        ("complete_tf_tree", "rate:=0.0", "parameter 'rate' must be greater than 0 Hz"),
    ],
)
@pytest.mark.usefixtures("domain_id")
def test_an_invalid_parameter_stops_the_node_with_an_error(node, parameter, sentence):
    command = [sys.executable, "-m", f"coframe.lab.{node}", "--ros-args", "-p", parameter]
    result = subprocess.run(command, capture_output=True, text=True, timeout=30, check=False)
    assert result.returncode == 1
    assert result.stderr.startswith(f"{node}: ")
    assert sentence in result.stderr
    assert "Traceback" not in result.stderr


@pytest.mark.parametrize("node", ["static_tf_broadcaster", "dynamic_tf_broadcaster", "complete_tf_tree"])
@pytest.mark.parametrize(
    ("arguments", "environment", "sentence"),
    [
        (["-r", "nonsense"], {}, "'-r nonsense'. Error: it does not have the form from:=to"),
        (["--params-file", "nowhere.yaml"], {}, "--params-file nowhere.yaml"),
        (["-r", "__node:=a-b"], {}, "Invalid node name"),
        ([], {"ROS_DOMAIN_ID": "abc"}, "ROS_DOMAIN_ID is 'abc'"),
        pytest.param(
            [],
            {"ROS_AUTOMATIC_DISCOVERY_RANGE": "FAR"},
            "ROS_AUTOMATIC_DISCOVERY_RANGE is 'FAR'",
            marks=pytest.mark.dds_only("the variable has no effect on Zenoh"),
        ),
    ],
)
@pytest.mark.usefixtures("domain_id")
def test_an_invalid_command_line_or_environment_stops_the_node_with_an_error(node, arguments, environment, sentence):
    command = [sys.executable, "-m", f"coframe.lab.{node}", "--ros-args", *arguments]
    result = subprocess.run(
        command, capture_output=True, text=True, timeout=30, check=False, env={**os.environ, **environment}
    )
    assert result.returncode == 1
    assert result.stderr.startswith(f"{node}: ")
    assert sentence in result.stderr
    assert "Traceback" not in result.stderr
