# SPDX-License-Identifier: Apache-2.0
"""tf2_nav_msgs and tf2_visualization_msgs."""

import copy
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import tf2_nav_msgs
import tf2_ros
import tf2_visualization_msgs
from geometry_msgs.msg import Point, PoseStamped, Quaternion
from nav_msgs.msg import Odometry
from nav_msgs.msg import Path as PathMessage
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker

ROTATION = Rotation.random(random_state=5)
ORIENTATION = Rotation.random(random_state=6)
TRANSLATION = (1.0, -2.0, 3.0)


@pytest.fixture
def transform(stamped):
    return stamped("map", "odom", 3.0, TRANSLATION, tuple(ROTATION.as_quat()))


@pytest.fixture
def buffer(transform):
    buffer = tf2_ros.Buffer()
    buffer.set_transform_static(transform, "me")
    return buffer


def place(pose, x, y, z):
    pose.position = Point(x=x, y=y, z=z)
    qx, qy, qz, qw = ORIENTATION.as_quat().tolist()
    pose.orientation = Quaternion(x=qx, y=qy, z=qz, w=qw)


def is_at(pose, x, y, z):
    position = [pose.position.x, pose.position.y, pose.position.z]
    q = pose.orientation
    expected = (ROTATION * ORIENTATION).as_quat(canonical=True)
    return np.allclose(position, ROTATION.apply([x, y, z]) + TRANSLATION) and np.allclose(
        [q.x, q.y, q.z, q.w], expected
    )


def test_odometry(buffer):
    factor = np.random.default_rng(1).normal(size=(6, 6))
    covariance = factor @ factor.T
    odometry = Odometry(child_frame_id="base_link")
    odometry.header.frame_id, odometry.header.stamp.sec = "odom", 9
    place(odometry.pose.pose, 1.0, 2.0, 3.0)
    odometry.pose.covariance = odometry.twist.covariance = covariance.reshape(36)
    odometry.twist.twist.linear.x = 0.5
    before = copy.deepcopy(odometry)
    moved = buffer.transform(odometry, "map")
    assert (moved.header.frame_id, moved.header.stamp.sec, moved.child_frame_id) == ("map", 9, "base_link")
    assert is_at(moved.pose.pose, 1.0, 2.0, 3.0)
    blocks = np.kron(np.eye(2), ROTATION.as_matrix())
    assert np.allclose(np.reshape(moved.pose.covariance, (6, 6)), blocks @ covariance @ blocks.T, atol=1e-13)
    assert moved.twist == before.twist
    moved.twist.twist.linear.x = 7.0
    assert odometry == before


def path_of(*frames):
    path = PathMessage()
    path.header.frame_id, path.header.stamp.sec = "odom", 9
    for number, frame in enumerate(frames):
        pose = PoseStamped()
        pose.header.frame_id, pose.header.stamp.sec = frame, 10 + number
        place(pose.pose, float(number), 2.0, 3.0)
        path.poses.append(pose)
    return path


def test_path(buffer):
    path = path_of("odom", "", "odom")
    before = copy.deepcopy(path)
    moved = buffer.transform(path, "map")
    assert (moved.header.frame_id, moved.header.stamp.sec) == ("map", 9)
    assert [pose.header.frame_id for pose in moved.poses] == ["map"] * 3
    assert [pose.header.stamp.sec for pose in moved.poses] == [10, 11, 12]
    assert all(is_at(pose.pose, float(number), 2.0, 3.0) for number, pose in enumerate(moved.poses))
    assert path == before


def test_path_with_a_pose_in_another_frame_is_rejected(transform):
    with pytest.raises(tf2_ros.InvalidArgumentException, match=r"Pose 1 of the path is expressed in frame 'base_link'"):
        tf2_nav_msgs.do_transform_path(path_of("odom", "base_link"), transform)


def test_marker(buffer):
    marker = Marker(type=Marker.LINE_STRIP, ns="lane", frame_locked=True, text="left")
    marker.header.frame_id, marker.header.stamp.sec = "odom", 9
    place(marker.pose, 1.0, 2.0, 3.0)
    marker.points, marker.colors = [Point(x=1.0), Point(y=1.0)], [ColorRGBA(r=1.0), ColorRGBA(a=1.0)]
    before = copy.deepcopy(marker)
    moved = buffer.transform(marker, "map")
    assert (moved.header.frame_id, moved.header.stamp.sec) == ("map", 9)
    assert is_at(moved.pose, 1.0, 2.0, 3.0)
    assert (moved.points, moved.colors) == (before.points, before.colors)
    assert (moved.type, moved.ns, moved.text, moved.frame_locked) == (Marker.LINE_STRIP, "lane", "left", True)
    moved.scale.x = 7.0
    moved.points.append(Point())
    assert marker == before


def test_marker_without_an_orientation(transform):
    marker = Marker()
    marker.pose.orientation.w = 0.0
    q = tf2_visualization_msgs.do_transform_marker(marker, transform).pose.orientation
    assert np.allclose([q.x, q.y, q.z, q.w], ROTATION.as_quat(canonical=True))


def test_packages_use_only_the_api_of_ros(tmp_path):
    """The packages must also work with a sourced ROS installation, whose packages take precedence."""
    (tmp_path / "rclpy").mkdir()
    (tmp_path / "rclpy" / "__init__.py").touch()
    for package in ("tf2_ros", "tf2_geometry_msgs", "geometry_msgs", "nav_msgs", "std_msgs", "visualization_msgs"):
        (tmp_path / package).mkdir()
        (tmp_path / package / "__init__.py").write_text(
            "class TransformRegistration:\n    def add(self, kind, function): print(kind.__name__)\n"
            "do_transform_pose = transform_covariance = None\n"
        )
        (tmp_path / package / "msg.py").write_text(
            "class Odometry: ...\nclass Path: ...\nclass Marker: ...\n"
            "class PoseStamped: ...\nclass TransformStamped: ...\nclass Header: ...\n"
        )
    result = subprocess.run(
        [sys.executable, "-c", "import tf2_nav_msgs, tf2_visualization_msgs"],
        env={**os.environ, "PYTHONPATH": str(tmp_path)},
        cwd=Path(__file__).parent,
        capture_output=True,
        text=True,
        check=True,
    )
    assert result.stdout.split() == ["Odometry", "Path", "Marker"]
