# SPDX-License-Identifier: Apache-2.0
"""All that interpolates between two samples gives the pose that `native/core/interpolation.inc` defines.

Each user is a function from two poses and a fraction to the interpolated pose. The page has a formula of its own,
because it is not native code: its tests compare it with poses of the core in `viewer/test/interpolation.json`.
"""

import json
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

import coframe
from coframe.sensors import deskew

REFERENCE = Path(__file__).resolve().parents[2] / "viewer/test/interpolation.json"
PERIOD = 1 << 30
TURNS = (0.0, 1e-9, 1e-4, 0.01, 0.05, 0.3, 0.6, 1.5, 3.0)
FRACTIONS = (0.0, 0.125, 0.5, 0.71875, 1.0)  # exact in binary, as are the stamps
CORNERS = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])


def definition(first, second, fraction):
    """Return the pose at a fraction between two: on a straight line, and on the shorter arc, as SciPy computes it."""
    ends = Rotation.from_quat([first.quaternion, second.quaternion])
    translation = (1 - fraction) * first.translation + fraction * second.translation
    return translation, Slerp([0, 1], ends)(fraction).as_matrix()


def buffer_of(first, second):
    buffer = coframe.Buffer(None)
    for stamp, pose in ((PERIOD, first), (2 * PERIOD, second)):
        buffer.set("odom", "base", pose, stamp)
    buffer.set("base", "lidar", coframe.Transform(), static=True)
    return buffer


def stamp_of(fraction):
    return PERIOD + round(fraction * PERIOD)


def of_transform(found):
    return np.asarray(found.translation), Rotation.from_quat(found.quaternion).as_matrix()


def of_points(points):
    return points[0], (points[1:4] - points[0]).T


def lookup(first, second, fraction):
    return of_transform(buffer_of(first, second).lookup("odom", "base", stamp_of(fraction)))


def lookup_backwards(first, second, fraction):
    return of_transform(buffer_of(first, second).lookup("base", "odom", stamp_of(fraction)).inverse())


def lookup_in_a_snapshot(first, second, fraction):
    return of_transform(buffer_of(first, second).snapshot().lookup("odom", "lidar", stamp_of(fraction)))


def lookup_many(first, second, fraction):
    found = buffer_of(first, second).lookup_many("odom", "lidar", np.full(7, stamp_of(fraction)))
    return np.asarray(found.translation)[3], Rotation.from_quat(found.quaternion[3]).as_matrix()


def lookup_many_with_twist(first, second, fraction):
    stamps = np.full(7, stamp_of(fraction))
    found, _ = buffer_of(first, second).lookup_many("odom", "base", stamps, twist=True)
    return np.asarray(found.translation)[3], Rotation.from_quat(found.quaternion[3]).as_matrix()


def deskew_between_two_samples(first, second, fraction):
    times = np.full(4, stamp_of(fraction))
    return of_points(deskew(CORNERS, times, buffer_of(first, second), "odom", source="base"))


def deskew_along_a_chain(first, second, fraction):
    buffer = buffer_of(first, second)
    for stamp in (1, 3 * PERIOD):
        buffer.set("map", "odom", coframe.Transform(), stamp)
    times = np.full(4, stamp_of(fraction))
    return of_points(deskew(CORNERS, times, buffer, "map", source="lidar"))


def deskew_many_times(first, second, fraction):
    """Each point has its own time: poses are interpolated in blocks."""
    times = np.random.default_rng(0).permutation(np.linspace(PERIOD, 2 * PERIOD, 400).astype(np.int64))
    own = [17, 123, 251, 399]
    times[own] = stamp_of(fraction)
    points = np.zeros((400, 3))
    points[own] = CORNERS
    return of_points(deskew(points, times, buffer_of(first, second), "odom", source="base")[own])


USERS = (
    lookup,
    lookup_backwards,
    lookup_in_a_snapshot,
    lookup_many,
    lookup_many_with_twist,
    deskew_between_two_samples,
    deskew_along_a_chain,
    deskew_many_times,
)


def pairs():
    """Yield pairs of poses with turns of all sizes, also with quaternions on opposite sides."""
    random = np.random.default_rng(11)
    for turn in TURNS:
        for sign in (1.0, -1.0):
            start = Rotation.random(random_state=int(random.integers(1 << 30)))
            axis = random.normal(size=3)
            end = Rotation.from_rotvec(turn * axis / np.linalg.norm(axis)) * start
            first = coframe.Transform(random.normal(size=3), start.as_quat())
            yield first, coframe.Transform(random.normal(size=3), sign * end.as_quat())


@pytest.mark.parametrize("user", USERS, ids=lambda user: user.__name__)
def test_every_user_interpolates_as_defined(user):
    for first, second in pairs():
        for fraction in FRACTIONS:
            (translation, rotation), found = definition(first, second, fraction), user(first, second, fraction)
            np.testing.assert_allclose(found[0], translation, rtol=0, atol=1e-12)
            np.testing.assert_allclose(found[1], rotation, rtol=0, atol=1e-12)


def reference():
    """Return poses of the core for the page: both ends, the fraction and the pose between them."""
    return [
        {
            "first": list(first.values),
            "second": list(second.values),
            "fraction": fraction,
            "pose": list(buffer_of(first, second).lookup("odom", "base", stamp_of(fraction)).values),
        }
        for first, second in pairs()
        for fraction in FRACTIONS
    ]


def test_the_page_is_compared_with_the_core():
    """`python tests/core/test_interpolation.py` writes the file again if the definition has changed."""
    known = json.loads(REFERENCE.read_text())
    for old, new in zip(known, reference(), strict=True):
        assert old["first"] == pytest.approx(new["first"], abs=1e-15)
        assert old["pose"] == pytest.approx(new["pose"], abs=1e-12)


if __name__ == "__main__":
    REFERENCE.write_text(json.dumps(reference()) + "\n")
