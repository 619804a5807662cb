# SPDX-License-Identifier: Apache-2.0
"""tf_transformations, compared with SciPy."""

import math

import numpy as np
import pytest
import transforms3d
from scipy.spatial.transform import Rotation, Slerp

import tf_transformations as tft

AXES = [
    kind + first + second + third
    for kind in "sr"
    for first in "xyz"
    for second in "xyz"
    for third in "xyz"
    if first != second != third
]


def same_rotation(quaternion, expected):
    return np.allclose(np.abs(np.dot(quaternion, expected)), 1.0, atol=1e-14)


def oracle(angles, axes):
    """Return SciPy's name of a convention, in which rotating axes are upper-case."""
    return Rotation.from_euler(axes[1:].upper() if axes[0] == "r" else axes[1:], angles)


@pytest.mark.parametrize("axes", AXES)
def test_all_conventions_of_euler_angles(axes):
    random = np.random.default_rng(len(axes))
    for angles in random.uniform(-math.pi, math.pi, (20, 3)):
        expected = oracle(angles, axes)
        assert same_rotation(tft.quaternion_from_euler(*angles, axes=axes), expected.as_quat())
        assert np.allclose(tft.euler_matrix(*angles, axes)[:3, :3], expected.as_matrix(), atol=1e-14)
        again = tft.euler_from_matrix(expected.as_matrix(), axes)
        assert np.allclose(oracle(again, axes).as_matrix(), expected.as_matrix(), atol=1e-12)
        assert np.allclose(tft.euler_from_quaternion(expected.as_quat(), axes), again, atol=1e-12)


@pytest.mark.parametrize("axes", AXES)
def test_gimbal_lock(axes):
    locked = (0.0, math.pi) if axes[1] == axes[3] else (math.pi / 2, -math.pi / 2)
    for second in locked:
        expected = oracle((0.4, second, 0.7), axes).as_matrix()
        again = tft.euler_from_matrix(expected, axes)
        assert np.allclose(oracle(again, axes).as_matrix(), expected, atol=1e-7)
        assert again[2 if axes[0] == "s" else 0] == 0.0


def test_invalid_conventions():
    assert len(AXES) == 24
    for wrong in ("xyz", "sxxy", "qxyz", "sxy", "sxya", ""):
        with pytest.raises(ValueError, match="Expected 's' or 'r'"):
            tft.quaternion_from_euler(0.0, 0.0, 0.0, wrong)


def test_roll_pitch_yaw_is_the_default():
    quaternion = tft.quaternion_from_euler(0.1, 0.2, 0.3)
    assert same_rotation(quaternion, Rotation.from_euler("xyz", [0.1, 0.2, 0.3]).as_quat())
    roll, pitch, yaw = tft.euler_from_quaternion(quaternion)
    assert (roll, pitch, yaw) == pytest.approx((0.1, 0.2, 0.3))
    assert isinstance(yaw, float)


@pytest.mark.parametrize("seed", range(20))
def test_quaternions(seed):
    first, second = Rotation.random(2, random_state=seed)
    q1, q2 = first.as_quat(), second.as_quat()
    assert np.allclose(tft.quaternion_matrix(q1)[:3, :3], first.as_matrix(), atol=1e-14)
    assert np.allclose(tft.quaternion_matrix(5.0 * q1)[:3, :3], first.as_matrix(), atol=1e-14)
    assert same_rotation(tft.quaternion_multiply(q2, q1), (second * first).as_quat())
    assert np.allclose(tft.quaternion_multiply(tft.quaternion_inverse(3.0 * q1), 3.0 * q1), [0, 0, 0, 1], atol=1e-14)
    assert np.allclose(
        tft.quaternion_conjugate(q1),
        first.inv().as_quat() * np.sign(first.inv().as_quat() @ tft.quaternion_conjugate(q1)),
    )
    from_matrix = tft.quaternion_from_matrix(tft.quaternion_matrix(q1))
    assert np.allclose(from_matrix, first.as_quat(canonical=True), atol=1e-14)
    between = Slerp([0.0, 1.0], Rotation.concatenate([first, second]))(0.3)
    assert same_rotation(tft.quaternion_slerp(q1, q2, 0.3), between.as_quat())
    assert same_rotation(tft.quaternion_slerp(q1, -q2, 0.3), between.as_quat())


@pytest.mark.parametrize("axis", [(1, 0, 0), (0, 1, 0), (0, 0, 1)])
def test_half_turns(axis):
    matrix = Rotation.from_rotvec(math.pi * np.array(axis)).as_matrix()
    assert np.allclose(np.abs(tft.quaternion_from_matrix(matrix)), [*axis, 0.0], atol=1e-14)


def test_slerp_at_the_ends():
    q = tft.quaternion_about_axis(0.4, (0, 0, 2))
    assert np.allclose(tft.quaternion_slerp(q, [0, 0, 0, 1], 0.0), q)
    assert np.allclose(tft.quaternion_slerp(q, [0, 0, 0, 1], 1.0), [0, 0, 0, 1])
    assert np.allclose(tft.quaternion_slerp(q, q, 0.5), q)


def test_zero_quaternion_is_the_identity():
    assert np.array_equal(tft.quaternion_matrix([0, 0, 0, 0]), np.eye(4))


def test_random_rotations_are_rotations():
    matrix = tft.random_rotation_matrix()
    assert np.allclose(matrix @ matrix.T, np.eye(4))
    assert np.isclose(tft.vector_norm(tft.random_quaternion([0.1, 0.2, 0.3])), 1.0)
    assert tft.random_vector(5).shape == (5,)


def test_rotation_about_a_line():
    axis = np.array([1.0, 2.0, -0.5])
    point = np.array([3.0, 1.0, 2.0])
    matrix = tft.rotation_matrix(0.7, axis, point)
    assert np.allclose(matrix[:3, :3], Rotation.from_rotvec(0.7 * axis / np.linalg.norm(axis)).as_matrix())
    assert np.allclose(matrix @ [*point, 1.0], [*point, 1.0])
    assert tft.is_same_transform(matrix, tft.rotation_matrix(*tft.rotation_from_matrix(matrix)))
    with pytest.raises(ValueError, match="not a rotation"):
        tft.rotation_from_matrix(tft.scale_matrix(2.0))


def test_translation_and_products():
    move = tft.translation_matrix([1.0, 2.0, 3.0])
    turn = tft.euler_matrix(0.1, 0.2, 0.3)
    assert tft.translation_from_matrix(move).tolist() == [1.0, 2.0, 3.0]
    assert np.array_equal(tft.concatenate_matrices(move, turn), move @ turn)
    assert np.array_equal(tft.concatenate_matrices(), tft.identity_matrix())
    assert np.allclose(tft.concatenate_matrices(move, turn, tft.inverse_matrix(move @ turn)), np.eye(4))


def test_round_trip_of_reflections_and_scalings():
    mirror = tft.reflection_matrix([1.0, 2.0, 3.0], [0.0, 1.0, 1.0])
    assert np.allclose(mirror @ mirror, np.eye(4))
    assert tft.is_same_transform(mirror, tft.reflection_matrix(*tft.reflection_from_matrix(mirror)))
    for scaling in (
        tft.scale_matrix(2.5, [1.0, 2.0, 3.0]),
        tft.scale_matrix(-0.5, [1.0, 2.0, 3.0], [0.0, 1.0, 1.0]),
    ):
        assert tft.is_same_transform(scaling, tft.scale_matrix(*tft.scale_from_matrix(scaling)))


def test_decomposing_and_composing():
    parts = {
        "scale": [1.5, 0.5, 2.0],
        "shear": [0.1, -0.2, 0.3],
        "angles": [0.1, -0.2, 0.3],
        "translate": [1.0, 2.0, 3.0],
    }
    matrix = tft.compose_matrix(**parts)
    scale, shear, angles, translate, perspective = tft.decompose_matrix(matrix)
    assert np.allclose(scale, parts["scale"])
    assert np.allclose(shear, parts["shear"])
    assert np.allclose(angles, parts["angles"])
    assert np.allclose(translate, parts["translate"])
    assert np.allclose(perspective, [0, 0, 0, 1])
    for other in (tft.reflection_matrix([0, 0, 0], [1, 2, 3]), tft.compose_matrix(perspective=[0.1, 0.2, 0.3, 1.0])):
        assert tft.is_same_transform(other, tft.compose_matrix(*tft.decompose_matrix(other)))
    with pytest.raises(ValueError, match="singular"):
        tft.decompose_matrix(np.zeros((4, 4)) + np.diag([0, 0, 0, 1]))


def test_vectors():
    assert tft.vector_norm([3.0, 4.0]) == 5.0
    assert tft.vector_norm([[3.0, 4.0], [6.0, 8.0]], axis=1).tolist() == [5.0, 10.0]
    assert tft.unit_vector([3.0, 4.0]).tolist() == [0.6, 0.8]
    out = np.empty((2, 2))
    tft.unit_vector([[3.0, 4.0], [6.0, 8.0]], axis=1, out=out)
    assert np.allclose(out, [[0.6, 0.8], [0.6, 0.8]])


@pytest.fixture
def vectors():
    return np.random.default_rng(4).normal(size=(10, 3))


def moved(matrix, points):
    homogeneous = np.column_stack([points, np.ones(len(points))]) @ matrix.T
    return homogeneous[:, :3] / homogeneous[:, 3:]


@pytest.mark.parametrize("kind", ["orthogonal", "parallel", "perspective"])
def test_projections_lead_to_the_plane_along_the_rays(kind, vectors):
    point, normal, ray, center = vectors[:4]
    options = {"parallel": {"direction": ray}, "perspective": {"perspective": center}}.get(kind, {})
    matrix = tft.projection_matrix(point, normal, **options)
    points = vectors[4:]
    found = moved(matrix, points)
    assert np.allclose((found - point) @ normal, 0.0, atol=1e-9)
    rays = {"orthogonal": np.tile(normal, (6, 1)), "parallel": np.tile(ray, (6, 1))}.get(kind, points - center)
    assert np.allclose(np.cross(found - points, rays), 0.0, atol=1e-9)
    again = tft.projection_from_matrix(matrix)
    assert tft.is_same_transform(matrix, tft.projection_matrix(*again))
    if kind == "perspective":
        pseudo = tft.projection_matrix(point, normal, pseudo=True, **options)
        assert tft.is_same_transform(pseudo, tft.projection_matrix(*tft.projection_from_matrix(pseudo, pseudo=True)))


def test_shears(vectors):
    point, normal, other = vectors[:3]
    direction = np.cross(normal, other)
    matrix = tft.shear_matrix(0.7, direction, point, normal)
    unit = normal / np.linalg.norm(normal)
    distances = (vectors - point) @ unit
    expected = vectors + np.outer(distances * math.tan(0.7), direction / np.linalg.norm(direction))
    assert np.allclose(moved(matrix, vectors), expected)
    angle, *others = tft.shear_from_matrix(matrix)
    assert angle == pytest.approx(0.7)
    assert np.allclose(tft.shear_matrix(angle, *others), matrix)
    with pytest.raises(ValueError, match="not orthogonal"):
        tft.shear_matrix(0.7, normal, point, normal)
    with pytest.raises(ValueError, match="not a shear"):
        tft.shear_from_matrix(np.eye(4))


def test_view_volumes():
    limits = (-1.0, 3.0, -2.0, 2.0, 1.0, 10.0)
    corners = np.array([[-1.0, -2.0, 1.0], [3.0, 2.0, 10.0]])
    assert np.allclose(moved(tft.clip_matrix(*limits), corners), [[-1, -1, -1], [1, 1, 1]])
    # In a perspective view, the limits along x and y grow with the distance; x and y change their sign, as upstream.
    far = moved(tft.clip_matrix(*limits, perspective=True), np.array([[-1.0, -2.0, 1.0], [30.0, 20.0, 10.0]]))
    assert np.allclose(np.abs(far[:, :2]), 1.0)
    assert np.allclose(far[:, 2], [-1.0, 1.0])
    for wrong in ((1, 0, 0, 1, 1, 2), (0, 1, 1, 1, 1, 2), (0, 1, 0, 1, 3, 2)):
        with pytest.raises(ValueError, match="invalid frustum"):
            tft.clip_matrix(*wrong)
    with pytest.raises(ValueError, match="near <= 0"):
        tft.clip_matrix(0, 1, 0, 1, 0, 1, perspective=True)


def test_superimposition_is_that_of_scipy(vectors):
    others = np.random.default_rng(5).normal(size=(10, 3))
    matrix = tft.superimposition_matrix(vectors.T, others.T)
    rotation, _ = Rotation.align_vectors(others - others.mean(axis=0), vectors - vectors.mean(axis=0))
    assert np.allclose(matrix[:3, :3], rotation.as_matrix())
    exact = tft.concatenate_matrices(
        tft.translation_matrix((1, 2, 3)), tft.random_rotation_matrix(), np.diag([2, 2, 2, 1])
    )
    found = tft.superimposition_matrix(vectors.T, moved(exact, vectors).T, scaling=True)
    assert np.allclose(found, exact)


def test_cells_of_crystals():
    matrix = tft.orthogonalization_matrix((10.0, 10.0, 10.0), (90.0, 90.0, 90.0))
    assert np.allclose(matrix[:3, :3], np.eye(3) * 10)
    lengths, angles = (9.8, 12.0, 15.5), (87.2, 80.7, 69.7)
    edges = tft.orthogonalization_matrix(lengths, angles)[:3, :3].T
    assert np.allclose(np.linalg.norm(edges, axis=1), lengths)
    cosines = (edges @ edges.T) / np.outer(lengths, lengths)
    assert np.allclose(np.degrees(np.arccos([cosines[1, 2], cosines[0, 2], cosines[0, 1]])), angles)


def test_the_arcball_follows_the_pointer():
    ball = tft.Arcball()
    ball.place([100, 100], 100)
    ball.down([100, 100])
    ball.drag([150, 100])
    # The point in front has moved to where the pointer is: halfway to the right edge.
    assert np.allclose(ball.matrix()[:3, :3] @ [0, 0, 1], Rotation.from_euler("y", 60, degrees=True).apply([0, 0, 1]))
    ball.next()
    assert np.allclose(ball.matrix()[:3, :3], Rotation.from_euler("y", 120, degrees=True).as_matrix())
    ball = tft.Arcball(initial=tft.random_rotation_matrix())
    start = ball.matrix()
    ball.place([100, 100], 100)
    ball.setaxes([1, 0, 0], [0, 1, 0])
    ball.setconstrain(True)
    assert ball.getconstrain()
    ball.down([100, 90])
    ball.drag([105, 40])
    turned = Rotation.from_matrix((ball.matrix() @ start.T)[:3, :3]).as_rotvec()
    assert np.allclose(np.cross(turned, [1, 0, 0]), 0.0, atol=1e-9), "only about the nearest axis"
    ball.drag([100, 90])
    assert np.linalg.norm(ball.matrix() - start) < 0.1
    with pytest.raises(ValueError, match="not a quaternion or matrix"):
        tft.Arcball(initial=[1, 2, 3])


def test_results_are_those_of_transforms3d():
    random = np.random.default_rng(6)
    for axes in AXES:
        angles = random.uniform(-math.pi, math.pi, 3)
        assert np.allclose(tft.euler_matrix(*angles, axes)[:3, :3], transforms3d.euler.euler2mat(*angles, axes))
        w, x, y, z = transforms3d.euler.euler2quat(*angles, axes)
        assert same_rotation(tft.quaternion_from_euler(*angles, axes), (x, y, z, w))
        matrix = transforms3d.euler.euler2mat(*angles, axes)
        assert np.allclose(tft.euler_from_matrix(matrix, axes), transforms3d.euler.mat2euler(matrix, axes))
    first, second = random.normal(size=(2, 4))
    w, x, y, z = transforms3d.quaternions.qmult(np.roll(first, 1), np.roll(second, 1))
    assert np.allclose(tft.quaternion_multiply(first, second), (x, y, z, w))
    axis, point = random.normal(size=(2, 3))
    assert np.allclose(tft.rotation_matrix(0.3, axis, point), transforms3d.axangles.axangle2aff(axis, 0.3, point=point))
    assert np.allclose(tft.reflection_matrix(point, axis), transforms3d.reflections.rfnorm2aff(axis, point))
    assert np.allclose(tft.scale_matrix(1.5, point, axis), transforms3d.zooms.zfdir2aff(1.5, axis, point))
