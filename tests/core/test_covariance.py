# SPDX-License-Identifier: Apache-2.0
"""How sure a pose is in another frame: against sampled poses, and against exact cases."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import coframe


def random_transform(rng):
    return coframe.Transform(rng.normal(size=3), Rotation.random(random_state=rng.integers(2**31)).as_quat())


def random_covariance(rng, size):
    root = rng.normal(size=(6, 6)) * size
    return root @ root.T


def disturbed(transform, errors):
    """The transform with errors (N, 6) of its position and about its fixed axes."""
    turns = Rotation.from_rotvec(errors[:, 3:]) * Rotation.from_quat(transform.quaternion)
    return coframe.Transform(transform.translation + errors[:, :3], turns.as_quat())


def errors_between(disturbed, exact):
    turns = Rotation.from_quat(disturbed.quaternion) * Rotation.from_quat(exact.quaternion).inv()
    return np.concatenate([disturbed.translation - exact.translation, turns.as_rotvec()], axis=1)


@pytest.mark.parametrize("seed", range(2))
def test_sampled_poses_have_the_computed_covariance(seed):
    rng = np.random.default_rng(seed)
    transform, pose = random_transform(rng), random_transform(rng)
    of_pose, of_transform = random_covariance(rng, 1e-3), random_covariance(rng, 1e-3)
    found, covariance = transform.transform_pose(pose, of_pose, own_covariance=of_transform)
    assert found.is_close(transform @ pose)
    draw = lambda c: rng.multivariate_normal(np.zeros(6), c, size=40_000)  # noqa: E731
    scattered = disturbed(transform, draw(of_transform)) @ disturbed(pose, draw(of_pose))
    sampled = np.cov(errors_between(scattered, found).T)
    np.testing.assert_allclose(covariance, sampled, atol=0.05 * np.abs(sampled).max())


def test_a_quarter_turn_changes_the_axes():
    turn = coframe.Transform.from_rpy([5, 0, 0], [0, 0, np.pi / 2])
    _, covariance = turn.transform_pose(coframe.Transform(), np.diag([1.0, 2, 3, 4, 5, 6]))
    np.testing.assert_allclose(covariance, np.diag([2.0, 1, 3, 5, 4, 6]), atol=1e-12)


def test_the_shape_is_the_given_one():
    flat = np.eye(6).reshape(36)
    assert coframe.Transform().transform_pose(coframe.Transform(), flat)[1].tolist() == flat.tolist()
    batch = coframe.Transform(np.zeros((7, 3)))
    assert batch.transform_pose(coframe.Transform(), np.eye(6))[1].shape == (7, 6, 6)
    with pytest.raises(ValueError, match=r"must have shape"):
        coframe.Transform().transform_pose(coframe.Transform(), np.eye(3))


def test_frames_are_checked():
    transform = coframe.Transform(target="map", source="base")
    with pytest.raises(coframe.FrameMismatchException):
        transform.transform_pose(coframe.Transform(target="odom", source="cup"), np.eye(6))
