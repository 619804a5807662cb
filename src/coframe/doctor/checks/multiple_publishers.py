# SPDX-License-Identifier: Apache-2.0
"""TF003: an edge with several publishers whose poses differ, so that it flickers."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor._finding import Finding, Severity
from coframe.doctor._flicker import alternation_cause, flicker
from coframe.doctor._rules import drop_tracks
from coframe.doctor.pose_mistakes import explain_mutual_difference

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF003"
_CHANGES = 3


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per edge, based on its publishers if known, else on its poses."""
    for edge in (edge.current for edge in observation.edges):
        if len(edge.publishers) > 1:
            yield from _known_publishers(edge)
        elif not edge.publishers and not edge.static:
            yield from _unknown_publishers(edge)


def _known_publishers(edge: Edge) -> Iterator[Finding]:
    changes = int(np.count_nonzero(np.diff(edge.publisher)))
    if not edge.static and changes < _CHANGES:
        return  # one publisher replaced the other
    found = flicker(edge)
    differ = found is not None or (edge.static and not edge.constant)
    first, second, *_ = edge.publishers
    jumps = f": the pose jumps by {_size(found.distance, found.angle)} {found.jumps} times" if found else ""
    cause = _cause(edge) if differ and edge.static else alternation_cause(edge, found) if found else ""
    yield Finding(
        code=CODE,
        severity=Severity.ERROR if differ else Severity.NOTE,
        text=f"{len(edge.publishers)} publishers"
        + (f" with different poses{jumps}{cause}" if differ else " with equal or nearly equal poses"),
        fix=f"Stop {first} or {second}, or disable the transform in one of them (lab: publish_arm:=false; "
        "robot_localization: publish_tf: false; diff_drive_controller: enable_odom_tf: false).",
        harm="" if differ else "As soon as one of them lags behind or publishes another pose, the transform flickers.",
        edge=edge.key,
        first_stamp=edge.first_stamp,
        publishers=edge.publishers,
    )


def _cause(edge: Edge) -> str:
    """Return a clause with the mistake that explains the difference between two publishers of a static transform."""
    last = [np.flatnonzero(edge.publisher == number)[-1:] for number in dict.fromkeys(edge.publisher.tolist())]
    first, second = map(edge.poses, last[:2])
    explained = explain_mutual_difference(first, second)
    if explained is None:
        return ""
    mistake, in_first = explained
    wrong, right = edge.publishers[:2] if in_first else edge.publishers[1::-1]
    return f": {mistake.text(f'that of {right}', f'the pose of {wrong}')}"


def _unknown_publishers(edge: Edge) -> Iterator[Finding]:
    found = flicker(edge)
    if found is not None:
        yield Finding(
            code=CODE,
            severity=Severity.ERROR,
            text=f"the pose jumps by {_size(found.distance, found.angle)} and back {found.jumps} times, as with two "
            f"publishers that disagree{alternation_cause(edge, found)}; the recording does not contain their names",
            fix=f"On the running robot, `coframe doctor` names the publishers of {edge.name}: stop one of them.",
            edge=edge.key,
            first_stamp=int(edge.stamp[found.first]),
            choices=drop_tracks(edge.key),
        )


def _size(distance: float, angle: float) -> str:
    return f"{distance:.3g} m and {degrees(angle):.3g} degrees"
