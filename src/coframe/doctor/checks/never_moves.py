"""TF018: what never changes sent as moving, and what changes sent as static."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.doctor.phrases import static_arguments

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF018"
_LEAST = 10  # transforms
_LONG = 5_000_000_000  # nanoseconds
# Joints at rest are told of in one message with others, at the same stamps.
_TOGETHER = 0.5
_MOVES_BY_HABIT = ("odom", "base_link", "base_footprint")
_CHANGES = 3


def find(observation: Observation) -> Iterator[Finding]:
    """One finding a link."""
    moving = [edge.stamp for edge in observation.dynamic if not edge.constant]
    for edge in filter(_should_be_static, observation.dynamic):
        stamps = np.concatenate(moving) if moving else edge.stamp[:0]
        if np.mean(np.isin(edge.stamp, stamps)) < _TOGETHER:
            yield Finding(
                code=CODE,
                severity=Severity.NOTE,
                text=f"did not change in {edge.count} transforms on /tf: if it never does, it is a static one",
                fix=f"Send it once: coframe static {static_arguments(edge)}; in code "
                "StaticTransformBroadcaster(self) instead of TransformBroadcaster(self), and no timer.",
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
                text=f"changed {changes} times on /tf_static: the past changes with it, nothing is interpolated, "
                "and the "
                "topic is made for what is sent once",
                fix="Send it as a moving one: TransformBroadcaster(self) instead of StaticTransformBroadcaster(self), "
                "stamped with the time of the measurement.",
                edge=edge.key,
                first_stamp=edge.first_stamp,
                publishers=edge.publishers,
            )


def _should_be_static(edge: Edge) -> bool:
    if edge.child.rpartition("/")[2] in _MOVES_BY_HABIT or edge.count < _LEAST:
        return False
    return edge.constant and int(edge.stamp.max() - edge.stamp.min()) >= _LONG
