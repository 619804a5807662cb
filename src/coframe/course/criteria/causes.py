# SPDX-License-Identifier: Apache-2.0
"""Causes of lost points, found by trial: a common mistake is named only if it explains what was observed.

All functions return "" if no common mistake fits. The report then prints no cause.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.analysis.similar_frames import is_misspelling
from coframe.doctor.checks.late_listeners import lookup_advice
from coframe.doctor.pose_mistakes import explain
from coframe.doctor.quaternion_causes import likely_cause

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable

    from coframe.transform.transform import Transform

__all__ = [
    "BLOCKED_CAUSE",
    "NO_ROTATION_VALUES",
    "edge_cause",
    "log_cause",
    "name_mistake",
    "period_cause",
    "pose_cause",
    "quaternion_values",
]

BLOCKED_CAUSE = (
    "the node does not run its callbacks: a loop or a sleep, for example in the constructor, prevents rclpy.spin(node) "
    "from running them. Use create_timer"
)
NO_ROTATION_VALUES = "the quaternion is 0, 0, 0, 0, so tf2 rejects the transform: without a rotation, w is 1.0"
_SWAPPED_CAUSE = "parent and child are swapped: header.frame_id is the parent, child_frame_id is the child"
_TYPED_DIGITS_CAUSE = (
    "the components of the quaternion are rounded, so its length is not 1: use math.sqrt(0.5), or math.sin and "
    "math.cos of half the angle, instead of typed digits such as 0.707"
)
_MAX_ROUNDING_ERROR = 5e-4  # the error of a component that was typed with three digits
_UNIT_TOLERANCE = 1e-6
_MAX_PERIOD_ERROR = 0.02  # as a fraction
# In the failure of a lookup, as tf2 writes it.
_UNKNOWN_FRAME = '" passed to lookupTransform'
_FAILURES = ("Lookup would require", "Could not find a connection")


def name_mistake(observed: str, expected: str) -> str:
    """Return how a name differs from the wanted one, if it is probably the same name.

    Example:
        >>> name_mistake("/imu_link", "imu_link")
        "the name '/imu_link' begins with a slash: use 'imu_link'"
        >>> name_mistake("end_efector", "end_effector"), name_mistake("odom", "map")
        ("'end_efector' looks like a misspelling of 'end_effector'", '')
    """
    if observed == expected:
        return ""
    if observed.strip("/") == expected.strip("/"):
        verb = "begins" if observed.startswith("/") else "ends"
        return f"the name {observed!r} {verb} with a slash: use {expected!r}"
    if observed.strip().lower() == expected.lower():
        return f"{observed!r} is another name than {expected!r}: names are compared letter by letter"
    return f"{observed!r} looks like a misspelling of {expected!r}" if is_misspelling(observed, expected) else ""


def edge_cause(parent: str, child: str, edges: Iterable[tuple[str, str]], known: Collection[str]) -> str:
    """Return why an edge was not received, given the received edges as parent and child.

    Args:
        parent: The parent of the missing edge.
        child: Its child.
        edges: The received edges.
        known: The frames of the task, which are not misspellings of each other.
    """
    received = list(dict.fromkeys(edges))
    if (child, parent) in received:
        return _SWAPPED_CAUSE
    for found_parent, found_child in received:
        if found_child == child and found_parent != parent:
            mistake = "" if found_parent in known else name_mistake(found_parent, parent)
            return mistake or f"header.frame_id is {found_parent!r} instead of {parent!r}"
    for _, found_child in received:
        if found_child not in known and (mistake := name_mistake(found_child, child)):
            return mistake
    return ""


def quaternion_values(quaternion: Any) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Return the values of a Quaternion message in the order x, y, z, w."""
    return np.array([quaternion.x, quaternion.y, quaternion.z, quaternion.w])


def pose_cause(pose: Transform, quaternion: Any, expected: Transform) -> str:
    """Return the mistake in a published pose, or in the length of its quaternion.

    Args:
        pose: The published pose, normalized.
        quaternion: The Quaternion message of the published pose.
        expected: The correct pose.
    """
    values = quaternion_values(quaternion)
    length = float(np.linalg.norm(values))
    if length == 0.0:
        return NO_ROTATION_VALUES
    if abs(length - 1.0) > _UNIT_TOLERANCE:
        correct = expected.quaternion * np.sign(expected.quaternion @ values or 1.0)
        if np.abs(values - correct).max() < _MAX_ROUNDING_ERROR:
            return _TYPED_DIGITS_CAUSE
        if np.isfinite(values).all() and (cause := likely_cause(values[None])):
            return f"{cause.text}. {cause.fix}".rstrip(".")
    if np.allclose(pose.quaternion, [0.0, 0.0, 0.0, 1.0]) and not np.allclose(
        np.abs(expected.quaternion), [0.0, 0.0, 0.0, 1.0]
    ):
        moved = "" if np.allclose(pose.translation, expected.translation, atol=1e-6) else ", and the position is wrong"
        return f"the rotation is missing: the quaternion is the identity{moved}"
    found = explain(_row(pose), _row(expected), meters=_UNIT_TOLERANCE, radians=_UNIT_TOLERANCE)
    if found is None or np.isnan(found.meters + found.radians):
        return ""
    return f"the pose is correct if {found.reading}. {found.fix}".rstrip(".")


def _row(pose: Transform) -> np.ndarray[Any, np.dtype[np.float64]]:
    return np.concatenate([pose.translation, pose.quaternion])[None]


def period_cause(rate: float, expected_rate: float) -> str:
    """Return the mistake in the period of a timer, from the measured and the wanted rate in Hz.

    Example:
        >>> period_cause(0.05, 50.0)
        'the period of the timer is 20 s: create_timer takes seconds, so 0.02 instead of 20'
        >>> period_cause(5.0, 50.0)
        'the period of the timer is 0.2 s; for 50 Hz it must be 0.02 s'
    """
    if rate <= 0.0 or abs(rate - expected_rate) <= 0.1 * expected_rate:
        return ""
    period, right = 1.0 / rate, 1.0 / expected_rate
    if abs(period - 1000.0 * right) <= _MAX_PERIOD_ERROR * period:
        units = f"create_timer takes seconds, so {right:g} instead of {1000.0 * right:g}"
        return f"the period of the timer is {period:.3g} s: {units}"
    if abs(period - expected_rate) <= _MAX_PERIOD_ERROR * period:
        return f"the period of the timer is {period:.3g} s: the rate {expected_rate:g} is used as the period {right:g}"
    return f"the period of the timer is {period:.3g} s; for {expected_rate:g} Hz it must be {right:g} s"


def log_cause(output: str) -> str:
    """Return the last failed lookup in the output of a program, with the advice that the doctor gives about it."""
    failure = next(filter(None, map(_failed_lookup, reversed(output.splitlines()))), "")
    return f"its lookups fail: {failure[:200].rstrip('.')}. {lookup_advice(failure)}".rstrip(". ") if failure else ""


def _failed_lookup(line: str) -> str:
    """Return the failure of a lookup in a line of output, without the level and the name of the node before it."""
    if (place := line.find(_UNKNOWN_FRAME)) > 0:
        return line[line.rfind('"', 0, place) :].strip()
    place = max(map(line.find, _FAILURES))
    return line[1 + max(line.rfind("]", 0, place), line.rfind(":", 0, place)) :].strip() if place >= 0 else ""
