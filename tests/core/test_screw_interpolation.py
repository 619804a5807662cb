# SPDX-License-Identifier: Apache-2.0
"""A buffer that interpolates along screws: constant twists are exact at 10 Hz, in every kind of lookup."""

import numpy as np
import pytest

import coframe
from coframe import Transform

SECOND = 1_000_000_000
STEP = SECOND // 10
TWIST = np.array([1.5, 0.2, -0.1, 0.3, -0.2, 1.2])  # of base, in meters and radians per second
ARM = np.array([0.1, 0.0, 0.4, -0.5, 0.9, 0.1])
START = Transform.from_rpy([5.0, -3, 1], [0.2, 0.1, 2.0])


def base_at(times):
    return START @ Transform.exp(np.asarray(times)[..., None] / SECOND * TWIST)


def lidar_at(times):
    seconds = np.asarray(times)[..., None] / SECOND
    return base_at(times) @ Transform([0.5, 0, 1]) @ Transform.exp(seconds * ARM)


def filled(interpolation):
    buffer = coframe.Buffer(None, interpolation=interpolation)
    stamps = np.arange(0, 3 * SECOND, STEP) + 1
    buffer.set_many("map", "base", stamps, base_at(stamps))
    buffer.set("base", "mount", Transform([0.5, 0, 1]), static=True)
    buffer.set_many("mount", "lidar", stamps + STEP // 3, Transform.exp((stamps + STEP // 3)[:, None] / SECOND * ARM))
    return buffer


@pytest.fixture
def buffer():
    return filled("screw")


TIMES = np.random.default_rng(1).integers(STEP, 29 * STEP, 1000)


def test_single_lookups_are_exact(buffer):
    for time in TIMES[:100].tolist():
        assert buffer.lookup("map", "lidar", time).is_close(lidar_at(time), translation=1e-12, rotation=1e-12)
        assert buffer.lookup("lidar", "map", time).is_close(lidar_at(time).inverse(), translation=1e-12, rotation=1e-12)
    assert (
        not filled("decoupled")
        .lookup("map", "lidar", STEP // 2 + STEP)
        .is_close(lidar_at(STEP // 2 + STEP), translation=1e-4)
    )


@pytest.mark.parametrize("threads", [1, 2])
def test_many_lookups_are_exact(buffer, threads):
    found = buffer.lookup_many("map", "lidar", TIMES, threads=threads)
    assert found.is_close(lidar_at(TIMES), translation=1e-12, rotation=1e-12)
    assert buffer.lookup_many("lidar", "map", TIMES).is_close(found.inverse(), translation=1e-12, rotation=1e-12)


def test_twists_are_constant(buffer):
    poses, twists = buffer.lookup_many("map", "base", TIMES, twist=True)
    assert poses.is_close(base_at(TIMES), translation=1e-12, rotation=1e-12)
    in_body = np.concatenate(
        [(poses.rotation.swapaxes(1, 2) @ part[..., None])[..., 0] for part in np.split(twists, 2, 1)], 1
    )
    np.testing.assert_allclose(in_body, np.broadcast_to(TWIST, in_body.shape), atol=1e-9)


def test_extrapolation_and_walks_are_exact(buffer):
    last = buffer.span("map", "base")[1]
    found = buffer.lookup("map", "base", last + STEP // 2, extrapolate="1s")
    assert found.is_close(base_at(last + STEP // 2), translation=1e-9, rotation=1e-9)
    buffer.set("odom", "base", Transform(), stamp=100 * SECOND)  # a new parent: no path can be cached
    time = int(TIMES[0])
    assert buffer.lookup("map", "lidar", time).is_close(lidar_at(time), translation=1e-12, rotation=1e-12)
    many = buffer.lookup_many("map", "lidar", TIMES[:5])
    assert many.is_close(lidar_at(TIMES[:5]), translation=1e-12, rotation=1e-12)


@pytest.mark.parametrize("points_per_time", [1, 100])
def test_deskewing_is_exact(buffer, points_per_time):
    from coframe import _core

    times = np.repeat(np.sort(TIMES), points_per_time)
    points = np.random.default_rng(2).normal(size=(len(times), 3))
    expected = lidar_at(times[::50]) @ points[::50]
    columns = [np.ascontiguousarray(axis) for axis in points.T]
    identity = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
    _core.deskew_fields(buffer, "map", "lidar", times, identity, [tuple(columns)], False, 1)
    np.testing.assert_allclose(np.stack(columns, axis=1)[::50], expected, atol=1e-9)


def test_the_option_is_kept_and_can_be_chosen_for_a_copy(buffer):
    assert buffer.interpolation == "screw"
    assert buffer.snapshot().interpolation == "screw"
    time = int(TIMES[0])
    assert buffer.snapshot().lookup("map", "lidar", time) == buffer.lookup("map", "lidar", time)
    plain = filled("decoupled")
    assert plain.interpolation == "decoupled"
    copied = plain.snapshot(interpolation="screw")
    assert copied.lookup("map", "lidar", time).is_close(lidar_at(time), translation=1e-12, rotation=1e-12)
    with pytest.raises(ValueError, match="interpolation must be 'decoupled' or 'screw', not 'cubic'"):
        coframe.Buffer(interpolation="cubic")
