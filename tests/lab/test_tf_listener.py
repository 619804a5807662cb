# SPDX-License-Identifier: Apache-2.0
"""tf_listener: the pose of the end effector."""

import math
import signal

import numpy as np
import pytest

import tf2_ros
from coframe.lab.tf_listener import TransformListenerNode
from geometry_msgs.msg import PoseStamped, TransformStamped


def nanoseconds(stamp):
    return stamp.sec * 10**9 + stamp.nanosec


def angle(rotation):
    return 2 * math.atan2(rotation.z, rotation.w)


def test_the_pose_belongs_to_its_stamp(start, run):
    observer = start()
    run("tf_listener")
    run("dynamic_tf_broadcaster")
    poses = observer.hear(PoseStamped, "/end_effector_pose")
    transforms, _ = observer.hear_tf()
    observer.until(lambda: len(poses) >= 20)
    stamps = np.array([nanoseconds(pose.header.stamp) for pose in poses])
    assert np.median(np.diff(stamps)) == pytest.approx(0.1e9, rel=0.1)
    joints = {
        nanoseconds(message.transforms[0].header.stamp): [angle(t.transform.rotation) for t in message.transforms[:2]]
        for message in transforms
    }
    compared = 0
    for pose in poses:
        assert pose.header.frame_id == "base_link"
        if nanoseconds(pose.header.stamp) not in joints:
            continue  # older than the first received transform of the arm
        q1, q2 = joints[nanoseconds(pose.header.stamp)]
        position = pose.pose.position
        assert position.x == pytest.approx(0.5 * math.cos(q1) + 0.4 * math.cos(q1 + q2), abs=1e-12)
        assert position.y == pytest.approx(0.5 * math.sin(q1) + 0.4 * math.sin(q1 + q2), abs=1e-12)
        assert position.z == pytest.approx(0.1)
        assert angle(pose.pose.orientation) == pytest.approx(q1 + q2, abs=1e-12)
        compared += 1
    assert compared >= 15


def test_waiting_for_a_late_broadcaster_logs_few_warnings(start, capfd):
    observer = start()
    observer.add(TransformListenerNode())
    poses = observer.hear(PoseStamped, "/end_effector_pose")
    observer.spin_for(0.6)
    assert poses == []
    warnings = [line for line in capfd.readouterr().err.splitlines() if "Transform lookup failed" in line]
    assert len(warnings) == 1
    late = TransformStamped()
    late.header.frame_id, late.child_frame_id = "base_link", "end_effector"
    late.transform.translation.x = 0.9
    late.transform.rotation.w = 1.0
    tf2_ros.StaticTransformBroadcaster(observer.node).sendTransform(late)
    observer.until(lambda: poses)
    assert poses[0].pose.position.x == 0.9


def test_points_are_transformed(start, capfd):
    observer = start()
    node = observer.add(TransformListenerNode())
    turned = TransformStamped()
    turned.header.frame_id, turned.child_frame_id = "base_link", "camera_link"
    turned.transform.translation.x = 1.0
    turned.transform.rotation.z = turned.transform.rotation.w = math.sqrt(0.5)
    tf2_ros.StaticTransformBroadcaster(observer.node).sendTransform(turned)
    assert node.transform_point([1, 0, 2], "camera_link", "base_link") == pytest.approx([1.0, 1.0, 2.0])
    assert node.transform_point([1, 0, 2], "camera_link", "nowhere") is None
    assert "Point transform failed" in capfd.readouterr().err


@pytest.mark.parametrize(
    "name",
    [
        "static_tf_broadcaster",
        "dynamic_tf_broadcaster",
        "tf_listener",
        "sensor_transform",
        "complete_tf_tree",
        "simulated_lidar",
    ],
)
def test_nodes_end_cleanly_when_terminated(start, run, name):
    observer = start()
    process = run(name)
    observer.until(lambda: name in observer.node.get_node_names())
    process.send_signal(signal.SIGTERM)
    assert process.wait(20) == 0
