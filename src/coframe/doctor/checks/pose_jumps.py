# SPDX-License-Identifier: Apache-2.0
"""TF020: edges that jump farther than a robot moves, or that alternate between two poses."""

from __future__ import annotations

from math import degrees
from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import times
from coframe.doctor._finding import Finding, Severity
from coframe.doctor._flicker import alternation_cause, flicker, jump_cause
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF020"
_MIN_SPEED = 30.0  # m/s
_MIN_DISTANCE = 0.5  # meters
_MIN_ANGLE = 1.5  # radians
_MIN_ANGULAR_SPEED = 30.0  # rad/s
_MIN_STEP_RATIO = 20.0  # times the median step
_MIN_JUMPS = 10


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per edge; flicker of one publisher is reported here, of several as TF003."""
    for edge in (edge.current for edge in observation.dynamic):
        if edge.count < _MIN_JUMPS:
            continue
        found = flicker(edge)
        if found is None:
            yield from _jumps(edge)
        elif len(edge.publishers) == 1:
            yield Finding(
                code=CODE,
                severity=Severity.WARNING,
                text=f"alternates {found.jumps} times between two poses, {found.distance:.3g} m and "
                f"{degrees(found.angle):.3g} degrees apart{alternation_cause(edge, found)}",
                fix=f"In {edge.publishers[0]}: check whether one filter has two inputs that disagree (odom0 and imu0 "
                "of robot_localization), or whether two timers publish the same child_frame_id.",
                edge=edge.key,
                first_stamp=int(edge.stamp[found.first]),
                publishers=edge.publishers,
            )


def _jumps(edge: Edge) -> Iterator[Finding]:
    seconds = np.maximum(np.abs(edge.steps), 1) / SECOND
    far = (edge.distances > _MIN_DISTANCE) & (edge.distances > _MIN_STEP_RATIO * np.median(edge.distances))
    far &= edge.distances / seconds > _MIN_SPEED
    has_rotated = (edge.rotation_steps > _MIN_ANGLE) & (
        edge.rotation_steps > _MIN_STEP_RATIO * np.median(edge.rotation_steps)
    )
    has_rotated &= edge.rotation_steps / seconds > _MIN_ANGULAR_SPEED
    rows = np.flatnonzero(far | has_rotated)
    if not len(rows):
        return
    worst = int(rows[np.argmax(edge.distances[rows] + edge.rotation_steps[rows])])
    cause = jump_cause(edge, rows)
    yield Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"jumps {times(len(rows))}, at worst {edge.distances[worst]:.3g} m and "
        f"{degrees(edge.rotation_steps[worst]):.3g} "
        f"degrees within {seconds[worst] * 1e3:.3g} ms"
        + (f"; after the jump, {cause.text('that before')}" if cause else ""),
        fix=cause.fix
        if cause
        else "If the jump is not intended (initialpose, a reset), limit what the estimator accepts "
        "(robot_localization: odom0_pose_rejection_threshold). Publish jumps only in map -> odom: odom -> base_link "
        "must be continuous (REP-105).",
        edge=edge.key,
        first_stamp=int(edge.stamp[worst + 1]),
        publishers=edge.publishers,
    )
