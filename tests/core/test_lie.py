# SPDX-License-Identifier: Apache-2.0
"""Operations of SE(3) on 1e5 poses, also next to 0 and pi, compared with SciPy."""

import os
import subprocess
import sys

import numpy as np
import pytest
from scipy.spatial import transform as scipy_transform
from scipy.spatial.transform import Rotation

from coframe import Transform, _core
from coframe.errors import FrameMismatchException, InvalidArgumentException

MANY = 100_000
TOLERANCE = 1e-12


def rotation_vectors(rng, count):
    """Rotations by any angle; a quarter of them next to no rotation, a quarter next to half a turn."""
    axes = rng.normal(size=(count, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    angles = rng.uniform(0, np.pi, count)
    angles[: count // 4] = 10 ** rng.uniform(-15, 0, count // 4)
    angles[count // 4 : count // 2] = np.pi - 10 ** rng.uniform(-15, 0, count // 2 - count // 4)
    special = np.array([0.0, np.pi, 1e-200, 5e-324])[: count // 4]
    angles[: len(special)] = special
    return axes * angles[:, None]


def random_twists(rng, count=MANY):
    return np.concatenate([rng.uniform(-5, 5, (count, 3)), rotation_vectors(rng, count)], axis=1)


def random_batch(rng, shape=(MANY,), **names):
    count = int(np.prod(shape))
    rotations = Rotation.from_rotvec(rotation_vectors(rng, count)).as_quat()
    return Transform(rng.uniform(-5, 5, (*shape, 3)), rotations.reshape(*shape, 4), **names)


def rigid_transform_class():
    if not hasattr(scipy_transform, "RigidTransform"):
        pytest.skip("SciPy has RigidTransform since 1.16")
    return scipy_transform.RigidTransform


def rigid(transform):
    return rigid_transform_class().from_components(transform.translation, Rotation.from_quat(transform.quaternion))


def swapped(twists):
    """The order of SciPy: rotation, then translation."""
    return np.concatenate([twists[..., 3:], twists[..., :3]], axis=-1)


def assert_same(ours, theirs, tolerance=TOLERANCE):
    np.testing.assert_allclose(ours.matrix, theirs.as_matrix(), rtol=0, atol=tolerance)


@pytest.fixture
def rng():
    return np.random.default_rng(11)


def test_exponentials_are_those_of_scipy(rng):
    twists = random_twists(rng)
    assert_same(Transform.exp(twists), rigid_transform_class().from_exp_coords(swapped(twists)))


def test_logarithms_are_those_of_scipy(rng):
    poses = random_batch(rng)
    found, theirs = poses.log(), rigid(poses).as_exp_coords()
    # By half a turn, both directions of the axis are right.
    same = np.abs(found - swapped(theirs)).max(axis=1) < TOLERANCE
    half_turns = np.abs(np.linalg.norm(found[:, 3:], axis=1) - np.pi) < 1e-15
    assert (same | half_turns).all()
    np.testing.assert_allclose(Transform.exp(found).matrix, poses.matrix, rtol=0, atol=TOLERANCE)


def test_logarithm_and_exponential_are_inverse(rng):
    twists = random_twists(rng)
    back = Transform.exp(twists).log()
    np.testing.assert_allclose(back[4:], twists[4:], rtol=0, atol=TOLERANCE)
    np.testing.assert_allclose(back[:1], twists[:1], rtol=0, atol=TOLERANCE)


def test_small_rotations_keep_their_relative_precision():
    twists = np.zeros((300, 6))
    twists[:, 3] = 10.0 ** np.arange(-300, 0)
    np.testing.assert_allclose(Transform.exp(twists).log()[:, 3], twists[:, 3], rtol=1e-15)


def test_compositions_are_those_of_scipy(rng):
    a, b = random_batch(rng), random_batch(rng)
    assert_same(a @ b, rigid(a) * rigid(b))
    assert_same(a[0] @ b, rigid(a[0]) * rigid(b))
    assert_same(a @ b[0], rigid(a) * rigid(b[0]))


def test_powers_are_those_of_scipy(rng):
    poses = random_batch(rng, (1000,))
    for exponent in (-1, 0.25, 2):  # SciPy rounds exponents to float32
        assert_same(poses**exponent, rigid(poses) ** exponent, 1e-11)
    assert (pow(poses[5], 0.5) @ poses[5] ** 0.5).is_close(poses[5], translation=1e-12, rotation=1e-12)
    assert poses.pow(np.linspace(0, 1, 1000))[-1].is_close(poses[-1], translation=1e-11, rotation=1e-11)


def test_adjoint_moves_twists(rng):
    poses, twists = random_batch(rng, (50,)), random_twists(rng, 50) * 0.1
    moved = (poses.adjoint() @ twists[..., None])[..., 0]
    assert (poses @ Transform.exp(twists)).is_close(Transform.exp(moved) @ poses, translation=1e-12, rotation=1e-12)


@pytest.mark.parametrize("level", _core.CPU_LEVELS)
def test_all_processor_levels_agree(level):
    program = (
        "import numpy as np, coframe\n"
        "twists = np.random.default_rng(3).normal(size=(1003, 6))\n"
        "twists[:500, 3:] *= 10.0 ** -np.arange(500)[:, None] % 20\n"
        "a = coframe.Transform.exp(twists); b = coframe.Transform.exp(twists[::-1])\n"
        "parts = [a.log().sum(), np.asarray(a @ b).sum(), np.asarray(a.interpolate(b, 0.3)).sum()]\n"
        "print(repr(float(sum(parts) + np.asarray(a.interpolate(b, 0.3, interpolation='screw')).sum())))"
    )
    run = lambda cpu: float(  # noqa: E731
        subprocess.run(
            [sys.executable, "-c", program],
            env=os.environ | {"COFRAME_CPU_LEVEL": cpu},
            check=True,
            capture_output=True,
            text=True,
        ).stdout
    )
    assert run(level) == pytest.approx(run("plain"), abs=1e-10)


def test_screws_have_a_constant_twist(rng):
    a, twists = random_batch(rng, (500,)), random_twists(rng, 500)
    b = a @ Transform.exp(twists)
    for s in (0.0, 0.25, 0.5, 1.0, 1.5, -0.5):
        expected = a @ Transform.exp(s * twists)
        inside = np.linalg.norm(twists[:, 3:], axis=1) < np.pi - 1e-9  # at half a turn there are two shortest ways
        found = a.interpolate(b, s, interpolation="screw")
        assert found[inside].is_close(expected[inside], translation=1e-9, rotation=1e-9)


def test_decoupled_interpolation_is_a_line_and_slerp(rng):
    a, b = random_batch(rng, (400,)), random_batch(rng, (400,))
    s = np.linspace(0, 1, 400)
    found = a.interpolate(b, s)
    line = a.translation + s[:, None] * (b.translation - a.translation)
    np.testing.assert_allclose(found.translation, line, rtol=0, atol=TOLERANCE)
    turn = Rotation.from_quat(a.quaternion).inv() * Rotation.from_quat(b.quaternion)
    slerp = Rotation.from_quat(a.quaternion) * Rotation.from_rotvec(s[:, None] * turn.as_rotvec())
    np.testing.assert_allclose(found.rotation, slerp.as_matrix(), rtol=0, atol=TOLERANCE)


def test_interpolation_continues_beyond_both_ends():
    a, b = Transform(stamp=100), Transform.from_rpy([1.0, 0, 0], yaw=0.5, stamp=200)
    for name in ("decoupled", "screw"):
        ahead, behind = a.interpolate(b, 2.0, interpolation=name), a.interpolate(b, -1.0, interpolation=name)
        assert (ahead.yaw, behind.yaw) == (pytest.approx(1.0), pytest.approx(-0.5))
        assert (ahead.stamp, behind.stamp) == (300, 0)
    assert a.interpolate(b, [[0.0, 0.5, 1.0]]).stamps.tolist() == [[100, 150, 200]]
    with pytest.raises(ValueError, match="must be 'decoupled' or 'screw', not 'cubic'"):
        a.interpolate(b, 0.5, interpolation="cubic")
    with pytest.raises(FrameMismatchException, match="cannot interpolate between"):
        Transform(target="a").interpolate(Transform(target="b"), 0.5)


def test_distance_is_in_meters_and_radians(rng):
    a = Transform.from_rpy([1.0, 2.0, 3.0], yaw=3.0, target="map", source="base")
    b = Transform.from_rpy([1.0, 2.0, 7.0], yaw=-3.0)
    meters, radians = a.distance(b)
    assert type(meters) is float
    assert (meters, radians) == (pytest.approx(4.0), pytest.approx(2 * np.pi - 6.0))
    many = random_batch(rng, (5,))
    assert [part.shape for part in a.distance(many)] == [(5,), (5,)]
    with pytest.raises(FrameMismatchException, match="cannot compare map <- base and odom <- base"):
        a.distance(Transform(target="odom", source="base"))


def test_mean_is_that_of_scipy(rng):
    poses = random_batch(rng, (2, 30), target="map", source="base", stamp=5)
    weights = rng.uniform(size=(2, 30))
    found = poses.mean(weights)
    theirs = Rotation.from_quat(poses.quaternion.reshape(-1, 4)).mean(weights.reshape(-1))
    np.testing.assert_allclose(found.rotation, theirs.as_matrix(), atol=1e-12)
    np.testing.assert_allclose(found.translation, np.average(poses.translation, axis=(0, 1), weights=weights))
    assert (found.target, found.source, found.stamp, found.shape) == ("map", "base", None, ())
    for bad in ([1.0], np.full((2, 30), -1.0), np.zeros((2, 30))):
        with pytest.raises(ValueError, match="weights must"):
            poses.mean(bad)
    with pytest.raises(ValueError, match="needs a batch of at least one"):
        poses[0][:0].mean()


def test_stack_and_concatenate_keep_frames_stamps_and_covariances():
    single = [Transform([i, 0, 0], source="base", stamp=i, covariance=np.eye(6) * (i + 1)) for i in range(3)]
    stacked = Transform.stack(single)
    assert (stacked.shape, stacked.stamps.tolist(), stacked.source) == ((3,), [0, 1, 2], "base")
    assert stacked.covariance[:, 0, 0].tolist() == [1.0, 2.0, 3.0]
    assert Transform.stack([stacked, stacked]).shape == (2, 3)
    joined = Transform.concatenate([stacked, Transform([9.0, 0, 0])])
    assert (joined.shape, joined.x.tolist(), joined.stamps, joined.covariance) == ((4,), [0, 1, 2, 9], None, None)
    with pytest.raises(FrameMismatchException, match="cannot stack"):
        Transform.stack([single[0], Transform(source="other")])
    with pytest.raises(ValueError, match="at least one"):
        Transform.concatenate([])


def test_replace_changes_only_what_is_given():
    pose = Transform.from_rpy([1, 2, 3], yaw=0.5, target="map", source="base", stamp=7).with_covariance(np.eye(6))
    assert pose.replace() == pose
    renamed = pose.replace(target="world", stamp=None)
    assert (renamed.target, renamed.source, renamed.stamp) == ("world", "base", None)
    assert renamed.values == pose.values
    assert pose.replace(translation=[0, 0, 0]).yaw == pose.yaw
    assert pose.replace(covariance=None).covariance is None
    with pytest.raises(InvalidArgumentException, match="must be finite"):
        pose.replace(translation=[np.nan, 0, 0])
    if sys.version_info >= (3, 13):
        import copy

        assert copy.replace(pose, source=None).source is None


def test_format_rounds_the_numbers():
    assert f"{Transform([1.23456, 0, 0], target='a'):.2f}" == (
        "Transform(a <- ?, translation=[1.23, 0.00, 0.00], rpy=[0.00, 0.00, 0.00])"
    )
    assert f"{Transform()}" == str(Transform())


def test_other_representations_are_those_of_scipy(rng):
    poses = random_batch(rng, (1000,))
    theirs = Rotation.from_quat(poses.quaternion)
    np.testing.assert_allclose(poses.as_rotvec()[4:], theirs.as_rotvec()[4:], atol=TOLERANCE)
    clear = np.abs(np.sin(poses.as_euler("zxz")[:, 1])) > 1e-3  # elsewhere, SciPy assumes gimbal lock earlier
    expected = theirs[clear].as_euler("zxz", degrees=True)
    np.testing.assert_allclose(poses[clear].as_euler("zxz", degrees=True), expected, atol=1e-9)
    ours, scipys = poses.as_dual_quaternion(), rigid(poses).as_dual_quat()
    signs = np.sign(
        (ours * scipys)[:, :4].sum(axis=1, keepdims=True)
    )  # a dual quaternion and its negative are the same
    np.testing.assert_allclose(ours, signs * scipys, atol=TOLERANCE)
    assert_same(poses, poses.as_rigid_transform())
    assert Transform.from_scipy(rigid(poses)).is_close(poses, translation=1e-15, rotation=1e-14)


@pytest.mark.parametrize("shape", [(), (1,), (2, 3), (0,)])
def test_all_representations_round_trip(rng, shape):
    pose = random_batch(rng, shape)
    t, (axis, angle) = pose.translation, pose.as_axis_angle()
    degrees = pose.as_axis_angle(degrees=True)
    for back in (
        Transform.from_rotvec(t, pose.as_rotvec()),
        Transform.from_rotvec(t, pose.as_rotvec(degrees=True), degrees=True),
        Transform.from_axis_angle(t, 7.0 * axis, angle),
        Transform.from_axis_angle(t, *degrees, degrees=True),
        Transform.from_euler(t, "ZYX", pose.as_euler("ZYX")),
        Transform.from_euler(t, "xzy", pose.as_euler("xzy", degrees=True), degrees=True),
        Transform.from_dual_quaternion(-3.0 * pose.as_dual_quaternion()),
        Transform.exp(pose.log()),
        Transform.from_matrix(pose.matrix),
        Transform(t) @ Transform.from_matrix(pose.rotation),
    ):
        assert back.shape == shape
        assert back.is_close(pose, translation=1e-12, rotation=1e-12)


def test_one_axis_of_euler_angles_needs_no_list():
    assert Transform.from_euler([0, 0, 0], "z", 90, degrees=True).yaw == pytest.approx(np.pi / 2)
    with pytest.raises(ValueError, match="seq must be one to three axes"):
        Transform.from_euler([0, 0, 0], "xYz", [0, 0, 0])
    with pytest.raises(ValueError, match="without equal neighbors"):
        Transform().as_euler("xxy")
    with pytest.raises(InvalidArgumentException, match="axis must not be zero"):
        Transform.from_axis_angle([0, 0, 0], [0, 0, 0], 1.0)


@pytest.mark.parametrize("shape", [(), (4,)])
def test_points_keep_float32(shape):
    pose = Transform(np.ones((*shape, 3)))
    assert (pose @ np.zeros((4, 3), dtype=np.float32)).dtype == np.float32
    assert (pose @ np.zeros((4, 3), dtype=np.int32)).dtype == np.float64
    assert pose.transform_point(np.zeros((4, 3), dtype=np.float32)).dtype == np.float32


def test_wrong_twists_are_refused():
    with pytest.raises(ValueError, match=r"twist must have shape \(\.\.\., 6\), not \(3,\)"):
        Transform.exp([1, 2, 3])
    with pytest.raises(InvalidArgumentException, match="twist must be finite"):
        Transform.exp([1, 2, 3, np.inf, 0, 0])
