# SPDX-License-Identifier: Apache-2.0
"""Arithmetic with angles in radians, with the API of the ROS 2 package `angles`.

The limits of a joint are an interval from `left_limit` to `right_limit`, counterclockwise. An interval whose left limit
is the larger one contains pi.
"""

from math import fmod, pi

__all__ = [
    "normalize_angle",
    "normalize_angle_positive",
    "shortest_angular_distance",
    "shortest_angular_distance_with_large_limits",
    "shortest_angular_distance_with_limits",
    "two_pi_complement",
]

_TURN = 2.0 * pi


def normalize_angle_positive(angle: float) -> float:
    """Return an angle from 0 to 2 pi."""
    return fmod(fmod(angle, _TURN) + _TURN, _TURN)


def normalize_angle(angle: float) -> float:
    """Return an angle from -pi to pi."""
    positive = normalize_angle_positive(angle)
    return positive - _TURN if positive > pi else positive


def shortest_angular_distance(from_angle: float, to_angle: float) -> float:
    """Return the shortest rotation from one angle to another, from -pi to pi."""
    return normalize_angle(to_angle - from_angle)


def two_pi_complement(angle: float) -> float:
    """Return the equivalent rotation in the other direction, from -2 pi to 2 pi."""
    if abs(angle) > _TURN:
        angle = fmod(angle, _TURN)
    return angle + _TURN if angle <= 0.0 else angle - _TURN


def shortest_angular_distance_with_limits(
    from_angle: float, to_angle: float, left_limit: float, right_limit: float
) -> tuple[bool, float]:
    """Return the shortest rotation from one angle to another that stays within limits.

    Args:
        from_angle: Angle at the beginning.
        to_angle: Angle at the end.
        left_limit: Lower limit, from -pi to pi.
        right_limit: Upper limit, from -pi to pi.

    Returns:
        Whether both angles are within the limits, and the rotation. If an angle is not, the rotation is one that moves
        away from the closer limit.
    """
    delta = shortest_angular_distance(from_angle, to_angle)
    other = two_pi_complement(delta)
    inside, low, high = _find_min_max_delta(from_angle, left_limit, right_limit)
    if inside:
        for rotation in (delta, other):
            if low <= rotation <= high:
                return True, rotation
        # The angle at the end is outside: stop at the limit that is closer to it.
        _, low, high = _find_min_max_delta(to_angle, left_limit, right_limit)
        low, high = high, low
    if abs(low) < abs(high):
        return False, min(delta, other)
    if abs(low) > abs(high):
        return False, max(delta, other)
    return False, delta if abs(delta) < abs(other) else other


def shortest_angular_distance_with_large_limits(
    from_angle: float, to_angle: float, left_limit: float, right_limit: float
) -> tuple[bool, float]:
    """Return the shortest rotation from one angle to another within limits that may be more than a turn apart.

    Args:
        from_angle: Angle at the beginning, which is not normalized.
        to_angle: Angle at the end, which is normalized.
        left_limit: Lower limit.
        right_limit: Upper limit.

    Returns:
        Whether `from_angle` and the angle after the rotation are within the limits, and the rotation.
    """
    delta = shortest_angular_distance(from_angle, to_angle)
    rotations = sorted((delta, two_pi_complement(delta)), key=abs)
    for rotation in rotations:
        if left_limit <= from_angle + rotation <= right_limit:
            return left_limit <= from_angle <= right_limit, rotation
    return False, rotations[0]


def _find_min_max_delta(from_angle: float, left_limit: float, right_limit: float) -> tuple[bool, float, float]:
    """Return whether an angle is within limits, and the rotations to the left and the right limit."""
    left = shortest_angular_distance(from_angle, left_limit)
    right = shortest_angular_distance(from_angle, right_limit)
    low, high_to_left = sorted((left, two_pi_complement(left)))
    low_to_right, high = sorted((right, two_pi_complement(right)))
    if left == 0.0:
        return True, 0.0, high
    if right == 0.0:
        return True, low, 0.0
    if low <= low_to_right or high >= high_to_left:
        return (left_limit, right_limit) == (-pi, pi), low_to_right, high_to_left
    return True, low, high
