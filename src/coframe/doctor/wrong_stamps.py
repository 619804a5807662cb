# SPDX-License-Identifier: Apache-2.0
"""The rule that decides which edges have wrong stamps: those on another clock, ahead of it or far behind it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.time import MILLISECOND, SECOND

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.analysis.clock_offset import ClockOffset
    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["MIN_LEAD", "MIN_MESSAGES", "is_ahead", "is_ahead_by_design", "is_behind", "wrong_offset"]

MIN_LEAD = 20 * MILLISECOND
MIN_MESSAGES = 5
_MAX_LAG = 500 * MILLISECOND
# Localization nodes stamp map -> odom ahead of time, by their parameter transform_tolerance.
_TOLERANCE = 2 * SECOND


def is_ahead(lags: NDArray[np.int64]) -> bool:
    """Return whether more than 5 % of some stamps are ahead of the clock on arrival, given arrival minus stamp."""
    return bool(np.mean(lags < -MIN_LEAD) > 0.05)


def is_behind(lags: NDArray[np.int64]) -> bool:
    """Return whether stamps are usually far behind the clock on arrival, given arrival minus stamp."""
    return bool(np.median(lags) > _MAX_LAG)


def is_ahead_by_design(edge: Edge, lags: NDArray[np.int64]) -> bool:
    """Return whether stamps ahead of the clock are usual: localization, and constant transforms that are repeated."""
    return -int(lags.min()) <= _TOLERANCE and (edge.constant or edge.child.rpartition("/")[2] == "odom")


def wrong_offset(observation: Observation, edge: Edge) -> ClockOffset | None:
    """Return the offset of the stamps of an edge from the usual clock if TF008 or TF009 reports them; else None."""
    clock = observation.clocks.get(edge.name)
    if edge.static or edge.is_unset or clock is None:
        return None
    if clock != observation.usual_clock:
        return observation.offset(edge.name)
    lags = observation.lags(edge.stamp, edge.arrived)
    if lags is None or edge.count < MIN_MESSAGES:
        return None
    wrong = not is_ahead_by_design(edge, lags) if is_ahead(lags) else is_behind(lags)
    return observation.offset(edge.name) if wrong else None
