# SPDX-License-Identifier: Apache-2.0
"""angles: rotations are checked by what they lead to."""

from math import cos, inf, isclose, pi, sin

from hypothesis import assume, given
from hypothesis import strategies as st

import angles

ANGLES = st.floats(-20.0, 20.0) | st.sampled_from([0.0, pi, -pi, 2 * pi, pi / 2])
NORMAL = st.integers(-3100, 3100).map(lambda number: number / 1000)


def same(first, second):
    return isclose(cos(first), cos(second), abs_tol=1e-9) and isclose(sin(first), sin(second), abs_tol=1e-9)


@given(ANGLES, ANGLES)
def test_angles_keep_their_direction(first, second):
    assert same(angles.normalize_angle(first), first)
    assert -pi <= angles.normalize_angle(first) <= pi
    assert 0 <= angles.normalize_angle_positive(first) <= 2 * pi
    distance = angles.shortest_angular_distance(first, second)
    assert abs(distance) <= pi
    assert same(first + distance, second)
    other = angles.two_pi_complement(distance)
    assert same(first + other, second)
    assert isclose(abs(distance) + abs(other), 2 * pi)


@given(NORMAL, NORMAL, NORMAL, NORMAL)
def test_rotations_within_limits(start, end, left, right):
    low, high = min(left, right), max(left, right)
    assume(low < high)
    valid, rotation = angles.shortest_angular_distance_with_limits(start, end, low, high)
    assert valid == (low <= start <= high and low <= end <= high)
    assert same(start + rotation, end)
    if valid:
        assert isclose(start + rotation, end, abs_tol=1e-9), "the rotation does not pass the limits"


@given(st.floats(-20.0, 20.0), NORMAL, st.floats(0.0, 10.0), st.floats(0.0, 10.0))
def test_rotations_within_more_than_a_turn(start, end, below, above):
    low, high = start - below, start + above
    valid, rotation = angles.shortest_angular_distance_with_large_limits(start, end, low, high)
    reached = [start + r for r in (angles.shortest_angular_distance(start, end) + 2 * pi * n for n in (-1, 0, 1))]
    possible = [r - start for r in reached if low <= r <= high and abs(r - start) <= 2 * pi]
    assert valid == bool(possible)
    assert same(start + rotation, end)
    assert abs(rotation) <= min(map(abs, possible), default=inf) + 1e-9
