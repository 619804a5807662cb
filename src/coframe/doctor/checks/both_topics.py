"""TF005: a link that is told of both as static and as moving."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.doctor.finding import Finding, Severity
from coframe.doctor.phrases import times

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF005"


def find(observation: Observation) -> Iterator[Finding]:
    """One finding a link."""
    static = {edge.key: edge for edge in observation.static}
    for edge in observation.dynamic:
        fixed = static.get(edge.key)
        if fixed is not None:
            yield Finding(
                code=CODE,
                severity=Severity.WARNING,
                text=f"told {times(fixed.count)} on /tf_static and {times(edge.count)} on /tf: each change of kind "
                "clears what a buffer knows of it",
                fix="Send it one way. If it moves, remove it from the StaticTransformBroadcaster (or make its "
                "URDF joint "
                f"not fixed); if not, stop sending {edge.child!r} on /tf.",
                edge=edge.key,
                first_stamp=edge.first_stamp,
                publishers=tuple(dict.fromkeys([*fixed.publishers, *edge.publishers])),
            )
