# SPDX-License-Identifier: Apache-2.0
"""Time offsets from rotation: right within the stated deviation for many seeds; refused without enough motion."""

import numpy as np
import pytest

from coframe.errors import TrajectoryError
from coframe.trajectories.motion_offset import motion_offset

scipy = pytest.importorskip("scipy", reason="the truth is made with SciPy")
from scipy.spatial.transform import Rotation, Slerp  # noqa: E402 - after the check

SECOND = 1_000_000_000
OFFSET = 1234.567  # seconds


def pair(seed, *, seconds=60, rates=(50, 30), noise=0.003, drift=0.0, size=0.4, period=None):
    """Return two trajectories of one body: other mounts, other maps, other clocks, other sample times, noise."""
    rng = np.random.default_rng(seed)
    times = np.arange(-2.0, seconds + 4.0, 0.05)
    if period is None:
        kernel = np.exp(-0.5 * (np.arange(-60, 61) * 0.05 / 0.6) ** 2)
        kernel /= np.sqrt((kernel**2).sum())
        speeds = np.stack([np.convolve(rng.normal(size=len(times)), kernel, "same") for _ in range(3)], axis=1) * size
    else:
        speeds = np.outer(np.sin(2 * np.pi * times / period), [0, 0, size])
    turns = [Rotation.identity()]
    for speed in speeds[:-1]:
        turns.append(turns[-1] * Rotation.from_rotvec(speed * 0.05))
    body = Slerp(times, Rotation.concatenate(turns))
    one, other = (np.sort(rng.uniform(0, seconds, int(seconds * rate))) for rate in rates)
    noisy = lambda count: Rotation.from_rotvec(rng.normal(size=(count, 3)) * noise)  # noqa: E731
    mount, world = Rotation.random(2, random_state=seed)
    clock = other - OFFSET - drift * (other - seconds / 2)
    return (
        (np.round((one + 1e9) * SECOND).astype(np.int64), (body(one) * noisy(len(one))).as_quat()),
        (
            np.round((clock + 1e9) * SECOND).astype(np.int64),
            (world * body(other) * mount * noisy(len(other))).as_quat(),
        ),
    )


@pytest.mark.parametrize(
    "situation",
    [
        pytest.param({"seconds": 20}, id="short"),
        pytest.param({}, id="usual", marks=pytest.mark.slow),
        pytest.param({"rates": (50, 10)}, id="few poses", marks=pytest.mark.slow),
        pytest.param({"noise": 0.001, "rates": (200, 200)}, id="precise", marks=pytest.mark.slow),
    ],
)
def test_offsets_are_right_within_their_deviation(situation):
    errors, deviations = [], []
    for seed in range(8):
        found = motion_offset(*pair(seed, **situation))
        errors.append(found.offset - OFFSET * SECOND)
        deviations.append(found.deviation)
        assert found.drift == 0.0
    assert np.abs(errors).max() < 3e6
    assert np.sqrt(np.mean(np.square(errors))) < 2e6
    ratios = np.array(errors) / np.array(deviations)
    assert np.sqrt(np.mean(ratios**2)) < 1.8
    assert np.abs(ratios).max() < 4.0


def test_a_drift_is_found():
    found = motion_offset(*pair(1, seconds=300, drift=200e-6))
    assert found.drift == pytest.approx(200e-6, rel=0.15)
    assert found.offset / SECOND == pytest.approx(OFFSET, abs=0.002)


def test_both_directions_agree():
    one, other = pair(3)
    assert motion_offset(one, other).offset == pytest.approx(-motion_offset(other, one).offset, abs=2e6)


@pytest.mark.parametrize(
    ("situation", "reason"),
    [
        ({"size": 0.0}, "do not agree at any time offset"),
        ({"size": 0.01}, "do not agree at any time offset|too small for a time offset"),
        ({"noise": 0.2}, "do not agree at any time offset|too small for a time offset"),
        ({"period": 5.0}, "repeats itself: time offsets that differ by"),
    ],
)
def test_too_little_or_repeated_motion_is_refused(situation, reason):
    with pytest.raises(TrajectoryError, match=reason):
        motion_offset(*pair(2, **situation))


@pytest.mark.parametrize("count", [0, 1, 2])
def test_few_poses_are_refused(count):
    one, (stamps, rotations) = pair(1, seconds=5)
    with pytest.raises(TrajectoryError, match="at least three poses"):
        motion_offset(one, (stamps[:count], rotations[:count]))


def test_unsorted_repeated_and_invalid_poses_do_no_harm():
    one, (stamps, rotations) = pair(4)
    expected = motion_offset(one, (stamps, rotations))
    order = np.random.default_rng(0).permutation(len(stamps))
    broken = np.concatenate([rotations, rotations[:50], np.full((3, 4), np.nan)])[:, :]
    times = np.concatenate([stamps, stamps[:50], stamps[:3] + 1])
    found = motion_offset(
        one,
        (np.concatenate([times[order], times[len(stamps) :]]), np.concatenate([broken[order], broken[len(stamps) :]])),
    )
    assert found.offset == pytest.approx(expected.offset, abs=1e6)
