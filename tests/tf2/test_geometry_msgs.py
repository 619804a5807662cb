# SPDX-License-Identifier: Apache-2.0
"""tf2_geometry_msgs, compared with SciPy."""

import copy

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import tf2_geometry_msgs
import tf2_geometry_msgs.tf2_geometry_msgs as functions
import tf2_ros
from geometry_msgs.msg import (
    Point32,
    PointStamped,
    PolygonStamped,
    Pose,
    PoseStamped,
    PoseWithCovarianceStamped,
    TransformStamped,
    Vector3Stamped,
)

RANDOM = np.random.default_rng(4)
ROTATION = Rotation.random(random_state=5)
TRANSLATION = RANDOM.normal(size=3)


@pytest.fixture
def transform(stamped):
    return stamped("target", "source", 3.0, tuple(TRANSLATION), tuple(ROTATION.as_quat()))


def xyz(message):
    return np.array([message.x, message.y, message.z])


def xyzw(message):
    return np.array([message.x, message.y, message.z, message.w])


def fill(message, numbers):
    message.x, message.y, message.z = (float(number) for number in numbers)


def test_point(transform):
    point = PointStamped()
    fill(point.point, (1.0, 2.0, 3.0))
    moved = tf2_geometry_msgs.do_transform_point(point, transform)
    assert np.allclose(xyz(moved.point), ROTATION.apply([1.0, 2.0, 3.0]) + TRANSLATION, atol=1e-14)
    assert moved.header is transform.header


def test_vector_is_only_rotated_and_the_transform_is_not_modified(transform):
    before = copy.deepcopy(transform)
    vector = Vector3Stamped()
    fill(vector.vector, (1.0, 2.0, 3.0))
    moved = tf2_geometry_msgs.do_transform_vector3(vector, transform)
    assert np.allclose(xyz(moved.vector), ROTATION.apply([1.0, 2.0, 3.0]), atol=1e-14)
    assert transform == before


def test_pose(transform):
    orientation = Rotation.random(random_state=6)
    pose = Pose()
    fill(pose.position, (1.0, 2.0, 3.0))
    pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w = orientation.as_quat().tolist()
    expected = (ROTATION * orientation).as_quat(canonical=True)
    for moved in (
        tf2_geometry_msgs.do_transform_pose(pose, transform),
        tf2_geometry_msgs.do_transform_pose_stamped(PoseStamped(pose=pose), transform).pose,
    ):
        assert np.allclose(xyz(moved.position), ROTATION.apply([1.0, 2.0, 3.0]) + TRANSLATION, atol=1e-14)
        assert np.allclose(xyzw(moved.orientation), expected, atol=1e-14)
        assert moved.orientation.w >= 0.0


def test_covariance(transform):
    factor = RANDOM.normal(size=(6, 6))
    covariance = factor @ factor.T
    pose = PoseWithCovarianceStamped()
    pose.pose.pose.orientation.w = 1.0
    pose.pose.covariance = covariance.reshape(36)
    moved = tf2_geometry_msgs.do_transform_pose_with_covariance_stamped(pose, transform)
    rotation = np.kron(np.eye(2), ROTATION.as_matrix())
    expected = (rotation @ covariance @ rotation.T).reshape(36)
    assert np.allclose(moved.pose.covariance, expected, atol=1e-13)
    assert np.array_equal(
        tf2_geometry_msgs.transform_covariance(pose.pose.covariance, transform.transform), moved.pose.covariance
    )


def test_covariance_is_exact_for_a_half_turn(stamped):
    half_turn = stamped("a", "b", rotation=(1.0, 0.0, 0.0, 0.0))
    covariance = np.arange(1.0, 37.0)
    signs = np.array([1.0, -1.0, -1.0, 1.0, -1.0, -1.0])
    expected = (covariance.reshape(6, 6) * np.outer(signs, signs)).reshape(36)
    assert np.array_equal(tf2_geometry_msgs.transform_covariance(covariance, half_turn), expected)


def test_polygon(transform):
    polygon = PolygonStamped()
    polygon.polygon.points = [Point32(x=1.0, y=2.0, z=3.0), Point32(x=-1.0, y=0.5, z=0.0)]
    moved = tf2_geometry_msgs.do_transform_polygon_stamped(polygon, transform)
    expected = ROTATION.apply([[1.0, 2.0, 3.0], [-1.0, 0.5, 0.0]]) + TRANSLATION
    assert np.allclose([xyz(point) for point in moved.polygon.points], expected)
    assert moved.header is transform.header


def test_zero_quaternion_is_the_identity(stamped):
    point = PointStamped()
    point.point.x = 1.0
    moved = tf2_geometry_msgs.do_transform_point(point, stamped("a", "b", rotation=(0.0, 0.0, 0.0, 0.0)))
    assert xyz(moved.point).tolist() == [1.0, 0.0, 0.0]


@pytest.mark.parametrize("seed", range(20))
def test_quaternion_and_matrix(seed):
    x, y, z, w = Rotation.random(random_state=seed).as_quat(canonical=True)
    quaternion = np.array([w, x, y, z])
    matrix = functions._get_mat_from_quat(3.0 * quaternion)
    assert np.allclose(matrix, Rotation.from_quat([x, y, z, w]).as_matrix(), atol=1e-14)
    assert np.allclose(functions._get_quat_from_mat(matrix), quaternion, atol=1e-14)


def test_affine_round_trip():
    quaternion = np.roll(ROTATION.as_quat(canonical=True), 1)
    translation, rotation = functions._decompose_affine(functions._build_affine(quaternion, TRANSLATION))
    assert np.allclose(translation, TRANSLATION)
    assert np.allclose(rotation, quaternion)
    assert np.array_equal(functions._build_affine(), np.eye(4))


def test_stamped_types_are_registered():
    registry = tf2_ros.TransformRegistration()
    for message in (PointStamped, Vector3Stamped, PoseStamped, PoseWithCovarianceStamped, PolygonStamped):
        assert registry.get(message)
    for message in (Vector3Stamped, PoseStamped, PointStamped):
        assert tf2_ros.convert(message(), message) == message()
    assert tf2_geometry_msgs.TransformStamped is TransformStamped
