# SPDX-License-Identifier: Apache-2.0
"""Twists, wrenches, accelerations, inertias, orientations and arrays of poses, compared with SciPy."""

import copy

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import tf2_geometry_msgs
import tf2_ros
from geometry_msgs.msg import (
    AccelStamped,
    AccelWithCovarianceStamped,
    Inertia,
    InertiaStamped,
    Point,
    Pose,
    PoseArray,
    Quaternion,
    QuaternionStamped,
    Twist,
    TwistStamped,
    TwistWithCovarianceStamped,
    Vector3,
    Wrench,
    WrenchStamped,
)

RANDOM = np.random.default_rng(4)
ROTATION = Rotation.random(random_state=5)
TRANSLATION = RANDOM.normal(size=3)
FIRST, SECOND = RANDOM.normal(size=(2, 3))
FACTOR = RANDOM.normal(size=(6, 6))
COVARIANCE = FACTOR @ FACTOR.T


@pytest.fixture
def transform(stamped):
    return stamped("target", "source", 3.0, tuple(TRANSLATION), tuple(ROTATION.as_quat()))


def vector(numbers):
    x, y, z = numbers.tolist()
    return Vector3(x=x, y=y, z=z)


def xyz(message):
    return np.array([message.x, message.y, message.z])


def xyzw(message):
    return np.array([message.x, message.y, message.z, message.w])


def skew(v):
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


# Modern Robotics, (3.84), for vectors with the linear part first.
ADJOINT = np.block(
    [[ROTATION.as_matrix(), skew(TRANSLATION) @ ROTATION.as_matrix()], [np.zeros((3, 3)), ROTATION.as_matrix()]]
)


def twist():
    return Twist(linear=vector(FIRST), angular=vector(SECOND))


def test_twist_is_rotated(transform):
    moved = tf2_geometry_msgs.do_transform_twist_stamped(TwistStamped(twist=twist()), transform)
    assert np.allclose(xyz(moved.twist.linear), ROTATION.apply(FIRST), atol=1e-14)
    assert np.allclose(xyz(moved.twist.angular), ROTATION.apply(SECOND), atol=1e-14)
    assert moved.header is transform.header


def test_twist_at_the_origin_of_the_target(transform):
    moved = tf2_geometry_msgs.do_transform_twist_stamped(TwistStamped(twist=twist()), transform, at_target_origin=True)
    result = np.concatenate((xyz(moved.twist.linear), xyz(moved.twist.angular)))
    assert np.allclose(result, ADJOINT @ np.concatenate((FIRST, SECOND)), atol=1e-14)


def test_sensor_in_front_of_a_turning_robot_moves_sideways(stamped):
    """A sensor 1 m ahead of a robot that turns left with 2 rad/s moves to the left with 2 m/s."""
    spinning = TwistStamped(twist=Twist(angular=Vector3(z=2.0)))
    to_sensor = stamped("sensor", "robot", translation=(-1.0, 0.0, 0.0))
    moved = tf2_geometry_msgs.do_transform_twist_stamped(spinning, to_sensor, at_target_origin=True)
    assert xyz(moved.twist.linear).tolist() == [0.0, 2.0, 0.0]


def test_twist_with_covariance(transform):
    message = TwistWithCovarianceStamped()
    message.twist.twist = twist()
    message.twist.covariance = COVARIANCE.reshape(36)
    do_transform = tf2_geometry_msgs.do_transform_twist_with_covariance_stamped
    blocks = np.kron(np.eye(2), ROTATION.as_matrix())
    for moved, matrix in (
        (do_transform(message, transform), blocks),
        (do_transform(message, transform, at_target_origin=True), ADJOINT),
    ):
        expected = matrix @ np.concatenate((FIRST, SECOND))
        assert np.allclose(xyz(moved.twist.twist.linear), expected[:3], atol=1e-14)
        assert np.allclose(np.reshape(moved.twist.covariance, (6, 6)), matrix @ COVARIANCE @ matrix.T, atol=1e-13)


def test_wrench_is_rotated(transform):
    message = WrenchStamped(wrench=Wrench(force=vector(FIRST), torque=vector(SECOND)))
    moved = tf2_geometry_msgs.do_transform_wrench_stamped(message, transform)
    assert np.allclose(xyz(moved.wrench.force), ROTATION.apply(FIRST), atol=1e-14)
    assert np.allclose(xyz(moved.wrench.torque), ROTATION.apply(SECOND), atol=1e-14)


def test_wrench_at_the_origin_of_the_target_has_the_same_power(transform):
    """The power of a wrench and a twist does not depend on the frame."""
    message = WrenchStamped(wrench=Wrench(force=vector(FIRST), torque=vector(SECOND)))
    moved = tf2_geometry_msgs.do_transform_wrench_stamped(message, transform, at_target_origin=True)
    result = np.concatenate((xyz(moved.wrench.force), xyz(moved.wrench.torque)))
    assert np.allclose(result, np.linalg.inv(ADJOINT).T @ np.concatenate((FIRST, SECOND)), atol=1e-13)


def test_acceleration_is_rotated(transform):
    message = AccelWithCovarianceStamped()
    message.accel.accel.linear, message.accel.accel.angular = vector(FIRST), vector(SECOND)
    message.accel.covariance = COVARIANCE.reshape(36)
    moved = tf2_geometry_msgs.do_transform_accel_with_covariance_stamped(message, transform)
    plain = tf2_geometry_msgs.do_transform_accel_stamped(AccelStamped(accel=message.accel.accel), transform)
    assert plain.accel == moved.accel.accel
    assert np.allclose(xyz(plain.accel.linear), ROTATION.apply(FIRST), atol=1e-14)
    assert np.allclose(xyz(plain.accel.angular), ROTATION.apply(SECOND), atol=1e-14)
    blocks = np.kron(np.eye(2), ROTATION.as_matrix())
    assert np.allclose(np.reshape(moved.accel.covariance, (6, 6)), blocks @ COVARIANCE @ blocks.T, atol=1e-13)


def test_inertia_of_three_point_masses(transform):
    """Compare with the inertia of the transformed point masses."""
    masses, positions = np.array([1.0, 2.0, 4.0]), RANDOM.normal(size=(3, 3))

    def inertia_of(positions):
        com = masses @ positions / masses.sum()
        arms = positions - com
        tensor = sum(m * (arm @ arm * np.eye(3) - np.outer(arm, arm)) for m, arm in zip(masses, arms, strict=True))
        ixx, ixy, ixz, iyy, iyz, izz = tensor[np.triu_indices(3)].tolist()
        return Inertia(m=7.0, com=vector(com), ixx=ixx, ixy=ixy, ixz=ixz, iyy=iyy, iyz=iyz, izz=izz)

    moved = tf2_geometry_msgs.do_transform_inertia_stamped(
        InertiaStamped(inertia=inertia_of(positions)), transform
    ).inertia
    expected = inertia_of(ROTATION.apply(positions) + TRANSLATION)
    assert np.allclose(xyz(moved.com), xyz(expected.com), atol=1e-14)
    for entry in ("m", "ixx", "ixy", "ixz", "iyy", "iyz", "izz"):
        assert getattr(moved, entry) == pytest.approx(getattr(expected, entry), abs=1e-13)


def quaternion(rotation, length=1.0):
    x, y, z, w = (length * rotation.as_quat()).tolist()
    return Quaternion(x=x, y=y, z=z, w=w)


def test_orientation(transform):
    orientation = Rotation.random(random_state=6)
    message = QuaternionStamped(quaternion=quaternion(orientation, 3.0))
    moved = tf2_geometry_msgs.do_transform_quaternion_stamped(message, transform)
    assert np.allclose(xyzw(moved.quaternion), (ROTATION * orientation).as_quat(canonical=True), atol=1e-14)
    assert moved.header is transform.header


def test_zero_quaternion_is_the_identity(transform):
    message = QuaternionStamped(quaternion=Quaternion(x=0.0, y=0.0, z=0.0, w=0.0))
    moved = tf2_geometry_msgs.do_transform_quaternion_stamped(message, transform)
    assert np.allclose(xyzw(moved.quaternion), ROTATION.as_quat(canonical=True), atol=1e-14)


def test_pose_array(transform):
    orientations, positions = Rotation.random(5, random_state=7), RANDOM.normal(size=(5, 3))
    message = PoseArray()
    message.poses = [
        Pose(position=Point(x=x, y=y, z=z), orientation=quaternion(orientation))
        for (x, y, z), orientation in zip(positions.tolist(), orientations, strict=True)
    ]
    moved = tf2_geometry_msgs.do_transform_pose_array(message, transform)
    assert np.allclose([xyz(pose.position) for pose in moved.poses], ROTATION.apply(positions) + TRANSLATION)
    expected = (ROTATION * orientations).as_quat(canonical=True)
    assert np.allclose([xyzw(pose.orientation) for pose in moved.poses], expected, atol=1e-14)
    assert moved.header is transform.header
    assert tf2_geometry_msgs.do_transform_pose_array(PoseArray(), transform).poses == []


@pytest.mark.parametrize(
    "kind",
    [
        AccelStamped,
        AccelWithCovarianceStamped,
        InertiaStamped,
        PoseArray,
        QuaternionStamped,
        TwistStamped,
        TwistWithCovarianceStamped,
        WrenchStamped,
    ],
)
def test_buffer_transform_does_not_modify_its_arguments(kind, stamped):
    buffer = tf2_ros.Buffer()
    buffer.set_transform_static(stamped("target", "source", 0.0, (1.0, 2.0, 3.0), (0.0, 0.0, 1.0, 0.0)), "me")
    message = kind()
    message.header.frame_id, message.header.stamp.sec = "source", 7
    before = copy.deepcopy(message)
    moved = buffer.transform(message, "target")
    assert type(moved) is kind
    assert (moved.header.frame_id, moved.header.stamp.sec) == ("target", 7)
    assert message == before
