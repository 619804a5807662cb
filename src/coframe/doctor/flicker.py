"""Flicker: a link that goes back and forth between two poses, as two publishers that disagree make it."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe.doctor.edge import angles_between

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.doctor.edge import Edge

__all__ = ["Flicker", "flicker"]

_LEAST = 6  # jumps there and back
_METRES = 1e-3
_RADIANS = 1e-2
# A jump is so many times larger than what is left of it one or a few rows later.
_CLEARLY = 6.0
_SAMPLE = 1_000  # rows are enough for a quantile
_TURNS = 3
_MOSTLY = 0.4
_GOLDEN = 0.6180339887498949
# How many rows the slower publisher may lie apart.
_LONGEST_RUN = 12


class Flicker(NamedTuple):
    """How often a link jumped there and back, how far (metres, radians; medians), and the row of the first jump."""

    jumps: int
    distance: float
    angle: float
    first: int


def flicker(edge: Edge) -> Flicker | None:
    """Whether a link jumps away and back again and again; None if not."""
    if edge.count < _LEAST + 2:
        return None
    typical_distance, typical_angle = _typical(edge)
    jumps = np.flatnonzero(
        (edge.distances > _CLEARLY * typical_distance + _METRES) | (edge.turns > _CLEARLY * typical_angle + _RADIANS)
    )
    if len(jumps) < _LEAST:
        return None
    back = jumps[1:][np.diff(jumps) <= _LONGEST_RUN]
    away = jumps[:-1][np.diff(jumps) <= _LONGEST_RUN]
    # From the row before a jump to the row after the next one: what is left of it.
    left = np.linalg.norm(edge.values[away, :3] - edge.values[back + 1, :3], axis=1)
    turned = angles_between(edge.rotations[away], edge.rotations[back + 1])
    distance, angle = edge.distances[away], edge.turns[away]
    returned = (distance > 2.0 * left + _METRES) | (angle > 2.0 * turned + _RADIANS)
    # Most jumps must be undone by the next one: a robot that is teleported now and then does not flicker.
    if np.count_nonzero(returned) < max(_LEAST, len(jumps) // 2):
        return None
    rows = away[returned]
    return Flicker(len(rows), float(np.median(edge.distances[rows])), float(np.median(edge.turns[rows])), int(rows[0]))


def _typical(edge: Edge) -> tuple[float, float]:
    """How far it mostly moves where nobody else has told in between.

    Of two publishers that take turns every second row is of the same one, and if one is twice as quick every third; if
    it is quicker than that, half of the rows follow on one of the same.
    """
    rows = _sample(edge.count - _TURNS)
    moved = [
        np.linalg.norm(edge.values[rows + turn, :3] - edge.values[rows, :3], axis=1) for turn in range(1, _TURNS + 1)
    ]
    turned = [angles_between(edge.rotations[rows], edge.rotations[rows + turn]) for turn in range(1, _TURNS + 1)]
    return float(np.quantile(moved, _MOSTLY, axis=1).min()), float(np.quantile(turned, _MOSTLY, axis=1).min())


def _sample(count: int) -> NDArray[np.intp]:
    """Rows from all over; steps of the same size might meet the turns of one publisher only."""
    if count <= _SAMPLE:
        return np.arange(count)
    return np.asarray(np.arange(_SAMPLE) * _GOLDEN % 1.0 * count).astype(np.intp)
