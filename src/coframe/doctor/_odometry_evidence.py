# SPDX-License-Identifier: Apache-2.0
"""Transforms that differ from an odometry topic by a common mistake."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.pose_mistakes import explain_mutual_difference
from coframe.time import MILLISECOND

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation, ObservedPoses

__all__ = ["odometry_contradictions"]

_MAX_TIME_DIFFERENCE = 2 * MILLISECOND
_MIN_COMPARED = 10
_MAX_COMPARED = 500
_MAX_DISTANCE, _MAX_ANGLE = 2e-3, 2e-3
_MIN_MOTION = 0.05  # meters or radians; poses at rest could match by chance


def odometry_contradictions(observation: Observation) -> Iterator[tuple[Edge, str, str]]:
    """Yield edges that agree with an odometry topic only if a mistake is assumed, with a description and a fix."""
    for poses in observation.poses:
        edge = next((one for one in observation.dynamic if one.key == (poses.frame, poses.child)), None)
        if edge is None:
            continue
        rows, others = _match_rows(edge, poses)
        if len(rows) < _MIN_COMPARED:
            continue
        published, expected = edge.poses(rows), poses.values[others]
        if max(np.ptp(expected[:, :3], axis=0).max(), np.ptp(expected[:, 3:], axis=0).max()) < _MIN_MOTION:
            continue
        explained = explain_mutual_difference(published, expected, meters=_MAX_DISTANCE, radians=_MAX_ANGLE)
        if explained is None or np.isnan(explained[0].meters + explained[0].radians):
            continue
        mistake, in_transform = explained
        wrong, right = ("the pose", f"that of {poses.topic}") if in_transform else (f"the pose of {poses.topic}", "it")
        yield edge, f"differs from {poses.topic}: {mistake.text(right, wrong)} ({len(rows)} compared)", mistake.fix


def _match_rows(edge: Edge, poses: ObservedPoses) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the rows of an edge and of poses with nearly the same stamp."""
    order = np.argsort(edge.stamp, kind="stable")
    stamps = edge.stamp[order]
    after = np.minimum(np.searchsorted(stamps, poses.stamp), len(stamps) - 1)
    before = np.maximum(after - 1, 0)
    nearer = np.abs(stamps[before] - poses.stamp) < np.abs(stamps[after] - poses.stamp)
    nearest = np.where(nearer, before, after)
    others = np.flatnonzero(np.abs(stamps[nearest] - poses.stamp) <= _MAX_TIME_DIFFERENCE)[:_MAX_COMPARED]
    return order[nearest[others]], others
