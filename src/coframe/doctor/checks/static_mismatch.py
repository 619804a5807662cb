# SPDX-License-Identifier: Apache-2.0
"""TF018: constant transforms that are published as dynamic, and changing transforms that are published as static."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.analysis.static_command import static_command
from coframe.doctor._finding import Finding, Severity
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF018"
_MIN_TRANSFORMS = 10  # transforms
_MIN_DURATION = 5 * SECOND
# Joints at rest are published in one message with moving ones, with the same stamps.
_MIN_COMMON_SHARE = 0.5
_USUALLY_MOVING_FRAMES = ("odom", "base_link", "base_footprint")
_CHANGES = 3


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per edge."""
    moving_stamps = [edge.stamp for edge in observation.dynamic if not edge.constant]
    for edge in filter(_should_be_static, observation.dynamic):
        stamps = np.concatenate(moving_stamps) if moving_stamps else edge.stamp[:0]
        if np.mean(np.isin(edge.stamp, stamps)) < _MIN_COMMON_SHARE:
            command = static_command(*edge.key, edge.values[-1].tolist())
            yield Finding(
                code=CODE,
                severity=Severity.NOTE,
                text=f"constant in all {edge.count} transforms on /tf; an edge that never changes should be static",
                fix=f"Publish the edge once: `{command}`; in code use StaticTransformBroadcaster(self) instead of "
                "TransformBroadcaster(self), without a timer.",
                edge=edge.key,
                first_stamp=edge.first_stamp,
                publishers=edge.publishers,
            )
    for edge in observation.static:
        changes = int(np.count_nonzero((np.diff(edge.values, axis=0) != 0).any(axis=1)))
        if changes >= _CHANGES and len(edge.publishers) < 2:
            yield Finding(
                code=CODE,
                severity=Severity.WARNING,
                text=f"changed {changes} times on /tf_static; each change also applies to the past, and nothing is "
                "interpolated",
                fix="Publish a dynamic transform: TransformBroadcaster(self) instead of "
                "StaticTransformBroadcaster(self), stamped with the time of the measurement.",
                edge=edge.key,
                first_stamp=edge.first_stamp,
                publishers=edge.publishers,
            )


def _should_be_static(edge: Edge) -> bool:
    if edge.child.rpartition("/")[2] in _USUALLY_MOVING_FRAMES or edge.count < _MIN_TRANSFORMS:
        return False
    return edge.constant and int(edge.stamp.max() - edge.stamp.min()) >= _MIN_DURATION
