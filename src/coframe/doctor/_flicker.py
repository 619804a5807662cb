# SPDX-License-Identifier: Apache-2.0
"""Flicker: an edge that alternates between two poses, as if two publishers disagree. Also explains jumps."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe.doctor._edge import angles_between
from coframe.doctor.pose_mistakes import Explanation, explain, explain_mutual_difference

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.doctor._edge import Edge

__all__ = ["Flicker", "alternation_cause", "flicker", "jump_cause"]

_MIN_JUMPS = 6  # jumps away and back
_DISTANCE_RESOLUTION = 1e-3
_ANGLE_RESOLUTION = 1e-2
# A jump must be larger than this multiple of the usual step.
_MIN_STEP_RATIO = 6.0
_TOLERANCE = 2.0  # usual steps that two poses at nearly the same time may differ
_MAX_COMPARED = 200  # jumps
_SAMPLE_ROWS = 1_000  # rows, which are enough for a quantile
_MAX_REVERSALS = 3
_MIN_ALTERNATION_SHARE = 0.4
_GOLDEN_RATIO = 0.6180339887498949
# The maximum distance between two rows of the slower publisher.
_MAX_RUN = 12


class Flicker(NamedTuple):
    """The number of jumps away and back, their median size (meters, radians), and the row before each."""

    jumps: int
    distance: float
    angle: float
    rows: NDArray[np.intp]

    @property
    def first(self) -> int:
        """The row of the first jump."""
        return int(self.rows[0])


def flicker(edge: Edge) -> Flicker | None:
    """Return the flicker of an edge that repeatedly jumps away and back, or None if it does not."""
    if edge.count < _MIN_JUMPS + 2:
        return None
    # The usual step is computed only if there are enough large steps, because it takes most of the time.
    if (
        np.count_nonzero((edge.distances > _DISTANCE_RESOLUTION) | (edge.rotation_steps > _ANGLE_RESOLUTION))
        < _MIN_JUMPS
    ):
        return None
    typical_distance, typical_angle = _typical_step(edge)
    jumps = np.flatnonzero(
        (edge.distances > _MIN_STEP_RATIO * typical_distance + _DISTANCE_RESOLUTION)
        | (edge.rotation_steps > _MIN_STEP_RATIO * typical_angle + _ANGLE_RESOLUTION)
    )
    if len(jumps) < _MIN_JUMPS:
        return None
    back = jumps[1:][np.diff(jumps) <= _MAX_RUN]
    away = jumps[:-1][np.diff(jumps) <= _MAX_RUN]
    # The difference between the row before a jump and the row after the next one.
    left = np.linalg.norm(edge.values[away, :3] - edge.values[back + 1, :3], axis=1)
    angles = angles_between(edge.rotations[away], edge.rotations[back + 1])
    distance, angle = edge.distances[away], edge.rotation_steps[away]
    returned = (distance > 2.0 * left + _DISTANCE_RESOLUTION) | (angle > 2.0 * angles + _ANGLE_RESOLUTION)
    # Most jumps must be reversed by the next one: a robot that is moved to a new pose a few times does not flicker.
    if np.count_nonzero(returned) < max(_MIN_JUMPS, len(jumps) // 2):
        return None
    rows = away[returned]
    return Flicker(len(rows), float(np.median(edge.distances[rows])), float(np.median(edge.rotation_steps[rows])), rows)


def alternation_cause(edge: Edge, flicker: Flicker) -> str:
    """Return a clause with the mistake that explains how the two poses differ, or "" if no common mistake does."""
    rows = flicker.rows[: 2 * _MAX_COMPARED : 2]  # every second jump returns
    explained = explain_mutual_difference(edge.poses(rows), edge.poses(rows + 1), **_tolerances(edge))
    return f"; {explained[0].text('the other', 'one of them')}" if explained else ""


def jump_cause(edge: Edge, rows: NDArray[np.intp]) -> Explanation | None:
    """Return the mistake that explains jumps after given rows, compared with the pose before, or None if none does.

    A single jump is explained only by a mistake that poses do not match by chance.
    """
    rows = rows[:_MAX_COMPARED]
    # Of a jump away and a jump back, only the first one leads to the wrong pose.
    found = explain(edge.poses(rows[::2] + 1), edge.poses(rows[::2]), **_tolerances(edge))
    if found is None or not (found.is_specific or len(rows) >= _MIN_JUMPS):
        return None
    return found


def _tolerances(edge: Edge) -> dict[str, float]:
    """Return how far an edge usually moves between two rows, as the limits of a comparison."""
    distance, angle = _typical_step(edge)
    return {
        "meters": _TOLERANCE * distance + _DISTANCE_RESOLUTION,
        "radians": _TOLERANCE * angle + _ANGLE_RESOLUTION / 10,
    }


def _typical_step(edge: Edge) -> tuple[float, float]:
    """Return the usual step, in meters and radians, between two rows of the same publisher.

    With two publishers that alternate, every second row is from the same one, and every third row if one of them has
    twice the rate of the other. With a larger ratio, half of the rows follow a row of the same publisher.
    """
    rows = _sample(edge.count - _MAX_REVERSALS)
    distances = [
        np.linalg.norm(edge.values[rows + rotation, :3] - edge.values[rows, :3], axis=1)
        for rotation in range(1, _MAX_REVERSALS + 1)
    ]
    angles = [
        angles_between(edge.rotations[rows], edge.rotations[rows + rotation])
        for rotation in range(1, _MAX_REVERSALS + 1)
    ]
    return float(np.quantile(distances, _MIN_ALTERNATION_SHARE, axis=1).min()), float(
        np.quantile(angles, _MIN_ALTERNATION_SHARE, axis=1).min()
    )


def _sample(count: int) -> NDArray[np.intp]:
    """Return a sample of rows at irregular distances, because a regular one could contain only one publisher."""
    if count <= _SAMPLE_ROWS:
        return np.arange(count)
    return np.asarray(np.arange(_SAMPLE_ROWS) * _GOLDEN_RATIO % 1.0 * count).astype(np.intp)
