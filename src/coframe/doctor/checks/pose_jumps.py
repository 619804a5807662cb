"""TF020: links that jump farther than anything moves, or swing between two poses."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.doctor.flicker import flicker
from coframe.doctor.phrases import times

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF020"
_FAST = 30.0  # m/s
_FAR = 0.5  # metres
_TURNED = 1.5  # radians
_SPINNING = 30.0  # rad/s
_UNUSUAL = 20.0  # times the usual step
_LEAST = 10


def find(observation: Observation) -> Iterator[Finding]:
    """One finding a link; flicker of a single known publisher is told here, that of several in TF003."""
    for edge in (edge.current for edge in observation.dynamic):
        if edge.count < _LEAST:
            continue
        found = flicker(edge)
        if found is None:
            yield from _jumps(edge)
        elif len(edge.publishers) == 1:
            yield Finding(
                code=CODE,
                severity=Severity.WARNING,
                text=f"swings between two poses, {found.distance:.3g} m and {degrees(found.angle):.3g} degrees apart, "
                f"{found.jumps} times",
                fix=f"In {edge.publishers[0]}: does one filter get two sources that disagree (odom0 and imu0 of "
                "robot_localization),"
                " or do two timers send the same child_frame_id?",
                edge=edge.key,
                first_stamp=int(edge.stamp[found.first]),
                publishers=edge.publishers,
            )


def _jumps(edge: Edge) -> Iterator[Finding]:
    seconds = np.maximum(np.abs(edge.steps), 1) * 1e-9
    far = (edge.distances > _FAR) & (edge.distances > _UNUSUAL * np.median(edge.distances))
    far &= edge.distances / seconds > _FAST
    turned = (edge.turns > _TURNED) & (edge.turns > _UNUSUAL * np.median(edge.turns))
    turned &= edge.turns / seconds > _SPINNING
    rows = np.flatnonzero(far | turned)
    if not len(rows):
        return
    worst = int(rows[np.argmax(edge.distances[rows] + edge.turns[rows])])
    yield Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"jumps {times(len(rows))}, at worst {edge.distances[worst]:.3g} m and {degrees(edge.turns[worst]):.3g} "
        f"degrees within {seconds[worst] * 1e3:.3g} ms",
        fix="Was the robot set somewhere else (initialpose, a reset)? Else limit what the estimator takes in "
        "(robot_localization: odom0_pose_rejection_threshold), and keep jumps in map -> odom: odom -> base_link "
        "must be "
        "smooth (REP-105).",
        edge=edge.key,
        first_stamp=int(edge.stamp[worst + 1]),
        publishers=edge.publishers,
    )
