"""TF003: one link, two publishers that say different things: it flickers."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.doctor.flicker import flicker

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF003"
_SWITCHES = 3


def find(observation: Observation) -> Iterator[Finding]:
    """One finding a link; where nobody says who sends, by what the link does."""
    for edge in (edge.current for edge in observation.edges):
        if len(edge.publishers) > 1:
            yield from _of_publishers(edge)
        elif not edge.publishers and not edge.static:
            yield from _of_unknown(edge)


def _of_publishers(edge: Edge) -> Iterator[Finding]:
    switches = int(np.count_nonzero(np.diff(edge.publisher)))
    if not edge.static and switches < _SWITCHES:
        return  # one has taken over from the other
    found = flicker(edge)
    differ = found is not None or (edge.static and not edge.constant)
    first, second, *_ = edge.publishers
    apart = f": it jumps by {_size(found.distance, found.angle)} {found.jumps} times" if found else ""
    yield Finding(
        code=CODE,
        severity=Severity.ERROR if differ else Severity.NOTE,
        text=f"{len(edge.publishers)} publishers"
        + (f" that disagree{apart}" if differ else " that say the same, or nearly"),
        fix=f"Stop one of the two, {first} or {second}, or switch its transform off (lab: publish_arm:=false; "
        "robot_localization and diff_drive_controller: publish_tf / enable_odom_tf: false).",
        harm="" if differ else "As soon as one of them lags behind or says something else, the link flickers.",
        edge=edge.key,
        first_stamp=edge.first_stamp,
        publishers=edge.publishers,
    )


def _of_unknown(edge: Edge) -> Iterator[Finding]:
    found = flicker(edge)
    if found is not None:
        yield Finding(
            code=CODE,
            severity=Severity.ERROR,
            text=f"jumps by {_size(found.distance, found.angle)} and back, {found.jumps} times: as two publishers that "
            "disagree make it; the recording does not say who they were",
            fix=f"On the running robot, `coframe doctor` names the publishers of {edge.parent} -> {edge.child}: stop "
            "one of them.",
            edge=edge.key,
            first_stamp=int(edge.stamp[found.first]),
        )


def _size(distance: float, angle: float) -> str:
    return f"{distance:.3g} m and {degrees(angle):.3g} degrees"
