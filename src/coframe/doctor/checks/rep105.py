# SPDX-License-Identifier: Apache-2.0
"""TF007: the order of earth, map, odom and base_link by REP-105."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.doctor._finding import Finding, Severity

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF007"
_ORDER = {"earth": 0, "map": 1, "odom": 2, "base_footprint": 3, "base_link": 3}


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding for every frame that is below a frame that should be below it."""
    for frame in observation.frames:
        prefix, _, name = frame.rpartition("/")
        if name not in _ORDER:
            continue
        above = [edge.parent for edge in observation.path(frame)]
        wrong = [
            other
            for other in above
            if other.rpartition("/")[0] == prefix and _ORDER.get(other.rpartition("/")[2], -1) > _ORDER[name]
        ]
        if wrong:
            edge = observation.last[frame]
            yield Finding(
                code=CODE,
                severity=Severity.WARNING,
                text=f"{frame!r} is below {wrong[0]!r}; the order of REP-105 is map -> odom -> base_link",
                fix=f"Make {wrong[0]!r} the child and {frame!r} the parent, and publish the inverse of the current "
                "pose.",
                edge=edge.key,
                frames=frozenset({frame, wrong[0]}),
                first_stamp=edge.first_stamp,
                publishers=edge.publishers,
            )
