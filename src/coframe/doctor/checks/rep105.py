"""TF007: the order of earth, map, odom and base_link that REP-105 sets."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.doctor.finding import Finding, Severity

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF007"
_ORDER = {"earth": 0, "map": 1, "odom": 2, "base_footprint": 3, "base_link": 3}


def find(observation: Observation) -> Iterator[Finding]:
    """One finding for every frame that stands above one it should stand below."""
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
                text=f"{frame!r} stands below {wrong[0]!r}; REP-105 has map -> odom -> base_link",
                fix=f"Turn the transform round: {wrong[0]!r} is the child, and what is sent is its pose in {frame!r} "
                "(the inverse of what is sent now).",
                edge=edge.key,
                frames=frozenset({frame, wrong[0]}),
                first_stamp=edge.first_stamp,
                publishers=edge.publishers,
            )
