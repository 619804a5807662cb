# SPDX-License-Identifier: Apache-2.0
"""Covariances along a tree and over time, and lookups at two times."""

import numpy as np
import pytest

import coframe
from coframe import Transform
from coframe.errors import ExtrapolationException, InvalidArgumentException
from geometry_msgs.msg import PoseWithCovarianceStamped
from nav_msgs.msg import Odometry

SECOND = 1_000_000_000
SAMPLES = 400_000


def random_covariance(rng, meters, radians):
    root = np.diag([meters] * 3 + [radians] * 3) @ rng.normal(size=(6, 6)) / 2.5
    return root @ root.T


def scattered(rng, transform):
    errors = rng.multivariate_normal(np.zeros(6), transform.as_covariance("body"), size=SAMPLES)
    return transform.with_covariance(None) @ Transform.exp(errors)


@pytest.fixture
def rng():
    return np.random.default_rng(21)


@pytest.fixture
def tree(rng):
    """map -> odom -> base -> lidar, and map -> anchor; base moves, lidar and anchor count as exact."""
    buffer = coframe.Buffer(None)
    odom = Transform.from_rpy([1.0, 2, 0], yaw=0.4)
    buffer.set("map", "odom", odom, static=True, covariance=random_covariance(rng, 0.05, 0.02))
    for second in (1, 2, 3):
        pose = Transform.from_rpy([second, 0.5 * second, 0], [0.1, 0, 0.7 * second], stamp=second * SECOND)
        buffer.set("odom", "base", pose.with_covariance(random_covariance(rng, 0.02 * second, 0.02)))
    buffer.set("base", "lidar", Transform.from_rpy([1.0, 0, 0.5], yaw=1.0), static=True)
    buffer.set("map", "anchor", Transform([5.0, 5, 0]), static=True)
    return buffer


@pytest.mark.parametrize(
    ("target", "source"), [("map", "lidar"), ("lidar", "map"), ("anchor", "lidar"), ("lidar", "odom")]
)
def test_the_covariance_of_a_chain_is_that_of_sampled_poses(rng, tree, target, source):
    when = 1_500_000_000
    found = tree.lookup(target, source, when, covariance=True)
    assert found.is_close(tree.lookup(target, source, when))
    assert (found.target, found.source, found.stamp) == (target, source, when)
    a = tree.lookup("map", "odom", when, covariance=True)
    b = tree.lookup("odom", "base", when, covariance=True)
    to_base = scattered(rng, a) @ scattered(rng, b) if "odom" not in (target, source) else scattered(rng, b)
    ends = {"lidar": to_base @ tree.lookup("base", "lidar"), "anchor": tree.lookup("map", "anchor")}
    poses = ends.get(target, Transform()).inverse() @ ends.get(source, Transform())
    errors = (
        found.with_covariance(None).inverse()
        @ poses.replace(target=None, source=None).replace(target=target, source=source, stamp=None)
    ).log()
    sampled = errors.T @ errors / SAMPLES
    size = np.sqrt(np.outer(np.diag(sampled), np.diag(sampled)))
    np.testing.assert_allclose(found.as_covariance("body") / size, sampled / size, rtol=0, atol=0.01)


def test_edges_without_a_covariance_are_listed(tree):
    assert tree.lookup("map", "lidar", SECOND, covariance=True).exact_edges == ("lidar",)
    assert tree.lookup("anchor", "base", SECOND, covariance=True).exact_edges == ("anchor",)
    exact = tree.lookup("base", "lidar", covariance=True)
    assert not exact.covariance.any()
    assert tree.lookup("map", "lidar", SECOND).covariance is None
    assert tree.lookup("map", "map", SECOND, covariance=True).exact_edges == ()


def test_covariances_are_interpolated_along_the_child_and_held_at_the_ends():
    buffer = coframe.Buffer(None)
    sideways = np.diag([0.0, 1.0, 0, 0, 0, 0])
    for second, yaw, factor in ((1, 0.0, 1.0), (3, np.pi / 2, 3.0)):
        pose = Transform.from_rpy(yaw=yaw, stamp=second * SECOND).with_covariance(factor * sideways, "body")
        buffer.set("odom", "base", pose)
    found = buffer.lookup("odom", "base", 2 * SECOND, covariance=True)
    np.testing.assert_allclose(found.as_covariance("body"), 2 * sideways, atol=1e-12)
    buffer.set("odom", "base", Transform(stamp=4 * SECOND))
    later = buffer.lookup("odom", "base", 4 * SECOND, covariance=True)
    np.testing.assert_allclose(later.as_covariance("body"), 3 * sideways, atol=1e-12)


def test_many_lookups_are_those_one_by_one(tree):
    times = np.array([0.5, 1.0, 2.0, 1.25, 3.0]) * SECOND
    many = tree.lookup_many("anchor", "lidar", times.astype(np.int64), covariance=True, on_error="nan")
    assert many.exact_edges == ("anchor", "lidar")
    for i, time in enumerate(times[1:], 1):
        one = tree.lookup("anchor", "lidar", int(time), covariance=True)
        np.testing.assert_allclose(many.covariance[i], one.covariance, rtol=1e-9, atol=1e-15)
    assert np.isnan(many.covariance[0]).all()
    with pytest.raises(ValueError, match="cannot be combined with out"):
        tree.lookup_many("map", "base", times.astype(np.int64), covariance=True, out=np.empty((5, 7)))


def test_messages_give_edges_their_covariances(tree):
    covariance = np.diag([1.0, 2, 3, 4, 5, 6])
    odometry = Odometry(child_frame_id="base")
    odometry.header.frame_id, odometry.header.stamp.sec = "odom", 1
    odometry.pose.covariance[:] = covariance.reshape(36)
    tree.freeze()
    tree.set_covariance("odom", "base", odometry)
    pose = tree.lookup("odom", "base", SECOND, covariance=True)
    np.testing.assert_allclose(pose.as_covariance("body"), covariance, atol=1e-12)  # the message has no rotation
    localized = Transform([1.0, 0, 0], covariance=covariance).to_msg(PoseWithCovarianceStamped, "map", SECOND)
    buffer = coframe.Buffer(None)
    assert buffer.set("map", "base", Transform(localized))
    np.testing.assert_allclose(buffer.lookup("map", "base", covariance=True).covariance, covariance)


def test_wrong_covariances_are_refused(tree):
    with pytest.raises(InvalidArgumentException, match="the pose of 'base' in 'odom' has no covariance"):
        tree.set_covariance("odom", "base", Odometry())
    with pytest.raises(InvalidArgumentException, match="has no stamp"):
        tree.set_covariance("odom", "base", Transform(covariance=np.eye(6)))
    with pytest.raises(InvalidArgumentException, match="cannot store the transform map <- base as odom <- base"):
        tree.set_covariance("odom", "base", Transform(target="map", covariance=np.eye(6), stamp=1))
    with pytest.raises(InvalidArgumentException, match="must be symmetric"):
        tree.set("odom", "base", Transform(), 9 * SECOND, covariance=np.arange(36.0))
    assert tree.span("odom", "base")[1] == 3 * SECOND


def test_batches_have_covariances():
    buffer = coframe.Buffer(None)
    batch = Transform(np.eye(3), stamp=[1, 2, 3], covariance=np.eye(6) * np.arange(1.0, 4.0)[:, None, None])
    assert buffer.set_many("map", "base", None, batch) == 3
    assert buffer.lookup("map", "base", 2, covariance=True).covariance[0, 0] == 2.0
    buffer.set_many("map", "tool", [1, 2], np.asarray(batch)[:2], covariance=np.eye(6))
    assert buffer.lookup("map", "tool", 2, covariance=True).covariance[5, 5] == 1.0
    assert buffer.snapshot().lookup("map", "tool", 2, covariance=True).covariance[5, 5] == 1.0


def test_old_covariances_are_dropped():
    from coframe.buffer._covariances import EdgeCovariances

    edge = EdgeCovariances(10)
    edge.add(list(range(0, 1000, 2)), np.zeros((500, 6, 6)))
    assert len(edge._stamps) <= 7


def test_lookups_at_two_times(tree):
    late, early = 3 * SECOND, 1 * SECOND
    found = tree.lookup("base", "lidar", late, fixed="odom", source_time=early)
    expected = tree.lookup("base", "odom", late) @ tree.lookup("odom", "lidar", early)
    assert found.is_close(expected, translation=1e-12, rotation=1e-12)
    assert (found.target, found.source, found.stamp) == ("base", "lidar", late)
    assert found == tree._lookup_full("base", late, "lidar", early, "odom")
    uncertain = tree.lookup("base", "lidar", late, fixed="odom", source_time=early, covariance=True)
    assert uncertain.is_close(expected, translation=1e-12, rotation=1e-12)
    assert uncertain.exact_edges == ("lidar",)
    assert uncertain.covariance[0, 0] > tree.lookup("odom", "base", late, covariance=True).covariance[0, 0]
    assert tree.lookup("map", "base", early, fixed="odom").is_close(tree.lookup("map", "base", early))


def test_lookups_at_two_times_extrapolate_and_wait(tree):
    beyond = 3 * SECOND + SECOND // 10
    with pytest.raises(ExtrapolationException):
        tree.lookup("base", "lidar", beyond, fixed="odom", source_time=SECOND)
    found = tree.lookup("base", "lidar", beyond, fixed="odom", source_time=SECOND, extrapolate="1s", hold=True)
    assert found.stamp == beyond
    with pytest.raises(ExtrapolationException):
        tree.lookup("base", "lidar", beyond, fixed="odom", source_time=SECOND, timeout="1ms")
    with pytest.raises(ValueError, match="source_time needs fixed"):
        tree.lookup("base", "lidar", SECOND, source_time=SECOND)
