# SPDX-License-Identifier: Apache-2.0
"""Independent checks of the poses that were read from a file."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import count
from coframe.time import MICROSECOND, MILLISECOND, SECOND

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

__all__ = ["findings", "likely_unit", "looks_like_seconds"]

MAX_NORM_ERROR = 1e-3
MIN_SPACING = 1_000  # nanoseconds; no trajectory has a million poses per second
_MIN_PLAUSIBLE_TIME, _MAX_PLAUSIBLE_TIME = 946_684_800, 4_102_444_800  # the years 2000 and 2100, in seconds
_MAX_STEP = 3600 * SECOND
_MIN_MOVES = 10
# Mean resultant lengths of the directions of motion, seen from the moving frame.
_MIN_STRAIGHT_LENGTH, _MAX_SCATTERED_LENGTH = 0.95, 0.85


def looks_like_seconds(stamps: NDArray[np.int64]) -> bool:
    """Return whether times that should be nanoseconds are closer together than in any trajectory."""
    steps = np.diff(stamps)
    if not len(steps):
        return bool(len(stamps)) and 100_000_000 <= int(stamps[0]) < 100_000_000_000  # 1973 to 5138
    return 0 < abs(int(np.median(steps))) < MIN_SPACING


def likely_unit(stamps: NDArray[np.int64]) -> int:
    """Return the unit of integer stamps in nanoseconds: the one that gives plausible dates, otherwise by spacing."""
    first = abs(int(stamps[0])) if len(stamps) else 0
    step = abs(int(np.median(np.diff(stamps)))) if len(stamps) > 1 else 0
    for unit in (SECOND, MILLISECOND, MICROSECOND):
        if _MIN_PLAUSIBLE_TIME * SECOND < first * unit < _MAX_PLAUSIBLE_TIME * SECOND and step * unit <= _MAX_STEP:
            return unit
    return SECOND if looks_like_seconds(stamps) else 1


def findings(
    stamps: NDArray[np.int64] | None, positions: NDArray[np.float64], xyzw: NDArray[np.float64]
) -> Iterator[str]:
    """Yield one sentence for each suspicious property.

    Args:
        stamps: (N,) nanoseconds, or None if the file has no times.
        positions: (N, 3) meters.
        xyzw: (N, 4) quaternions as they were read.
    """
    steps = np.ones(0) if stamps is None else np.diff(stamps)
    if stamps is not None and (steps <= 0).any():
        row = int(np.flatnonzero(steps <= 0)[0]) + 2
        yield (
            f"the times do not increase at {count(int((steps <= 0).sum()), 'pose')}; the first one is pose {row}, at "
            f"{stamps[row - 1]} ns after {stamps[row - 2]} ns"
        )
    norms = np.linalg.norm(xyzw, axis=1)
    wrong = np.flatnonzero(~(np.abs(norms - 1) <= MAX_NORM_ERROR))
    if len(wrong):
        yield (
            f"the quaternions of {count(len(wrong), 'pose')} do not have norm 1; the first one is pose {wrong[0] + 1}, "
            f"with norm {norms[wrong[0]]:.4g}"
        )
    as_read = _resultant_length(positions, xyzw)
    if as_read is None or as_read >= _MAX_SCATTERED_LENGTH:
        return
    readings = {
        "the quaternions are read with w first": (positions, xyzw[:, (1, 2, 3, 0)]),
        "the quaternions are read with w last": (positions, xyzw[:, (3, 0, 1, 2)]),
        "the poses are inverted": (_inverse_positions(positions, xyzw), xyzw * (-1, -1, -1, 1)),
    }
    for how, (places, rotations) in readings.items():
        other = _resultant_length(places, rotations)
        if other is not None and other > _MIN_STRAIGHT_LENGTH:
            yield (
                f"the path is smoother if {how}: {_percent_text(other)} instead of {_percent_text(as_read)} of the "
                "motion is in one direction of the moving frame"
            )


def _resultant_length(positions: NDArray[np.float64], xyzw: NDArray[np.float64]) -> float | None:
    """Return how similar the directions of motion are in the moving frame: 0 to 1, or None if it hardly moves."""
    if len(positions) <= _MIN_MOVES:
        return None
    steps = np.diff(positions, axis=0)
    lengths = np.linalg.norm(steps, axis=1)
    norms = np.linalg.norm(xyzw[:-1], axis=1)
    moving = (lengths > 0.1 * np.median(lengths)) & (lengths > 0) & (norms > 0)
    if np.count_nonzero(moving) < _MIN_MOVES:
        return None
    directions = steps[moving] / lengths[moving, None]
    local_directions = _rotate_vectors(directions, xyzw[:-1][moving] * (-1, -1, -1, 1) / norms[moving, None])
    return float(np.linalg.norm(local_directions.mean(axis=0)))


def _inverse_positions(positions: NDArray[np.float64], xyzw: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the positions of the inverse poses."""
    norms = np.linalg.norm(xyzw, axis=1)[:, None]
    return -_rotate_vectors(positions, xyzw * (-1, -1, -1, 1) / np.where(norms > 0, norms, 1.0))


def _rotate_vectors(vectors: NDArray[np.float64], xyzw: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return vectors rotated by unit quaternions."""
    axis, scalar = xyzw[:, :3], xyzw[:, 3:]
    result: NDArray[np.float64] = vectors + 2 * np.cross(axis, np.cross(axis, vectors) + scalar * vectors)
    return result


def _percent_text(share: float) -> str:
    return f"{100 * share:.0f} %"
