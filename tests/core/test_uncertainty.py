# SPDX-License-Identifier: Apache-2.0
"""Covariances of transforms: conventions, and what operations do to them, against sampled poses."""

import copy
import pickle

import numpy as np
import pytest

from coframe import Transform
from coframe.errors import FrameMismatchException, InvalidArgumentException

SAMPLES = 200_000


def random_transform(rng, shape=(), **names):
    return Transform(rng.normal(size=(*shape, 3)) * 2, rng.normal(size=(*shape, 4)), **names)


def random_covariance(rng, meters, radians):
    root = np.diag([meters] * 3 + [radians] * 3) @ rng.normal(size=(6, 6)) / 2.5
    return root @ root.T


def scattered(rng, transform, count=SAMPLES):
    """Poses with errors of the covariance: the definition of the convention."""
    along_target = rng.multivariate_normal(np.zeros(6), transform.covariance, size=count)
    along_source = np.concatenate(
        [along_target[:, :3] @ transform.rotation, along_target[:, 3:] @ transform.rotation], axis=1
    )
    return transform.with_covariance(None) @ Transform.exp(along_source)


def sampled_covariance(transform, poses):
    errors = (transform.with_covariance(None).inverse() @ poses).log()
    turned = np.concatenate([errors[:, :3] @ transform.rotation.T, errors[:, 3:] @ transform.rotation.T], axis=1)
    return turned.T @ turned / len(poses)


def assert_covariance(transform, poses, tolerance):
    sampled = sampled_covariance(transform, poses)
    size = np.sqrt(np.outer(np.diag(sampled), np.diag(sampled)))
    np.testing.assert_allclose(transform.covariance / size, sampled / size, rtol=0, atol=tolerance)


SIZES = [pytest.param(0.02, 0.01, 0.01, id="small"), pytest.param(0.6, 0.35, 0.05, id="large")]


@pytest.fixture
def rng():
    return np.random.default_rng(8)


@pytest.mark.parametrize(("meters", "radians", "tolerance"), SIZES)
def test_composition_and_inverse_and_relative_pose(rng, meters, radians, tolerance):
    a, b = (random_transform(rng).with_covariance(random_covariance(rng, meters, radians)) for _ in range(2))
    of_a, of_b = scattered(rng, a), scattered(rng, b)
    assert_covariance(a @ b, of_a @ of_b, tolerance)
    assert_covariance(a.inverse(), of_a.inverse(), tolerance)
    assert_covariance(a.inverse() @ b, of_a.inverse() @ of_b, tolerance)
    exact = random_transform(rng)
    assert_covariance(exact @ a, exact @ of_a, tolerance)
    assert_covariance(a @ exact, of_a @ exact, tolerance)


@pytest.mark.parametrize(("meters", "radians", "tolerance"), SIZES)
def test_chains_of_five(rng, meters, radians, tolerance):
    chain = [random_transform(rng).with_covariance(random_covariance(rng, meters, radians) / 5) for _ in range(5)]
    product, poses = chain[0], scattered(rng, chain[0])
    for edge in chain[1:]:
        product, poses = product @ edge, poses @ scattered(rng, edge)
    assert_covariance(product, poses, tolerance)


@pytest.mark.parametrize(("meters", "radians", "tolerance"), SIZES)
def test_fusion_is_the_mean_of_all_truths_that_both_estimates_allow(rng, meters, radians, tolerance):
    truth = random_transform(rng)
    measured = []
    for _ in range(2):
        covariance = random_covariance(rng, meters, radians)
        poses = scattered(rng, truth.with_covariance(covariance, "body"), 2000)
        measured.append(poses.with_covariance(covariance, "body"))
    fused = measured[0].fuse(measured[1])
    # If the covariance is right, the squared distance to the truth has a chi-squared distribution.
    squares = fused.mahalanobis(truth) ** 2
    assert squares.mean() == pytest.approx(6.0, rel=max(0.08, 2 * tolerance))
    error = lambda poses: (poses.distance(truth)[0] ** 2).mean()  # noqa: E731
    assert error(fused) < min(error(measured[0]), error(measured[1]))


def test_fusion_with_exact_directions_keeps_them():
    flat = np.diag([0.1, 0.1, 0, 0, 0, 0.01])  # a robot on a plane
    a = Transform.from_rpy([1.0, 0, 0], yaw=0.1, target="map", source="base").with_covariance(flat)
    b = Transform.from_rpy([1.02, 0, 0], yaw=0.1).with_covariance(flat)
    fused = a.fuse(b)
    assert (fused.x, fused.z, fused.yaw) == (pytest.approx(1.01), 0.0, pytest.approx(0.1))
    np.testing.assert_allclose(fused.covariance, flat / 2, rtol=1e-4, atol=1e-12)
    assert (fused.target, fused.source) == ("map", "base")
    assert a.fuse(b.with_covariance(flat * 1e12)).is_close(a, translation=1e-9)


def test_ros_and_gtsam_conventions():
    pose = Transform.from_rpy([5, 0, 0], yaw=np.pi / 2).with_covariance(np.diag([1.0, 2, 3, 4, 5, 6]).reshape(36))
    assert np.diag(pose.as_covariance()).tolist() == [1, 2, 3, 4, 5, 6]
    np.testing.assert_allclose(np.diag(pose.as_covariance("body")), [2, 1, 3, 5, 4, 6])
    np.testing.assert_allclose(np.diag(pose.as_covariance("gtsam")), [5, 4, 6, 2, 1, 3])
    for convention in ("ros", "body", "gtsam"):
        again = pose.with_covariance(pose.as_covariance(convention), convention)
        np.testing.assert_allclose(again.covariance, pose.covariance, atol=1e-12)
    with pytest.raises(ValueError, match="convention must be 'ros', 'body' or 'gtsam', not 'eigen'"):
        pose.as_covariance("eigen")
    with pytest.raises(ValueError, match="needs a covariance, but the transform map <- \\? has none"):
        Transform(target="map").as_covariance()


@pytest.mark.parametrize(
    ("matrix", "message"),
    [
        (np.eye(6) + np.diag([1.0] * 5, 1), "must be symmetric"),
        (np.diag([1.0, 1, 1, 1, 1, -0.1]), "must not have negative eigenvalues, but has -0.1"),
        (np.full((6, 6), np.nan), "must be finite"),
    ],
)
def test_invalid_covariances_are_refused(matrix, message):
    with pytest.raises(InvalidArgumentException, match=message):
        Transform(covariance=matrix)
    with pytest.raises(InvalidArgumentException, match=message):
        Transform(np.zeros((3, 3))).with_covariance(matrix)


def test_shapes_of_covariances_are_checked():
    with pytest.raises(ValueError, match=r"must have shape \(\.\.\., 6, 6\) or \(\.\.\., 36\), not \(3, 3\)"):
        Transform(covariance=np.eye(3))
    with pytest.raises(ValueError, match=r"must have shape \(3, 6, 6\), not \(2, 6, 6\)"):
        Transform(np.zeros((3, 3)), covariance=np.ones((2, 6, 6)))
    batch = Transform(np.zeros((3, 3)), covariance=np.eye(6))
    assert batch.covariance.shape == (3, 6, 6)
    assert batch[1:].covariance.shape == (2, 6, 6)
    with pytest.raises(ValueError, match="read-only"):
        batch.covariance[0, 0, 0] = 2.0


def test_mahalanobis_distance_has_a_chi_squared_distribution(rng):
    pose = random_transform(rng).with_covariance(random_covariance(rng, 0.1, 0.05))
    squares = pose.mahalanobis(scattered(rng, pose, 50_000)) ** 2
    stats = pytest.importorskip("scipy.stats")  # Imported here because that takes a second.
    assert stats.kstest(squares, stats.chi2(6).cdf).pvalue > 1e-3
    other = pose.with_covariance(pose.covariance * 3)
    assert pose.mahalanobis(other) == pytest.approx(0.0, abs=1e-9)
    shifted = Transform([2.0, 0, 0]).with_covariance(np.eye(6) * 3)
    assert Transform(covariance=np.eye(6)).mahalanobis(shifted) == pytest.approx(1.0)
    with pytest.raises(InvalidArgumentException, match="singular"):
        Transform(covariance=np.diag([1.0, 1, 0, 0, 0, 1])).mahalanobis(Transform())


def test_ellipsoid_contains_the_stated_part_of_the_positions(rng):
    pose = random_transform(rng, target="map").with_covariance(random_covariance(rng, 0.1, 0.0))
    for confidence in (0.5, 0.95):
        region = pose.ellipsoid(confidence)
        assert region.pose.target == "map"
        inside = region.pose.replace(target=None).inverse() @ scattered(rng, pose, 100_000).translation
        share = (((inside / region.radii) ** 2).sum(axis=1) < 1.0).mean()
        assert share == pytest.approx(confidence, abs=0.01)
    assert (np.diff(region.radii) <= 0).all()
    assert np.linalg.det(region.pose.rotation) == pytest.approx(1.0)
    with pytest.raises(ValueError, match="between 0 and 1"):
        pose.ellipsoid(95)


def test_interpolation_of_covariances_turns_with_the_body():
    sideways = np.diag([0.0, 1.0, 0, 0, 0, 0])
    a = Transform().with_covariance(sideways, "body")
    b = Transform.from_rpy(yaw=np.pi / 2).with_covariance(3 * sideways, "body")
    np.testing.assert_allclose(a.interpolate(b, 0.5).as_covariance("body"), 2 * sideways, atol=1e-12)
    assert a.interpolate(b.with_covariance(None), 0.5).covariance is None


def test_copies_keep_the_covariance():
    for pose in (Transform(covariance=np.eye(6)), Transform(np.zeros((2, 3)), covariance=np.eye(6))):
        for copied in (copy.deepcopy(pose), pickle.loads(pickle.dumps(pose))):
            assert copied == pose
            assert not copied.covariance.flags.writeable
        assert pose != pose.with_covariance(None)


def test_only_the_same_frames_are_fused():
    known = np.eye(6)
    with pytest.raises(FrameMismatchException, match="cannot fuse"):
        Transform(target="a", covariance=known).fuse(Transform(target="b", covariance=known))
    with pytest.raises(ValueError, match=r"fuse\(\) needs a covariance"):
        Transform().fuse(Transform())
