# SPDX-License-Identifier: Apache-2.0
"""Absolute and relative pose errors with known results."""

import numpy as np
import pytest

import coframe
from coframe import quaternion
from coframe.trajectories import Delta, TrajectoryError, align, associate, compare_trajectories, parse_delta

SECOND = 1_000_000_000
START = 1_700_000_000 * SECOND


def spiral(count=100, seed=None, step=SECOND // 20):
    """Return a moving robot; with a seed, with noise of a few centimeters and hundredths of a radian."""
    t = np.arange(count) / 10
    translation = np.stack([np.cos(t), np.sin(t), t / 5], axis=1)
    rpy = np.stack([0.1 * np.sin(t), 0.1 * t, t], axis=1)
    if seed is not None:
        rng = np.random.default_rng(seed)
        translation = translation + rng.normal(scale=0.03, size=translation.shape)
        rpy = rpy + rng.normal(scale=0.02, size=rpy.shape)
    return coframe.Transform(translation, quaternion.from_rpy(rpy), stamp=START + np.arange(count) * step)


def moved(poses, motion, scale=1.0):
    motion = coframe.Transform.from_rpy(*motion)
    return motion @ coframe.Transform(scale * poses.translation, poses.quaternion, stamp=poses.stamps)


MOTION = ([3.0, -2.0, 1.0], [0.2, -0.4, 2.0])


def test_equal_trajectories_have_no_errors():
    result = compare_trajectories(spiral(), spiral())
    assert result.ape.translation_statistics == (0,) * 7
    assert result.ape.rotation_statistics.max < 1e-7
    assert result.rpe.translation_statistics.max < 1e-14
    assert (len(result.ape.translation), len(result.rpe.translation)) == (100, 99)


def test_a_constant_offset_is_an_absolute_error_only():
    estimate = moved(spiral(), ([0.3, 0.4, 0.0], [0, 0, 0.1]))
    shifted = moved(spiral(), ([0.3, 0.4, 0.0], [0, 0, 0]))
    assert compare_trajectories(spiral(), shifted).ape.translation_statistics.mean == pytest.approx(0.5)
    result = compare_trajectories(spiral(), estimate)
    assert result.ape.rotation_statistics.median == pytest.approx(0.1)
    assert result.rpe.translation_statistics.max < 1e-14


def test_alignment_finds_a_rigid_motion():
    result = compare_trajectories(spiral(), moved(spiral(), MOTION), align="se3")
    assert result.ape.translation_statistics.max < 1e-13
    assert result.alignment.scale == 1.0
    expected = coframe.Transform.from_rpy(*MOTION).inverse()
    assert result.alignment.transform.is_close(expected, translation=1e-12, rotation=1e-9)


def test_alignment_finds_the_scale():
    estimate = moved(spiral(), MOTION, scale=2.5)
    assert compare_trajectories(spiral(), estimate, align="se3").ape.translation_statistics.max > 0.5
    result = compare_trajectories(spiral(), estimate, align="sim3")
    assert result.alignment.scale == pytest.approx(1 / 2.5)
    assert result.ape.translation_statistics.max < 1e-13
    assert result.rpe.translation_statistics.max < 1e-13


def test_alignment_never_mirrors():
    mirrored = coframe.Transform(spiral().translation * [1, 1, -1], stamp=spiral().stamps)
    found = align(spiral(), mirrored)
    assert np.linalg.det(found.transform.rotation) == pytest.approx(1.0)


@pytest.mark.parametrize("count", [1, 2, 50])
def test_a_straight_line_cannot_be_aligned(count):
    line = coframe.Transform(np.arange(count)[:, None] * [1.0, 2.0, 0.0], stamp=np.arange(count))
    with pytest.raises(TrajectoryError, match="on one line or at one point"):
        align(line, line)


def test_poses_are_paired_by_the_nearest_stamp():
    reference = spiral(100)
    shift = 4_000_000
    estimate = coframe.Transform(reference.translation[::3], stamp=reference.stamps[::3] + shift)
    one, other = associate(reference, estimate)
    np.testing.assert_array_equal(one.stamps, reference.stamps[::3])
    assert len(other) == 34
    with pytest.raises(TrajectoryError, match=r"within 3 ms of each other: the reference has stamps from 1700000000\."):
        associate(reference, estimate, "3ms")
    assert len(associate(reference, estimate, "4ms")[0]) == 34
    with pytest.raises(ValueError, match="must not be negative"):
        associate(reference, estimate, -1)


def test_unordered_stamps_are_paired():
    shuffled = np.random.default_rng(1).permutation(100)
    one, other = associate(spiral()[shuffled], spiral())
    np.testing.assert_array_equal(one.stamps, other.stamps)
    assert compare_trajectories(spiral()[shuffled], spiral()).ape.translation_statistics.max == 0


def test_trajectories_without_stamps_are_paired_in_order():
    kitti = coframe.Transform(spiral().translation, spiral().quaternion)
    assert compare_trajectories(spiral(), kitti).ape.translation_statistics.max == 0
    with pytest.raises(TrajectoryError, match="has 100 poses and the estimate has 99"):
        compare_trajectories(spiral(), kitti[:99])
    with pytest.raises(TrajectoryError, match="have no stamps, so no poses are 1 s apart"):
        compare_trajectories(kitti, kitti, delta="1s")


@pytest.mark.parametrize(
    ("delta", "ends"),
    [
        (1, range(1, 10)),
        (4, [4, 8]),
        ("4", [4, 8]),
        ("200ms", [4, 8]),
        ("0.21s", [5]),
        ("2m", [2, 4, 6, 8]),
        ("2.5m", [3, 6, 9]),
        (Delta(3.0, "meters"), [3, 6, 9]),
    ],
)
def test_relative_errors_end_where_the_delta_is_reached(delta, ends):
    drive = coframe.Transform(np.arange(10)[:, None] * [1.0, 0, 0], stamp=np.arange(10) * SECOND // 20)
    result = compare_trajectories(drive, drive, delta=delta)
    assert result.rpe.index.tolist() == list(ends)
    assert result.delta.unit in {"frames", "seconds", "meters"}


def test_a_delta_longer_than_the_trajectory_is_an_error():
    with pytest.raises(TrajectoryError, match="needs two poses that are 100 frames apart; the 100 paired poses"):
        compare_trajectories(spiral(), spiral(), delta=100)


@pytest.mark.parametrize("text", ["0", "-1", "1.5", "m", "", "5 parsecs", "0s", "nan"])
def test_invalid_deltas_are_errors(text):
    with pytest.raises(ValueError, match=r"not a (distance between poses|duration)"):
        parse_delta(text)


def test_wrong_arguments_are_errors():
    with pytest.raises(ValueError, match="No alignment named 'SE3'"):
        compare_trajectories(spiral(), spiral(), align="SE3")
    with pytest.raises(ValueError, match="The estimate must be a batch"):
        compare_trajectories(spiral(), spiral()[0])
    with pytest.raises(ValueError, match="delta must be positive"):
        compare_trajectories(spiral(), spiral(), delta=0)


def test_statistics():
    reference = coframe.Transform(np.zeros((4, 3)), stamp=np.arange(4))
    estimate = coframe.Transform([[1.0, 0, 0], [2, 0, 0], [3, 0, 0], [6, 0, 0]], stamp=np.arange(4))
    found = compare_trajectories(reference, estimate).ape.translation_statistics
    assert found == pytest.approx((np.sqrt(12.5), 3.0, 2.5, np.sqrt(3.5), 1.0, 6.0, 50.0))
    data = compare_trajectories(reference, estimate).as_dict()
    assert data["ape"]["translation"]["sse"] == 50.0
    assert data["pairs"] == 4


@pytest.mark.parametrize("alignment", ["none", "se3", "sim3"])
def test_positions_too_large_to_calculate_with_are_an_error(alignment):
    """LAPACK does not return for some matrices with infinite elements."""
    far = np.full((20, 3), 1e308)
    far[::2] *= -1
    poses = [
        coframe.Transform(positions, np.tile([0.0, 0, 0, 1], (20, 1)), stamp=np.arange(20) * SECOND)
        for positions in (far, -far, np.random.default_rng(1).normal(size=(20, 3)) * 1e99)
    ]
    with pytest.raises(TrajectoryError, match=r"a position of 1e\+308 m; the maximum is 1e\+100 m"):
        compare_trajectories(poses[0], poses[1], align=alignment)
    large = compare_trajectories(poses[2], poses[2], align=alignment)
    assert large.ape.translation_statistics.max < 1e88
