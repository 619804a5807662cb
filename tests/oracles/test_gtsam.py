# SPDX-License-Identifier: Apache-2.0
"""Covariances of poses, compared with GTSAM where it is installed: `pip install gtsam`."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from coframe import Transform

pytestmark = pytest.mark.slow
gtsam = pytest.importorskip("gtsam", reason="GTSAM (pip install gtsam) is not installed")


def pose3(transform):
    return gtsam.Pose3(gtsam.Rot3(transform.rotation), transform.translation)


def random_pose(rng, size):
    root = rng.normal(size=(6, 6)) * size
    pose = Transform(rng.normal(size=3), Rotation.random(rng=rng).as_quat())
    return pose.with_covariance(root @ root.T, "body")


@pytest.fixture
def rng():
    return np.random.default_rng(4)


def test_compositions_are_those_of_its_jacobians(rng):
    a, b = random_pose(rng, 1e-4), random_pose(rng, 1e-4)
    of_a, of_b = np.zeros((6, 6), order="F"), np.zeros((6, 6), order="F")
    product = pose3(a).compose(pose3(b), of_a, of_b)
    np.testing.assert_allclose((a @ b).matrix, product.matrix(), atol=1e-12)
    expected = of_a @ a.as_covariance("gtsam") @ of_a.T + of_b @ b.as_covariance("gtsam") @ of_b.T
    np.testing.assert_allclose((a @ b).as_covariance("gtsam"), expected, rtol=1e-6, atol=1e-14)
    inverse = np.zeros((6, 6), order="F")
    pose3(a).inverse(inverse)
    expected = inverse @ a.as_covariance("gtsam") @ inverse.T
    np.testing.assert_allclose(a.inverse().as_covariance("gtsam"), expected, rtol=1e-9, atol=1e-16)


def test_fusion_is_the_optimum_of_two_priors(rng):
    a = random_pose(rng, 0.05)
    b = (a.with_covariance(None) @ Transform.exp(rng.normal(size=6) * 0.05)).with_covariance(
        random_pose(rng, 0.05).as_covariance("body"), "body"
    )
    graph, start = gtsam.NonlinearFactorGraph(), gtsam.Values()
    start.insert(0, pose3(a))
    for pose in (a, b):
        noise = gtsam.noiseModel.Gaussian.Covariance(pose.as_covariance("gtsam"))
        graph.add(gtsam.PriorFactorPose3(0, pose3(pose), noise))
    parameters = gtsam.LevenbergMarquardtParams()
    parameters.setRelativeErrorTol(1e-15)
    parameters.setAbsoluteErrorTol(1e-15)
    result = gtsam.LevenbergMarquardtOptimizer(graph, start, parameters).optimize()
    fused = a.fuse(b)
    np.testing.assert_allclose(fused.matrix, result.atPose3(0).matrix(), atol=1e-6)
    theirs = gtsam.Marginals(graph, result).marginalCovariance(0)
    np.testing.assert_allclose(fused.as_covariance("gtsam"), theirs, rtol=0.02, atol=1e-6)
    error = lambda pose: graph.error(values_of(pose))  # noqa: E731
    assert error(fused) <= error(Transform.from_matrix(result.atPose3(0).matrix())) + 1e-12


def values_of(pose):
    values = gtsam.Values()
    values.insert(0, pose3(pose))
    return values


def test_mahalanobis_distance_is_its_error(rng):
    a = random_pose(rng, 0.1)
    b = a.with_covariance(None) @ Transform.exp(rng.normal(size=6) * 0.05)
    noise = gtsam.noiseModel.Gaussian.Covariance(a.as_covariance("gtsam"))
    factor = gtsam.PriorFactorPose3(0, pose3(a), noise)
    assert a.mahalanobis(b) ** 2 == pytest.approx(2 * factor.error(values_of(b)), rel=1e-9)
